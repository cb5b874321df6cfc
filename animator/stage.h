// A character before a camera that stays where it is.
#pragma once

#include <functional>
#include <memory>

#include "animator/flat_figure.h"
#include "animator/render_films.h"

namespace skel {

using MomentPainter = std::function<Image(double time_s)>;

class Stage {
 public:
  // Both outlive the stage. Throws UsageError: the character lacks the joint whose weights are asked for.
  Stage(const RenderCommandOptions& options, const Performer& performer);

  // Of one of the performer's clips, which the painter takes along. It is not to outlive the stage.
  MomentPainter painterOf(const Clip& clip, const FilmOptions& film) const;
  // Whether the clip tears much of a drawing however calm it is, which it then says on stderr, as it does
  // where the clip is calmer for that.
  bool sayTorn(const Clip& clip) const;
  // Whether several threads may paint at once.
  bool isConcurrent() const { return !scene_ || scene_->isConcurrent(); }
  // No more painters are made: frees what only they are made of.
  void forgetPictures() {
    if (flat_) flat_->forgetPictures();
  }

 private:
  const RenderCommandOptions& options_;
  const Performer& performer_;
  int weights_of_ = -1;
  std::vector<Clip> shown_;  // by the camera, whichever clip plays; empty: that one
  std::unique_ptr<FlatFigure> flat_;
  std::unique_ptr<Scene> scene_;
};

}  // namespace skel
