#include "animator/document.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "animator/glb_output.h"
#include "animator/load_character.h"
#include "animator/pose_file.h"
#include "animator/rig_source.h"
#include "animator/rig_text.h"
#include "libskel/animation/clip_file.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/pose_hash.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/export/formats.h"
#include "libskel/import/read_weights.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

// Without "..", as far as that goes.
std::string shownPath(const std::string& path) { return fs::path(path).lexically_normal().string(); }

// Keys nearer than this are one.
constexpr double kSameTime_s = 1e-3;

Pose restPose(const Skeleton& skeleton) {
  Pose pose;
  pose.rotations.assign(skeleton.joints.size(), Eigen::Quaternionf::Identity());
  return pose;
}

// A value at a time among others that stand in their order.
template <class Value>
void putKey(std::vector<float>& times, std::vector<Value>& values, double time_s, const Value& value) {
  const auto at = std::lower_bound(times.begin(), times.end(), float(time_s - kSameTime_s));
  const auto i = at - times.begin();
  if (at != times.end() && std::abs(double(*at) - time_s) <= kSameTime_s) {
    values[std::size_t(i)] = value;
  } else {
    times.insert(at, float(time_s));
    values.insert(values.begin() + i, value);
  }
}

template <class Value>
void dropKey(std::vector<float>& times, std::vector<Value>& values, double time_s) {
  for (std::size_t i = times.size(); i-- > 0;)
    if (std::abs(double(times[i]) - time_s) <= kSameTime_s) {
      times.erase(times.begin() + std::ptrdiff_t(i));
      values.erase(values.begin() + std::ptrdiff_t(i));
    }
}

bool isEmpty(const JointTrack& track) {
  return track.times_s.empty() && track.translation_times_s.empty() && track.scale_times_s.empty();
}

bool moves(const Clip& clip) { return !clip.tracks.empty() || !clip.root_times_s.empty(); }

std::string savedKey(const std::string& path) { return fs::absolute(path).lexically_normal().string(); }

// As far as a typed number shows. Floats are no more of unit length than they can be.
bool sameTurn(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) {
  constexpr double kSame = 5e-4;  // rad
  return a.cast<double>().normalized().angularDistance(b.cast<double>().normalized()) < kSame;
}

std::size_t countTimes(const Clip& clip) {
  std::set<float> times(clip.root_times_s.begin(), clip.root_times_s.end());
  for (const JointTrack& track : clip.tracks) times.insert(track.times_s.begin(), track.times_s.end());
  return times.size();
}

// What to say where the clip of the file has become another one of more keys; or "".
std::string moreKeys(const std::string& path, const Clip& loaded) {
  if (!path.ends_with(kClipFileEnding)) return "";
  const Clip held = readClipFile(path);
  const std::size_t before = countTimes(held), now = countTimes(loaded);
  if (held.rest_pose.empty() || now <= before) return "";
  return "; its keys at " + std::to_string(before) + " moments are at " + std::to_string(now) +
         " here, as it is not for this character's rest pose";
}

}  // namespace

FilmExport::FilmExport(std::string path, std::shared_ptr<const RiggedCharacter> character, Clip clip,
                       Camera camera, FilmOptions options)
    : path_(std::move(path)), count_(frameCount(clip, options)) {
  VideoOptions video_options{
      .width = options.width, .height = options.height, .frame_rate = options.frame_rate};
  video_options.frames = count_;
  video_options.transparent = options.look.background.a < 255 && options.look.picture.empty();
  std::shared_ptr<VideoWriter> video = openVideo(path_, video_options);
  work_ = std::async(std::launch::async, [this, video, character, clip = std::move(clip), camera, options] {
    struct Stopped {};
    try {
      const Scene scene(*character, fastestPainter(character->mesh));
      writeFilm(scene, clip, camera, options, *video, [this] {
        ++done_;
        if (stop_) throw Stopped();
      });
      video->finish();
    } catch (const Stopped&) {
    }
  });
}

