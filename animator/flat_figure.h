// A drawing that performs clips as it was drawn: a cut-out in the picture plane.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "animator/film.h"
#include "libskel/cutout/cut_out.h"
#include "libskel/cutout/paint_cut_out.h"
#include "libskel/pipeline/drawn_cut_out.h"
#include "libskel/pipeline/rig_character.h"

namespace skel {

// Whether films of it look better as it was drawn than as a model: by eye (docs/looks.md) those of people do,
// unless their joints are a guess. Then more is torn than a model shows.
bool looksBetterFlat(const RiggedDrawing& drawing);

// A clause where the clip turns the head aside, which a drawing seen from one side does not show.
std::optional<std::string> unseenTurn(const RiggedDrawing& drawing, const Clip& clip);

class FlatFigure {
 public:
  // The drawing outlives the figure.
  explicit FlatFigure(const RiggedDrawing& drawing);

  // Kept by the clip's name; one thread at a time.
  Calm calmFor(const Clip& clip) const;

  // As filmCamera(), straight from the front.
  Camera camera(const std::vector<Clip>& clips, double width_over_height) const;

  // Of the look, the background and the skeleton are shown. `painter`: for this camera and size, see
  // painterFor().
  Image paint(const Clip& clip, const Calm& calm, double time_s, const Camera& camera,
              const CutOutPainter& painter, const FilmOptions& options) const;
  CutOutPainter painterFor(const Camera& camera, int height) const;
  // No more painters are made. The drawing's own pictures are not needed from its construction on.
  void forgetPictures();

 private:
  const RiggedDrawing& drawing_;
  CutOut cut_out_;
  mutable std::map<std::string, Calm> calm_;
};

}  // namespace skel
