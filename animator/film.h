// A clip as a film.
#pragma once

#include <functional>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/pipeline/posed_character.h"
#include "libskel/scene/scene.h"
#include "libskel/video/video_writer.h"

namespace skel {

struct FilmOptions {
  int width = 512, height = 512;
  double frame_rate = 30;  // 1/s
  double duration_s = 0;   // longer than the clip: it plays again and again; 0: the clip's
  Look look;
};

// Whole frames, at least one. The last one comes a frame before the end, so that films that loop do not stop;
// of a clip that is played once and does not end in its first pose, at its end.
int frameCount(const Clip& clip, const FilmOptions& options);
// The moment that a frame shows, of the clip played again and again.
double timeOf(int frame, const Clip& clip, const FilmOptions& options);

// Points that show where the figure ends: in the rest pose and at 32 moments of each clip; of clips that make
// too many points, at fewer.
Eigen::MatrixX3f outermostPoints(const RiggedCharacter& character, const std::vector<Clip>& clips);

// Shows all of the clips, from one side: the eye does not move.
Camera filmCamera(const RiggedCharacter& character, const std::vector<Clip>& clips, double yaw_rad,
                  double pitch_rad, double width_over_height);

// Frames into `video`, which is not finished, several painted at once if `concurrent`, while others are
// encoded. `paint` is called with the number of each, `on_frame` when it is written.
void writeFrames(int count, bool concurrent, const std::function<Image(int)>& paint, VideoWriter& video,
                 const std::function<void()>& on_frame);

// All frames of a film: `clip` is relative to the character's rest pose.
void writeFilm(const Scene& scene, const Clip& clip, const Camera& camera, const FilmOptions& options,
               VideoWriter& video, const std::function<void()>& on_frame);

}  // namespace skel