FilmExport::~FilmExport() {
  stop_ = true;
  if (work_.valid()) work_.wait();
}

bool FilmExport::isDone() const {
  return !work_.valid() || work_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void FilmExport::finish() {
  if (work_.valid()) work_.get();
}

// A step from here to the end of the scope, unless a larger one is open.
class AnimationDocument::StepScope {
 public:
  explicit StepScope(AnimationDocument& document) : document_(document) { document_.beginStep(); }
  ~StepScope() { document_.endStep(); }

 private:
  AnimationDocument& document_;
};

namespace {

// Nobody has asked for one clip of the folder: what is wrong with one of its files keeps no window from
// opening.
ClipSource asOffered(ClipSource library) {
  library.names = {""};
  return library;
}

}  // namespace

AnimationDocument::AnimationDocument(const CharacterSource& source, const ClipSource& library)
    : source_(source), library_(asOffered(library)) {
  CharacterFile file = loadCharacterWithClips(source, library_, &message_);
  name_ = file.name;
  bones_ = file.bones;
  ink_hull_ = file.ink_hull;
  state_.character = std::make_shared<const RiggedCharacter>(std::move(file.character));
  state_.clips = std::make_shared<const std::vector<Clip>>(std::move(file.clips));
  state_.pose = restPose(skeleton());
  takeEaseOfLibrary();
  setSaved(source.path, clips());
  on_disk_.note(source.path);
  if (!library.clips_dir.empty())
    for (const std::string& file : filesBelow(library.clips_dir))
      file.ends_with(kClipFileEnding) ? on_disk_.note(file) : on_disk_.noteUnread(file);
}

const Clip* AnimationDocument::clip() const {
  return state_.clip < 0 ? nullptr : &(*state_.clips)[std::size_t(state_.clip)];
}

JointTransforms AnimationDocument::posed() const {
  return posedFromRest(skeleton(), state_.pose, heightOf(character()));
}

double AnimationDocument::duration_s() const { return clip() ? double(clip()->duration_s()) : 0; }

Pose AnimationDocument::poseOfClip() const {
  return clip() ? samplePose(*clip(), skeleton(), float(state_.time_s)) : restPose(skeleton());
}

void AnimationDocument::takePoseFromClip() { state_.pose = poseOfClip(); }

bool AnimationDocument::standsAs(const Pose& pose) const {
  return pose.rotations.size() == state_.pose.rotations.size() &&
         std::equal(pose.rotations.begin(), pose.rotations.end(), state_.pose.rotations.begin(), sameTurn) &&
         state_.pose.root_translation.isApprox(pose.root_translation, 1e-6f);
}

void AnimationDocument::playOrPause() {
  if (!canPlay()) {
    message_ = clip() ? "nothing to play: the clip has no length" : "nothing to play: choose a clip";
    return;
  }
  if (!playing && !loops && state_.time_s >= duration_s()) setTime(0);
  playing = !playing;
}

bool AnimationDocument::advance(double seconds) {
  const double duration = duration_s();
  if (!playing || !canPlay()) return playing = false;
  double time_s = state_.time_s + seconds * speed;
  if (loops) {
    time_s = std::fmod(time_s, duration);
    if (time_s < 0) time_s += duration;
  } else if (time_s >= duration || time_s < 0) {
    time_s = std::clamp(time_s, 0.0, duration);
    playing = false;
  }
  setTime(time_s);
  return true;
}

void AnimationDocument::setTime(double time_s) {
  std::optional<StepScope> step;
  if (!standsAs(poseOfClip())) {
    step.emplace(*this);
    message_ = "what had no key is gone; undo brings it back";
  }
  state_.time_s = std::clamp(time_s, 0.0, duration_s());
  takePoseFromClip();
}

double AnimationDocument::snapped(double time_s) const {
  constexpr double kHalfFrame_s = 0.5 / kFrameRate;
  double nearest_s = std::round(time_s * kFrameRate) / kFrameRate;
  if (!clip()) return nearest_s;
  if (nearest_s > duration_s() || std::abs(duration_s() - time_s) < std::abs(nearest_s - time_s))
    nearest_s = duration_s();
  double way_s = kHalfFrame_s;
  const auto look = [&](const std::vector<float>& times_s) {
    for (const float key_s : times_s)
      if (std::abs(double(key_s) - time_s) < way_s) {
        way_s = std::abs(double(key_s) - time_s);
        nearest_s = double(key_s);
      }
  };
  for (const JointTrack& track : keyed().tracks)
    for (const auto* times_s : {&track.times_s, &track.translation_times_s, &track.scale_times_s})
      look(*times_s);
  look(keyed().root_times_s);
  return nearest_s;
}

void AnimationDocument::scrub(double time_s) { setTime(snapped(std::clamp(time_s, 0.0, duration_s()))); }

int AnimationDocument::jointAt(const Eigen::Vector2d& px, const Projection& projection,
                               double radius_px) const {
  const std::vector<Eigen::Vector3f> joints = posedJoints(skeleton(), posed());
  int best = -1;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto at = projection(joints[j].cast<double>());
    if (!at || (*at - px).norm() > radius_px) continue;
    radius_px = (*at - px).norm();
    best = int(j);
  }
  return best;
}

