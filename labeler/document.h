// What the labelling window shows and does, without the window: the drawings, what is known about the current
// one, the steps that change it, undo and redo of every step, and saving after each.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "labeler/describe_step.h"
#include "labeler/doubts.h"
#include "labeler/drawing_list.h"
#include "labeler/drawing_state.h"
#include "labeler/figure.h"
#include "labeler/label_document.h"
#include "labeler/layer_brush.h"
#include "labeler/layer_document.h"
#include "labeler/mask_document.h"
#include "labeler/motion_document.h"
#include "labeler/placed_joints.h"
#include "labeler/skeleton_document.h"
#include "libskel/classifier/mlp.h"
#include "libskel/core/files_left.h"
#include "libskel/core/undo_history.h"
#include "libskel/pipeline/rig_document.h"
#include "libskel/skeleton/body_plans.h"

namespace skel {

// What a person looks through.
enum class Subject {
  kJoints,   // with the mask and the limbs before the body
  kClasses,  // of the candidates
};

// A drawing in the list.
struct Item {
  DrawingFiles files;
  // Joints that do not follow from others, and those placed by hand; of a skeleton file and of a frame of a
  // motion all joints, and those that were found or placed.
  Progress joints;
  Progress classes;                                     // candidates, and those that have a label
  bool has_shape = false;                               // a mask or limbs before the body were mended by hand
  std::string problem;                                  // why it cannot be labelled; else empty
  std::optional<std::vector<std::string>> doubts = {};  // doubtsOf(); nothing: not looked for yet

  const Progress& of(Subject subject) const { return subject == Subject::kJoints ? joints : classes; }
};

struct DocumentOptions {
  Mlp mlp;  // suggests labels
  BodyPlans body_plans;
  Recognizer recognizer = Recognizer::kTree;
};

class Document {
 public:
  // `path` is a folder of pictures of any depth, one picture, one skeleton file or one motion file. Throws
  // InputError.
  Document(const std::string& path, DocumentOptions options);

  const std::string& path() const { return path_; }  // that was opened
  const std::vector<Item>& items() const { return items_; }
  int current() const { return current_; }
  const Item& item() const { return items_[static_cast<size_t>(current_)]; }
  // Of the current drawing: what its files say, or a person, else the nets.
  const SkeletonTemplate& bodyPlan() const { return planNamed(state_.body_plan, options_.body_plans); }
  // That takeOtherPlan() takes; null: there is none.
  const SkeletonTemplate* otherPlan() const;
  // Joints are what this is about: they are kept in a file of their own.
  bool editsSkeleton() const { return skeleton_.has_value(); }
  bool editsMotion() const { return motion_.has_value(); }
  // Takes pictures that have come into the folder since into the list, each at its place; what is open stays
  // open. Returns by how many places that has moved.
  int lookAgain();
  // Where the last session has left off: classes if candidates have labels and no joint was placed.
  Subject subject() const { return subject_; }
  // doubtsOf() the item, looked for when first asked for.
  const std::vector<std::string>& doubts(int item);
  // Somebody may have run skel-infer.
  void forgetDoubts();
  // False, and stays, where there is no such item or the last step is not on the disk.
  bool go(int item);

  const Image& image() const { return image_; }
  const DrawingState& state() const { return state_; }
  // Silhouette and candidates; not found where there is no figure.
  const Figure& figure() const { return *figure_; }
  // One line about the last step, or why it was refused.
  const std::string& message() const { return message_; }
  // Whether mask, joints and limbs were made for another picture than the one that lies there: a photo that
  // was taken again. Steps are saved, but skel-infer does not take them up until acceptJoints() or rigAnew().
  bool isOfEarlierPicture() const {
    return !motion_ && !image_.empty() && state_.image_sha256 != image_sha256_;
  }
  // What item().joints counts, to stand behind the numbers.
  const char* countedJoints() const {
    return isOfEarlierPicture() ? "for this photo" : editsJointsAlone() ? "joints found" : "joints placed";
  }
  // Why the last step is not on the disk; empty: it is.
  const std::string& saveProblem() const { return save_problem_; }

