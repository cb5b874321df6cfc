// What is said at the end of a run over many drawings.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "infer/figure_result.h"

namespace skel {

class ClassTable {
 public:
  // `numbered`: names say which figure. `most_names`: so many drawings are named for a sentence, the others
  // counted, and sentences beyond a few hundred are counted, too; 0: all, so that memory grows with them.
  explicit ClassTable(bool numbered, std::size_t most_names = 0)
      : numbered_(numbered), most_names_(most_names) {}

  void add(const DrawingResult& drawing);

  // A line of counts, then each sentence once with the drawings that it holds for: those to retake first,
  // those to look at, what else there is to know. Paths are words for the shell.
  std::string text() const;

 private:
  // A sentence and the drawings that it holds for.
  struct Line {
    std::string sentence;
    std::vector<std::string> names;
    std::string mend_file;  // of the first
    std::size_t count = 0;
  };
  struct Lines {
    std::vector<Line> lines;  // in the order in which they were first said
    std::map<std::string, std::size_t> places;
    std::size_t others = 0;
  };

  void add(Lines& lines, const std::string& sentence, const std::string& name,
           const std::string& mend_file = "") const;
  std::string namesOf(const Line& line, const char* between) const;

  bool numbered_;
  std::size_t most_names_;
  Lines retake_, look_at_, notes_;
  std::size_t to_retake_ = 0, to_look_at_ = 0, fine_ = 0, failed_ = 0, kept_ = 0;
};

}  // namespace skel