void AnimationDocument::chooseClip(int clip) {
  if (clip == state_.clip || clip < -1 || clip >= int(clips().size())) return;
  const StepScope step(*this);
  state_.clip = clip;
  state_.time_s = 0;
  takePoseFromClip();
  message_ = clip < 0 ? "no clip: the character rests" : "clip \"" + clips()[std::size_t(clip)].name + "\"";
}

std::string AnimationDocument::whyIdle(int joint) const {
  if (joint < 0 || carriesSkin(skeleton(), character().weights, joint)) return "";
  return '"' + skeleton().joints[std::size_t(joint)].name +
         "\" moves nothing of this figure: no skin follows it";
}

void AnimationDocument::sayIfIdle(int joint) {
  if (std::string why = whyIdle(joint); !why.empty()) message_ = std::move(why);
}

void AnimationDocument::choose(int joint) {
  if (message_ == whyIdle(chosen_)) message_.clear();
  chosen_ = joint;
  sayIfIdle(joint);
}

void AnimationDocument::turnJoint(int joint, int axis, double angle_rad) {
  const StepScope step(*this);
  sayIfIdle(joint);
  playing = false;
  Eigen::Quaternionf& turn = state_.pose.rotations[std::size_t(joint)];
  turn = (turn * Eigen::AngleAxisf(float(angle_rad), Eigen::Vector3f::Unit(axis))).normalized();
}

Eigen::Vector3d AnimationDocument::anglesOf(int joint) const {
  const Eigen::Matrix3d r = state_.pose.rotations[std::size_t(joint)].cast<double>().toRotationMatrix();
  const double y = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  // Straight up or down, x and z turn about the same axis: all of it is x.
  if (std::abs(r(2, 0)) > 1 - 1e-6) return {std::atan2(-r(1, 2), r(1, 1)), y, 0};
  return {std::atan2(r(2, 1), r(2, 2)), y, std::atan2(r(1, 0), r(0, 0))};
}

void AnimationDocument::setAngles(int joint, const Eigen::Vector3d& angles_rad) {
  const StepScope step(*this);
  sayIfIdle(joint);
  playing = false;
  state_.pose.rotations[std::size_t(joint)] = rotationOfAngles(angles_rad.cast<float>());
}

