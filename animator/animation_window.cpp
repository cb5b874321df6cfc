#include "animator/animation_window.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "animator/document.h"
#include "animator/key_marks.h"
#include "animator/pose_file.h"
#include "animator/rig_text.h"
#include "animator/stage_view.h"
#include "libskel/animation/clip_file.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/text.h"
#include "libskel/draw/color.h"
#include "libskel/image/result_picture.h"
#include "libskel/window/file_dialog.h"
#include "libskel/window/keys.h"
#include "libskel/window/widgets.h"
#include "libskel/window/window.h"

namespace skel {
namespace {

constexpr float kListWidth = 236, kTimeHeight = 96, kStatusHeight = 40, kButtonHeight = 38;
// Keys nearer to each other on the time line are no longer told apart.
constexpr float kKeysApart_px = 14;

constexpr const char* kSides[] = {"Front", "Left side", "Back", "Right side"};

constexpr KeyHelp kHelp[] = {
    {"Left drag", "turn the view, or a joint by its ring (Shift: by steps of 15 degrees)"},
    {"Right drag", "move the view (the middle button, too)"},
    {"Wheel  +  -", "zoom"},
    {"Click", "choose a joint; beside the figure: none"},
    {"Tab  Shift Tab", "next, previous joint"},
    {"F  Arrow up", "all in view; from the front, the side, behind ..."},
    {"Space", "play, pause"},
    {"Left  Right", "a frame back, on"},
    {"K  Delete", "set a key, remove it"},
    {"R  Shift R", "reset the joint, the whole pose"},
    {"1  2  3  4", "solid, translucent, wireframe, skeleton"},
    {"W", "weights of the joint as colours"},
    {"Ctrl Z  Ctrl Y", "undo, redo"},
    {"Ctrl O  S  E  Q", "open a character, save it, write a film, quit"},
    {"H  F1", "this help; Esc closes it"},
};

// Of a film; by the name that --background takes, or a colour of one's own.
constexpr struct {
  const char *label, *name;
} kBackgrounds[] = {{"white", "white"},
                    {"grey", "grey"},
                    {"black", "black"},
                    {"a colour", nullptr},
                    {"none (transparent)", "none"}};

// A button that stays down.
bool toggle(const char* label, const ImVec2& size, bool on, const char* hint) {
  if (on) {
    ImGui::PushStyleColor(ImGuiCol_Button, {0.17f, 0.36f, 0.71f, 1});
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, {0.21f, 0.42f, 0.80f, 1});
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, {0.15f, 0.32f, 0.64f, 1});
    ImGui::PushStyleColor(ImGuiCol_Text, {1, 1, 1, 1});
  }
  const bool clicked = ImGui::Button(label, size);
  if (on) ImGui::PopStyleColor(4);
  tip(hint);
  return clicked;
}

void heading(const char* text) {
  ImGui::Spacing();
  ImGui::TextDisabled("%s", text);
}

// Of what names of files end with.
std::function<bool(const std::string&)> endsWith(std::vector<std::string> endings) {
  return [endings = std::move(endings)](const std::string& name) {
    return std::any_of(endings.begin(), endings.end(),
                       [&](const std::string& ending) { return name.ends_with(ending); });
  };
}

class AnimationWindow {
 public:
  explicit AnimationWindow(AnimationDocument& document) : document_(document), stage_(document) {
    ImGui::GetIO().ConfigDragClickToInputText = true;
  }

  // With a star where clips are not saved.
  std::string title() const {
    return "skel-animate: " + printable(document_.path()) + (document_.unsavedClips().empty() ? "" : " *");
  }

  // Asks first where clips would be lost.
  bool mayClose() {
    quit();
    return closes_;
  }

  NextFrame frame() {
    if (next_) std::exchange(next_, {})();
    const bool moves = document_.advance(double(ImGui::GetIO().DeltaTime));
    if (!isTyping() && !dialog_.isOpen() && !losing_ && !renames_) keys();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    // Fields are seen on white, the menu bar belongs to the window.
    ImGui::PushStyleColor(ImGuiCol_FrameBg, {0.93f, 0.945f, 0.97f, 1});
    ImGui::PushStyleColor(ImGuiCol_MenuBarBg, {0.957f, 0.961f, 0.973f, 1});
    ImGui::PushStyleColor(ImGuiCol_Border, {0.86f, 0.88f, 0.92f, 1});
    ImGui::Begin("skel-animate", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_MenuBar |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse |
                     ImGuiWindowFlags_NoNavInputs);
    drawMenu();
    const float height = ImGui::GetContentRegionAvail().y - kStatusHeight;
    // Narrow windows leave more of their width to the figure.
    const float panel_width = std::clamp(0.222f * ImGui::GetContentRegionAvail().x, 262.f, 292.f);
    drawLists(height);
    ImGui::SameLine();
    ImGui::BeginChild(
        "middle", {ImGui::GetContentRegionAvail().x - panel_width - 8, height}, false,
        ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBackground);
    const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    stage_.draw({room.x, room.y - kTimeHeight - 8});
    drawSides(corner);
    drawTime(room.x);
    ImGui::EndChild();
    ImGui::SameLine();
    drawPanel(panel_width, height);
    drawStatus();
    dialog_.draw();
    drawLosing();
    drawRename();
    ImGui::End();
    ImGui::PopStyleColor(3);
    if (help_) drawHelp(corner, room);
    if (closes_) return NextFrame::kClose;
    return moves || film_ || next_ ? NextFrame::kAtOnce : NextFrame::kOnInput;
  }

