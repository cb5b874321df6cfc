// What the fuzzers share: readers may refuse hostile bytes by skel::Error, and do nothing else.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

#include "libskel/core/error.h"
#include "tests/support/temp_dir.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace skel {

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Any exception but ours leaves, and ends the program.
template <class Read>
void mayRefuse(const Read& read) {
  try {
    read();
  } catch (const Error&) {
  }
}

// For a promise that was broken without a crash.
inline void require(bool kept, const std::string& promise) {
  if (kept) return;
  std::fprintf(stderr, "broken: %s\n", promise.c_str());
  std::abort();
}

// The bytes as a file, for readers that want a path. One at a time.
inline std::string fileOf(std::string_view bytes, const std::string& name) {
  static const TempDir dir;
  std::ofstream(dir.file(name), std::ios::binary) << bytes;
  return dir.file(name);
}

}  // namespace skel