  // Steps. Each can be undone and is saved at once; between beginStep() and endStep() several make one.
  void label(const std::vector<int>& candidates, std::optional<JointClass> label);
  // Labels whatever has no label as suggested.
  void acceptSuggestions();
  // Labels every candidate by the nearest bone.
  void labelFromJoints();
  void moveJoint(int joint, const Eigen::Vector2d& image_px);
  // Says of all joints that are known that they are where they belong, as if each had been placed. What was
  // made for an earlier picture counts for this one from then on; a mask or limbs of it only when this is
  // said twice, as the first time the message names them: false.
  bool acceptJoints();
  // Forgets all joints and rigs: one step. Of an earlier picture mask, limbs and labels are forgotten, too.
  void rigAnew();
  // Finds the joints anew by the other body plan: one step. Painted limbs are forgotten.
  void takeOtherPlan();
  // Of a motion: all joints as in the frame before, for frames in which none are found.
  void takeJointsOfFrameBefore();
  // Adds to the figure, or erases from it, along a line with a round brush. Labels stay where the figure
  // stays. A stroke that would leave no figure is refused.
  void paintMask(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px, double radius_px, bool add);
  // The same of the area around a place that looks alike (paintArea()).
  void paintMaskArea(const Eigen::Vector2d& at_px, bool add);
  // Says of the figure that it is outlined as it should be: its mask is kept as if it had been painted. Of an
  // earlier picture this is acceptJoints().
  void acceptMask();
  // The figure is found in the picture again.
  void forgetMask();
  // Says which part pixels of the figure are, along a line with a round brush. The first stroke starts from
  // what is found in the picture.
  void paintLayer(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px, double radius_px,
                  const LayerBrush& brush);
  // A limb that is one piece with the body becomes a body of its own, as far as it is known, or goes back.
  void cutLimb(int limb);
  // Limbs before the body are found in the picture again.
  void forgetLayers();
  // Those painted, else those found by rig() or findLimbs(); null: not looked for since mask or joints have
  // changed.
  std::shared_ptr<const LayerMap> layers() const { return state_.layers ? state_.layers : found_layers_; }
  // Looks for them with the joints as they are. No step.
  void findLimbs();
  // Whether findJoints() has something to do: nobody has looked for the joints of this drawing yet.
  bool wantsJoints() const;
  // Recognises them and builds the model. No step.
  void findJoints();
  // Recognises the joints anew, but for those that a person has placed, and builds the model. Says why where
  // that cannot be done.
  void rig();
  // Builds the model of the joints as they are, all of which are known. No step.
  void rigAsItIs();
  // The model of the last rig() or rigAsItIs(), until picture, mask, joints or painted limbs change; else
  // null.
  const std::shared_ptr<const RiggedDrawing>& rigged() const { return rigged_; }

  void beginStep();
  void endStep();
  bool canUndo() const { return history_.canUndo() || open_step_; }
  bool canRedo() const { return history_.canRedo(); }
  // Goes to the drawing of that step and says what it was. False if there is none.
  bool undo();
  bool redo();
  // What the step has changed that was undone or done again last.
  const std::vector<Work>& travelled() const { return travelled_; }

  // See figure.h and placed_joints.h.
  int mostUnsure() const { return skel::mostUnsure(*figure_, state_.labels); }
  int candidateAt(const Eigen::Vector2d& image_px, double radius_px) const {
    return skel::candidateAt(*figure_, image_px, radius_px);
  }
  int jointAt(const Eigen::Vector2d& image_px, double radius_px) const {
    return skel::jointAt(state_.joints, image_px, radius_px);
  }
  std::vector<int> candidatesNear(const Eigen::Vector2d& image_px, double radius_px) const {
    return skel::candidatesNear(*figure_, image_px, radius_px);
  }
  std::vector<int> candidatesInside(const Polygon& lasso) const {
    return skel::candidatesInside(*figure_, lasso);
  }

 private:
  struct Step {
    int item;
    DrawingState before, after;
  };
  struct OpenStep {
    DrawingState before;
    std::shared_ptr<const Figure> figure;
  };
  class StepScope;

