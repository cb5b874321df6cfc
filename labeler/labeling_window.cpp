#include "labeler/labeling_window.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "labeler/canvas_view.h"
#include "labeler/preview.h"
#include "libskel/core/caught_error.h"
#include "libskel/draw/color.h"
#include "libskel/image/result_picture.h"
#include "libskel/pipeline/drawing_notes.h"
#include "libskel/skeleton/motion_file.h"
#include "libskel/skeleton/skeleton_file.h"
#include "libskel/window/file_dialog.h"
#include "libskel/window/keys.h"
#include "libskel/window/widgets.h"
#include "libskel/window/window.h"

namespace skel {
namespace {

constexpr float kListWidth = 220, kPanelWidth = 270, kStatusHeight = 46, kButtonHeight = 44;
constexpr const char* kToolNames[kToolCount] = {"Joints", "Mask", "Limbs", "Touch", "Brush", "Lasso"};
constexpr const char* kToolKeys[kToolCount] = {"J", "M", "G", "V", "B", "L"};
constexpr const char* kToolHelp[kToolCount] = {
    "Drag joints to their place; Enter when all are right",
    "Left adds to the figure, right erases; Enter when it is right",
    "Paint limbs that lie before the body, skirt, hair, things; right: that is the body",
    "Point at a disc, press 1 to 4",
    "Paint over discs in the chosen class",
    "Draw a line around discs"};
constexpr key::Code kNumbers[] = {key::k0, key::k1, key::k2, key::k3, key::k4,
                                  key::k5, key::k6, key::k7, key::k8};
constexpr int kFirstClassTool = static_cast<int>(Tool::kTouch);

constexpr KeyHelp kHelp[] = {
    {"J", "drag joints"},
    {"Enter  Space", "all joints are right: the next unfinished drawing; in mask: the figure is right"},
    {"R  Shift R",
     "rig and show the model; forget all joints first, of an earlier photo all that was mended"},
    {"P", "person or animal: joints anew by the other body plan"},
    {"C", "of a motion: joints as in the frame before"},
    {"M  X",
     "mend the mask: left button adds, right button erases; X swaps them; with Shift an area of one colour"},
    {"G  X",
     "paint limbs before the body (1 to 4), hair, skirt, cape, thing (5 to 8), body (0); X cuts a limb out"},
    {"V  B  L", "classes of the candidates: touch, brush, lasso"},
    {"1  2  3  4", "head, body, hand, leg: what the mouse touches, N has chosen, brush or lasso take"},
    {"0  Delete  Backspace", "take the label away; brush and lasso do so from then on"},
    {"N  Tab", "go to the disc that is least sure; Enter accepts its suggestion, as 1 to 4 do"},
    {"A", "accept all suggestions that are left"},
    {"D", "classes from the joints"},
    {"[  ]", "smaller, larger brush"},
    {"Ctrl O", "open another folder, drawing, skeleton or motion"},
    {"Ctrl Q", "close the window"},
    {"Ctrl Z", "undo"},
    {"Ctrl Y  Ctrl Shift Z", "redo"},
    {"Page Up  Page Down", "previous, next drawing; so do the arrow keys"},
    {"U", "next unfinished drawing"},
    {"W", "next one of these that the last run of skel-infer was unsure of"},
    {"Wheel  +  -  F", "zoom; fit the drawing into the view"},
    {"Middle or right drag", "move the drawing; in mask the middle one alone"},
    {"H  ?  F1", "this help; Esc closes it"},
};

// A flat button of one colour, with a frame if it is the one in use.
bool colorButton(const char* label, const ImVec2& size, const Color& color, bool in_use) {
  const ImVec4 c(color.r / 255.f, color.g / 255.f, color.b / 255.f, in_use ? 1.f : 0.42f);
  ImGui::PushStyleColor(ImGuiCol_Button, c);
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImVec4(c.x, c.y, c.z, in_use ? 1.f : 0.65f));
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, ImVec4(c.x, c.y, c.z, 1.f));
  if (in_use) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1, 1, 1, 1));
  const bool clicked = ImGui::Button(label, size);
  ImGui::PopStyleColor(in_use ? 4 : 3);
  return clicked;
}

enum class Keep { kBeginning, kEnd };

