#include "libskel/window/file_dialog.h"

#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "libskel/window/keys.h"

namespace skel {
namespace fs = std::filesystem;

namespace {

constexpr float kWidth = 700, kListHeight = 300, kRowHeight = 28, kButtonHeight = 38;

bool isFolder(const std::string& path) {
  std::error_code unknown;
  return fs::is_directory(path, unknown);
}

// A sheet of paper, or a folder with its tab.
void drawIcon(const ImVec2& corner, bool is_folder) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float x = corner.x + 8, y = corner.y + kRowHeight / 2;
  if (is_folder) {
    list->AddRectFilled({x, y - 7}, {x + 8, y}, IM_COL32(226, 168, 62, 255), 2);
    list->AddRectFilled({x, y - 5}, {x + 18, y + 7}, IM_COL32(240, 190, 92, 255), 2);
  } else {
    list->AddRectFilled({x + 3, y - 8}, {x + 15, y + 8}, IM_COL32_WHITE, 2);
    list->AddRect({x + 3, y - 8}, {x + 15, y + 8}, IM_COL32(150, 160, 180, 255), 2, 0, 1.5f);
  }
}

// The end of a long path tells more than its beginning.
std::string shortenedPath(const std::string& path, float room) {
  std::string shown = path;
  for (std::size_t cut = path.find('/', 1); ImGui::CalcTextSize(shown.c_str()).x > room;) {
    if (cut == std::string::npos) break;
    shown = ".." + path.substr(cut);
    cut = path.find('/', cut + 1);
  }
  return shown;
}

}  // namespace

void FileDialog::ask(FileQuestion question) {
  question_ = std::move(question);
  const fs::path suggestion = question_.suggestion;
  std::string name = isFolder(question_.suggestion) ? "" : suggestion.filename().string();
  if (const auto place = places_.find(question_.kind); place != places_.end() && !question_.begins_there) {
    enter(place->second);
    if (!saves()) name.clear();
  } else {
    enter(folderAround(question_.suggestion));
    // "out/hero.glb" where there is no "out" yet.
    std::error_code unknown;
    if (saves())
      name = fs::absolute(suggestion).lexically_relative(listing_.folder).string();
    else if (!fs::exists(suggestion, unknown))
      name.clear();
  }
  setName(name);
  problem_.clear();
  asked_.clear();
  open_ = opens_ = true;
}

void FileDialog::enter(const std::string& folder) {
  listing_ = listFolder(folder, shows_all_ ? nullptr : question_.shows);
  scrolls_up_ = true;
}

void FileDialog::goTo(const std::string& folder) {
  enter(folder);
  if (!saves()) setName("");
}

void FileDialog::setName(const std::string& name) {
  std::snprintf(name_.data(), name_.size(), "%s", name.c_str());
}

std::string FileDialog::path() const {
  const std::string name = name_.data();
  if (name.empty()) return listing_.folder;
  const std::string typed = pathIn(listing_.folder, name);
  std::error_code unknown;
  const bool as_typed = saves() ? isFolder(typed) : fs::exists(typed, unknown);
  return question_.ending.empty() || as_typed ? typed : withEnding(typed, question_.ending);
}

void FileDialog::answer(bool sees_replace) {
  const std::string name = name_.data();
  if (name.empty() && question_.use != FileUse::kOpenFileOrFolder) return;
  const std::string path = this->path();
  // A folder's name leads into it, unless it is an answer.
  const bool is_answer = question_.use == FileUse::kOpenFileOrFolder ||
                         (question_.use == FileUse::kSaveFileOrFolder && name.ends_with('/'));
  if (isFolder(path) && !is_answer) {
    enter(path);
    setName("");
    return;
  }
  if (replaces() && !sees_replace && asked_ != path) {
    asked_ = path;
    problem_.clear();
    return;
  }
  asked_.clear();
  problem_ = question_.answer(path);
  types_on_ = !problem_.empty();
  if (types_on_) return;
  places_[question_.kind] = folderAround(fs::absolute(path).parent_path().string());
  open_ = false;
  ImGui::CloseCurrentPopup();
}