  Item& mutableItem() { return items_[static_cast<size_t>(current_)]; }
  // From the files of an item that is new in the list. Whether a person has placed joints in it.
  bool takeProgress(Item& item, FormerNames& names);
  void loadFirst();  // unfinished that can be read
  void load(int item);
  void clear();
  void loadDrawing();
  // Files that are read when the drawing is loaded and written after a step.
  std::vector<std::string> ownFiles() const;
  void noteFiles();
  // The first of them that is not as this window has left it; "": none.
  std::string fileChangedElsewhere() const;
  // Loads the drawing anew where that is so, and does on it what has been done since the last save. False,
  // with nothing changed but saveProblem(), where it cannot be read.
  bool takeOutsideChange();
  void readAnew(const std::string& changed);
  // What `mine` has changed of `base`, done to the state. Returns what cannot be, to be said.
  const char* merge(const DrawingState& mine, const DrawingState& base,
                    const std::shared_ptr<const Figure>& my_figure);
  // Steps from before a change elsewhere would undo that, too. Whether there was one.
  bool dropOutdatedSteps();
  // Says why where it does not.
  void takeModel();
  bool build(RigInput input);                 // the same, of the model alone
  void setBodyPlan(const std::string& name);  // with no joints
  // Of the files of a drawing, if they say it; "" where they do not, or say one that is not asked for.
  std::string planOfFiles() const;
  // Takes what the label file and the skeleton file say, and says what is odd about it.
  void takeMended();
  // "joints, mask (M), limbs (G)": `also`, and what else of an earlier picture is there.
  std::string earlierParts(const std::string& also) const;
  // Before a step that leaves out what was made for an earlier picture. False, with nothing changed, if this
  // one shows no figure.
  bool forgetEarlier();
  // Takes a mask and lets the candidates follow; false, with nothing changed, if it shows no figure.
  bool replaceMask(std::shared_ptr<const MaskVersion> mask);
  bool travel(const Step& step, const DrawingState& target);
  // travel(), and says so: "undone: a stroke of the mask of Hanna.jpg".
  bool travel(const Step& step, const DrawingState& target, const char* done);
  template <class Travel>
  bool throughHistory(const Travel& travel);
  void save();
  void writeFiles();
  // SkeletonFile::foundOutline() of the picture that the state was made for.
  std::string foundOutline();
  int figureNumber() const { return skeleton_ ? skeleton_->figureNumber() : 1; }
  // One step; paint() returns whether it has changed any pixel.
  void changeMask(bool add, const std::function<bool(Plane8& mask, std::uint8_t value)>& paint);
  // Each says why where that is not so.
  bool mayHaveShape();    // a mask and limbs of its own: another figure's may be those of another drawing
  bool mayHaveClasses();  // label files are of the first figure
  // Which figure of that mask it is.
  int figureOfMask(const MaskVersion* mask) const;
  bool editsJointsAlone() const { return skeleton_ || motion_; }
  void forgetRig();  // mask or joints have changed
  RigInput rigInput() const;
  bool knowsAllJoints() const;
  RigInput inputWithJoints() const;  // as they are, all of which are known
  RigOptions rigOptions() const;
  bool letsNetsChoose() const;  // the body plan
  void count();

  DocumentOptions options_;
  std::string path_;
  std::vector<Item> items_;
  Subject subject_ = Subject::kJoints;
  int current_ = 0;
  std::optional<SkeletonDocument> skeleton_;  // what `path_` holds, or neither
  std::optional<MotionDocument> motion_;
  std::set<std::string> given_masks_;  // mask files that were there before

  // Of the current drawing.
  Image image_;
  std::string image_sha256_;
  std::optional<std::string> found_outline_;  // of the picture's own outline, once it was asked for
  bool accepts_earlier_ = false;  // has been told that this takes up what was made for an earlier picture
  LabelDocument labels_;
  MaskDocument masks_;
  LayerDocument painted_layers_;
  DrawingState state_, saved_;  // the latter as it is on the disk
  FilesLeft on_disk_;
  bool outdated_ = false;  // see dropOutdatedSteps()
  std::shared_ptr<const Figure> figure_;
  RigDocument rig_;
  std::shared_ptr<const RiggedDrawing> rigged_;
  std::shared_ptr<const LayerMap> found_layers_;  // in the picture, for the mask and joints that are there
  bool looked_for_joints_ = false;                // in the picture, with the mask that is there
  bool plan_is_said_ = false;                     // by a file or a person

  std::optional<OpenStep> open_step_;
  UndoHistory<Step> history_;
  std::vector<Work> travelled_;
  std::string message_, save_problem_;
};

}  // namespace skel
