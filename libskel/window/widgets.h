// What all windows are made of beside Dear ImGui's own.
#pragma once

#include <imgui.h>

#include <cstddef>

#include "libskel/window/keys.h"

namespace skel {

// In this frame; `repeat`: also while it is held down.
inline bool pressed(key::Code code, bool repeat = false) { return ImGui::IsKeyPressed(code, repeat); }

inline constexpr float kTipWidth_em = 35;

// Of the last item, under the mouse.
inline void tip(const char* text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kTipWidth_em * ImGui::GetFontSize());
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

template <class Action>
void enabledButton(const char* label, const ImVec2& size, bool enabled, const Action& action,
                   const char* hint) {
  ImGui::BeginDisabled(!enabled);
  if (ImGui::Button(label, size)) action();
  ImGui::EndDisabled();
  tip(hint);
}

// Of questions before something is lost, or for a name: a popup in the middle, between beginQuestion() and
// endQuestion(), by ImGui::BeginPopupModal() with these flags.
inline constexpr ImGuiWindowFlags kQuestionFlags =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize;
inline constexpr float kQuestionWidth = 460;
inline const ImVec2 kQuestionButton = {120, 44};

inline void beginQuestion(const char* name) {
  if (!ImGui::IsPopupOpen(name)) ImGui::OpenPopup(name);
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(24, 20));
  ImGui::PushStyleVar(ImGuiStyleVar_PopupRounding, 12);
}
inline void endQuestion() { ImGui::PopStyleVar(2); }

// Of the list that is open: the arrows choose, Return and Escape close it.
inline void listKeys(std::size_t& chosen, std::size_t count) {
  if (pressed(key::kUp, true) && chosen > 0) --chosen;
  if (pressed(key::kDown, true) && chosen + 1 < count) ++chosen;
  if (pressed(key::kEnter) || pressed(key::kEscape)) ImGui::CloseCurrentPopup();
}

// A line of the help.
struct KeyHelp {
  const char *keys, *what;
};

// Their names in the window's colour, in a table that was begun with two columns.
template <class Lines, class Text>
void keyHelpRows(const Lines& lines, const Text& text) {
  for (const KeyHelp& line : lines) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored({0.17f, 0.36f, 0.71f, 1}, "%s", line.keys);
    ImGui::TableNextColumn();
    text(line.what);
  }
}

}  // namespace skel