// What fits into `room`, px, with ".." for the rest.
std::string shortened(const std::string& text, float room, Keep keep) {
  const auto width = [](const std::string& shown) { return ImGui::CalcTextSize(shown.c_str()).x; };
  if (width(text) <= room) return text;
  const auto cut = [&](std::size_t kept) {
    return keep == Keep::kEnd ? ".." + text.substr(text.size() - kept) : text.substr(0, kept) + "..";
  };
  const auto splitsLetter = [&](std::size_t kept) {  // of UTF-8
    return (text[keep == Keep::kEnd ? text.size() - kept : kept] & 0xC0) == 0x80;
  };
  std::size_t kept = text.size();
  while (kept > 4 && (splitsLetter(kept) || width(cut(kept)) > room)) --kept;
  return cut(kept);
}

class LabelingWindow {
 public:
  LabelingWindow(Document& document, const DocumentOptions& options)
      : document_(document), options_(options), canvas_(document) {
    if (document.subject() == Subject::kClasses) canvas_.tool = class_tool_;
  }

  NextFrame frame() {
    if (!ImGui::GetIO().WantTextInput && !dialog_.isOpen() && !losing_) keys();
    // A drawing is seen before its joints are looked for.
    if (std::exchange(opened_item_, document_.current()) != document_.current())
      came_doubted_ = !document_.doubts(document_.current()).empty();
    const bool wants_joints = canvas_.tool == Tool::kJoints && document_.wantsJoints();
    if (wants_joints && std::exchange(seen_, document_.current()) == document_.current())
      document_.findJoints();
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(io.DisplaySize);
    ImGui::Begin("skel-label", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse |
                     ImGuiWindowFlags_NoNavInputs);
    const float height = ImGui::GetContentRegionAvail().y - kStatusHeight;
    drawList(height);
    ImGui::SameLine();
    ImGui::BeginChild(
        "middle", {ImGui::GetContentRegionAvail().x - kPanelWidth - 8, height}, false,
        ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBackground);
    drawTools();
    const ImVec2 corner = ImGui::GetCursorPos();
    canvas_.draw();
    keepModel();
    if (document_.image().empty()) drawProblem(corner);
    ImGui::EndChild();
    ImGui::SameLine();
    const bool moving = drawPanel(height);
    drawStatus();
    dialog_.draw();
    drawLosing();
    ImGui::End();
    if (help_) drawHelp();
    if (closes_) return NextFrame::kClose;
    return moving || wants_joints || looks_for_doubts_ || opened_ ? NextFrame::kAtOnce : NextFrame::kOnInput;
  }

  // Asks first where a step would be lost.
  bool mayClose() {
    canvas_.cancel();
    losing_ = !document_.go(document_.current());
    return !losing_;
  }

  // For pictures that have come into the folder, and results.
  void lookAgain() {
    document_.forgetDoubts();
    lookForPictures();
  }

  // What is to be shown instead; null: nothing else.
  std::unique_ptr<Document> takeOpened() { return std::move(opened_); }

 private:
  void lookForPictures() {
    const int moved = document_.lookAgain();
    if (moved == 0) return;
    canvas_.followMoved(moved);
    if (seen_ >= 0) seen_ += moved;
    if (modelled_ >= 0) modelled_ += moved;
    if (opened_item_ >= 0) opened_item_ += moved;
    scroll_to_current_ = true;
  }

  Subject subject() const {
    return static_cast<int>(canvas_.tool) < kFirstClassTool ? Subject::kJoints : Subject::kClasses;
  }