void AnimationDocument::resetJoint(int joint) {
  const StepScope step(*this);
  playing = false;
  const auto j = std::size_t(joint);
  state_.pose.rotations[j] = Eigen::Quaternionf::Identity();
  if (!state_.pose.translations_m.empty()) state_.pose.translations_m[j].setZero();
  if (!state_.pose.scales.empty()) state_.pose.scales[j].setOnes();
  if (skeleton().joints[j].parent < 0) state_.pose.root_translation.setZero();
  message_ = "\"" + skeleton().joints[j].name + "\" as in the rest pose";
}

void AnimationDocument::resetPose() {
  const StepScope step(*this);
  playing = false;
  state_.pose = restPose(skeleton());
  message_ = "the rest pose";
}

const ClipKeys* AnimationDocument::eased() const {
  if (!state_.eased) return nullptr;
  const auto at = state_.eased->find(clip()->name);
  return at == state_.eased->end() ? nullptr : &at->second;
}

ClipKeys AnimationDocument::keys() const { return eased() ? *eased() : ClipKeys{*clip()}; }

const Clip& AnimationDocument::keyed() const { return eased() ? eased()->clip : *clip(); }

void AnimationDocument::keepEase(const std::string& before, const ClipKeys& keys) {
  auto eased = std::make_shared<std::map<std::string, ClipKeys>>();
  if (state_.eased) *eased = *state_.eased;
  eased->erase(before);
  if (keys.ease != KeyEase::kNone) (*eased)[keys.clip.name] = keys;
  state_.eased = std::move(eased);
}

void AnimationDocument::takeEaseOfLibrary() {
  auto eased = std::make_shared<std::map<std::string, ClipKeys>>();
  for (ClipKeys& keys : easedKeysOf(library_, skeleton())) {
    // The character may have a clip of this name itself.
    if (std::find(clips().begin(), clips().end(), withEvenKeys(keys)) == clips().end()) continue;
    const std::string name = keys.clip.name;
    (*eased)[name] = std::move(keys);
  }
  state_.eased = std::move(eased);
}

void AnimationDocument::replaceKeys(const ClipKeys& keys) {
  Clip played = keys.clip;  // straight from key to key, should there be too many even ones
  try {
    played = withEvenKeys(keys);
  } catch (const InputError&) {
  }
  keepEase(clip()->name, keys);
  auto clips = std::make_shared<std::vector<Clip>>(*state_.clips);
  (*clips)[std::size_t(state_.clip)] = std::move(played);
  state_.clips = std::move(clips);
}

void AnimationDocument::setKey() {
  if (!clip()) {
    message_ = "keys need a clip: choose one, or make a new one";
    return;
  }
  playing = false;
  const Pose told = samplePose(*clip(), skeleton(), float(state_.time_s));
  ClipKeys edited = keys();
  Clip& changed = edited.clip;
  if (changed.interpolation == RotationInterpolation::kAngles) changed = withSlerp(changed);
  std::vector<int> joints;
  for (int j = 0; j < jointCount(); ++j)
    if (!sameTurn(told.rotations[std::size_t(j)], state_.pose.rotations[std::size_t(j)])) joints.push_back(j);
  if (joints.empty() && chosen_ >= 0) joints.push_back(chosen_);
  const bool moved = !state_.pose.root_translation.isApprox(told.root_translation, 1e-6f);
  if (joints.empty() && !moved) {
    message_ = "nothing to key: turn a joint, or choose one";
    return;
  }
  const StepScope step(*this);
  state_.time_s = std::min(snapped(state_.time_s), duration_s());
  for (const int j : joints) {
    const std::string& name = skeleton().joints[std::size_t(j)].name;
    auto track = std::find_if(changed.tracks.begin(), changed.tracks.end(),
                              [&](const JointTrack& t) { return t.joint == name; });
    if (track == changed.tracks.end()) {
      changed.tracks.push_back({name, {}, {}});
      track = changed.tracks.end() - 1;
    }
    track->angles_rad.clear();
    putKey(track->times_s, track->rotations, state_.time_s, state_.pose.rotations[std::size_t(j)]);
  }
  if (moved)
    putKey(changed.root_times_s, changed.root_translations, state_.time_s, state_.pose.root_translation);
  changed.lead_s = 0;  // the clip may no longer come from the rest pose, nor the feet stand
  changed.contacts.clear();
  replaceKeys(edited);
  takePoseFromClip();
  message_ = "key set for " + std::to_string(joints.size()) + (joints.size() == 1 ? " joint" : " joints");
}

