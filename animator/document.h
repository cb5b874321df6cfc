// What the window of skel-animate shows and does, without the window: a character, its clips, the pose that
// it is in, playing, the steps that change any of these, and undo of every step.
#pragma once

#include <atomic>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "animator/film.h"
#include "animator/load_character.h"
#include "libskel/animation/clip_file.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/core/files_left.h"
#include "libskel/core/undo_history.h"
#include "libskel/export/write_character.h"
#include "libskel/scene/scene.h"

namespace skel {

inline constexpr double kFrameRate = 30;  // of the window's frames, and of films unless told otherwise, 1/s

// What steps change and undo brings back. Whatever is large is shared and never changes, so that copies are
// cheap.
struct AnimationState {
  std::shared_ptr<const RiggedCharacter> character;
  std::shared_ptr<const std::vector<Clip>> clips;  // relative to the character's rest pose
  // Of those that ease, by their names, what is edited: `clips` has even keys in place of these.
  std::shared_ptr<const std::map<std::string, ClipKeys>> eased;
  int clip = -1;  // -1: none, the character rests
  double time_s = 0;
  Pose pose;
};

// A film that is being written on a thread of its own.
class FilmExport {
 public:
  FilmExport(std::string path, std::shared_ptr<const RiggedCharacter> character, Clip clip, Camera camera,
             FilmOptions options);
  ~FilmExport();  // stops it

  const std::string& path() const { return path_; }
  float share() const { return float(done_) / float(count_); }
  bool isDone() const;
  // Waits; throws what went wrong.
  void finish();

 private:
  std::string path_;
  int count_;
  std::atomic<int> done_ = 0;
  std::atomic<bool> stop_ = false;
  std::future<void> work_;
};

class AnimationDocument {
 public:
  // See loadCharacter(). Throws InputError.
  explicit AnimationDocument(const CharacterSource& source, const ClipSource& library = {});

  const AnimationState& state() const { return state_; }
  const RiggedCharacter& character() const { return *state_.character; }
  const Skeleton& skeleton() const { return state_.character->skeleton; }
  const std::vector<Clip>& clips() const { return *state_.clips; }
  const Clip* clip() const;  // null: none
  const std::string& path() const { return source_.path; }
  int jointCount() const { return int(skeleton().joints.size()); }
  // One line about the last step, or why it was refused.
  const std::string& message() const { return message_; }
  void say(const std::string& message) { message_ = message; }
  // In the pose that is shown.
  JointTransforms posed() const;

  // Time. These take the pose from the clip, and are steps only where joints have been turned and got no key.
  bool playing = false, loops = true;
  double speed = 1;
  double duration_s() const;
  bool canPlay() const { return duration_s() > 0; }
  // From the start if it stands at the end; says so if there is nothing to play.
  void playOrPause();
  // Goes on by so much time of the watch; false if nothing moves.
  bool advance(double seconds);
  void setTime(double time_s);
  // To the key, or else the frame or the end, that is nearest.
  void scrub(double time_s);

  // The joint that keys and numbers speak of; -1: none.
  int chosen() const { return chosen_; }
  void choose(int joint);
  // The nearest within `radius_px`; -1 if there is none.
  int jointAt(const Eigen::Vector2d& px, const Projection& projection, double radius_px) const;

  // Steps. Between beginStep() and endStep() several make one.
  void chooseClip(int clip);
  // By so much about an axis of the joint's own, as it stands (0, 1, 2: x, y, z).
  void turnJoint(int joint, int axis, double angle_rad);
  // As angles (x, y, z) with R = Rz · Ry · Rx.
  Eigen::Vector3d anglesOf(int joint) const;
  void setAngles(int joint, const Eigen::Vector3d& angles_rad);
  void resetJoint(int joint);
  void resetPose();
  // A key at the current time, as scrub() takes it, for each joint whose pose is not what the clip says, or
  // for the chosen one.
  void setKey();
  // Of the chosen joint, or of all, at the current time.
  void removeKey();
  // Without keys, in the rest pose, and chosen; it is for this character alone.
  void newClip(const std::string& name, double duration_s);
  void setDuration(double duration_s);
  // Refused if another clip has that name.
  void renameClip(const std::string& name);
  // When there are keys: of the chosen joint, or of all.
  std::vector<double> keyTimes() const;

