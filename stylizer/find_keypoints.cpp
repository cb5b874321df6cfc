#include "stylizer/find_keypoints.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/video/frame_file.h"
#include "libskel/video/outline_distance.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

// The mean colour of the figure in a disc around a joint, in [0, 1].
Eigen::Vector3d colorAt(const Image& image, const Plane8& figure, const Eigen::Vector2d& at,
                        double radius_px) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  const int reach = std::max(1, int(std::lround(radius_px)));
  const int cx = int(std::lround(at.x())), cy = int(std::lround(at.y()));
  for (int y = std::max(0, cy - reach); y <= std::min(image.height - 1, cy + reach); ++y)
    for (int x = std::max(0, cx - reach); x <= std::min(image.width - 1, cx + reach); ++x) {
      if (figure(y, x) == 0 || std::hypot(x - at.x(), y - at.y()) > radius_px) continue;
      const std::uint8_t* p = image.pixel(x, y);
      sum += Eigen::Vector3d(p[0], p[1], p[2]) / 255;
      ++count;
    }
  return count > 0 ? Eigen::Vector3d(sum / count) : Eigen::Vector3d::Constant(0.5);
}

constexpr std::size_t kAskedFrames = 5;  // for the body plan of their figure

struct Sighting {
  bool found = false;
  std::string plan;  // of the figure, where it was asked
  Skeleton skeleton;
  Eigen::VectorXd colors;
  double long_side_px = 0;
  FrameOutline outline;
};

RigInput inputOf(const FilmFrame& frame, FigureMethod method) {
  RigInput input;
  input.image = frame.video.image;
  if (method == FigureMethod::kStill) input.mask = frame.figure;
  return input;
}

Sighting look(const FilmFrame& frame, FigureMethod method, const RigOptions& rig) {
  Sighting sighting;
  sighting.outline = outlineOf(frame.figure);
  if (sighting.outline.points.empty()) return sighting;
  const RiggedDrawing drawing = rigCharacter(inputOf(frame, method), rig);
  if (!drawing.found()) return sighting;
  sighting.found = true;
  sighting.skeleton = drawing.recognition.skeleton;
  sighting.long_side_px = kWorkingGridSize / drawing.silhouette.grid.scale;
  sighting.colors.resize(3 * Eigen::Index(sighting.skeleton.joints.size()));
  std::vector<Eigen::Vector2d> looked_at;
  for (const Joint& joint : sighting.skeleton.joints) looked_at.push_back(joint.image);
  for (const TemplateLimb& limb : rig.body_plan.limbs) {
    const auto at = [&](int j) {
      return std::size_t(sighting.skeleton.index(rig.body_plan.joints[std::size_t(j)].name));
    };
    const std::size_t middle = at(limb.joints[1]), end = at(limb.joints[2]);
    looked_at[end] = (sighting.skeleton.joints[middle].image + sighting.skeleton.joints[end].image) / 2;
  }
  for (std::size_t j = 0; j < looked_at.size(); ++j)
    sighting.colors.segment<3>(3 * Eigen::Index(j)) =
        colorAt(drawing.image, drawing.silhouette.mask, looked_at[j], 0.02 * sighting.long_side_px);
  return sighting;
}

std::string otherPlanOfMost(const std::vector<Sighting>& sightings) {
  std::map<std::string, int> votes;
  int asked = 0;
  for (const Sighting& sighting : sightings)
    if (!sighting.plan.empty()) ++asked, ++votes[sighting.plan];
  for (const auto& [plan, count] : votes)
    if (plan != "biped" && 2 * count > asked) return plan;
  return "";
}

// Frames beside each other; those without a figure stay where the last one was, and count nothing.
JointSightings sideBySide(const std::vector<Sighting>& all, const SkeletonTemplate& plan) {
  const Eigen::Index joints = Eigen::Index(plan.joints.size()), m = Eigen::Index(all.size());
  JointSightings seen{PoseMatrix::Zero(2 * joints, m), Eigen::MatrixXd::Zero(joints, m),
                      Eigen::MatrixXd::Constant(3 * joints, m, 0.5), 1, false};
  std::vector<double> sides;
  std::size_t last = 0;
  while (!all[last].found) ++last;
  for (Eigen::Index f = 0; f < m; ++f) {
    const bool found = all[std::size_t(f)].found;
    if (found) last = std::size_t(f);
    const Sighting& s = all[last];
    if (found) sides.push_back(s.long_side_px);
    for (const Joint& joint : s.skeleton.joints) {
      const int j = plan.find(joint.name), at = s.skeleton.index(joint.name);
      seen.places.col(f).segment<2>(2 * j) = joint.image;
      seen.confidences(j, f) = found ? std::max(joint.confidence, 0.05) : 0;
      seen.colors.col(f).segment<3>(3 * j) = s.colors.segment<3>(3 * at);
    }
  }
  std::nth_element(sides.begin(), sides.begin() + Eigen::Index(sides.size() / 2), sides.end());
  seen.figure_px = sides[sides.size() / 2];
  return seen;
}

// Read once more rather than kept whole, or written before it is known that they show anything.
void writePictures(const FilmSource& film, const std::vector<MotionFrame>& frames, const fs::path& beside) {
  const auto reader = readVideo(film.path, film.frame_rate);
  VideoFrame frame;
  for (std::size_t i = 0; i < frames.size() && reader->next(frame) && frame.file.empty(); ++i)
    writeFile((beside / frames[i].image_file).string(), encodeFrame(frame.image));
}