void AnimationDocument::removeKey() {
  if (!clip()) return;
  const StepScope step(*this);
  ClipKeys edited = keys();
  Clip& changed = edited.clip;
  for (JointTrack& track : changed.tracks) {
    if (chosen_ >= 0 && track.joint != skeleton().joints[std::size_t(chosen_)].name) continue;
    if (!track.angles_rad.empty()) {
      std::vector<float> times = track.times_s;
      dropKey(times, track.angles_rad, state_.time_s);
    }
    dropKey(track.times_s, track.rotations, state_.time_s);
    dropKey(track.translation_times_s, track.translations_m, state_.time_s);
    dropKey(track.scale_times_s, track.scales, state_.time_s);
  }
  if (chosen_ <= 0) dropKey(changed.root_times_s, changed.root_translations, state_.time_s);
  std::erase_if(changed.tracks, isEmpty);
  // It stays as long as it was.
  changed.least_duration_s = std::max(changed.least_duration_s, clip()->duration_s());
  replaceKeys(edited);
  takePoseFromClip();
  message_ = "key removed";
}

void AnimationDocument::newClip(const std::string& name, double duration_s) {
  const StepScope step(*this);
  std::string unique = name;
  for (int i = 2; hasClip(clips(), unique); ++i) unique = name + "-" + std::to_string(i);
  auto clips = std::make_shared<std::vector<Clip>>(*state_.clips);
  Clip clip;
  clip.name = unique;
  clip.least_duration_s = float(duration_s);
  clips->push_back(std::move(clip));
  state_.clip = int(clips->size()) - 1;
  state_.clips = std::move(clips);
  state_.time_s = 0;
  takePoseFromClip();
  playing = false;
  message_ = "new clip \"" + unique + "\": pose the character and set keys";
}

void AnimationDocument::setDuration(double duration_s) {
  if (!clip()) return;
  const StepScope step(*this);
  ClipKeys edited = keys();
  Clip& changed = edited.clip;
  changed.least_duration_s = float(std::max(duration_s, 0.0));
  replaceKeys(edited);
  if (state_.time_s > this->duration_s()) setTime(this->duration_s());
}

bool AnimationDocument::hasOtherClip(const std::string& name) const {
  return std::any_of(clips().begin(), clips().end(),
                     [&](const Clip& other) { return &other != clip() && other.name == name; });
}

void AnimationDocument::renameClip(const std::string& name) {
  if (!clip() || name.empty() || name == clip()->name) return;
  if (hasOtherClip(name)) {
    message_ = "there is a clip \"" + name + "\" already";
    return;
  }
  const StepScope step(*this);
  ClipKeys edited = keys();
  Clip& changed = edited.clip;
  changed.name = name;
  chosen_names_.insert(name);
  replaceKeys(edited);
  message_ = "the clip is called \"" + name + "\"";
}

void AnimationDocument::setSaved(const std::string& path, const std::vector<Clip>& clips) {
  saved_[savedKey(path)] = clips;
}

void AnimationDocument::takeSavedFrom(const std::string& clip_file) {
  if (saved_.contains(savedKey(clip_file))) return;
  try {
    const Clip held = loadClipFor(clip_file, character(), library_);
    if (!isSaved(held)) return;
    for (auto& [file, clips] : saved_) std::erase(clips, held);
    setSaved(clip_file, {held});
  } catch (const Error&) {  // it is none of the clips, then
  }
}

