// A drawing that is being worked on: rigged again after each change, but for what the change does not touch.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "libskel/pipeline/rig_character.h"

namespace skel {

struct RigMemory;
enum class RigPart;

// Keeps what the drawing is rigged from and what each stage has made of it. Whatever came before,
// rigged() has the bytes of rigCharacter() of the same input and options. What is set and is the same as
// before is no change. A moved joint or a stroke of the mask leaves out what looks at the picture alone; a
// limb painted before the body, what finds limbs; other ways to bind the skin or other clips, all up to the
// mesh, or the skin. As much memory as two of the results.
class RigDocument {
 public:
  explicit RigDocument(RigOptions options = {});
  ~RigDocument();
  RigDocument(RigDocument&&) noexcept;
  RigDocument& operator=(RigDocument&&) noexcept;

  const RigInput& input() const { return input_; }
  const RigOptions& options() const { return options_; }

  void setOptions(RigOptions options);
  // All of it at once: what is not in it is forgotten. Throws UsageError unless `input.figures` is null.
  void setInput(RigInput input);
  // One by one; what they mean is said at RigInput. Another image than the one before forgets what was made
  // for that: the mask, the layers, joints that were moved, placed or given, its file's name. Set those after
  // it, or all by setInput(). A mask of another size than the image is refused by rigged(), as a UsageError.
  void setImage(Image image);
  void setMask(std::optional<Plane8> mask);
  void setLayers(std::optional<NamedPicture> layers);
  void setSkeleton(std::optional<Skeleton> skeleton, int turned_deg = 0);
  // A joint of rigged(), to a place in image px. Those half way between it and another follow it
  // (followPlaced()), the others stay where they are. Throws UsageError if there is none of that name, or the
  // place is not finite or farther than kFarthestJoint_px; and as rigged() does. To undo it, setInput() a
  // copy of input() from before.
  void moveJoint(const std::string& name, const Eigen::Vector2d& image_px);

  // Up to date: runs the stages that a change since the last call has touched; RiggedDrawing::times has
  // those. Throws as rigCharacter() does, and is then not up to date.
  std::shared_ptr<const RiggedDrawing> rigged();
  // While a joint is being dragged, for the eye: the last rigged() with its joints where those of the given
  // skeleton are now. Its mesh and its layers stay as they were; joints are lifted, skin and clips made anew,
  // which may stretch the skin. rigged() itself, where it is up to date or something else has changed.
  std::shared_ptr<const RiggedDrawing> draft();
  // Those of rigged(), without what comes after them.
  LayerMap layers();

 private:
  void note(RigPart part);  // has changed

  RigInput input_;
  RigOptions options_;
  std::unique_ptr<RigMemory> memory_;
  std::shared_ptr<const RiggedDrawing> rigged_;  // null: not up to date
  std::string drawn_plan_;                       // the body plan of the last one that was found
  bool joints_alone_ = false;                    // have moved since
};

}  // namespace skel
