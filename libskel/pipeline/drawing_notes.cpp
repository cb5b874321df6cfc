#include "libskel/pipeline/drawing_notes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <numbers>

#include "libskel/animation/arm_abilities.h"
#include "libskel/core/file_names.h"
#include "libskel/core/text.h"
#include "libskel/core/tool_command.h"
#include "libskel/cutout/flat_pose.h"
#include "libskel/deform/measure_figure.h"
#include "libskel/deform/stretch.h"

namespace skel {
namespace {

constexpr const char* kPaintTheLimb = "; if it is drawn before the body, paint it (skel-label FILE, key G)";

constexpr const char* kPaintTheArms = "; if each is to move by itself, paint them (skel-label FILE, key G)";

// Of the way from the first to the second joint of the limb, how much has pixels of it near by.
double shareOfUpperHalf(const RiggedDrawing& drawing, int limb) {
  constexpr int kSteps = 24;
  constexpr double kNear = 0.15;  // of the way
  const Plane8& map = drawing.layers.limb;
  const TemplateLimb& joints = drawing.body_plan.limbs[std::size_t(limb) - 1];
  const auto place = [&](int k) {
    const Skeleton& skeleton = drawing.recognition.skeleton;
    const std::string& name = drawing.body_plan.joints[std::size_t(joints.joints[std::size_t(k)])].name;
    return skeleton.joints[std::size_t(skeleton.index(name))].image;
  };
  const Eigen::Vector2d from = place(0), way = place(1) - from;
  const int reach = std::max(1, int(kNear * way.norm()));
  int seen = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const Eigen::Vector2d p = from + way * i / kSteps;
    const Eigen::Index x0 = std::max<Eigen::Index>(0, Eigen::Index(p.x()) - reach),
                       y0 = std::max<Eigen::Index>(0, Eigen::Index(p.y()) - reach),
                       x1 = std::min<Eigen::Index>(map.cols(), Eigen::Index(p.x()) + reach + 1),
                       y1 = std::min<Eigen::Index>(map.rows(), Eigen::Index(p.y()) + reach + 1);
    if (x0 < x1 && y0 < y1) seen += (map.block(y0, x0, y1 - y0, x1 - x0) == std::uint8_t(limb)).any();
  }
  return double(seen) / kSteps;
}

}  // namespace

std::string noteText(const Note& note, const std::string& file) {
  std::string text = note.text;
  const auto put = [&](const std::string& what, const std::string& placeholder, std::size_t within) {
    for (std::size_t at = text.find(placeholder); at != text.npos;
         at = text.find(placeholder, at + within + what.size()))
      text.replace(at + within, placeholder.size() - within, what);
  };
  put(toolCommand("skel-label") + " " + shellWord(file), "skel-label FILE", 0);
  if (file != "FILE" && endingOf(file) != ".json")
    put(shellWord(std::filesystem::path(file).stem().string()), "--facing NAME", 9);
  return text;
}

std::vector<std::string> withAdviceIfUpright(std::vector<std::string> notes, const std::string& advice) {
  for (std::string& note : notes)
    if (note.starts_with("the figure is turned by ") && note.ends_with(" degrees"))
      note += " (if it is not, " + advice + ")";
  return notes;
}

std::vector<std::string> figureNotes(const RiggedDrawing& drawing) {
  std::vector<std::string> notes = drawing.silhouette.warnings;
  notes.insert(notes.end(), drawing.recognition.warnings.begin(), drawing.recognition.warnings.end());
  return notes;
}

std::vector<std::string> partlyDrawnNotes(const RiggedDrawing& drawing) {
  constexpr double kLeast = 0.35;
  std::vector<std::string> notes;
  for (int limb = 1; drawing.layers.any() && limb <= int(drawing.body_plan.limbs.size()); ++limb)
    if (!isLeg(drawing.body_plan, drawing.body_plan.limbs[std::size_t(limb) - 1]) &&
        drawing.layers.has(limb) && shareOfUpperHalf(drawing, limb) < kLeast)
      notes.push_back(
          "the " + limbName(drawing.body_plan, limb) +
          " is drawn in part alone and may come off the body: look at it (skel-label FILE, key G)");
  return notes;
}

