// Runs a fuzzer's entry without libFuzzer: over the files of a folder and a number of mutations of them, the
// same ones each time. The input at hand lies in the file <program>.input; a crash leaves it there.
//   fuzz_json 3000 seeds/json
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "libskel/core/files.h"
#include "libskel/core/rng.h"
#include "tests/fuzz/fuzz.h"

namespace fs = std::filesystem;

namespace skel {
namespace {

constexpr double kMaxTime_s = 20;  // sanitized
constexpr long kMaxMemory_kB = 1'000'000;

// Numbers and brackets on which readers of text stumble.
constexpr const char* kTokens[] = {"0",   "-1",  "1e999", "1e308", "-1e-320", "4294967296", "99999999999999",
                                   "0.5", "nan", "null",  "[]",    "{}",      "\"\"",       "\"body\"",
                                   "[[",  "\\",  "\n",    "true",  "1",       "\xff"};

void mutate(std::string& bytes, const std::vector<std::string>& seeds, Rng& rng) {
  const auto below = [&](std::size_t count) { return rng.below(static_cast<std::uint32_t>(count)); };
  const std::size_t at = below(bytes.size() + 1),
                    length = below(std::min<std::size_t>(bytes.size() - at, 32) + 1);
  switch (rng.below(8)) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ 1 << rng.below(8));
      break;
    case 1:
      if (at < bytes.size()) bytes[at] = "\x00\x01\x7f\x80\xff\x20"[rng.below(6)];
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 4:
      if (rng.chance(0.2)) bytes.resize(at);
      break;
    case 5: {
      const std::string& other = seeds[below(seeds.size())];
      const std::size_t from = below(other.size() + 1);
      bytes.insert(at, other.substr(from, below(65)));
      break;
    }
    default: {  // a number of a text for another
      const auto digit = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
      const auto begin = std::find_if(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end(), digit);
      const auto end = std::find_if_not(begin, bytes.end(), digit);
      bytes.replace(begin, end, kTokens[below(std::size(kTokens))]);
    }
  }
}

// Whether it took no longer than it may.
bool run(const std::string& bytes, const std::string& input_file) {
  std::ofstream(input_file, std::ios::binary) << bytes;
  const std::clock_t start = std::clock();
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  const double time_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (time_s <= kMaxTime_s) return true;
  std::fprintf(stderr, "%s took %.1f s\n", input_file.c_str(), time_s);
  return false;
}

}  // namespace
}  // namespace skel

int main(int argc, char** argv) {
  using namespace skel;
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s MUTATIONS FOLDER\n", argv[0]);
    return 1;
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(argv[2])) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const fs::path& file : files) seeds.push_back(readFile(file.string()));
  if (seeds.empty()) {
    std::fprintf(stderr, "%s holds no files\n", argv[2]);
    return 1;
  }
  const std::string input_file = fs::path(argv[0]).filename().string() + ".input";
  for (const std::string& seed : seeds)
    if (!run(seed, input_file)) return 1;
  Rng rng(1);
  for (int left = std::atoi(argv[1]); left > 0; --left) {
    std::string bytes = seeds[rng.below(static_cast<std::uint32_t>(seeds.size()))];
    for (int changes = 1 + static_cast<int>(rng.below(4)); changes > 0; --changes) mutate(bytes, seeds, rng);
    if (!run(bytes, input_file)) return 1;
  }
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  if (usage.ru_maxrss > kMaxMemory_kB) {
    std::fprintf(stderr, "took %ld MB of memory\n", usage.ru_maxrss / 1000);
    return 1;
  }
  fs::remove(input_file);
  return 0;
}