 private:
  // Also as a field opens: that it wants text is said a frame later.
  static bool isTyping() {
    return ImGui::GetIO().WantTextInput || ImGui::IsMouseReleased(0) || ImGui::IsMouseDoubleClicked(0);
  }

  void keys() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl) {
      if (pressed(key::kZ, true)) io.KeyShift ? document_.redo() : document_.undo();
      if (pressed(key::kY, true)) document_.redo();
      if (pressed(key::kO)) unlessUnsaved([this] { askModel(); });
      if (pressed(key::kS)) askSaveModel();
      if (pressed(key::kE)) askFilm();
      if (pressed(key::kQ)) quit();
      return;
    }
    if (pressed(key::kH) || pressed(key::kSlash) || pressed(key::kF1)) help_ = !help_;
    if (pressed(key::kEscape)) help_ = false;
    if (pressed(key::kSpace)) document_.playOrPause();
    if (pressed(key::kLeft, true)) stepFrames(-1);
    if (pressed(key::kRight, true)) stepFrames(+1);
    if (pressed(key::kUp)) stage_.lookFrom(quarter_++ % 4);
    if (pressed(key::kK)) document_.setKey();
    if (pressed(key::kDelete)) document_.removeKey();
    if (pressed(key::kR)) {
      if (io.KeyShift)
        document_.resetPose();
      else if (document_.chosen() >= 0)
        document_.resetJoint(document_.chosen());
    }
    if (pressed(key::kTab, true)) {
      const int count = document_.jointCount();
      const int from = document_.chosen() < 0 ? (io.KeyShift ? count : -1) : document_.chosen();
      document_.choose((from + (io.KeyShift ? -1 : 1) + count) % count);
    }
    if (pressed(key::k1)) setSolid(!stage_.look.solid);
    if (pressed(key::k2)) setTranslucent(!stage_.look.translucent);
    if (pressed(key::k3)) stage_.look.wireframe = !stage_.look.wireframe;
    if (pressed(key::k4)) stage_.look.skeleton = !stage_.look.skeleton;
    if (pressed(key::kW)) stage_.weights = !stage_.weights;
    if (pressed(key::kF)) stage_.fit();
    if (pressed(key::kPlus, true)) stage_.zoomBy(1.2);
    if (pressed(key::kMinus, true)) stage_.zoomBy(1 / 1.2);
  }

  void setSolid(bool on) {
    stage_.look.solid = on;
    if (on) stage_.look.translucent = false;
  }
  void setTranslucent(bool on) {
    stage_.look.translucent = on;
    if (on) stage_.look.solid = false;
  }

  void stepFrames(int frames) {
    document_.playing = false;
    document_.scrub(document_.state().time_s + frames / kFrameRate);
  }

  std::string suggestion(const std::string& ending) const {
    return "out/" + std::filesystem::path(document_.path()).stem().string() + ending;
  }

  using Action = bool (AnimationDocument::*)(const std::string&);

  // Has a question answered by an action of the document; `then` comes after that, in the next frame.
  void ask(FileQuestion question, Action action, std::function<void()> then = {}) {
    question.answer = [this, action, then = std::move(then)](const std::string& path) {
      if (!(document_.*action)(path)) return document_.message();
      next_ = then;
      return std::string();
    };
    dialog_.ask(std::move(question));
  }

  // What is about to be lost, and what comes when it is saved or given up.
  struct Losing {
    std::vector<std::string> clips;  // none: the pose
    std::string why;
    std::function<void()> then;
  };

  void unlessUnsaved(std::function<void()> then) {
    std::vector<std::string> clips = document_.unsavedClips();
    if (clips.empty()) return unlessPosed(std::move(then));
    const std::string why = clips.size() == 1 ? "is not saved." : "are not saved.";
    losing_ = Losing{std::move(clips), why, [this, then] { unlessPosed(then); }};
  }
  void unlessPosed(std::function<void()> then) {
    if (!document_.hasUnsavedPose()) return then();
    losing_ = Losing{{}, "The pose is neither a key of a clip nor saved.", std::move(then)};
  }

  void quit() {
    const bool asks = dialog_.isOpen() || renames_;  // something else
    if (losing_ || (asks && (!document_.unsavedClips().empty() || document_.hasUnsavedPose()))) return;
    unlessUnsaved([this] { closes_ = true; });
  }

  // One clip as a file, several with the character.
  void save(const Losing& losing) {
    if (losing.clips.empty()) return askSavePose(losing.then);
    if (losing.clips.size() > 1) return askSaveModel(losing.then);
    for (int i = 0; i < int(document_.clips().size()); ++i)
      if (document_.clips()[std::size_t(i)].name == losing.clips.front()) document_.chooseClip(i);
    askSaveClip(losing.then);
  }

  void drawLosing() {
    if (!losing_) return;
    beginQuestion("losing");
    if (ImGui::BeginPopupModal("losing", nullptr, kQuestionFlags)) {
      ImGui::PushTextWrapPos(kQuestionWidth);
      const std::string clips = joined(losing_->clips);
      ImGui::TextUnformatted((clips + (clips.empty() ? "" : " ") + losing_->why).c_str());
      ImGui::PopTextWrapPos();
      ImGui::Spacing();
      const bool saves = ImGui::Button("Save ...", kQuestionButton);
      ImGui::SameLine();
      const bool discards = ImGui::Button("Discard", kQuestionButton);
      ImGui::SameLine();
      const bool cancels = ImGui::Button("Cancel", kQuestionButton) || pressed(key::kEscape);
      if (saves || discards || cancels) {
        const Losing losing = *std::exchange(losing_, std::nullopt);
        ImGui::CloseCurrentPopup();
        if (saves) next_ = [this, losing] { save(losing); };
        if (discards) next_ = losing.then;
      }
      ImGui::EndPopup();
    }
    endQuestion();
  }

  void askName() {
    if (!document_.clip()) return;
    std::snprintf(name_.data(), name_.size(), "%s", document_.clip()->name.c_str());
    renames_ = true;
  }

  void drawRename() {
    if (!renames_) return;
    beginQuestion("rename");
    if (ImGui::BeginPopupModal("rename", nullptr, kQuestionFlags)) {
      ImGui::TextUnformatted("The clip's name");
      ImGui::SetNextItemWidth(kQuestionWidth);
      if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
      bool done = ImGui::InputText("##clip name", name_.data(), name_.size(),
                                   ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
      done |= ImGui::Button("Rename", kQuestionButton);
      ImGui::SameLine();
      const bool cancels = ImGui::Button("Cancel", kQuestionButton) || pressed(key::kEscape);
      if (done) document_.renameClip(name_.data());
      if (done || cancels) {
        renames_ = false;
        ImGui::CloseCurrentPopup();
      }
      ImGui::EndPopup();
    }
    endQuestion();
  }

  // In the middle, as files are asked for.
  void askModel() {
    ask({"Open a character: a drawing, or a model (.glb)", "Open", "character", document_.path(),
         FileUse::kOpen,
         [](const std::string& name) { return isDrawingName(name) || name.ends_with(".glb"); }},
        &AnimationDocument::openModel);
  }
  void askSaveModel(std::function<void()> then = {}) {
    ask({"Save the character with its clips (.glb)", "Save", "saved character", suggestion(".glb"),
         FileUse::kSave, endsWith({".glb"}), ".glb"},
        &AnimationDocument::saveModel, std::move(then));
  }
  void askPose() {
    ask({"Load a pose", "Load", "pose", suggestion(kPoseFileEnding), FileUse::kOpen,
         endsWith({kPoseFileEnding}), kPoseFileEnding},
        &AnimationDocument::loadPose);
  }
  void askSavePose(std::function<void()> then = {}) {
    ask({"Save the pose", "Save", "pose", suggestion(kPoseFileEnding), FileUse::kSave,
         endsWith({kPoseFileEnding}), kPoseFileEnding},
        &AnimationDocument::savePose, std::move(then));
  }
  void askClip() {
    FileQuestion question{"Load a clip (.clip.json, .bvh, key frames)",
                          "Load",
                          "clip",
                          suggestion(kClipFileEnding),
                          FileUse::kOpen,
                          endsWith({kClipFileEnding, ".bvh"}),
                          kClipFileEnding};
    question.answer = [this](const std::string& path) {
      const auto load = [this, path] { return document_.loadClip(path); };
      if (const std::string below = document_.unsavedBelow(path); !below.empty()) {
        losing_ = Losing{{below}, "is not saved, and the file's clip of that name would replace it.", load};
        return std::string();
      }
      return load() ? std::string() : document_.message();
    };
    dialog_.ask(std::move(question));
  }
  void askSaveClip(std::function<void()> then = {}) {
    const std::string file = document_.fileForClip();
    FileQuestion question{
        "Save the clip",
        "Save",
        "clip",
        "out/" + (document_.clip() ? safeFileName(document_.clip()->name) : "clip") + kClipFileEnding,
        FileUse::kSave,
        endsWith({kClipFileEnding}),
        kClipFileEnding};
    if (!file.empty()) question.suggestion = file, question.begins_there = true;
    ask(std::move(question), &AnimationDocument::saveClip, std::move(then));
  }
  void askSkeleton() {
    ask({"Load a skeleton; the weights are computed anew", "Load", "skeleton", suggestion(".rig.json"),
         FileUse::kOpen, endsWith({".json"}), ".rig.json"},
        &AnimationDocument::loadSkeleton);
  }
  void askSaveSkeleton() {
    ask({"Save the skeleton", "Save", "skeleton", suggestion(".rig.json"), FileUse::kSave,
         endsWith({".json"}), ".rig.json"},
        &AnimationDocument::saveSkeleton);
  }
  void askWeights() {
    ask({"Load weights", "Load", "weights", suggestion(".weights.json"), FileUse::kOpen, endsWith({".json"}),
         ".weights.json"},
        &AnimationDocument::loadWeights);
  }
  void askSaveWeights() {
    ask({"Save the weights", "Save", "weights", suggestion(".weights.json"), FileUse::kSave,
         endsWith({".weights.json"}), ".weights.json"},
        &AnimationDocument::saveWeights);
  }
  void askFilm() {
    film_size_ = {2 * std::max(8, stage_.width() * 256 / std::max(1, stage_.height())), 512};
    const std::string name = document_.clip() ? "-" + safeFileName(document_.clip()->name) : "";
    dialog_.ask({"Write a film of what is seen (" + videoFormatNames() + ")", "Write", "film",
                 suggestion(name + ".mp4"), FileUse::kSaveFileOrFolder,
                 endsWith({".mp4", ".gif", ".webp", ".png"}), ".mp4",
                 [this](const std::string& path) { return startFilm(path) ? "" : document_.message(); },
                 [this] { drawFilmOptions(); }});
  }

  bool startFilm(const std::string& path) {
    FilmOptions options;
    options.width = film_size_[0];
    options.height = film_size_[1];
    options.frame_rate = film_rate_;
    options.look = stage_.look;
    options.look.background = filmBackground();
    options.look.weights_of = stage_.weights ? document_.chosen() : -1;
    film_ = document_.exportFilm(path, stage_.camera(), options);
    return film_ != nullptr;
  }

  Color filmBackground() const {
    const char* name = kBackgrounds[film_background_].name;
    if (name) return *backgroundColor(name);
    const auto byte = [](float share) { return std::uint8_t(std::lround(share * 255)); };
    return {byte(film_color_[0]), byte(film_color_[1]), byte(film_color_[2])};
  }

  static void endMenu() {
    if (pressed(key::kEscape)) ImGui::CloseCurrentPopup();
    ImGui::EndMenu();
  }

  void drawMenu() {
    const bool has_clip = document_.clip() != nullptr;
    if (!ImGui::BeginMenuBar()) return;
    if (ImGui::BeginMenu("File")) {
      if (ImGui::MenuItem("Open character ...", "Ctrl O")) unlessUnsaved([this] { askModel(); });
      if (ImGui::MenuItem("Save character ...", "Ctrl S")) askSaveModel();
      ImGui::Separator();
      if (ImGui::MenuItem("Load pose ...")) askPose();
      if (ImGui::MenuItem("Save pose ...")) askSavePose();
      ImGui::Separator();
      if (ImGui::MenuItem("Load clip ...")) askClip();
      if (ImGui::MenuItem("Save clip ...", nullptr, false, has_clip)) askSaveClip();
      ImGui::Separator();
      if (ImGui::MenuItem("Load skeleton ...")) unlessUnsaved([this] { askSkeleton(); });
      if (ImGui::MenuItem("Save skeleton ...")) askSaveSkeleton();
      if (ImGui::MenuItem("Load weights ...")) askWeights();
      if (ImGui::MenuItem("Save weights ...")) askSaveWeights();
      ImGui::Separator();
      if (ImGui::MenuItem("Write film ...", "Ctrl E")) askFilm();
      ImGui::Separator();
      if (ImGui::MenuItem("Quit", "Ctrl Q")) quit();
      endMenu();
    }
    if (ImGui::BeginMenu("Edit")) {
      if (ImGui::MenuItem("Undo", "Ctrl Z", false, document_.canUndo())) document_.undo();
      if (ImGui::MenuItem("Redo", "Ctrl Y", false, document_.canRedo())) document_.redo();
      ImGui::Separator();
      if (ImGui::MenuItem("Set key", "K", false, has_clip)) document_.setKey();
      if (ImGui::MenuItem("Remove key", "Delete", false, has_clip)) document_.removeKey();
      if (ImGui::MenuItem("Reset pose", "Shift R")) document_.resetPose();
      if (ImGui::MenuItem("Rename clip ...", nullptr, false, has_clip)) askName();
      endMenu();
    }
    if (ImGui::BeginMenu("View")) {
      if (ImGui::MenuItem("Fit", "F")) stage_.fit();
      for (int quarter = 0; quarter < 4; ++quarter)
        if (ImGui::MenuItem(kSides[quarter])) stage_.lookFrom(quarter);
      ImGui::Separator();
      ImGui::MenuItem("Turning rings", nullptr, &stage_.handles);
      ImGui::MenuItem("Shadow", nullptr, &stage_.look.shadow);
      if (document_.character().mesh.ink.width_m > 0)
        ImGui::MenuItem("Line around it", nullptr, &stage_.look.ink);
      const bool dual = stage_.look.blending == Blending::kDualQuaternions;
      if (ImGui::MenuItem("Dual quaternions", nullptr, dual))
        stage_.look.blending = dual ? Blending::kLinear : Blending::kDualQuaternions;
      endMenu();
    }
    if (ImGui::MenuItem("Help")) help_ = !help_;
    ImGui::EndMenuBar();
  }

  void drawLists(float height) {
    ImGui::BeginChild("lists", {kListWidth, height}, false, ImGuiWindowFlags_NoBackground);
    const float clips_height = std::min(height * 0.42f, 52 + 27 * float(document_.clips().size() + 1));
    ImGui::BeginChild("clips", {0, clips_height}, true);
    ImGui::TextDisabled("Clips");
    ImGui::SameLine(ImGui::GetContentRegionAvail().x - 48);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(9, 2));
    if (ImGui::Button("New")) document_.newClip("my-clip", 2);
    ImGui::PopStyleVar();
    tip("A clip of your own: pose, set keys, save");
    ImGui::BeginChild("names of clips");
    if (ImGui::Selectable("(rest pose)", document_.state().clip < 0)) document_.chooseClip(-1);
    for (int i = 0; i < int(document_.clips().size()); ++i) {
      ImGui::PushID(i);
      if (ImGui::Selectable(document_.clips()[std::size_t(i)].name.c_str(), document_.state().clip == i)) {
        document_.chooseClip(i);
        document_.playing = document_.duration_s() > 0 && !document_.clip()->tracks.empty();
      }
      if (document_.state().clip == i && seen_clip_ != i) {
        const float top = ImGui::GetWindowPos().y, bottom = top + ImGui::GetWindowHeight();
        if (ImGui::GetItemRectMin().y < top || ImGui::GetItemRectMax().y > bottom) ImGui::SetScrollHereY();
      }
      ImGui::PopID();
    }
    seen_clip_ = document_.state().clip;
    ImGui::EndChild();
    ImGui::EndChild();
    ImGui::BeginChild("joints", {0, 0}, true);
    ImGui::TextDisabled("Joints");
    ImGui::PushStyleVar(ImGuiStyleVar_IndentSpacing, 13);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(2, 2));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(8, 3));
    drawJoint(0);
    ImGui::PopStyleVar(3);
    ImGui::EndChild();
    ImGui::EndChild();
  }

  void drawJoint(int joint) {
    const auto& joints = document_.skeleton().joints;
    bool is_leaf = true;
    for (const Joint& other : joints) is_leaf &= other.parent != joint;
    ImGuiTreeNodeFlags flags =
        ImGuiTreeNodeFlags_DefaultOpen | ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_SpanAvailWidth;
    if (is_leaf) flags |= ImGuiTreeNodeFlags_Leaf;
    if (document_.chosen() == joint) flags |= ImGuiTreeNodeFlags_Selected;
    const Color side = sideColor(joints[std::size_t(joint)].name);
    ImGui::PushStyleColor(ImGuiCol_Text,
                          ImVec4(float(side.r) / 320, float(side.g) / 320, float(side.b) / 320, 1));
    const bool open = ImGui::TreeNodeEx(joints[std::size_t(joint)].name.c_str(), flags);
    ImGui::PopStyleColor();
    if (ImGui::IsItemClicked()) document_.choose(joint);
    if (!open) return;
    for (int child = joint + 1; child < int(joints.size()); ++child)
      if (joints[std::size_t(child)].parent == joint) drawJoint(child);
    ImGui::TreePop();
  }

  // Over the corner of the picture.
  void drawSides(const ImVec2& corner) {
    const ImVec2 button = {62, 28};
    const ImVec2 below = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({corner.x + 10, corner.y + 10});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(4, 3));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(4, 4));
    ImGui::BeginChild("sides", {button.x, 5 * button.y + 4 * 4}, false,
                      ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar);
    constexpr const char* kLabels[] = {"Front", "Left", "Back", "Right"};
    for (int quarter = 0; quarter < 4; ++quarter)
      if (toggle(kLabels[quarter], button, stage_.isSeenFrom(quarter), kSides[quarter]))
        stage_.lookFrom(quarter);
    if (ImGui::Button("Fit", button)) stage_.fit();
    tip("All in view: key F");
    ImGui::EndChild();
    ImGui::PopStyleVar(2);
    ImGui::SetCursorScreenPos(below);
  }

  void drawTime(float width) {
    ImGui::BeginChild("time", {width, kTimeHeight}, true, ImGuiWindowFlags_NoScrollbar);
    const double duration = document_.duration_s();
    enabledButton(
        document_.playing ? "Pause" : "Play", {88, kButtonHeight}, document_.canPlay(),
        [&] { document_.playOrPause(); }, "Space");
    ImGui::SameLine();
    drawTimeline(ImGui::GetContentRegionAvail().x, duration);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(8, 3));
    ImGui::AlignTextToFramePadding();
    if (document_.clip()) {
      ImGui::Text("%.2f s of", document_.state().time_s);
      ImGui::SameLine();
      auto length = float(duration);
      ImGui::SetNextItemWidth(84);
      const bool changed = ImGui::DragFloat("##length", &length, 0.02f, 0.1f, 60, "%.2f s");
      inOneStep(changed, [&] { document_.setDuration(double(length)); });
      tip("How long the clip is; never shorter than its last key");
    } else {
      ImGui::TextDisabled("no clip");
    }
    ImGui::SameLine(184);
    ImGui::Checkbox("Loop", &document_.loops);
    ImGui::SameLine(0, 14);
    ImGui::TextUnformatted("Speed");
    ImGui::SameLine();
    constexpr float kValueWidth = 64;
    auto speed = float(document_.speed);
    ImGui::SetNextItemWidth(std::clamp(
        ImGui::GetContentRegionAvail().x - kValueWidth - ImGui::GetStyle().ItemSpacing.x, 30.f, 150.f));
    if (ImGui::SliderFloat("##speed", &speed, 0.1f, 3, "", ImGuiSliderFlags_NoInput))
      document_.speed = double(speed);
    ImGui::SameLine();
    char value[16];
    std::snprintf(value, sizeof value, "%.2f###1x", document_.speed);
    if (ImGui::Button(value, {kValueWidth, 0})) document_.speed = 1;
    tip("Back to 1");
    ImGui::PopStyleVar();
    ImGui::EndChild();
  }

  // What the widget before changes while it has the focus, dragged or typed, makes one step.
  void inOneStep(bool changed, const std::function<void()>& change) {
    if (ImGui::IsItemActivated()) document_.beginStep(), ++open_steps_;
    if (changed) change();
    if (ImGui::IsItemDeactivated() && open_steps_ > 0) document_.endStep(), --open_steps_;
  }

  void drawTimeline(float width, double duration) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float height = kButtonHeight, margin = 10;
    ImGui::InvisibleButton("timeline", {width, height});
    const float x0 = corner.x + margin, x1 = corner.x + width - margin, y = corner.y + height / 2;
    if (ImGui::IsItemActive() && duration > 0) {
      document_.playing = false;
      document_.scrub(double((ImGui::GetIO().MousePos.x - x0) / (x1 - x0)) * duration);
    }
    ImDrawList* list = ImGui::GetWindowDrawList();
    if (duration <= 0) {
      const char* const hint = document_.clip() ? "A clip of one moment: give it a length below"
                                                : "Choose a clip on the left, or make one";
      const ImVec2 size = ImGui::CalcTextSize(hint);
      list->AddText({corner.x + (width - size.x) / 2, y - size.y / 2},
                    ImGui::GetColorU32(ImGuiCol_TextDisabled), hint);
      return;
    }
    list->AddRectFilled({x0 - 4, y - 4}, {x1 + 4, y + 4}, IM_COL32(222, 227, 237, 255), 4);
    const auto at = [&](double time_s) {
      return x0 + (x1 - x0) * float(std::clamp(time_s / duration, 0.0, 1.0));
    };
    list->AddRectFilled({x0 - 4, y - 4}, {at(document_.state().time_s), y + 4}, IM_COL32(120, 160, 225, 255),
                        4);
    const double apart_s = std::max(1.5 / kFrameRate, double(kKeysApart_px / (x1 - x0)) * duration);
    for (const KeyMark& mark : keyMarks(document_.keyTimes(), apart_s)) {
      const float x = at(mark.from_s);
      if (mark.isOne())
        list->AddQuadFilled({x, y - 13}, {x + 4.5f, y - 8.5f}, {x, y - 4}, {x - 4.5f, y - 8.5f},
                            IM_COL32(238, 150, 20, 255));
      else
        list->AddRectFilled({x, y - 10.5f}, {at(mark.to_s), y - 6.5f}, IM_COL32(238, 150, 20, 120), 2);
    }
    const float x = at(document_.state().time_s);
    list->AddCircleFilled({x, y}, 9, IM_COL32_WHITE);
    list->AddCircleFilled({x, y}, 7, IM_COL32(44, 92, 180, 255));
  }

  void drawPanel(float panel_width, float height) {
    ImGui::BeginChild("panel", {panel_width, height}, true);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(6, 8));
    const float width = ImGui::GetContentRegionAvail().x, half = (width - 8) / 2;
    enabledButton(
        "Undo", {half, kButtonHeight}, document_.canUndo(), [&] { document_.undo(); }, "Ctrl Z");
    ImGui::SameLine();
    enabledButton(
        "Redo", {half, kButtonHeight}, document_.canRedo(), [&] { document_.redo(); }, "Ctrl Y");

    heading("Show");
    Look& look = stage_.look;
    if (toggle("Solid", {half, kButtonHeight}, look.solid, "Key 1")) setSolid(!look.solid);
    ImGui::SameLine();
    if (toggle("Translucent", {half, kButtonHeight}, look.translucent, "Key 2"))
      setTranslucent(!look.translucent);
    if (toggle("Wireframe", {half, kButtonHeight}, look.wireframe, "Key 3")) look.wireframe = !look.wireframe;
    ImGui::SameLine();
    if (toggle("Skeleton", {half, kButtonHeight}, look.skeleton, "Key 4")) look.skeleton = !look.skeleton;

    drawChosenJoint(width, half);

    heading("Pose");
    enabledButton(
        "Load ...", {half, kButtonHeight}, true, [&] { askPose(); }, "A pose that was saved");
    ImGui::SameLine();
    enabledButton(
        "Save ...", {half, kButtonHeight}, true, [&] { askSavePose(); }, "The pose that is shown");
    enabledButton(
        "Reset all", {width, kButtonHeight}, true, [&] { document_.resetPose(); }, "Shift R");

    heading("Keys");
    const bool has_clip = document_.clip() != nullptr;
    enabledButton(
        "Set key", {half, kButtonHeight}, has_clip, [&] { document_.setKey(); },
        "K: of every joint that was turned");
    ImGui::SameLine();
    enabledButton(
        "Remove", {half, kButtonHeight}, has_clip, [&] { document_.removeKey(); }, "Delete");
    enabledButton(
        "Save clip ...", {width, kButtonHeight}, has_clip, [&] { askSaveClip(); }, "As a file");

    ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), ImGui::GetWindowHeight() - 56));
    const TriangleMesh& mesh = document_.character().mesh;
    ImGui::TextDisabled("%d joints, %d bones", document_.jointCount(), boneCount(document_.skeleton()));
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 6);
    const std::string size = std::to_string(mesh.vertices.rows()) + " vertices, " +
                             std::to_string(mesh.triangles.rows()) + " triangles";
    // As large as it fits.
    ImGui::SetWindowFontScale(std::min(1.f, width / ImGui::CalcTextSize(size.c_str()).x));
    ImGui::TextDisabled("%s", size.c_str());
    ImGui::SetWindowFontScale(1);
    ImGui::PopStyleVar();
    ImGui::EndChild();
  }

  void drawChosenJoint(float width, float half) {
    const int joint = document_.chosen();
    heading("Joint");
    if (joint < 0) {
      ImGui::TextUnformatted("Click one, or press Tab.");
      return;
    }
    const Color side = sideColor(document_.skeleton().joints[std::size_t(joint)].name);
    ImGui::TextColored({float(side.r) / 300, float(side.g) / 300, float(side.b) / 300, 1}, "%s",
                       document_.skeleton().joints[std::size_t(joint)].name.c_str());
    // While a number is dragged, the angles are its own: those of the rotation may jump to others of the same
    // meaning.
    if (!angles_held_ || angles_joint_ != joint)
      angles_deg_ = document_.anglesOf(joint) * 180 / std::numbers::pi;
    angles_joint_ = joint;
    angles_held_ = false;
    constexpr const char* kNames[] = {"x", "y", "z"};
    const ImVec4 colors[] = {{0.87f, 0.24f, 0.24f, 1}, {0.16f, 0.60f, 0.28f, 1}, {0.17f, 0.41f, 0.87f, 1}};
    for (int axis = 0; axis < 3; ++axis) {
      auto degrees = float(angles_deg_[axis]);
      if (std::abs(degrees) < 0.05f) degrees = 0;  // no "-0.0"
      ImGui::PushID(axis);
      ImGui::AlignTextToFramePadding();
      ImGui::TextColored(colors[axis], "%s", kNames[axis]);
      ImGui::SameLine(24);
      ImGui::SetNextItemWidth(width - 24);
      ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(8, 5));
      const bool changed = ImGui::DragFloat("##angle", &degrees, 0.5f, -360, 360, "%.1f\xc2\xb0");
      ImGui::PopStyleVar();
      inOneStep(changed, [&] {
        angles_deg_[axis] = double(degrees);
        document_.setAngles(joint, angles_deg_ * std::numbers::pi / 180);
      });
      angles_held_ |= ImGui::IsItemActive();
      tip("Drag, or click to type");
      ImGui::PopID();
    }
    enabledButton(
        "Reset", {half, kButtonHeight}, true, [&] { document_.resetJoint(joint); }, "R");
    ImGui::SameLine();
    if (toggle("Weights", {half, kButtonHeight}, stage_.weights,
               "Key W: how much the joint carries of the skin"))
      stage_.weights = !stage_.weights;
  }

  void drawStatus() {
    if (film_ && film_->isDone()) {
      try {
        film_->finish();
        document_.say("written: " + film_->path());
      } catch (...) {
        document_.say(caughtError(film_->path()).what());
      }
      film_.reset();
    }
    ImGui::AlignTextToFramePadding();
    if (film_) {
      ImGui::ProgressBar(film_->share(), {260, 24}, "");
      ImGui::SameLine();
      if (ImGui::SmallButton(" Stop ")) {
        film_.reset();
        document_.say("the film was not written");
      }
      ImGui::SameLine();
    }
    ImGui::TextUnformatted(document_.message().empty()
                               ? "A click chooses a clip or a joint, Space plays, H shows all keys"
                               : document_.message().c_str());
  }

  void drawFilmOptions() {
    ImGui::SetNextItemWidth(220);
    ImGui::InputInt2("width, height, px", film_size_.data());
    for (int& side : film_size_) side = std::clamp(side, 2, 8192);
    ImGui::SetNextItemWidth(106);
    ImGui::InputInt("frames a second", &film_rate_, 0);
    film_rate_ = std::clamp(film_rate_, 1, 240);
    ImGui::SetNextItemWidth(220);
    if (ImGui::BeginCombo("background", kBackgrounds[film_background_].label)) {
      for (std::size_t i = 0; i < std::size(kBackgrounds); ++i)
        if (ImGui::Selectable(kBackgrounds[i].label, i == film_background_)) film_background_ = i;
      listKeys(film_background_, std::size(kBackgrounds));
      ImGui::EndCombo();
    }
    if (!kBackgrounds[film_background_].name) {
      ImGui::SameLine();
      ImGui::ColorEdit3("##colour", film_color_.data(), ImGuiColorEditFlags_NoInputs);
    }
  }

  // Over the figure and the time line, never over the lists beside them.
  void drawHelp(const ImVec2& corner, const ImVec2& room) {
    ImGui::SetNextWindowPos({corner.x + room.x / 2, corner.y + room.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(room.x, 720.f), 0});
    ImGui::SetNextWindowSizeConstraints({0, 0}, room);
    ImGui::SetNextWindowBgAlpha(0.96f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 14);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(18, 14));
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(6, 2));
    ImGui::Begin("help", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
    if (ImGui::BeginTable("keys", 2)) {
      ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed);
      ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
      keyHelpRows(kHelp, [](const char* what) { ImGui::TextWrapped("%s", what); });
      ImGui::EndTable();
    }
    ImGui::Spacing();
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("Keys hold what was turned; playing and scrubbing show what the keys say.");
    ImGui::PopStyleColor();
    ImGui::End();
    ImGui::PopStyleVar(3);
  }

  AnimationDocument& document_;
  StageView stage_;
  FileDialog dialog_;
  int seen_clip_ = -1;  // that was chosen in the frame before
  std::unique_ptr<FilmExport> film_;
  std::array<int, 2> film_size_ = {512, 512};
  int film_rate_ = int(kFrameRate);
  std::size_t film_background_ = 0;
  std::array<float, 3> film_color_ = {0.62f, 0.83f, 1};
  Eigen::Vector3d angles_deg_ = Eigen::Vector3d::Zero();
  int angles_joint_ = -1;
  bool angles_held_ = false;
  int open_steps_ = 0, quarter_ = 0;
  bool help_ = false;
  std::function<void()> next_;  // at the beginning of the next frame
  std::optional<Losing> losing_;
  std::array<char, 256> name_{};  // that is being typed
  bool renames_ = false, closes_ = false;
};

}  // namespace

ExitCode runAnimationWindow(const CharacterSource& source, const ClipSource& clips) {
  AnimationDocument document(source, clips);
  if (!document.message().empty()) std::fprintf(stderr, "%s\n", printable(document.message()).c_str());
  std::string title = "skel-animate: " + source.path;
  Window window({title, 1320, 860});
  AnimationWindow content(document);
  window.run(
      [&] {
        if (const std::string now = content.title(); now != title) window.setTitle(title = now);
        return content.frame();
      },
      [&] { return content.mayClose(); });
  return ExitCode::kDone;
}

}  // namespace skel