std::optional<std::string> facingNote(const RiggedCharacter& character) {
  // Of people that nothing was learned from, those who are taken to look to a side less surely look to the
  // other in one case of four, and at us in another; those of more in one of forty each.
  constexpr double kSure = .9;
  if (!character.facing || character.facing->yaw_rad == 0 || character.facing->sure >= kSure)
    return std::nullopt;
  const bool left = character.facing->yaw_rad < 0;
  const long deg = std::lround(character.facing->yaw_rad * 180 / std::numbers::pi);
  const auto option = [](long degrees) { return "--facing NAME=" + std::to_string(degrees); };
  return std::string("was taken to look ") + (left ? "left" : "right") +
         ", which is doubtful: " + option(deg) + " says that it does, " + option(-deg) + " that it looks " +
         (left ? "right" : "left") + ", " + option(0) + " at you";
}

std::vector<Note> limbNotes(const RiggedDrawing& drawing, const std::vector<Clip>& clips) {
  constexpr double kWhole = .5;    // likeness: of less there are no limbs to speak of
  constexpr double kTorn = .02;    // share of the model's area that a clip stretches too far
  constexpr double kOfLimb = .01;  // of which so much is a limb's
  std::vector<Note> notes;
  if (drawing.recognition.likeness < kWhole) return notes;
  const SkeletonTemplate& body_plan = drawing.body_plan;
  if (drawing.layers.hands_linked)
    notes.push_back(
        {std::string("the hands hold one thing, or each other, so the arms stay as they are drawn") +
         kPaintTheArms});
  const std::vector<int>& at_rest = drawing.layers.at_rest;
  for (const int limb : drawing.layers.hidden) {
    if (drawing.layers.hands_linked) break;  // the arms alone can be hidden
    if (std::count(at_rest.begin(), at_rest.end(), limb) != 0) continue;
    const std::string name = limbName(body_plan, limb);
    notes.push_back({"the " + name + " cannot be told from the body and stays with it" + kPaintTheLimb,
                     "a limb that cannot be told from the body stays with it" + std::string(kPaintTheLimb),
                     name});
  }
  if (clips.empty()) return notes;
  const RiggedCharacter& character = drawing.character;
  std::map<int, std::vector<int>> joints_of_limb;  // of those that are no layers
  for (std::size_t k = 0; k < body_plan.limbs.size(); ++k) {
    const int limb = static_cast<int>(k) + 1;
    if (drawing.layers.has(limb)) continue;
    for (const int joint : body_plan.limbs[k].joints)
      if (const int j = character.skeleton.find(body_plan.joints[std::size_t(joint)].name); j >= 0)
        joints_of_limb[limb].push_back(j);
  }
  std::map<int, std::vector<std::string>> clips_of_limb;
  for (const ClipStretch& stretch :
       clipStretches(character.mesh, character.skeleton, character.weights, clips)) {
    int most = 0;
    double share = kOfLimb;
    for (const auto& [limb, joints] : joints_of_limb) {
      double sum = 0;
      for (const int joint : joints) sum += stretch.by_joint[std::size_t(joint)];
      if (sum > share) most = limb, share = sum;
    }
    if (stretch.share > kTorn && most > 0) clips_of_limb[most].push_back(stretch.clip);
  }
  for (const auto& [limb, names] : clips_of_limb) {
    const std::string name = limbName(body_plan, limb);
    notes.push_back({joined(names) + (names.size() == 1 ? " pulls the " : " pull the ") + name +
                         " out of shape" + kPaintTheLimb,
                     "a motion pulls a limb out of shape" + std::string(kPaintTheLimb),
                     name + " by " + joined(names)});
  }
  return notes;
}

std::optional<Note> restNote(const RiggedDrawing& drawing) {
  const std::vector<int>& arms = drawing.layers.at_rest;
  if (arms.empty()) return std::nullopt;
  const std::string stays =
      " against the body and stays as it is drawn; --cut-limbs has it move, and may tear what it lies on";
  const std::string name = arms.size() > 1 ? "each arm" : "the " + limbName(drawing.body_plan, arms.front());
  return Note{name + " lies" + stays};
}

std::vector<Note> armNotes(const RiggedCharacter& character, const std::vector<Clip>& clips) {
  std::vector<Note> notes;
  if (clips.empty()) return notes;
  const FigureShape shape =
      measureFigure(character.mesh, character.weights, character.skeleton, character.facing);
  for (std::string& clause : armsThatStay(clips, character.skeleton, shape))
    notes.push_back({std::move(clause)});
  return notes;
}

}  // namespace skel