bool AnimationDocument::isSaved(const Clip& clip) const {
  return std::any_of(saved_.begin(), saved_.end(), [&](const auto& file) {
    return std::find(file.second.begin(), file.second.end(), clip) != file.second.end();
  });
}

std::vector<std::string> AnimationDocument::unsavedClips() const {
  std::vector<std::string> names;
  for (const Clip& clip : clips())
    if (moves(clip) && !isSaved(clip)) names.push_back(clip.name);
  return names;
}

bool AnimationDocument::hasUnsavedPose() const {
  return !standsAs(poseOfClip()) && !(saved_pose_ && standsAs(*saved_pose_));
}

std::string AnimationDocument::unsavedBelow(const std::string& path) const {
  try {
    const std::string name = loadClipFor(path, character(), library_).name;
    const std::vector<std::string> unsaved = unsavedClips();
    return std::find(unsaved.begin(), unsaved.end(), name) == unsaved.end() ? "" : name;
  } catch (const Error&) {  // loadClip() says what is wrong with it
    return "";
  }
}

std::vector<double> AnimationDocument::keyTimes() const {
  std::vector<double> times;
  if (!clip()) return times;
  for (const JointTrack& track : keyed().tracks)
    if (chosen_ < 0 || track.joint == skeleton().joints[std::size_t(chosen_)].name)
      for (const auto* kind : {&track.times_s, &track.translation_times_s, &track.scale_times_s})
        times.insert(times.end(), kind->begin(), kind->end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end(), [](double a, double b) { return b - a < kSameTime_s; }),
              times.end());
  return times;
}

template <class Action>
bool AnimationDocument::attempt(const Action& action) {
  try {
    message_ = action();
    return true;
  } catch (...) {
    message_ = caughtError(source_.path).what();
  }
  return false;
}

bool AnimationDocument::openModel(const std::string& path) {
  return attempt([&] {
    CharacterSource source = source_;
    source.path = path;
    if (path != source_.path) source.skeleton.clear();
    std::string note;
    CharacterFile file = loadCharacterWithClips(source, library_, &note);
    const StepScope step(*this);
    playing = false;
    source_ = source;
    on_disk_.note(path);
    name_ = file.name;
    bones_ = file.bones;
    ink_hull_ = file.ink_hull;
    state_.character = std::make_shared<const RiggedCharacter>(std::move(file.character));
    state_.clips = std::make_shared<const std::vector<Clip>>(std::move(file.clips));
    takeEaseOfLibrary();
    state_.clip = -1;
    state_.time_s = 0;
    state_.pose = restPose(skeleton());
    chosen_ = -1;
    setSaved(path, clips());
    return note.empty() ? "opened " + path : note;
  });
}

void AnimationDocument::save(const std::string& path, std::string_view ending, std::string_view bytes) {
  if (on_disk_.hasChanged(path))
    throw OutputError(
        path, "was changed elsewhere since it was read or saved here; load it, or save under another name");
  path.ends_with(ending) ? replaceFile(path, bytes) : writeFile(path, bytes);
  on_disk_.note(path);
}

bool AnimationDocument::saveModel(const std::string& path) {
  return attempt([&] {
    // An animation without channels is none.
    std::vector<Clip> clips;
    std::copy_if(this->clips().begin(), this->clips().end(), std::back_inserter(clips), moves);
    ExportOptions options;
    options.name = name_;
    options.bones = bones_;
    options.ink_hull = ink_hull_;
    options.generator = kWrittenByView;
    save(path, ".glb", encodeGlb(character(), clips, options));
    setSaved(path, clips);
    return "saved " + shownPath(path);
  });
}

bool AnimationDocument::loadPose(const std::string& path) {
  return attempt([&] {
    Pose pose = parsePose(readFile(path), path, skeleton());
    on_disk_.note(path);
    const StepScope step(*this);
    playing = false;
    saved_pose_ = pose;
    state_.pose = std::move(pose);
    return "loaded " + path;
  });
}

