// The drawings that a command line means.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skel {

struct NamedDrawings {
  std::vector<std::string> drawings;
  std::vector<std::string> results;    // files that were named, but were made of a drawing
  std::vector<std::string> documents;  // PDF files in folders, passed over
  std::vector<std::string> films;      // GIF and WebP of several frames in folders, passed over
  std::vector<std::string> folders;    // in folders, with drawings in them, not named: not looked into
};

// `named`: pictures and folders, mixed. A folder stands for the drawings in it, not for those in its folders,
// in natural order: masks, views of the back, results, sheets of sprites and files that are no pictures are
// passed over, and so are films, which are told. A file that was named is a drawing, but for sheets of
// sprites, and results, masks and views of the back of which the drawing is among the others or whose
// skeleton file lies beside: so `*.png` in a folder of results means the drawings alone. Throws InputError: a
// folder without drawings or that cannot be read; UsageError: results alone.
NamedDrawings drawingsOf(const std::vector<std::string>& named);

// Two of `files` whose outputs would have one name, and what is to be said of other pairs: ", as would c and
// d". `names`: of their outputs. Nothing: all are different.
struct NameClash {
  std::string first, second, name, more;
};
std::optional<NameClash> nameClash(const std::vector<std::string>& files,
                                   const std::vector<std::string>& names);

// What is to be said of those that are no drawings.
std::vector<std::string> notesOf(const NamedDrawings& named);

}  // namespace skel
