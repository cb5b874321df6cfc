// What a training is made by: all that decides over its net. A checkpoint holds it, so that nobody goes on by
// other options than those that the provenance of the net names.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace skel {

struct MadeBy {
  // Of the training; where it was gone on with by more, those before as well.
  std::vector<int> steps;
  // Name on the command line and value, of whatever changes the net or what is measured of it: not where it
  // is written, how often that is reported, or by how many threads.
  std::vector<std::pair<std::string, std::string>> options;

  void add(const std::string& option, const std::string& value) { options.emplace_back(option, value); }
  void add(const std::string& option, double value);
};

// As values: content, not names, so that files may move. "none": there are none.
std::string contentOfFile(const std::string& path);  // "": no file
std::string contentOfFiles(const std::vector<std::string>& paths);

// "900"; "900, then 1200".
std::string stepsOf(const MadeBy& made_by);

// One line of JSON, with its end.
std::string formatMadeBy(const MadeBy& made_by);
// Of the first line of `bytes`; nothing where that is none such: checkpoints of former versions. `file` is
// the name that complaints use. Throws InputError: a damaged one.
std::optional<MadeBy> parseMadeBy(const std::string& bytes, const std::string& file);

// Throws InputError that names the first option that differs from what `file` was made by, and both values.
// Steps may be more.
void ensureSame(const MadeBy& was, const MadeBy& now, const std::string& file);

}  // namespace skel