bool FileDialog::entry(const std::string& name, bool is_folder) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushID(name.c_str());
  const bool chosen = ImGui::Selectable("##entry", name == name_.data(), ImGuiSelectableFlags_DontClosePopups,
                                        {0, kRowHeight});
  const bool twice = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0);
  ImGui::PopID();
  drawIcon(corner, is_folder);
  ImGui::GetWindowDrawList()->AddText(
      {corner.x + 36, corner.y + (kRowHeight - ImGui::GetTextLineHeight()) / 2},
      ImGui::GetColorU32(ImGuiCol_Text), name.c_str());
  if (chosen && !(is_folder && saves())) setName(name);
  return twice;
}

void FileDialog::drawPlace() {
  const fs::path folder = listing_.folder;
  ImGui::BeginDisabled(!folder.has_relative_path());
  if (ImGui::Button("Up", {64, 0})) goTo(folder.parent_path().string());
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (const char* home = std::getenv("HOME"); home && ImGui::Button("Home", {72, 0})) goTo(home);
  ImGui::SameLine();
  ImGui::TextUnformatted(
      shortenedPath(listing_.folder, kWidth - (ImGui::GetCursorPosX() - ImGui::GetWindowContentRegionMin().x))
          .c_str());
}

bool FileDialog::drawNames(float height) {
  std::string into;
  bool twice = false;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, {1, 1, 1, 1});
  ImGui::BeginChild("names", {kWidth, height}, true);
  if (std::exchange(scrolls_up_, false)) ImGui::SetScrollY(0);
  for (const std::string& name : listing_.folders)
    if (entry(name, true)) into = name;
  for (const std::string& name : listing_.files) twice |= entry(name, false);
  if (!listing_.problem.empty())
    ImGui::TextDisabled("%s", listing_.problem.c_str());
  else if (listing_.folders.empty() && listing_.files.empty())
    ImGui::TextDisabled("nothing to choose here");
  ImGui::EndChild();
  ImGui::PopStyleColor();
  if (!into.empty()) goTo(listing_.folder + "/" + into);
  return twice;
}

bool FileDialog::saves() const {
  return question_.use == FileUse::kSave || question_.use == FileUse::kSaveFileOrFolder;
}

bool FileDialog::replaces() const {
  std::error_code unknown;
  return saves() && name_[0] != '\0' && fs::is_regular_file(path(), unknown);
}

void FileDialog::draw() {
  if (std::exchange(opens_, false)) ImGui::OpenPopup("file");
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(24, 20));
  ImGui::PushStyleVar(ImGuiStyleVar_PopupRounding, 12);
  // Fields are seen on white.
  ImGui::PushStyleColor(ImGuiCol_FrameBg, {0.93f, 0.945f, 0.97f, 1});
  if (ImGui::BeginPopupModal("file", nullptr,
                             ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize)) {
    ImGui::TextUnformatted(question_.title.c_str());
    drawPlace();
    // Small windows keep the buttons in view.
    bool done = drawNames(std::clamp(size.y - 420, 90.f, kListHeight));
    ImGui::SetNextItemWidth(kWidth);
    if (std::exchange(types_on_, false) || ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    done |= ImGui::InputText("##name", name_.data(), name_.size(),
                             ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    // Keys belong to a list of the options that is open, also in the frame in which it closes.
    const bool list_open = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId);
    if (question_.options) question_.options();
    const bool over = replaces();
    const std::string said =
        over && asked_ == path()
            ? fs::path(asked_).filename().string() + " is there already; press Return once more to replace it"
            : problem_;
    if (!said.empty()) {
      ImGui::PushTextWrapPos(kWidth);
      ImGui::TextColored({0.84f, 0.23f, 0.19f, 1}, "%s", said.c_str());
      ImGui::PopTextWrapPos();
    }
    const std::string button = (over ? "Replace" : question_.button) + "###answer";
    const bool pressed = ImGui::Button(button.c_str(), {120, kButtonHeight});
    done |= pressed;
    done |= !list_open && !ImGui::GetIO().WantTextInput && ImGui::IsKeyPressed(key::kEnter, false);
    ImGui::SameLine();
    const bool cancelled =
        ImGui::Button("Cancel", {120, kButtonHeight}) || (!list_open && ImGui::IsKeyPressed(key::kEscape));
    if (question_.shows) {
      ImGui::SameLine(kWidth + ImGui::GetWindowContentRegionMin().x - 110);
      if (ImGui::Checkbox("all files", &shows_all_)) enter(listing_.folder);
    }
    if (done) {
      answer(pressed);
    } else if (cancelled) {
      open_ = false;
      ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
  }
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

}  // namespace skel