  // Clips that move something and that no file holds as they are.
  std::vector<std::string> unsavedClips() const;
  // Whether joints stand as neither the clip, or the rest pose, nor a file has them.
  bool hasUnsavedPose() const;
  // That of them which loadClip() would replace; "": none.
  std::string unsavedBelow(const std::string& path) const;

  // Files. What fails is said in message(); false then. Loading makes a step.
  bool openModel(const std::string& path);
  bool saveModel(const std::string& path);  // .glb with all clips
  bool loadPose(const std::string& path);
  bool savePose(const std::string& path);
  bool loadClip(const std::string& path);
  // The clip file that the clip was loaded from, or saved to, for this very rest pose; "": there is none.
  std::string fileOfClip() const;
  // What saveClip() is offered: that, or, of a clip that was loaded from a file for others, one beside it
  // that is named after it and this character; "": the clip came from no file.
  std::string fileForClip() const;
  // As it is for this character, which it is read back for key by key, with its ease, and for its body plan.
  // Saved under another name than its own it gets that, if it is free and nobody has chosen its own by
  // renameClip(); that is a step.
  bool saveClip(const std::string& path);
  bool loadSkeleton(const std::string& path);  // the weights are computed anew
  bool saveSkeleton(const std::string& path);
  bool loadWeights(const std::string& path);
  bool saveWeights(const std::string& path);
  // The clip, or a single frame of the pose where there is none, as it is seen.
  std::unique_ptr<FilmExport> exportFilm(const std::string& path, const Camera& camera,
                                         const FilmOptions& options);

  void beginStep();
  void endStep();
  bool canUndo() const { return history_.canUndo(); }
  bool canRedo() const { return history_.canRedo(); }
  bool undo();
  bool redo();

 private:
  class StepScope;
  template <class Action>
  bool attempt(const Action& action);
  Pose poseOfClip() const;  // or the rest pose
  void takePoseFromClip();
  bool standsAs(const Pose& pose) const;
  std::string whyIdle(int joint) const;  // why turning it moves nothing; "": it does
  void sayIfIdle(int joint);
  // The clip, which there is, as it is edited; eased(): null if it does not ease.
  const ClipKeys* eased() const;
  ClipKeys keys() const;
  const Clip& keyed() const;
  void replaceKeys(const ClipKeys& keys);
  void keepEase(const std::string& before, const ClipKeys& keys);
  void takeEaseOfLibrary();  // of those of its clips that are there
  bool hasOtherClip(const std::string& name) const;
  bool isFileOfClip(const std::string& path) const;  // that it was loaded from or saved to
  double snapped(double time_s) const;
  // A document of its kind is edited in place; nothing else that was read is written over, nor what another
  // program has made of it since. Throws OutputError.
  void save(const std::string& path, std::string_view ending, std::string_view bytes);
  // `path` holds these now, and no longer what it held.
  void setSaved(const std::string& path, const std::vector<Clip>& clips);
  // Before the file is written over: if one of those clips came from it, that is the file's alone to hold.
  void takeSavedFrom(const std::string& clip_file);
  bool isSaved(const Clip& clip) const;
  bool travel(AnimationState& step);
  // A clause behind what is said of a step: which of the files that are shown; "": none.
  std::string changedElsewhere() const;

  CharacterSource source_;
  ClipSource library_;
  std::string name_;
  BoneStyle bones_ = BoneStyle::kAlong;  // as the file that was opened has them
  bool ink_hull_ = false;                // as that file has it
  AnimationState state_;
  int chosen_ = -1;
  int open_steps_ = 0;
  AnimationState before_;
  UndoHistory<AnimationState> history_{200};
  std::string message_;
  std::map<std::string, std::vector<Clip>> saved_;  // as files hold them, by their paths
  std::map<std::string, std::string> files_;  // of clips that loadClip() and saveClip() know, by their names
  std::optional<Pose> saved_pose_;            // the same of the last one
  std::set<std::string> chosen_names_;        // by renameClip()
  FilesLeft on_disk_;
};

}  // namespace skel