bool AnimationDocument::savePose(const std::string& path) {
  return attempt([&] {
    save(path, kPoseFileEnding, formatPose(state_.pose, skeleton()));
    saved_pose_ = state_.pose;
    return "saved " + shownPath(path);
  });
}

bool AnimationDocument::loadClip(const std::string& path) {
  return attempt([&] {
    Clip clip = loadClipFor(path, character(), library_);
    const std::optional<ClipKeys> eased = easedKeysOf(path, skeleton());
    if (eased) clip = withEvenKeys(*eased);
    const bool loses_ease = !eased && easedKeysIn(path);
    const std::string more_keys = loses_ease || eased ? "" : moreKeys(path, clip);
    on_disk_.note(path);
    setSaved(path, {clip});
    files_[clip.name] = path;
    const StepScope step(*this);
    keepEase(clip.name, eased.value_or(ClipKeys()));
    playing = false;
    auto clips = std::make_shared<std::vector<Clip>>(*state_.clips);
    const auto same =
        std::find_if(clips->begin(), clips->end(), [&](const Clip& c) { return c.name == clip.name; });
    state_.clip = int(same - clips->begin());
    if (same == clips->end())
      clips->push_back(std::move(clip));
    else
      *same = std::move(clip);
    state_.clips = std::move(clips);
    state_.time_s = 0;
    takePoseFromClip();
    return "loaded " + path +
           (loses_ease ? "; its ease is even keys here, as it is not for this character's rest pose"
                       : more_keys);
  });
}

std::string AnimationDocument::fileOfClip() const {
  if (!clip()) return "";
  const auto known = files_.find(clip()->name);
  std::vector<std::string> paths;
  if (known != files_.end())
    paths = {known->second};
  else if (!library_.clips_dir.empty())
    paths = filesBelow(library_.clips_dir);
  for (const std::string& path : paths) {
    if (!path.ends_with(kClipFileEnding)) continue;
    try {
      const Clip held = readClipFile(path);
      if (held.name != clip()->name || held.rest_pose != restPoseHash(skeleton())) continue;
      // The character may have a clip of this name itself.
      if (known != files_.end() || isSaved(loadClipFor(path, character(), library_))) return path;
    } catch (const InputError&) {
    }
  }
  return "";
}

bool AnimationDocument::isFileOfClip(const std::string& path) const {
  const auto known = files_.find(clip()->name);
  const std::string file = known != files_.end() ? known->second : fileOfClip();
  return !file.empty() && savedKey(file) == savedKey(path);
}

std::string AnimationDocument::fileForClip() const {
  if (std::string own = fileOfClip(); !own.empty()) return own;
  const auto loaded = clip() ? files_.find(clip()->name) : files_.end();
  if (loaded == files_.end()) return "";
  const fs::path folder = fs::path(loaded->second).parent_path();
  return (folder / (clipNameIn(loaded->second) + "-" + stemOf(source_.path) + kClipFileEnding)).string();
}

bool AnimationDocument::saveClip(const std::string& path) {
  return attempt([&] {
    if (!clip()) throw UsageError("there is no clip to save: choose one, or make a new one");
    const std::string name = clipNameIn(path);
    const bool other_name = !name.empty() && name != safeFileName(clip()->name) && !isFileOfClip(path);
    const bool follows = other_name && !chosen_names_.contains(clip()->name) && !hasOtherClip(name);
    ClipKeys named = keys();
    if (follows) named.clip.name = name;  // a second clip, then
    takeSavedFrom(path);
    save(path, kClipFileEnding, formatClipKeys(madeFor(skeleton(), named)));
    setSaved(path, {withEvenKeys(named)});
    files_[named.clip.name] = path;
    if (follows) {
      const StepScope step(*this);
      replaceKeys(named);
    }
    if (!other_name) return "saved " + shownPath(path);
    return "saved " + shownPath(path) + "; the clip is " + (follows ? "now" : "still") + " called \"" +
           named.clip.name + '"' + (hasOtherClip(name) ? ", as there is another \"" + name + '"' : "");
  });
}

