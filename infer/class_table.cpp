#include "infer/class_table.h"

#include <algorithm>

#include "libskel/core/file_names.h"
#include "libskel/core/text.h"
#include "libskel/pipeline/drawing_notes.h"

namespace skel {
namespace {

constexpr std::size_t kMostSentences = 300;  // where not all names are told

// What is said of one figure, what differs from figure to figure behind it.
std::vector<std::pair<std::string, std::vector<std::string>>> notesOf(const FigureResult& figure) {
  std::vector<std::pair<std::string, std::vector<std::string>>> notes;
  for (const Note& note : figure.notes) {
    const std::string& sentence = note.shared.empty() ? note.text : note.shared;
    auto one =
        std::find_if(notes.begin(), notes.end(), [&](const auto& other) { return other.first == sentence; });
    if (one == notes.end()) one = notes.insert(notes.end(), {sentence, {}});
    if (!note.what.empty()) one->second.push_back(note.what);
  }
  return notes;
}

}  // namespace

void ClassTable::add(Lines& all, const std::string& sentence, const std::string& name,
                     const std::string& mend_file) const {
  const auto known = all.places.find(sentence);
  if (known == all.places.end() && most_names_ > 0 && all.lines.size() == kMostSentences) {
    ++all.others;
    return;
  }
  const std::size_t place = known == all.places.end() ? all.lines.size() : known->second;
  if (known == all.places.end()) {
    all.places.emplace(sentence, place);
    all.lines.push_back({sentence, {}, mend_file, 0});
  }
  Line& line = all.lines[place];
  ++line.count;
  if (most_names_ == 0 || line.names.size() < most_names_) line.names.push_back(name);
}

void ClassTable::add(const DrawingResult& drawing) {
  if (drawing.nothing_found) {
    ++to_retake_;
    add(retake_, "nothing was found on it", shellWord(drawing.source));
  } else {
    failed_ += !drawing.error.empty();
  }
  kept_ += drawing.kept;
  for (const FigureResult& figure : drawing.figures) {
    const std::string name =
        shellWord(drawing.source) + (numbered_ ? " (figure " + std::to_string(figure.number) + ")" : "");
    const bool again = figure.verdict == Verdict::kRetake, look = figure.verdict == Verdict::kLookAt;
    ++(again ? to_retake_ : look ? to_look_at_ : fine_);
    for (const std::string& reason : figure.reasons)
      add(again ? retake_ : look_at_, reason, name, figure.mend_file);
    for (const auto& [sentence, own] : notesOf(figure))
      add(notes_, sentence, name + (own.empty() ? "" : " (" + joined(own) + ")"), figure.mend_file);
  }
}

std::string ClassTable::namesOf(const Line& line, const char* between) const {
  std::string text;
  for (const std::string& name : line.names) text += (text.empty() ? "" : between) + name;
  const std::size_t more = line.count - line.names.size();
  return text + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

std::string ClassTable::text() const {
  const std::size_t all = to_retake_ + to_look_at_ + fine_ + failed_;
  std::string table =
      std::to_string(all) + (numbered_ ? " figures: " : " drawings: ") + std::to_string(fine_) + " fine";
  const auto count = [&](std::size_t some, const char* what) {
    if (some > 0) table += ", " + std::to_string(some) + what;
  };
  count(to_look_at_, " to look at");
  count(to_retake_, " to retake");
  count(failed_, " without a result");
  if (kept_ > 0) table += "; " + std::to_string(kept_) + (numbered_ ? " drawings" : "") + " done before";
  table += "\n";
  const auto said = [](const Line& line) {
    return noteText({line.sentence}, line.count == 1 && !line.mend_file.empty() ? line.mend_file : "FILE");
  };
  for (const Line& line : retake_.lines) table += "retake " + namesOf(line, " ") + ": " + said(line) + "\n";
  for (const Line& line : look_at_.lines) table += "look at " + namesOf(line, " ") + ": " + said(line) + "\n";
  for (const Line& line : notes_.lines) table += "note: " + said(line) + ": " + namesOf(line, ", ") + "\n";
  if (const std::size_t others = retake_.others + look_at_.others + notes_.others; others > 0)
    table += "and " + std::to_string(others) + " times something else\n";
  return table;
}

}  // namespace skel
