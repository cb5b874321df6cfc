// What skel-infer reads beside drawings: the results that it goes on from, lists of drawings, annotations.
#include <filesystem>
#include <vector>

#include "infer/annotation.h"
#include "infer/drawing_list.h"
#include "infer/result_file.h"
#include "libskel/image/write_image.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/synthetic_figure.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

void readResult(std::string_view text) {
  const DrawingResult result = parseResult(std::string(text), "out/fuzz.result.json");
  const DrawingResult again =
      parseResult(formatResult(result, "out/fuzz.result.json"), "out/again.result.json");
  require(again.origin == result.origin && again.source == result.source && again.error == result.error &&
              again.figures.size() == result.figures.size(),
          "what is written is read as it was");
}

void readList(const std::string& path, bool null_ended) {
  DrawingList all(path, null_ended, {});
  std::vector<std::string> drawings;
  while (const auto drawing = all.next()) drawings.push_back(*drawing);
  require(all.length() == drawings.size(), "a list has the length that it says");
  std::size_t shared_out = 0;
  for (std::size_t index = 1; index <= 3; ++index) {
    DrawingList shard(path, null_ended, {index, 3});
    for (std::size_t at = index - 1; const auto drawing = shard.next(); at += 3, ++shared_out)
      require(at < drawings.size() && *drawing == drawings[at], "a shard has every third drawing");
  }
  require(shared_out == drawings.size(), "each drawing is in one shard");
  for (const std::string& drawing : drawings)
    mayRefuse([&] {
      const fs::path stem = stemInTree(drawing);
      require(!stem.empty() && stem.is_relative(), "results lie below their folder");
      for (const fs::path& part : stem) require(part != "..", "results lie below their folder");
    });
}

// The joints of a drawing that is there, with its mask and without.
void readAnnotation(std::string_view text) {
  static const TempDir dir;
  static const SkeletonTemplate body_plan = loadTemplate("biped");
  static const CapsuleFigure figure{.size = 24};
  if (!fs::exists(dir.file("masked"))) {
    for (const char* folder : {"masked", "bare"}) {
      fs::create_directories(dir.file(folder));
      std::ofstream(dir.file(folder) + "/image.png", std::ios::binary) << encodePng(capsuleImage(figure));
    }
    std::ofstream(dir.file("masked/mask.png"), std::ios::binary) << encodePng(capsuleMask(figure));
  }
  Recognition found;
  found.skeleton = capsuleSkeleton(figure);
  for (const std::string folder : {"masked", "bare"}) {
    std::ofstream(dir.file(folder) + "/joints.json", std::ios::binary) << text;
    mayRefuse([&] {
      MeasuredDrawing drawing = readMeasuredDrawing(dir.path(), folder);
      turnClockwise(drawing, 1);
      for (const Recognition* recognition :
           {static_cast<const Recognition*>(nullptr), &std::as_const(found)}) {
        const Score said = score(drawing, recognition, capsuleMask(figure), body_plan);
        require(said.pck05 >= 0 && said.pck05 <= said.pck10 && said.pck10 <= 1 && said.error >= 0,
                "shares lie in [0, 1], and errors are numbers");
      }
    });
  }
}

}  // namespace
}  // namespace skel

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  const std::string_view text = textOf(data, size);
  mayRefuse([&] { readResult(text); });
  const std::string list = fileOf(text, "drawings.txt");
  for (const bool null_ended : {false, true}) mayRefuse([&] { readList(list, null_ended); });
  readAnnotation(text);
  return 0;
}
