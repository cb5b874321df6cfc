// A list of drawings, read as far as it is needed: it may be longer than memory.
#pragma once

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>

namespace skel {

// Of `count` runs that share a list this is number `index`, from 1 on: it takes every count-th drawing.
struct Shard {
  std::size_t index = 1, count = 1;
};

// "2/16". Throws UsageError.
Shard shardNamed(const std::string& text);

class DrawingList {
 public:
  // `file`: "-" is the standard input. Paths end with the line, or with a zero byte if they are `null_ended`;
  // empty ones do not count. Throws InputError.
  DrawingList(const std::string& file, bool null_ended, Shard shard);
  ~DrawingList();
  DrawingList(const DrawingList&) = delete;
  DrawingList& operator=(const DrawingList&) = delete;

  // The next drawing of this shard. Throws InputError: cannot be read, is no list.
  std::optional<std::string> next();

  // How many drawings this shard has, by reading the list once; 0: it comes out of a pipe.
  std::size_t length() const;

 private:
  bool readPath(std::string& path);

  std::string file_;
  std::FILE* stream_;
  bool null_ended_;
  Shard shard_;
  std::size_t read_ = 0;  // paths
};

// Where the results of a drawing of a list lie below --out: its path from the root, or from where the tool
// runs, without the ending and without what leads out ("../x/y.png": "x/y"). Throws InputError where none is
// left.
std::string stemInTree(const std::string& drawing);

}  // namespace skel