  void keys() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl) {
      if (pressed(key::kZ, true)) io.KeyShift ? redo() : undo();
      if (pressed(key::kY, true)) redo();
      if (pressed(key::kO)) askOpen();
      if (pressed(key::kQ)) closes_ = mayClose();
      return;
    }
    if (pressed(key::kH) || pressed(key::kSlash) || pressed(key::kF1)) help_ = !help_;
    if (pressed(key::kEscape)) help_ = false;
    if (canvas_.tool == Tool::kLimbs) {
      const std::vector<LayerBrush> brushes = layerBrushes(document_.bodyPlan());
      for (std::size_t b = 0; b < std::min(brushes.size(), std::size(kNumbers)); ++b)
        if (pressed(kNumbers[b])) canvas_.layer_brush = brushes[b];
    } else {
      for (int c = 0; c < kJointClassCount; ++c)
        if (pressed(kNumbers[c + 1])) chooseClass(static_cast<JointClass>(c), true);
      if (pressed(key::k0) || pressed(key::kDelete) || pressed(key::kBackspace)) takeClassAway();
    }
    const key::Code tool_keys[] = {key::kJ, key::kM, key::kG, key::kV, key::kB, key::kL};
    for (int t = 0; t < kToolCount; ++t)
      if (pressed(tool_keys[t])) chooseTool(static_cast<Tool>(t));
    if (pressed(key::kN) || pressed(key::kTab)) nextUnsure();
    if (pressed(key::kEnter) || pressed(key::kSpace)) {
      if (canvas_.tool == Tool::kMask)
        acceptMask();
      else
        subject() == Subject::kJoints ? acceptJoints() : acceptSelected();
    }
    if (pressed(key::kA)) acceptAll();
    if (pressed(key::kD)) labelFromJoints();
    if (pressed(key::kR)) rig(io.KeyShift);
    if (pressed(key::kP)) takeOtherPlan();
    if (pressed(key::kC)) takeJointsOfFrameBefore();
    if (pressed(key::kX)) {
      if (canvas_.tool == Tool::kLimbs)
        cutLimb();
      else
        canvas_.mask_adds = !canvas_.mask_adds;
    }
    if (pressed(key::kLeftBracket, true)) canvas_.growBrush(1 / 1.2);
    if (pressed(key::kRightBracket, true)) canvas_.growBrush(1.2);
    if (pressed(key::kPlus, true)) canvas_.zoom(1.25);
    if (pressed(key::kMinus, true)) canvas_.zoom(1 / 1.25);
    if (pressed(key::kF)) canvas_.fit();
    if (pressed(key::kPageDown, true) || pressed(key::kRight, true) || pressed(key::kDown, true)) go(+1);
    if (pressed(key::kPageUp, true) || pressed(key::kLeft, true) || pressed(key::kUp, true)) go(-1);
    if (pressed(key::kU)) goToUnfinished();
    if (pressed(key::kW)) goToDoubted();
  }

  void undo() {
    canvas_.cancel();
    if (document_.undo()) showTravelled();
  }
  void redo() {
    canvas_.cancel();
    if (document_.redo()) showTravelled();
  }
  void showTravelled() {
    scroll_to_current_ = true;
    const std::vector<Work>& works = document_.travelled();
    const auto toolFor = [&](Work work) {
      return work == Work::kMask              ? Tool::kMask
             : work == Work::kLimbs           ? Tool::kLimbs
             : work == Work::kJoints          ? Tool::kJoints
             : subject() == Subject::kClasses ? canvas_.tool
                                              : class_tool_;
    };
    const bool shown =
        std::any_of(works.begin(), works.end(), [&](Work work) { return toolFor(work) == canvas_.tool; });
    if (!works.empty() && !shown) chooseTool(toolFor(works.front()));
  }
  void acceptAll() { canvas_.cancel(), document_.acceptSuggestions(); }
  void labelFromJoints() { canvas_.cancel(), document_.labelFromJoints(); }

  void takeJointsOfFrameBefore() { canvas_.cancel(), document_.takeJointsOfFrameBefore(); }

  void takeOtherPlan() {
    canvas_.cancel();
    document_.takeOtherPlan();
    preview_.play();
  }

  void rig(bool forget) {
    canvas_.cancel();
    forget ? document_.rigAnew() : document_.rig();
    preview_.play();
  }

  // Whoever has seen the model sees what a joint, a limb or the mask makes of it.
  void keepModel() {
    if (document_.rigged()) {
      modelled_ = document_.current();
    } else if (modelled_ == document_.current() && !canvas_.isDrawing() && subject() == Subject::kJoints) {
      document_.rigAsItIs();
      if (!document_.rigged()) modelled_ = -1;
    }
  }

  void askOpen() {
    canvas_.cancel();
    dialog_.ask({"Open a folder of drawings, a drawing, a skeleton or a motion", "Open", "drawings",
                 document_.path(), FileUse::kOpenFileOrFolder,
                 [](const std::string& name) {
                   return isDrawingName(name) || name.ends_with(kSkeletonFileEnding) ||
                          name.ends_with(kMotionFileEnding);
                 },
                 "", [this](const std::string& path) { return open(path); }});
  }

  // Why not; "" if it was.
  std::string open(const std::string& path) {
    if (!document_.saveProblem().empty()) return "not saved yet: " + document_.saveProblem();
    try {
      opened_ = std::make_unique<Document>(path, options_);
    } catch (...) {
      return caughtError(path).what();
    }
    return "";
  }

  void chooseTool(Tool tool) {
    canvas_.cancel();
    canvas_.tool = tool;
    if (subject() == Subject::kClasses) class_tool_ = tool;
  }

  void acceptJoints() {
    canvas_.cancel();
    if (document_.acceptJoints() && !(came_doubted_ && goToDoubted())) goToUnfinished();
  }

  void acceptMask() { canvas_.cancel(), document_.acceptMask(); }

  void chooseClass(std::optional<JointClass> joint_class, bool label_too) {
    canvas_.active_class = joint_class;
    if (!label_too || canvas_.tool != Tool::kTouch) return;
    const bool goes_on = canvas_.chosen();
    labelSelected(joint_class);
    if (goes_on) nextUnsure();
  }

  // Of what is chosen; brush and lasso do so from now on.
  void takeClassAway() {
    if (canvas_.tool == Tool::kTouch) return labelSelected(std::nullopt);
    canvas_.active_class.reset();
  }

  void labelSelected(std::optional<JointClass> label) {
    if (canvas_.selected() < 0) return;
    canvas_.cancel();
    document_.label({canvas_.selected()}, label);
  }

  void nextUnsure() {
    chooseTool(Tool::kTouch);
    canvas_.select(document_.mostUnsure());
  }

  void acceptSelected() {
    if (canvas_.selected() < 0) return nextUnsure();
    const auto i = static_cast<size_t>(canvas_.selected());
    if (!document_.state().labels[i]) labelSelected(document_.figure().suggestions[i]);
    nextUnsure();
  }

  void go(int by) {
    lookForPictures();
    goTo(document_.current() + by);
  }

  void goTo(int item) {
    canvas_.cancel();
    if (document_.go(item)) scroll_to_current_ = true;
  }

  void goToUnfinished() {
    const int count = static_cast<int>(document_.items().size());
    for (int by = 1; by < count; ++by) {
      const int item = (document_.current() + by) % count;
      if (!document_.items()[static_cast<size_t>(item)].of(subject()).isWhole()) return goTo(item);
    }
  }

  // False where there is none.
  bool goToDoubted() {
    const int count = static_cast<int>(document_.items().size());
    for (int by = 1; by <= count; ++by) {
      const int item = (document_.current() + by) % count;
      if (!document_.items()[static_cast<size_t>(item)].of(subject()).isWhole() &&
          !document_.doubts(item).empty()) {
        goTo(item);
        return true;
      }
    }
    return false;
  }

  void drawList(float height) {
    const auto& items = document_.items();
    const auto done = static_cast<int>(std::count_if(
        items.begin(), items.end(), [&](const Item& item) { return item.of(subject()).isWhole(); }));
    ImGui::BeginChild("list", {kListWidth, height}, true);
    progressBar({static_cast<int>(items.size()), done}, "finished");
    ImGui::BeginChild("items", {0, -kButtonHeight - 10});
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(items.size()), kRowHeight + ImGui::GetStyle().ItemSpacing.y);
    if (scroll_to_current_) {
      const float row =
          (kRowHeight + ImGui::GetStyle().ItemSpacing.y) * static_cast<float>(document_.current());
      const float top = ImGui::GetScrollY(), view = ImGui::GetWindowHeight();
      if (row < top || row + kRowHeight > top + view) ImGui::SetScrollY(std::max(0.f, row - view / 2));
      scroll_to_current_ = false;
    }
    looks_for_doubts_ = false;
    while (clipper.Step())
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) drawRow(i);
    ImGui::EndChild();
    const float half = (ImGui::GetContentRegionAvail().x - 8) / 2;
    if (ImGui::Button("Previous", {half, kButtonHeight})) go(-1);
    ImGui::SameLine();
    if (ImGui::Button("Next", {half, kButtonHeight})) go(+1);
    ImGui::EndChild();
  }

  // One row a frame is looked at: pictures are read for it.
  bool isDoubted(int index) {
    const Item& item = document_.items()[static_cast<size_t>(index)];
    if (item.doubts) return !item.doubts->empty();
    return !std::exchange(looks_for_doubts_, true) && !document_.doubts(index).empty();
  }

  std::string stateOf(const Item& item) const {
    if (!item.problem.empty()) return item.problem;
    const Progress& progress = item.of(subject());
    if (progress.parts == 0) return item.has_shape ? "its shape was mended" : "not looked at yet";
    return std::to_string(progress.done) + " of " + std::to_string(progress.parts) +
           (item.has_shape ? "; its shape was mended" : "");
  }

  void drawRow(int index) {
    const Item& item = document_.items()[static_cast<size_t>(index)];
    const Progress& progress = item.of(subject());
    ImGui::PushID(index);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (ImGui::Selectable("##row", index == document_.current(), 0, {0, kRowHeight})) goTo(index);
    const bool doubted = item.problem.empty() && !progress.isWhole() && isDoubted(index);
    if (ImGui::IsItemHovered()) {
      std::string text = item.files.name + "\n" + stateOf(item);
      for (std::size_t i = 0; doubted && i < item.doubts->size(); ++i)
        text += "\n" + noteText({(*item.doubts)[i]}, item.files.image);
      tip(text.c_str());
    }
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 c{corner.x + 16, corner.y + kRowHeight / 2};
    if (!item.problem.empty()) {
      list->AddCircleFilled(c, 9, IM_COL32(214, 58, 48, 255));
      list->AddRectFilled({c.x - 1.5f, c.y - 5}, {c.x + 1.5f, c.y + 1}, IM_COL32_WHITE);
      list->AddRectFilled({c.x - 1.5f, c.y + 3}, {c.x + 1.5f, c.y + 6}, IM_COL32_WHITE);
    } else if (progress.isWhole()) {
      list->AddCircleFilled(c, 9, IM_COL32(38, 160, 84, 255));
      const ImVec2 tick[] = {{c.x - 4.5f, c.y}, {c.x - 1, c.y + 3.5f}, {c.x + 4.5f, c.y - 3.5f}};
      list->AddPolyline(tick, 3, IM_COL32_WHITE, 0, 2.5f);
    } else {
      if (doubted) {
        list->AddCircleFilled(c, 8, IM_COL32(240, 160, 30, 255));
        const ImVec2 size = ImGui::CalcTextSize("?");
        list->AddText({c.x - size.x / 2, c.y - size.y / 2}, IM_COL32_WHITE, "?");
      }
      list->AddCircle(c, 8, doubted ? IM_COL32(240, 160, 30, 255) : IM_COL32(170, 178, 192, 255), 24, 2.5f);
      if (item.has_shape && !doubted) list->AddCircleFilled(c, 3.5f, IM_COL32(38, 160, 84, 255));
      if (progress.done > 0) {
        const float share = static_cast<float>(progress.done) / static_cast<float>(progress.parts);
        list->PathArcTo(c, 8, -1.5708f, -1.5708f + 6.2832f * share, 24);
        list->PathStroke(IM_COL32(38, 160, 84, 255), 0, 3.5f);
      }
    }
    // The end of a long name tells more than its beginning.
    const std::string name = shortened(std::filesystem::path(item.files.name).replace_extension().string(),
                                       ImGui::GetContentRegionAvail().x - 40, Keep::kEnd);
    list->AddText({corner.x + 36, corner.y + (kRowHeight - ImGui::GetTextLineHeight()) / 2},
                  ImGui::GetColorU32(ImGuiCol_Text), name.c_str());
    ImGui::PopID();
  }

  static void progressBar(const Progress& progress, const char* what) {
    ImGui::Text("%d of %d %s", progress.done, progress.parts, what);
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, {0.15f, 0.63f, 0.33f, 1});
    ImGui::PushStyleColor(ImGuiCol_FrameBg, {0.88f, 0.90f, 0.93f, 1});
    const float parts = static_cast<float>(std::max(progress.parts, 1));
    ImGui::ProgressBar(static_cast<float>(progress.done) / parts, {-1, 10}, "");
    ImGui::PopStyleColor(2);
  }

  // In a row, `width` wide each.
  void toolButton(int tool, const char* label, bool in_use, float width) {
    if (colorButton(label, {width, kButtonHeight}, in_use ? Color{44, 92, 180} : Color{190, 200, 220},
                    in_use))
      chooseTool(static_cast<Tool>(tool));
    tip((std::string(kToolHelp[tool]) + "  (key " + kToolKeys[tool] + ")").c_str());
  }

  void drawTools() {
    constexpr float kWidth = 110;
    for (int t = 0; t < kFirstClassTool; ++t) {
      toolButton(t, kToolNames[t], static_cast<int>(canvas_.tool) == t, kWidth);
      ImGui::SameLine();
    }
    toolButton(static_cast<int>(class_tool_), "Classes", subject() == Subject::kClasses, kWidth);
    ImGui::SameLine(ImGui::GetContentRegionAvail().x - kWidth);
    if (ImGui::Button("Open ...", {kWidth, kButtonHeight})) askOpen();
    tip("Other drawings  (Ctrl O)");
    ImGui::Spacing();
  }

  // True while the model moves.
  bool drawPanel(float height) {
    ImGui::BeginChild("panel", {kPanelWidth, height}, true);
    const float width = ImGui::GetContentRegionAvail().x;
    const float third = (width - kButtonHeight - 16) / 2;
    enabledButton(
        "Undo", {third, kButtonHeight}, document_.canUndo(), [&] { undo(); }, "Ctrl Z");
    ImGui::SameLine();
    enabledButton(
        "Redo", {third, kButtonHeight}, document_.canRedo(), [&] { redo(); }, "Ctrl Y");
    ImGui::SameLine();
    if (ImGui::Button("?", {kButtonHeight, kButtonHeight})) help_ = !help_;
    tip("All keys  (key H)");
    ImGui::Spacing();
    if (canvas_.tool == Tool::kJoints) drawJoints(width);
    if (canvas_.tool == Tool::kMask) drawMask(width);
    if (canvas_.tool == Tool::kLimbs) drawLimbs(width);
    if (subject() == Subject::kClasses) drawClasses(width);
    ImGui::Spacing();
    enabledButton(
        "Rig it", {width, kButtonHeight}, document_.figure().silhouette.found(), [&] { rig(false); }, "R");
    bool moving = false;
    if (document_.rigged())
      moving = preview_.draw(document_.rigged(), width,
                             std::clamp(ImGui::GetContentRegionAvail().y, 120.f, 1.25f * width));
    ImGui::EndChild();
    return moving;
  }

  void drawJoints(float width) {
    const Progress& joints = document_.item().joints;
    if (document_.wantsJoints())
      ImGui::TextUnformatted("Finding the joints ...");
    else
      progressBar(joints, document_.countedJoints());
    if (document_.otherPlan() && joints.parts > 0) drawBodyPlans(width);
    enabledButton(
        "All right, next", {width, kButtonHeight}, joints.parts > 0, [&] { acceptJoints(); }, "Enter");
    if (document_.editsMotion())
      enabledButton(
          "As in the frame before", {width, kButtonHeight}, document_.current() > 0,
          [&] { takeJointsOfFrameBefore(); }, "C");
  }

  void drawBodyPlans(float width) {
    const float half = (width - 8) / 2;
    const auto button = [&](const char* label, const char* body_plan) {
      const bool in_use = document_.bodyPlan().name == body_plan;
      if (colorButton(label, {half, kButtonHeight}, {44, 92, 180}, in_use) && !in_use) takeOtherPlan();
      tip("Finds the joints anew  (key P)");
    };
    button("Person", "biped");
    ImGui::SameLine();
    button("Animal", "quadruped");
  }

  void drawBrushSize(float width) {
    constexpr double kLeast = kLeastBrush_px, kMost = kMostBrush_px;
    ImGui::SetNextItemWidth(width);
    ImGui::SliderScalar("##brush", ImGuiDataType_Double, &canvas_.brushRadius(), &kLeast, &kMost,
                        "brush, radius %.0f px", ImGuiSliderFlags_Logarithmic);
    tip("Its radius on the screen  (keys [ and ])");
  }

  void drawMask(float width) {
    const float half = (width - 8) / 2;
    if (colorButton("Add", {half, kButtonHeight}, {30, 140, 60}, canvas_.mask_adds)) canvas_.mask_adds = true;
    tip("With the left button; the right one erases  (key X)");
    ImGui::SameLine();
    if (colorButton("Erase", {half, kButtonHeight}, {210, 50, 40}, !canvas_.mask_adds))
      canvas_.mask_adds = false;
    tip("With the left button; the right one adds  (key X)");
    if (colorButton("Area of one colour", {width, kButtonHeight}, {90, 90, 90}, canvas_.mask_fills))
      canvas_.mask_fills = !canvas_.mask_fills;
    tip("A click takes all that looks alike around it, up to the next line  (Shift and click)");
    drawBrushSize(width);
    enabledButton(
        "Right as it is", {width, kButtonHeight}, document_.figure().silhouette.found(),
        [&] { acceptMask(); }, "Keep it, and do not ask again  (key Enter)");
    enabledButton(
        "Mask from the picture", {width, kButtonHeight}, document_.state().mask != nullptr,
        [&] {
          canvas_.cancel();
          document_.forgetMask();
        },
        "Find the figure in the picture again");
  }

  void cutLimb() {
    canvas_.cancel();
    document_.cutLimb(canvas_.layer_brush.limb);
  }

  void drawLimbs(float width) {
    const std::vector<LayerBrush> brushes = layerBrushes(document_.bodyPlan());
    for (std::size_t b = 0; b < brushes.size(); ++b) {
      if (b > 0 && b % 2 == 0) ImGui::SameLine();
      const std::string name = brushName(brushes[b], document_.bodyPlan());
      const auto rgb = brushColor(brushes[b]);
      if (colorButton((std::to_string(b) + " " + name.substr(0, name.find(','))).c_str(),
                      {b == 0 ? width : (width - 8) / 2, kButtonHeight}, {rgb[0], rgb[1], rgb[2]},
                      canvas_.layer_brush == brushes[b]))
        canvas_.layer_brush = brushes[b];
      if (name.find(',') != std::string::npos) tip(name.c_str());
    }
    drawBrushSize(width);
    const int limb = canvas_.layer_brush.limb;
    const bool apart = document_.layers() && document_.layers()->has(limb);
    enabledButton(
        apart ? "Leave it on the body" : "Cut it out", {width, kButtonHeight}, limb != 0, [&] { cutLimb(); },
        "The limb moves as a piece of its own, or with the body  (key X)");
    enabledButton(
        "Limbs from the picture", {width, kButtonHeight}, document_.state().layers != nullptr,
        [&] {
          canvas_.cancel();
          document_.forgetLayers();
          document_.rig();
        },
        "Find the limbs before the body in the picture again");
  }

  void drawClasses(float width) {
    const float half = (width - 8) / 2;
    for (int t = kFirstClassTool; t < kToolCount; ++t) {
      if (t > kFirstClassTool) ImGui::SameLine();
      toolButton(t, kToolNames[t], static_cast<int>(canvas_.tool) == t, (width - 16) / 3);
    }
    for (int c = 0; c < kJointClassCount; ++c) {
      if (c % 2 != 0) ImGui::SameLine();
      const char* name = kJointClassNames[static_cast<size_t>(c)];
      if (colorButton((std::to_string(c + 1) + " " + name).c_str(), {half, kButtonHeight}, classColor(name),
                      canvas_.active_class == static_cast<JointClass>(c)))
        chooseClass(static_cast<JointClass>(c), false);
    }
    const Progress& classes = document_.item().classes;
    progressBar(classes, "labelled");
    const bool found = document_.figure().silhouette.found(), open = found && classes.done < classes.parts;
    enabledButton(
        "Next unsure", {half, kButtonHeight}, open, [&] { nextUnsure(); }, "N");
    ImGui::SameLine();
    enabledButton(
        "Accept", {half, kButtonHeight}, open, [&] { acceptSelected(); }, "Enter");
    enabledButton(
        "Accept all", {half, kButtonHeight}, open, [&] { acceptAll(); }, "A");
    ImGui::SameLine();
    enabledButton(
        "From joints", {half, kButtonHeight}, found, [&] { labelFromJoints(); }, "D");
  }

  // In place of a picture that cannot be read.
  void drawProblem(const ImVec2& corner) const {
    constexpr float kMargin = 24;
    ImGui::SetCursorPos({corner.x + kMargin, corner.y + kMargin});
    ImGui::PushTextWrapPos(ImGui::GetWindowWidth() - kMargin);
    ImGui::TextUnformatted(document_.item().problem.c_str());
    ImGui::PopTextWrapPos();
  }

  void drawStatus() {
    ImGui::Dummy({0, 2});
    const std::string& problem = document_.saveProblem();
    const std::string saved = problem.empty() ? "saved" : "NOT SAVED: " + problem;
    const float saved_at =
        std::max(20.f, ImGui::GetWindowWidth() - ImGui::CalcTextSize(saved.c_str()).x - 54);
    const std::string message =
        document_.message().empty() ? kToolHelp[static_cast<size_t>(canvas_.tool)] : document_.message();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(
        shortened(message, saved_at - ImGui::GetCursorPosX() - 8, Keep::kBeginning).c_str());
    tip(message.c_str());
    ImGui::SameLine(saved_at);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImU32 color = problem.empty() ? IM_COL32(38, 160, 84, 255) : IM_COL32(214, 58, 48, 255);
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 10, at.y + 19}, 7, color);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 26);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(saved.c_str());
  }

  void drawLosing() {
    if (!losing_) return;
    beginQuestion("losing");
    if (ImGui::BeginPopupModal("losing", nullptr, kQuestionFlags)) {
      ImGui::PushTextWrapPos(kQuestionWidth);
      ImGui::TextUnformatted(("The last step is not saved: " + document_.saveProblem()).c_str());
      ImGui::PopTextWrapPos();
      ImGui::Spacing();
      if (ImGui::Button("Try again", kQuestionButton)) closes_ = mayClose();
      ImGui::SameLine();
      if (ImGui::Button("Discard", kQuestionButton)) closes_ = true;
      ImGui::SameLine();
      if (ImGui::Button("Cancel", kQuestionButton) || pressed(key::kEscape)) losing_ = false;
      if (!losing_) ImGui::CloseCurrentPopup();
      ImGui::EndPopup();
    }
    endQuestion();
  }

  // Over the drawing, which stays usable: any key still works.
  void drawHelp() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowBgAlpha(0.96f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 14);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(28, 22));
    ImGui::Begin("help", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    if (ImGui::BeginTable("keys", 2)) {
      keyHelpRows(kHelp, [](const char* what) { ImGui::Text("   %s", what); });
      ImGui::EndTable();
    }
    ImGui::Spacing();
    ImGui::TextDisabled("Everything is saved at once, and everything can be undone.");
    ImGui::End();
    ImGui::PopStyleVar(2);
  }

  static constexpr float kRowHeight = 34;

  Document& document_;
  DocumentOptions options_;  // of what is opened
  CanvasView canvas_;
  Preview preview_;
  FileDialog dialog_;
  std::unique_ptr<Document> opened_;
  Tool class_tool_ = Tool::kTouch;  // the last one used
  int seen_ = -1;                   // the last drawing whose joints were wanted
  int modelled_ = -1;               // the last drawing whose model was shown
  int opened_item_ = -1;            // the last drawing that was current
  bool came_doubted_ = false;       // the run was unsure of it
  bool help_ = false;
  bool losing_ = false;            // asks whether the last step may be lost
  bool looks_for_doubts_ = false;  // there are rows of which it is not known yet
  bool closes_ = false;
  bool scroll_to_current_ = true;
};

}  // namespace

ExitCode runLabelingWindow(const std::string& path, DocumentOptions options) {
  auto document = std::make_unique<Document>(path, options);
  Window window({"skel-label: " + path, 1320, 860});
  auto content = std::make_unique<LabelingWindow>(*document, options);
  bool had_focus = true;
  window.run(
      [&] {
        if (!std::exchange(had_focus, window.hasFocus()) && had_focus) content->lookAgain();
        if (auto opened = content->takeOpened()) {
          content = std::make_unique<LabelingWindow>(*opened, options);
          document = std::move(opened);
          window.setTitle("skel-label: " + document->path());
        }
        return content->frame();
      },
      [&] { return content->mayClose(); });
  return ExitCode::kDone;
}

}  // namespace skel