bool AnimationDocument::loadSkeleton(const std::string& path) {
  return attempt([&] {
    Skeleton skeleton = readSkeletonFor(character().mesh, path, "auto", nullptr, nullptr);
    on_disk_.note(path);
    RiggedCharacter changed = character();
    changed.weights = computeSkinWeights(changed.mesh, skeleton, SkinMethod::kGeodesic);
    changed.skeleton = std::move(skeleton);
    const StepScope step(*this);
    playing = false;
    state_.character = std::make_shared<const RiggedCharacter>(std::move(changed));
    // Clips that were made for other bones go, but for those that say what they need.
    state_.clips = std::make_shared<const std::vector<Clip>>(libraryFor(character(), library_));
    takeEaseOfLibrary();
    setSaved(path, clips());
    state_.clip = -1;
    state_.time_s = 0;
    state_.pose = restPose(this->skeleton());
    chosen_ = -1;
    return "loaded " + path + " and computed the weights anew";
  });
}

bool AnimationDocument::saveSkeleton(const std::string& path) {
  return attempt([&] {
    save(path, ".json", formatRig(skeleton()));
    return "saved " + shownPath(path);
  });
}

bool AnimationDocument::loadWeights(const std::string& path) {
  return attempt([&] {
    RiggedCharacter changed = character();
    changed.weights = readWeights(path, changed);
    on_disk_.note(path);
    const StepScope step(*this);
    state_.character = std::make_shared<const RiggedCharacter>(std::move(changed));
    return "loaded " + path;
  });
}

bool AnimationDocument::saveWeights(const std::string& path) {
  return attempt([&] {
    save(path, ".weights.json", exportWeights({character(), clips(), {}}).front().bytes);
    return "saved " + shownPath(path);
  });
}

std::unique_ptr<FilmExport> AnimationDocument::exportFilm(const std::string& path, const Camera& camera,
                                                          const FilmOptions& options) {
  std::unique_ptr<FilmExport> film;
  attempt([&] {
    Clip shown;
    if (clip() && duration_s() > 0) {
      shown = *clip();
    } else {
      shown = clipOfPose(state_.pose, skeleton(), "pose");
    }
    film = std::make_unique<FilmExport>(path, state_.character, std::move(shown), camera, options);
    return "writing " + path;
  });
  return film;
}

void AnimationDocument::beginStep() {
  if (open_steps_++ == 0) before_ = state_;
}

void AnimationDocument::endStep() {
  if (--open_steps_ > 0) return;
  history_.push(std::move(before_));
}

bool AnimationDocument::travel(AnimationState& step) {
  playing = false;
  std::swap(state_, step);
  if (chosen_ >= jointCount()) chosen_ = -1;
  return true;
}

std::string AnimationDocument::changedElsewhere() const {
  std::vector<std::string> changed;
  if (on_disk_.hasChanged(source_.path)) changed.push_back(source_.path);
  if (const auto of_clip = clip() ? files_.find(clip()->name) : files_.end();
      of_clip != files_.end() && on_disk_.hasChanged(of_clip->second))
    changed.push_back(of_clip->second);
  if (changed.empty()) return "";
  return "; changed elsewhere since it was read or saved here: " + joined(changed);
}

bool AnimationDocument::undo() {
  if (!history_.undo([&](AnimationState& step) { return travel(step); })) return false;
  message_ = "undone" + changedElsewhere();
  return true;
}

bool AnimationDocument::redo() {
  if (!history_.redo([&](AnimationState& step) { return travel(step); })) return false;
  message_ = "done again" + changedElsewhere();
  return true;
}

}  // namespace skel
