#include "libskel/labels/label_file.h"

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "tests/support/catch.h"
#include "tests/support/temp_dir.h"

using namespace skel;

namespace {

LabelFile sample() {
  LabelFile file;
  file.image = {"a.png", sha256("picture")};
  file.image_width = 600;
  file.image_height = 500;
  file.mask = LabelFile::Source{"a.mask.png", sha256("mask")};
  file.grid_width = 100;
  file.grid_height = 128;
  file.candidates = {{50, 30, 20.024984f}, {99, 127, 1}, {0, 0, 1.4142135f}};
  file.labels = {JointClass::kHead, JointClass::kLeg, std::nullopt};
  file.joints = {{"head", Eigen::Vector2d(300.25, 0.1)}, {"left_hand", std::nullopt}};
  file.recognized = {"head"};
  return file;
}

// A folder with the sample, in whose label file `from` is replaced by `to`.
std::vector<std::string> problems(const std::string& from, const std::string& to) {
  const TempDir dir;
  writeFile(dir.file("a.png"), "picture");
  writeFile(dir.file("a.mask.png"), "mask");
  const std::string path = dir.file("a.labels.json");
  std::string text = formatLabelFile(sample());
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  writeFile(path, text);
  std::vector<std::string> lines = findProblems(path);
  for (std::string& line : lines) {
    REQUIRE(line.starts_with(path + ": "));
    line.erase(0, path.size() + 2);
  }
  return lines;
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("more candidates than any figure has are refused by their place in the file") {
  std::string many;
  for (int i = 0; i < 9'998; ++i)
    many += ",{\"x\":" + std::to_string(i / 128 + .5) + ",\"y\":" + std::to_string(i % 128) +
            ",\"radius\":1,\"label\":null}";
  CHECK(problems("\n  ],", many + "\n  ],") ==
        Lines{"candidates: holds 10001 candidates; 10000 are the most"});
}

TEST_CASE("label files come back as they were") {
  const TempDir dir;
  const std::string path = dir.file("a.labels.json");
  writeLabelFile(path, sample());
  const LabelFile again = readLabelFile(path);
  CHECK(formatLabelFile(again) == readFile(path));
  REQUIRE(again.candidates.size() == 3);
  CHECK(again.candidates[0].radius == 20.024984f);
  CHECK(again.labels == sample().labels);
  CHECK(again.mask->file == "a.mask.png");
  CHECK(again.joints == sample().joints);
  CHECK(again.recognized == sample().recognized);

  LabelFile bare = sample();
  bare.mask.reset();
  bare.joints.clear();
  bare.recognized.clear();
  bare.candidates.clear();
  bare.labels.clear();
  writeLabelFile(path, bare);
  CHECK(readFile(path).find("\"version\": 1,") != std::string::npos);
  const LabelFile bare_again = readLabelFile(path);
  CHECK_FALSE(bare_again.mask);
  CHECK(bare_again.joints.empty());
  CHECK(bare_again.recognized.empty());
  CHECK(bare_again.candidates.empty());
}

TEST_CASE("a picture whose name is not UTF-8 is found again") {
  const TempDir dir;
  const std::string path = dir.file("h\xe9ros.labels.json");
  LabelFile labels = sample();
  labels.image.file = "h\xe9ros.png";
  labels.mask->file = "h\xe9ros.mask.png";
  labels.joints[1].first = "no joint\xff";
  writeFile(dir.file(labels.image.file), "picture");
  writeFile(dir.file(labels.mask->file), "mask");
  writeLabelFile(path, labels);
  CHECK(findProblems(path).empty());
  CHECK(readLabelFile(path).image.file == labels.image.file);
  CHECK(readLabelFile(path).mask->file == labels.mask->file);
}

TEST_CASE("a label file stands beside its image") {
  CHECK(labelFileFor("dir/knight.png") == "dir/knight.labels.json");
  CHECK(besideLabelFile("dir/knight.labels.json", "knight.png") == "dir/knight.png");
  CHECK(besideLabelFile("knight.labels.json", "knight.png") == "knight.png");
}

TEST_CASE(
    "of a file of nothing but bad candidates each kind of complaint is one line, with how many there are") {
  const TempDir dir;
  const std::string path = dir.file("a.labels.json");
  writeLabelFile(path, sample());
  std::string text = readFile(path);
  const std::size_t list = text.find('[', text.find("\"candidates\""));
  std::string many;
  for (int i = 0; i < 5000; ++i) many += "{},";
  writeFile(path, text.insert(list + 1, many));
  const Lines lines = findProblems(path);
  CAPTURE(lines);
  REQUIRE(lines.size() == 4);
  CHECK(lines[0] == path + ": candidates[0]: lacks \"x\" (and 4999 more such)");
  CHECK(lines[1] == path + ": candidates[0]: lacks \"label\" (and 4999 more such)");
  CHECK(lines[2] == path + ": image.file: \"a.png\" is missing");
  CHECK(lines[3] == path + ": mask.file: \"a.mask.png\" is missing");
}

TEST_CASE("a good label file has no problems") { CHECK(problems("600", "600").empty()); }

TEST_CASE("each problem of a label file is named with file, path and reason") {
  CHECK(problems("skel-labels", "skel-weights") ==
        Lines{"is a file of format \"skel-weights\", \"skel-labels\" was expected"});
  CHECK(problems("\"version\": 2", "\"version\": 7") ==
        Lines{"version: is 7, this program reads up to 2; use a newer skel"});
  CHECK(problems("\"head\"", "\"tail\"") ==
        Lines{"candidates[0].label: is \"tail\", must be head, body, hand, leg or null"});
  CHECK(problems("\"x\": 99", "\"x\": 100") == Lines{"candidates[1].x: is 100, must be between 0 and 99"});
  CHECK(problems("\"y\": 127", "\"y\": -1") == Lines{"candidates[1].y: is -1, must be between 0 and 127"});
  CHECK(problems("\"radius\": 1,", "\"radius\": 0,") == Lines{"candidates[1].radius: must be more than 0"});
  CHECK(problems("\"radius\": 1,", "\"radius\": null,") == Lines{"candidates[1].radius: must be a number"});
  CHECK(problems("\"x\": 0, \"y\": 0", "\"x\": 50, \"y\": 30") ==
        Lines{"candidates[2]: lies where an earlier candidate lies"});
  CHECK(problems("\"radius\"", "\"size\"") == Lines{"candidates[0]: has the unknown key \"size\""});
  CHECK(problems("300.25", "700") == Lines{"joints.head: lies outside the image"});
  CHECK(problems("[\"head\"]", "[\"head\", \"head\"]").empty());
  CHECK(problems("[\"head\"]", "[\"left_hand\"]") ==
        Lines{"recognized[0]: \"left_hand\" has no place in joints"});
  CHECK(problems("\"a.png\"", "\"../a.png\"") ==
        Lines{"image.file: must be the name of a file in the same folder"});
  CHECK(problems("\"a.png\"", "\"b.png\"") == Lines{"image.file: \"b.png\" is missing"});
  CHECK(problems(sha256("picture"), sha256("other")) ==
        Lines{"image.file: \"a.png\" has changed since it was labelled; label it anew"});
  CHECK(problems(sha256("mask"), sha256("other")) ==
        Lines{"mask.file: \"a.mask.png\" has changed since it was labelled; label it anew"});
  CHECK(problems(sha256("mask"), "abc") == Lines{"mask.sha256: must be 64 hexadecimal digits"});
  CHECK(problems("\"mask\"", "\"musk\"") == Lines{"has the unknown key \"musk\"", "lacks \"mask\""});
  CHECK(problems("{", "[").size() == 1);
}

TEST_CASE("several problems are all named, and reading stops at the first") {
  const TempDir dir;
  const std::string path = dir.file("a.labels.json");
  std::string text = formatLabelFile(sample());
  for (const auto& [from, to] : {std::pair("\"head\"", "\"tail\""), {"\"x\": 99", "\"x\": 999"}})
    text.replace(text.find(from), std::string(from).size(), to);
  writeFile(path, text);
  CHECK(findProblems(path).size() == 4);  // and neither image nor mask is there
  CHECK_THROWS_WITH(readLabelFile(path),
                    path + ": candidates[0].label: is \"tail\", must be head, body, hand, leg or null");
  CHECK_THROWS_AS(readLabelFile(dir.file("none.labels.json")), InputError);
}
