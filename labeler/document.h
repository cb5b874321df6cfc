// What the labelling window shows and does, without the window: the drawings, what is known about the current
// one, the steps that change it, undo and redo of every step, and saving after each.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "labeler/drawing_list.h"
#include "libskel/candidates/candidates.h"
#include "libskel/classifier/mlp.h"
#include "libskel/image/image.h"
#include "libskel/layers/layer_map.h"
#include "libskel/pipeline/rig_character.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/motion_file.h"
#include "libskel/skeleton/skeleton_file.h"
#include "libskel/skeleton/template.h"

namespace skel {

// What a person looks through.
enum class Subject {
  kJoints,   // with the mask and the limbs before the body
  kClasses,  // of the candidates
};

struct Progress {
  int parts = 0, done = 0;  // 0 parts: not looked at yet

  bool isWhole() const { return parts > 0 && done == parts; }
};

// A drawing in the list.
struct Item {
  DrawingFiles files;
  // Joints that do not follow from others, and those placed by hand; of a skeleton file and of a frame of a
  // motion all joints, and those that were found or placed.
  Progress joints;
  Progress classes;     // candidates, and those that have a label
  std::string problem;  // why it cannot be labelled; else empty

  const Progress& of(Subject subject) const { return subject == Subject::kJoints ? joints : classes; }
};

// A mask file as it is, or is to be, on the disk.
struct MaskVersion {
  Plane8 pixels;       // of the image's size
  std::string file;    // name, beside the image
  std::string png;     // its bytes; empty while a stroke is being drawn
  std::string sha256;  // of these
};

// What steps change and undo brings back. Masks are shared and never change, so that copies are cheap.
struct DrawingState {
  std::shared_ptr<const MaskVersion> mask;         // null: the figure is found in the picture
  std::vector<std::optional<JointClass>> labels;   // one a candidate (CandidateSet::maxima)
  std::vector<std::optional<PlacedJoint>> joints;  // one a joint of the template
  std::shared_ptr<const LayerMap> layers;          // painted by hand; null: found in the picture

  bool operator==(const DrawingState&) const;
};

// What follows from picture and mask.
struct Figure {
  Silhouette silhouette;
  CandidateSet candidates;
  std::vector<Eigen::Vector2d> centers_px;  // of the candidates, image px
  std::vector<JointClass> suggestions;      // by the current weights
  std::vector<double> certainties;          // their probabilities
};

struct DocumentOptions {
  Mlp mlp;  // suggests labels
  SkeletonTemplate body_plan;
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
  const SkeletonTemplate& bodyPlan() const { return options_.body_plan; }
  // Joints are what this is about: they are kept in a file of their own.
  bool editsSkeleton() const { return skeleton_file_.has_value(); }
  bool editsMotion() const { return motion_file_.has_value(); }
  // Where the last session has left off: classes if candidates have labels and no joint was placed.
  Subject subject() const { return subject_; }
  // False, and stays, where there is no such item or the last step is not on the disk.
  bool go(int item);

  const Image& image() const { return image_; }
  const DrawingState& state() const { return state_; }
  // Silhouette and candidates; not found where there is no figure.
  const Figure& figure() const { return *figure_; }
  // One line about the last step, or why it was refused.
  const std::string& message() const { return message_; }
  // Why the last step is not on the disk; empty: it is.
  const std::string& saveProblem() const { return save_problem_; }

  // Steps. Each can be undone and is saved at once; between beginStep() and endStep() several make one.
  void label(const std::vector<int>& candidates, std::optional<JointClass> label);
  // Labels whatever has no label as suggested.
  void acceptSuggestions();
  // Labels every candidate by the nearest bone.
  void labelFromJoints();
  void moveJoint(int joint, const Eigen::Vector2d& image_px);
  // Says of all joints that are known that they are where they belong, as if each had been placed.
  void acceptJoints();
  void forgetJoints();
  // Of a motion: all joints as in the frame before, for frames in which none are found.
  void takeJointsOfFrameBefore();
  // Adds to the figure, or erases from it, along a line with a round brush. Labels stay where the figure
  // stays. A stroke that would leave no figure is refused.
  void paintMask(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px, double radius_px, bool add);
  // The figure is found in the picture again.
  void forgetMask();
  // Says that pixels of the figure belong to a limb that lies before the body (LayerMap::limb; 0: to the
  // body), along a line with a round brush. The first stroke starts from what is found in the picture.
  void paintLayer(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px, double radius_px, int limb);
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
  // The model of the last rig(), until picture, mask, joints or painted limbs change; else null.
  const RiggedDrawing* rigged() const { return rigged_.get(); }

  void beginStep();
  void endStep();
  bool canUndo() const { return !undo_.empty() || open_step_; }
  bool canRedo() const { return !redo_.empty(); }
  // Goes to the drawing of that step. False if there is none.
  bool undo();
  bool redo();

  // The unlabelled candidate that the weights are least sure about; -1 if all are labelled.
  int mostUnsure() const;
  // The one whose centre is nearest to an image point, within `radius_px`; else, of the discs that hold the
  // point, the kept one with the nearest centre; -1 if there is none.
  int candidateAt(const Eigen::Vector2d& image_px, double radius_px) const;
  // The nearest within `radius_px`; -1 if there is none.
  int jointAt(const Eigen::Vector2d& image_px, double radius_px) const;
  std::vector<int> candidatesNear(const Eigen::Vector2d& image_px, double radius_px) const;
  std::vector<int> candidatesInside(const Polygon& lasso) const;

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
  void load(int item);
  void loadDrawing();
  // The one that the skeleton file was made with.
  void loadSkeletonsMask();
  // Says why where it does not.
  void takeModel();
  // Takes a mask and lets the candidates follow; false, with nothing changed, if it shows no figure.
  bool replaceMask(std::shared_ptr<const MaskVersion> mask);
  bool travel(std::deque<Step>& from, std::deque<Step>& to, DrawingState Step::*target);
  void save();
  void writeFiles();
  int figureNumber() const;  // of the drawing, as the skeleton file says
  void writeSkeletonFile();
  void writeMotionFile();
  std::string layersPath() const;  // of the drawing's figure
  void readLayers();               // where there is such a file
  void writeLayers();
  void forgetRig();  // mask or joints have changed
  RigInput rigInput() const;
  RigOptions rigOptions() const;
  Progress jointProgress() const;
  void count();

  DocumentOptions options_;
  std::vector<Item> items_;
  Subject subject_ = Subject::kJoints;
  int current_ = 0;
  Image image_;
  std::string image_sha256_;
  DrawingState state_;
  std::shared_ptr<const Figure> figure_;
  std::unique_ptr<RiggedDrawing> rigged_;
  std::shared_ptr<const LayerMap> found_layers_;  // in the picture, for the mask and joints that are there
  bool looked_for_joints_ = false;                // in the picture, with the mask that is there
  std::string path_;
  std::optional<SkeletonFile> skeleton_file_;  // what `path_` holds
  std::optional<MotionFile> motion_file_;
  std::set<std::string> given_masks_;               // mask files that were there before
  std::shared_ptr<const MaskVersion> opened_mask_;  // of the current drawing when it was opened
  std::shared_ptr<const MaskVersion> saved_mask_;   // beside the drawing
  std::shared_ptr<const LayerMap> saved_layers_;    // the same
  std::optional<OpenStep> open_step_;
  std::deque<Step> undo_, redo_;
  std::string message_, save_problem_;
};

}  // namespace skel
