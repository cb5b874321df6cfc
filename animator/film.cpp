#include "animator/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <map>
#include <set>

#include "libskel/core/parallel.h"

namespace skel {
namespace {

// Frames that are painted together: enough for all cores, few enough to take little memory.
constexpr int kBatch = 8;
// Moments of a clip that decide what the camera shows, and points of all of them together: a hundred clips of
// a hundred joints have a quarter of that.
constexpr int kMoments = 32;
constexpr std::size_t kMostPoints = 20'000'000;

// Where there is no thread to be had, frames are encoded when they are asked for.
constexpr auto kAtOnceIfPossible = std::launch::async | std::launch::deferred;

// The vertices that reach farthest in 26 directions, of those that each joint moves most: they say where the
// figure ends in any pose.
std::vector<Eigen::Index> outermostVertices(const RiggedCharacter& character) {
  Eigen::Matrix<float, 3, 26> directions;
  int count = 0;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0)
          directions.col(count++) = Eigen::Vector3f(float(x), float(y), float(z)).normalized();
  using Reach = std::array<std::pair<float, Eigen::Index>, 26>;
  std::map<int, Reach> reach_of_joint;
  const Eigen::MatrixX3f& vertices = character.mesh.vertices;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    Eigen::Index most;
    character.weights.weights.row(v).maxCoeff(&most);
    const Eigen::Matrix<float, 1, 26> ways = vertices.row(v) * directions;
    const auto [joint, is_new] = reach_of_joint.try_emplace(character.weights.joints(v, most));
    for (int d = 0; d < 26; ++d)
      if (auto& farthest = joint->second[std::size_t(d)]; is_new || ways[d] > farthest.first)
        farthest = {ways[d], v};
  }
  std::set<Eigen::Index> outermost;
  for (const auto& [joint, reach] : reach_of_joint)
    for (const auto& [way, vertex] : reach) outermost.insert(vertex);
  return {outermost.begin(), outermost.end()};
}

// Ends in the pose that it begins in, so that it may be played again and again.
bool comesBack(const Clip& clip) {
  constexpr float kSame_rad = 0.01F, kSame = 1e-3F;  // of the height, of a size; m
  if (clip.loops) return true;
  const auto apart = [](const auto& values) {
    return !values.empty() && (values.front() - values.back()).norm() > kSame;
  };
  for (const JointTrack& track : clip.tracks)
    if ((!track.rotations.empty() &&
         track.rotations.front().angularDistance(track.rotations.back()) > kSame_rad) ||
        apart(track.translations_m) || apart(track.scales))
      return false;
  return !apart(clip.root_translations);
}

bool showsItsEnd(const Clip& clip, const FilmOptions& options) {
  return options.duration_s == 0 && !comesBack(clip);
}

}  // namespace

int frameCount(const Clip& clip, const FilmOptions& options) {
  const double duration_s = options.duration_s > 0 ? options.duration_s : double(clip.duration_s());
  const int count = std::max(1, int(std::lround(duration_s * options.frame_rate)));
  return showsItsEnd(clip, options) ? count + 1 : count;
}

double timeOf(int frame, const Clip& clip, const FilmOptions& options) {
  const double time_s = frame / options.frame_rate;
  return showsItsEnd(clip, options) && frame < frameCount(clip, options)
             ? std::min(time_s, double(clip.duration_s()))
             : time_s;
}

Eigen::MatrixX3f outermostPoints(const RiggedCharacter& character, const std::vector<Clip>& clips) {
  const std::vector<Eigen::Index> outermost = outermostVertices(character);
  const Eigen::MatrixX3f vertices = character.mesh.vertices(outermost, Eigen::all);
  SkinWeights weights;
  weights.joints = character.weights.joints(outermost, Eigen::all);
  weights.weights = character.weights.weights(outermost, Eigen::all);
  const Eigen::Index count = vertices.rows();
  const std::size_t moments = clips.size() * kMoments,
                    most = kMostPoints / (std::size_t(count) + character.skeleton.joints.size()),
                    looks = std::min(moments, most);
  Eigen::MatrixX3f all((Eigen::Index(looks) + 1) * count, 3);
  all.topRows(count) = vertices;
  parallelFor(looks, 0, [&](std::size_t i) {
    const std::size_t moment = i * moments / looks;  // evenly, where they are too many
    const Clip& clip = clips[moment / kMoments];
    const double share = double(moment % kMoments) / kMoments;
    all.middleRows((Eigen::Index(i) + 1) * count, count) =
        skinVertices(vertices, weights, posedAt(character, clip, double(clip.duration_s()) * share));
  });
  return all;
}

Camera filmCamera(const RiggedCharacter& character, const std::vector<Clip>& clips, double yaw_rad,
                  double pitch_rad, double width_over_height) {
  return framingCamera(outermostPoints(character, clips), yaw_rad, pitch_rad, width_over_height);
}

void writeFrames(int count, bool concurrent, const std::function<Image(int)>& paint, VideoWriter& video,
                 const std::function<void()>& on_frame) {
  std::future<void> encoded;
  for (int first = 0; first < count; first += kBatch) {
    std::vector<Image> frames(std::size_t(std::min(kBatch, count - first)));
    parallelFor(frames.size(), concurrent ? 0 : 1, [&](std::size_t i) { frames[i] = paint(first + int(i)); });
    if (encoded.valid()) encoded.get();
    encoded = std::async(kAtOnceIfPossible, [&video, &on_frame, frames = std::move(frames)] {
      for (const Image& frame : frames) {
        video.add(frame);
        on_frame();
      }
    });
  }
  encoded.get();
}

void writeFilm(const Scene& scene, const Clip& clip, const Camera& camera, const FilmOptions& options,
               VideoWriter& video, const std::function<void()>& on_frame) {
  const auto paint = [&](int frame) {
    return scene.paint(posedAt(scene.character(), clip, timeOf(frame, clip, options)), camera, options.width,
                       options.height, options.look);
  };
  writeFrames(frameCount(clip, options), scene.isConcurrent(), paint, video, on_frame);
}

}  // namespace skel
