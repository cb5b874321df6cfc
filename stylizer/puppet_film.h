// A drawing that performs a motion.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "libskel/cutout/paint_cut_out.h"
#include "libskel/draw/color.h"
#include "libskel/video/video_writer.h"
#include "stylizer/puppet.h"

namespace skel {

struct FilmBackground {
  bool keep = false;     // that of the drawing, closed behind the figure
  Color color = kWhite;  // of a kept one, where the drawing is transparent
  Image picture;         // if not empty: instead of the colour, covering all of the film

  bool isTransparent() const { return picture.empty() && color.a < 255; }
};
// keep, a backgroundColor(), or a picture's file. Throws UsageError, InputError.
FilmBackground readBackground(const std::string& text);
// A drawing's own, to be kept in the film `output`: one that is transparent stays so, if the film can, else
// it is white.
FilmBackground keptBackground(const Image& drawing, const std::string& output);

struct PuppetFilmOptions {
  FilmBackground background;
  int size_px = 480;      // of the film's long side, at most
  double frame_rate = 0;  // 1/s; 0: the motion's
  double duration_s = 0;  // the motion repeats, or is cut
  bool loops = false;     // the first frame follows the last
};

struct PuppetFrames {
  int width = 0, height = 0;                         // px, even
  double scale = 1;                                  // film px a px of the drawing
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  // of the film's first pixel, in px of the drawing
  Image background;                                  // of the film's size
  PoseMatrix poses;                                  // one column a frame, px of the drawing
  double frame_rate = 0;
  double torn = 0;  // tornShare() of the frame that tears most
};

// How long a motion of frames at these times lasts, the last one as long as the others in the mean, or,
// alone, 1 / rate.
double motionLength_s(const std::vector<double>& times_s, double rate);

// `worn`: the motion as this body does it (wornBy()), one column a frame at `times_s`.
PuppetFrames layOut(const Puppet& puppet, const Performer& performer, const PoseMatrix& worn,
                    const std::vector<double>& times_s, const PuppetFilmOptions& options);

// `painter`: of the puppet, painterFor().
Image paintFrame(const Puppet& puppet, const CutOutPainter& painter, const PuppetFrames& frames,
                 std::size_t i);
CutOutPainter painterFor(const Puppet& puppet, const PuppetFrames& frames);

// All frames into `video`, several painted at once.
void writePuppetFilm(const Puppet& puppet, const PuppetFrames& frames, VideoWriter& video,
                     const std::function<void()>& on_frame);

}  // namespace skel
