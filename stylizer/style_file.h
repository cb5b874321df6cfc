// `<name>.style.json`: what skel-style fit found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/style/semantics.h"
#include "libskel/style/sparse_coding.h"

namespace skel {

struct StyleFrame {
  std::string motion;  // the file that it is from
  std::string action;
  int frame = 0;
};

struct StyleFile {
  SparseCoding coding;  // of the frames' canonical poses
  double sparsity = 0;
  std::vector<StyleFrame> frames;      // one a column of the activations
  std::optional<Semantics> semantics;  // where all frames have a class
};

std::string formatStyleFile(const StyleFile& style);

// Semantics::rebuilt and predicted stay empty. Throws InputError.
StyleFile readStyleFile(const std::string& path);

}  // namespace skel