// By the outlines, which know nothing of limbs that are taken for each other.
bool outlinesLoop(const std::vector<FrameOutline>& outlines, const Eigen::VectorXd& successive) {
  return outlines.size() >= 4 && successive.maxCoeff() > 0 &&
         hausdorffDistance(outlines.back(), outlines.front()) <= 1.5 * successive.maxCoeff();
}

}  // namespace

std::string filmName(const std::string& path) {
  const std::string name = fs::path(path).lexically_normal().filename().string();
  return name.empty() ? fs::path(path).parent_path().filename().string() : name;
}

void sayOtherPlan(const Keypoints& found, const std::string& film) {
  if (found.other_plan.empty()) return;
  std::fprintf(stderr,
               "%s: note: shows a %s's figure, and these motions are a person's: look at its joints "
               "(skel-style inspect)\n",
               printable(film).c_str(), found.other_plan.c_str());
}

void sayUnusedRate(const FilmSource& film) {
  if (film.frame_rate_given && !fs::is_directory(film.path))
    std::fprintf(
        stderr,
        "%s: note: a film says itself how many frames a second it has; --fps is for folders of frames\n",
        printable(film.path).c_str());
}

void sayAssumedRate(const FilmSource& film) {
  if (film.frame_rate_given || !fs::is_directory(film.path)) return;
  std::fprintf(stderr, "%s: note: %g frames a second assumed; --fps says another\n",
               printable(film.path).c_str(), film.frame_rate);
}

Keypoints findKeypoints(const KeypointOptions& options) {
  const SkeletonTemplate plan = loadTemplate("biped");
  Image background;
  const FilmInfo info = lookAtFilm(options.film, background);
  RigOptions rig;
  rig.body_plan = plan;
  rig.upright = true;
  rig.last = LastStage::kJoints;

  RigOptions any_plan = rigOptionsWithoutClips("auto");
  any_plan.upright = rig.upright;
  any_plan.last = rig.last;
  const std::size_t every = std::max<std::size_t>(1, std::size_t(info.frames) / kAskedFrames);

  Keypoints result;
  result.motion.frame_rate = std::clamp(info.frame_rate, kMinFrameRate, kMaxFrameRate);
  result.motion.source = filmName(options.film.path);
  result.motion.action = options.action;
  result.motion.frames.resize(std::size_t(info.frames));
  std::vector<Sighting> sightings(static_cast<std::size_t>(info.frames));
  const fs::path file = options.output;
  std::string stem = file.filename().string();
  if (stem.ends_with(kMotionFileEnding)) stem.resize(stem.size() - std::string(kMotionFileEnding).size());
  const fs::path pictures = file.parent_path() / (stem + ".frames");
  checkFrames(pictures.string(), "frame-");
  {
    ProgressBar bar("key points", std::size_t(info.frames));
    forEachFrame(options.film, info, background, [&](std::size_t i, FilmFrame& frame) {
      MotionFrame& out = result.motion.frames[i];
      std::string picture = frame.video.file;
      if (picture.empty()) {
        char name[32];
        std::snprintf(name, sizeof name, "frame-%04d.png", int(i) + 1);
        picture = (pictures / name).string();
      }
      out.image_file = pathSeenFrom(options.output, picture);
      out.image_width = frame.video.image.width;
      out.image_height = frame.video.image.height;
      out.time_s = frame.video.time_s;
      sightings[i] = look(frame, info.method, rig);
      if (sightings[i].found && i % every == 0)
        sightings[i].plan = rigCharacter(inputOf(frame, info.method), any_plan).body_plan.name;
      bar.advance();
    });
  }
  result.without_figure =
      int(std::count_if(sightings.begin(), sightings.end(), [](const Sighting& s) { return !s.found; }));
  if (result.without_figure == info.frames)
    throw InputError(options.film.path, "shows no figure in any frame");

  result.other_plan = otherPlanOfMost(sightings);

  std::vector<FrameOutline> outlines;
  for (Sighting& s : sightings) outlines.push_back(std::move(s.outline));
  const Eigen::VectorXd successive = successiveDistances(outlines);
  for (const int key : keyFrames(successive, options.threshold))
    result.motion.frames[std::size_t(key)].key = true;

  JointSightings seen = sideBySide(sightings, plan);
  seen.loop = options.loop == "auto" ? outlinesLoop(outlines, successive) : options.loop == "yes";
  seen.frame_rate = result.motion.frame_rate;
  const JointTracks tracks = trackJoints(seen, plan, options.track);
  result.loop = seen.loop;
  result.unevenness_seen = unevenness(seen.places, seen.figure_px);
  result.unevenness = unevenness(tracks.places, seen.figure_px);
  result.arms_swapped = int(std::count(tracks.arms_swapped.begin(), tracks.arms_swapped.end(), true));
  result.legs_swapped = int(std::count(tracks.legs_swapped.begin(), tracks.legs_swapped.end(), true));
  for (std::size_t f = 0; f < sightings.size(); ++f) {
    MotionFrame& frame = result.motion.frames[f];
    const Eigen::Vector2d corner(frame.image_width - 0.5, frame.image_height - 0.5);
    for (std::size_t j = 0; j < plan.joints.size(); ++j) {
      const Eigen::Vector2d at = jointOf(tracks.places, int(j), Eigen::Index(f));
      const double confidence = std::clamp(tracks.confidences(Eigen::Index(j), Eigen::Index(f)), 0., 1.);
      frame.joints.push_back(PlacedJoint{at.cwiseMax(-0.5).cwiseMin(corner), confidence,
                                         confidence < 0.3         ? JointOrigin::kCompleted
                                         : plan.joints[j].derived ? JointOrigin::kDerived
                                                                  : JointOrigin::kRecognized});
    }
  }
  writePictures(options.film, result.motion.frames, file.parent_path());
  return result;
}

}  // namespace skel
