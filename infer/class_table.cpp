#include "infer/class_table.h"

#include <algorithm>

#include "libskel/core/file_names.h"
#include "libskel/core/text.h"

namespace skel {
namespace {

// A sentence and the drawings that it holds for.
struct TableLine {
  std::string sentence;
  std::vector<std::string> names;
};

void add(std::vector<TableLine>& lines, const std::string& sentence, const std::string& name) {
  auto line = std::find_if(lines.begin(), lines.end(),
                           [&](const TableLine& other) { return other.sentence == sentence; });
  if (line == lines.end()) line = lines.insert(lines.end(), {sentence, {}});
  line->names.push_back(name);
}

std::string withSpaces(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += " " + name;
  return text;
}

}  // namespace

std::string classTable(const std::vector<DrawingResult>& drawings, bool numbered) {
  std::vector<TableLine> retake, look_at, notes;
  std::size_t to_retake = 0, to_look_at = 0, fine = 0, failed = 0;
  for (const DrawingResult& drawing : drawings) {
    failed += !drawing.error.empty();
    for (const FigureResult& figure : drawing.figures) {
      const std::string name =
          shellWord(drawing.source) + (numbered ? " (figure " + std::to_string(figure.number) + ")" : "");
      const bool again = figure.verdict == Verdict::kRetake, look = figure.verdict == Verdict::kLookAt;
      ++(again ? to_retake : look ? to_look_at : fine);
      for (const std::string& reason : figure.reasons) add(again ? retake : look_at, reason, name);
      // What differs from figure to figure stands behind its name.
      std::vector<TableLine> own;
      for (const Note& note : figure.notes)
        add(own, note.shared.empty() ? note.text : note.shared, note.what);
      for (TableLine& line : own) {
        std::erase(line.names, "");
        add(notes, line.sentence, name + (line.names.empty() ? "" : " (" + joined(line.names) + ")"));
      }
    }
  }
  const std::size_t all = to_retake + to_look_at + fine + failed;
  std::string table =
      std::to_string(all) + (numbered ? " figures: " : " drawings: ") + std::to_string(fine) + " fine";
  const auto count = [&](std::size_t some, const char* what) {
    if (some > 0) table += ", " + std::to_string(some) + what;
  };
  count(to_look_at, " to look at");
  count(to_retake, " to retake");
  count(failed, " without a result");
  table += "\n";
  for (const TableLine& line : retake)
    table += "retake" + withSpaces(line.names) + ": " + line.sentence + "\n";
  for (const TableLine& line : look_at)
    table += "look at" + withSpaces(line.names) + ": " + line.sentence + "\n";
  for (const TableLine& line : notes) table += "note: " + line.sentence + ": " + joined(line.names) + "\n";
  return table;
}

}  // namespace skel
