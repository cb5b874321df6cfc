// skel-train as a user runs it.
#include <algorithm>
#include <filesystem>

#include "libskel/classifier/weights_file.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/sha256.h"
#include "libskel/labels/label_file.h"
#include "libskel/labels/label_folder.h"
#include "tests/support/benchmark_samples.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"

using namespace skel;

namespace {

const std::string kTool = "skel-train";

std::string pictureOf(int character) { return "picture " + std::to_string(character); }

// A folder of the benchmark's samples as six characters, of as many pictures if not of one.
void fill(const TempDir& dir, bool of_one_picture = false) {
  const Samples samples = benchmarkSamples();
  for (int c = 0; c < 6; ++c) {
    const std::string name = "c" + std::to_string(c);
    const std::string picture = pictureOf(of_one_picture ? 0 : c);
    writeFile(dir.file(name + ".png"), picture);
    LabelFile file;
    file.image = {name + ".png", sha256(picture)};
    file.image_width = file.image_height = 100;
    file.grid_width = file.grid_height = 128;
    for (Eigen::Index i = c * 100; i < c * 100 + 100; ++i) {
      const Eigen::RowVector3f row = samples.inputs.row(i) * 126;
      file.candidates.push_back({row[0], row[1] + static_cast<float>(i) * 1e-4f, row[2] + 1});
      const auto target = samples.targets.row(i);
      file.labels.emplace_back(static_cast<JointClass>(2 * std::lround(target[0]) + std::lround(target[1])));
    }
    writeLabelFile(dir.file(name + ".labels.json"), file);
  }
}

ToolRun run(const std::string& arguments) { return runTool(kTool + " " + arguments); }

constexpr const char* kQuick = " --epochs 80 --restarts 2 --folds 3 --generated 0";

}  // namespace

TEST_CASE("skel-train writes weights, report and figures, the same bytes for every number of threads") {
  const TempDir dir;
  fill(dir);
  const auto train = [&](const std::string& name, const std::string& more) {
    return run(dir.path() + " -o " + dir.file(name) + kQuick + more);
  };
  const ToolRun one =
      train("a.json", " --threads 1 --json " + dir.file("f.json") + " --report " + dir.file("report"));
  REQUIRE(one.exit_code == 0);
  CHECK(one.out.find("on characters left out of training (3 folds)") != std::string::npos);
  CHECK(one.out.find("accuracy 0.9") != std::string::npos);
  CHECK(train("b.json", " --threads 3").exit_code == 0);
  CHECK(readFile(dir.file("a.json")) == readFile(dir.file("b.json")));
  CHECK(train("c.json", " --seed 9").exit_code == 0);
  CHECK(readFile(dir.file("a.json")) != readFile(dir.file("c.json")));

  const WeightsFile weights = readWeights(dir.file("a.json"));
  CHECK(weights.mlp.sizes() == std::vector<int>{3, 4, 4, 2});
  CHECK(weights.provenance.options == "--epochs 80 --restarts 2 --folds 3 --generated 0");
  CHECK(weights.provenance.samples == 600);
  CHECK(weights.provenance.characters == 6);
  CHECK(readWeights(dir.file("c.json")).provenance.seed == 9);

  for (const char* name : {"report/loss.png", "report/confusion.png"})
    CHECK(readFile(dir.file(name)).starts_with("\x89PNG"));
  for (const auto& [file, key] : {std::pair("f.json", ""), {"report/report.json", "evaluation"}}) {
    const JsonDocument document = JsonDocument::readFile(dir.file(file));
    const JsonValue figures = *key ? document.root().at(key) : document.root();
    CHECK(figures.at("accuracy").asNumber(0, 1) > 0.9);
    CHECK(figures.at("balanced_accuracy").asNumber(0, 1) > 0.9);
    CHECK(figures.at("confusion").items().size() == 4);
    CHECK(figures.at("characters").items().size() == 6);
  }

  const ToolRun evaluated =
      run("evaluate " + dir.path() + " --weights " + dir.file("a.json") + " --json " + dir.file("e.json"));
  CHECK(evaluated.exit_code == 0);
  const JsonDocument document = JsonDocument::readFile(dir.file("e.json"));
  CHECK(document.root().at("accuracy").asNumber(0.9, 1) > 0.9);
  CHECK(document.root().at("characters").items()[3].at("name").asString() == "c3");
  // Two nets that tell the same of all gave the same file.
  const JsonValue net = document.root().at("net");
  CHECK(net.at("weights_sha256").asString() == sha256(readFile(dir.file("a.json"))));
  CHECK(net.at("trained_on_sha256").asString() == document.root().at("set_sha256").asString());
  const ToolRun shipped = run("evaluate " + dir.path() + " --json " + dir.file("s.json"));
  CHECK(shipped.exit_code == 0);
  CHECK(JsonDocument::readFile(dir.file("s.json")).root().at("net").at("weights_sha256").asString() ==
        sha256(readFile(SKEL_SOURCE_DIR "/weights/default.json")));
}

TEST_CASE("every way of training works from the command line") {
  const TempDir dir;
  fill(dir);
  for (const char* options :
       {"--folds 2 --method lbfgs", "--folds 2 --method gradient",
        "--folds 2 --method gradient --batch 0 --momentum 0.9 --learning-rate 5",
        "--folds 3 --method gradient --batch 16 --class-weights balanced",
        "--folds 3 --no-mirror --weight-decay 1e-5", "--layers 3-6-2 --leave-one-out",
        "--folds 3 --validation 0.3 --warps 2 --warp 0.5", "--folds 0", "--folds 3 --draws 2 --drawn 4"}) {
    INFO(options);
    const ToolRun done =
        run(dir.path() + " -o " + dir.file("w.json") + " --epochs 60 --restarts 2 --generated 5 " + options);
    CHECK(done.err == "");
    CHECK(done.exit_code == 0);
    CHECK(readWeights(dir.file("w.json")).mlp.sizes().front() == 3);
  }
}

TEST_CASE("an accuracy on the training set could not be told from one on others, nor that of draws be read") {
  const TempDir dir;
  fill(dir);
  const auto figures = [&](const std::string& options) {
    REQUIRE(run(dir.path() + " -o " + dir.file("w.json") + " --epochs 30 --restarts 1 --generated 5 --json " +
                dir.file("e.json") + " " + options)
                .exit_code == 0);
    return JsonDocument::readFile(dir.file("e.json"));
  };
  const auto madeBy = [&] { return readWeights(dir.file("w.json")).provenance.options; };
  CHECK(figures("--folds 0").root().at("measured_on").asString() == "the training set itself");
  CHECK(madeBy().find(" --folds 0") != std::string::npos);
  CHECK_FALSE(figures("--leave-one-out").root().find("draws"));
  CHECK(madeBy().find(" --leave-one-out") != std::string::npos);
  const JsonDocument drawn = figures("--folds 3 --draws 2 --drawn 4");
  CHECK(drawn.root().at("measured_on").asString() == "characters left out of training");
  CHECK(drawn.root().at("draws").at("count").asInt(2, 2) == 2);
  CHECK(drawn.root().at("draws").at("characters").asInt(4, 4) == 4);
  CHECK(drawn.root().at("draws").at("accuracy").asNumber(0.1, 1) > 0);
  CHECK(drawn.root().at("draws").at("deviation").asNumber(0, 1) >= 0);
}

TEST_CASE("measuring failed on drawings without a candidate of one class") {
  const TempDir dir;
  fill(dir);
  for (const std::string& path : findLabelFiles(dir.path())) {
    LabelFile file = readLabelFile(path);
    std::replace(file.labels.begin(), file.labels.end(), std::optional(JointClass::kHand),
                 std::optional(JointClass::kLeg));
    writeLabelFile(path, file);
  }
  const ToolRun measured = run("evaluate " + dir.path() + " --json " + dir.file("e.json"));
  CHECK(measured.err == "");
  CHECK(measured.exit_code == 0);
  CHECK(measured.out.ends_with("\nno candidate is of class hand: not in the balanced accuracy\n"));
  const JsonDocument document = JsonDocument::readFile(dir.file("e.json"));
  const auto rows = document.root().at("confusion").items();
  double share = 0;
  for (const std::size_t c : {0, 1, 3}) {
    double sum = 0;
    for (const JsonValue& cell : rows[c].items()) sum += cell.asNumber(0, 600);
    share += rows[c].items()[c].asNumber(0, 600) / sum / 3;
  }
  CHECK(document.root().at("balanced_accuracy").asNumber(0, 1) == Approx(share));
  for (const JsonValue& cell : rows[2].items()) CHECK(cell.asNumber(0, 600) == 0);

  CHECK(run(dir.path() + " -o " + dir.file("w.json")).exit_code == 2);
}

TEST_CASE("characters whose names are not UTF-8 are trained on and reported") {
  const TempDir dir;
  fill(dir);
  std::filesystem::create_directories(dir.file("\xff"));
  for (const char* name : {"c5.png", "c5.labels.json"})
    std::filesystem::rename(dir.file(name), dir.file(std::string("\xff/") + name));
  CHECK(run(dir.path() + " -o " + dir.file("w.json") + kQuick + " --json " + dir.file("f.json") +
            " --report " + dir.file("report"))
            .exit_code == 0);
  const JsonDocument document = JsonDocument::readFile(dir.file("f.json"));
  CHECK(document.root().at("characters").items().back().at("name").asFileName() == "\xff/c5");
  CHECK(std::filesystem::exists(dir.file("report/report.json")));
}

TEST_CASE("wrong arguments are refused in one line, with exit code 1") {
  const TempDir dir;
  fill(dir);
  const std::string good = dir.path() + " -o " + dir.file("w.json") + " ";
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"", "a folder of label files and -o FILE are needed"},
           {dir.path(), "a folder of label files and -o FILE are needed"},
           {good + "--layers 3-x-2", "--layers \"3-x-2\": must be sizes such as 3-4-4-2"},
           {good + "--layers 3-0-2", "must be sizes such as 3-4-4-2"},
           {good + "--layers 4-4-2", "must begin with 3"},
           {good + "--layers 3", "must begin with 3"},
           {good + "--method newton", "--method"},
           {good + "--epochs 0", "--epochs"},
           {good + "--restarts 0", "--restarts"},
           {good + "--momentum 1", "--momentum"},
           {good + "--learning-rate -1", "--learning-rate"},
           {good + "--learning-rate nan", "--learning-rate"},
           {good + "--weight-decay 2", "--weight-decay"},
           {good + "--weight-decay nan", "--weight-decay"},
           {good + "--validation 1", "--validation"},
           {good + "--generated -1", "--generated"},
           {good + "--class-weights some", "--class-weights"},
           {good + "--folds 1", "--folds 1: must be 0 or at least 2"},
           {good + "--folds 3 --leave-one-out", "--folds excludes --leave-one-out"},
           {good + "--folds 9", "--folds 9: there are only 6 characters"},
           {good + "--folds 0 --draws 2", "--drawn 17: must be less than the 6 characters"},
           {good + "--candidates all", "--candidates"},
           {good + "--frobnicate", "--frobnicate"},
           {"evaluate", "dir is required"}}) {
    INFO(arguments);
    const ToolRun refused = run(arguments);
    CHECK(refused.exit_code == 1);
    CHECK(refused.err.find(message) != std::string::npos);
    CHECK(std::count(refused.err.begin(), refused.err.end(), '\n') == 1);
  }
}

TEST_CASE("bad data is refused with file, path and reason, and exit code 2") {
  const TempDir dir;
  fill(dir);
  const std::string label_file = dir.file("c2.labels.json");
  const std::string good = readFile(label_file);
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    writeFile(label_file, text);
    const ToolRun refused = run(dir.path() + " -o " + dir.file("w.json") + kQuick);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.starts_with("skel-train: " + dir.path()));
    writeFile(label_file, good);
    return refused.err;
  };
  const auto holds = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(holds(refusal("\"label\": \"leg\"", "\"label\": \"tail\""), "must be head, body, hand, leg or null"));
  CHECK(holds(refusal("\"radius\": ", "\"radius\": NaN, \"r\": "), "].radius is not a finite number"));
  CHECK(holds(refusal("\"height\": 128", "\"height\": 256"), "it is 128 px; label one of them anew"));
  CHECK(holds(refusal(sha256(pictureOf(2)), sha256("other")), "has changed since it was labelled"));
  CHECK(holds(refusal("\"version\": 1", "\"version\": 3"), "use a newer skel"));

  const TempDir empty;
  const ToolRun none = run(empty.path() + " -o " + dir.file("w.json"));
  CHECK(none.exit_code == 2);
  CHECK(holds(none.err, "holds no label files"));
  CHECK(run(empty.file("none") + " -o w.json").exit_code == 2);

  for (const char* joint_class : {"head", "body", "hand"}) {
    const TempDir lacking;
    fill(lacking);
    for (int c = 0; c < 6; ++c) {
      const std::string path = lacking.file("c" + std::to_string(c) + ".labels.json");
      LabelFile file = readLabelFile(path);
      for (auto& label : file.labels)
        if (kJointClassNames[static_cast<std::size_t>(*label)] == std::string(joint_class))
          label = JointClass::kLeg;
      writeLabelFile(path, file);
    }
    const ToolRun refused = run(lacking.path() + " -o " + dir.file("w.json"));
    CHECK(refused.exit_code == 2);
    CHECK(holds(refused.err, "no candidate is labelled \"" + std::string(joint_class) + "\""));
  }

  writeFile(dir.file("bad.json"), "{}");
  const ToolRun weights = run("evaluate " + dir.path() + " --weights " + dir.file("bad.json"));
  CHECK(weights.exit_code == 2);
  CHECK(holds(weights.err, "bad.json: lacks \"format\""));
}

TEST_CASE("evaluate refused a whole set for one picture that has changed") {
  const TempDir dir;
  fill(dir);
  writeFile(dir.file("c2.png"), "another picture");
  const ToolRun measured = run("evaluate " + dir.path());
  CHECK(measured.exit_code == 2);
  CHECK(measured.err == "skel-train: " + dir.file("c2.labels.json") +
                            ": image.file: \"c2.png\" has changed since it was labelled; label it anew\n");
  CHECK(measured.out.find("(500 candidates of 5 characters)") != std::string::npos);

  for (const char* name : {"c0", "c1", "c3", "c4", "c5"})
    writeFile(dir.file(std::string(name) + ".png"), "another picture");
  const ToolRun none = run("evaluate " + dir.path());
  CHECK(none.exit_code == 2);
  CHECK(none.out.empty());
  CHECK(none.err.ends_with("skel-train: " + dir.path() + ": no drawing is left\n"));
}

TEST_CASE("one label file made drawings with annotated joints alone drop out of evaluate without a word") {
  const TempDir dir;
  fill(dir);
  for (const char* ending : {".png", ".mask.png", ".joints.json"})
    std::filesystem::copy_file(SKEL_SOURCE_DIR "/datasets/characters/cap_boy" + std::string(ending),
                               dir.file("cap_boy") + ending);
  const ToolRun all = run("evaluate " + dir.path());
  CHECK(all.exit_code == 0);
  CHECK(all.err.empty());
  CHECK(all.out.find(" candidates of 7 characters)") != std::string::npos);

  // What a label file says of a drawing counts, as before.
  writeFile(dir.file("c0.joints.json"), R"({"joints": {"head": [1, 2]}})");
  CHECK(run("evaluate " + dir.path()).out == all.out);
}

TEST_CASE("evaluate said of animals only that the first joint is none of a biped") {
  const TempDir dir;
  for (const char* name : {"cat", "dog"}) {
    writeFile(dir.file(std::string(name) + ".png"), "picture");
    writeFile(dir.file(std::string(name) + ".joints.json"), R"({"joints": {"tail_root": [1, 2]}})");
  }
  const ToolRun animals = run("evaluate " + dir.path());
  CHECK(animals.exit_code == 2);
  CHECK(
      animals.err.starts_with("skel-train: " + dir.path() +
                              ": 2 of 2 drawings (cat.png, ...) have joints of a quadruped, not of a biped; "
                              "skel-infer evaluate --template quadruped measures those\n"));
}

TEST_CASE("joints said of animals among people only that their left hands are missing") {
  const TempDir dir;
  for (const auto& [name, joint] : {std::pair("cat", "tail_root"), {"dog", "tail_root"}, {"girl", "head"}}) {
    writeFile(dir.file(std::string(name) + ".png"), "picture");
    writeFile(dir.file(std::string(name) + ".joints.json"),
              "{\"joints\": {\"" + std::string(joint) + "\": [1, 2]}}");
  }
  const ToolRun people = run("joints --drawings " + dir.path() + " -o " + dir.file("net.bin"));
  CHECK(people.exit_code == 2);
  CHECK(people.err == "skel-train: " + dir.path() +
                          ": 2 of 3 drawings (cat.joints.json, ...) have joints of a quadruped, not of a "
                          "biped: --template quadruped takes those, in a folder of their own\n");
}

TEST_CASE("a net is not replaced by one of another kind, but by one of its own") {
  const TempDir dir;
  fill(dir);
  const std::string net = dir.file("net.bin"),
                    bytes = "{\"format\":\"skel-joint-net\",\"version\":3}\nweights";
  writeFile(net, bytes);
  const ToolRun refused = run(dir.path() + " -o " + net + kQuick);
  CHECK(refused.exit_code == 4);
  CHECK(refused.err.find(
            "net.bin: is a net that finds joints (--joint-net), and would be replaced by weights that "
            "tell candidates apart (--weights); name another output\n") != std::string::npos);
  CHECK(readFile(net) == bytes);
  writeFile(net, readFile(SKEL_SOURCE_DIR "/weights/default.json"));
  CHECK(run(dir.path() + " -o " + net + kQuick).exit_code == 0);
  CHECK(readWeights(net).provenance.samples == 600);

  for (const char* command : {"joints --steps 1 --validation 1", "pages --steps 1", "confidence --biped x"}) {
    INFO(command);
    const ToolRun other = run(std::string(command) + " -o " + net);
    CHECK(other.exit_code != 0);
    CHECK(readWeights(net).provenance.samples == 600);
  }
}

TEST_CASE("an output that cannot be written has exit code 4") {
  const TempDir dir;
  fill(dir);
  writeFile(dir.file("file"), "");
  CHECK(run(dir.path() + " -o " + dir.file("file/w.json") + kQuick).exit_code == 4);
}

TEST_CASE("the help of a command does not end with the example of the whole tool") {
  CHECK(skel::runTool("skel-train --help").out.find("Example: ") != std::string::npos);
  for (const std::string command : {"joints", "evaluate", "pages"})
    CHECK(skel::runTool("skel-train " + command + " --help").out.find("Example: ") == std::string::npos);
}

TEST_CASE("characters of one picture were left out one by one, and learned from in each other's shape") {
  const TempDir dir;
  fill(dir, true);
  const std::string train =
      dir.path() + " -o " + dir.file("w.json") + " --generated 0 --epochs 2 --restarts 1 ";
  const ToolRun refused = run(train + "--leave-one-out");
  CHECK(refused.exit_code == 1);
  CHECK(refused.err.find("--leave-one-out: there is only 1 picture of 6 characters; take --folds 0") !=
        std::string::npos);
  LabelFile other = readLabelFile(dir.file("c5.labels.json"));
  writeFile(dir.file("c5.png"), pictureOf(5));
  other.image.sha256 = sha256(pictureOf(5));
  writeLabelFile(dir.file("c5.labels.json"), other);
  const ToolRun done = run(train + "--leave-one-out");
  CHECK(done.exit_code == 0);
  CHECK(done.err ==
        "skel-train: note: 5 characters are one picture (c0, c1, c2, c3 and 1 more): they are left out "
        "together\n");
  CHECK(done.out.find("(2 folds)") != std::string::npos);
  CHECK(run(train + "--folds 0").err == "");
}

TEST_CASE("of one character --leave-one-out measured on the training set without a word") {
  const TempDir dir;
  fill(dir);
  for (int c = 1; c < 6; ++c) std::filesystem::remove(dir.file("c" + std::to_string(c) + ".labels.json"));
  for (const auto& [option, message] :
       {std::pair("--leave-one-out", "--leave-one-out: there is only 1 character; take --folds 0"),
        {"--folds 10", "--folds 10: there is only 1 character; take --folds 0"}}) {
    const ToolRun refused = run(dir.path() + " -o " + dir.file("w.json") + " " + option);
    CHECK(refused.exit_code == 1);
    CHECK(refused.err.find(message) != std::string::npos);
  }
}

TEST_CASE("classes were learned from animals among people without a word") {
  const TempDir dir;
  fill(dir);
  const std::string train = dir.path() + " -o " + dir.file("w.json") + " --generated 0 --epochs 2 --folds 0";
  const auto give = [&](int character, const std::string& joint) {
    const std::string path = dir.file("c" + std::to_string(character) + ".labels.json");
    LabelFile labels = readLabelFile(path);
    labels.joints = {{joint, Eigen::Vector2d(10, 10)}};
    writeLabelFile(path, labels);
  };
  for (int c = 0; c < 6; ++c) give(c, "head");
  CHECK(run(train).err == "");
  for (const int c : {1, 4}) give(c, "tail");
  CHECK(run(train).err ==
        "skel-train: note: 2 of 6 characters have joints of a quadruped (c1, c4): one net learns the classes "
        "of "
        "all\n");
}

TEST_CASE("a label file is not replaced by weights") {
  const TempDir dir;
  fill(dir);
  const std::string labels = dir.file("c0.labels.json"), before = readFile(labels);
  for (const std::string& command :
       {dir.path() + kQuick, std::string("joints --steps 1 --validation 1"), std::string("pages --steps 1"),
        std::string("average " SKEL_SOURCE_DIR "/weights/page_net.bin " SKEL_SOURCE_DIR
                    "/weights/page_net.bin")}) {
    INFO(command);
    const ToolRun refused = run(command + " -o " + labels);
    CHECK(refused.exit_code == 4);
    CHECK(
        refused.err.find("c0.labels.json: is a file of format \"skel-labels\", and would be replaced by ") !=
        std::string::npos);
    CHECK(readFile(labels) == before);
  }
}

TEST_CASE("skel-train says which pictures have no labels") {
  const TempDir dir;
  fill(dir);
  writeFile(dir.file("new.png"), "picture");
  const ToolRun train = run(dir.path() + " -o " + dir.file("w.json") + kQuick);
  CHECK(train.exit_code == 0);
  CHECK(train.err == "skel-train: note: 1 of 7 pictures have no labels (new.png): not learned from\n");
}

TEST_CASE(
    "skel-train says of how many epochs the weights are that it keeps: those after the last are unjudged") {
  const TempDir dir;
  fill(dir);
  const ToolRun train = run(dir.path() + " -o " + dir.file("w.json") + kQuick);
  const int epochs = readWeights(dir.file("w.json")).provenance.epochs;
  CHECK(train.out.ends_with("wrote " + dir.file("w.json") + " (of the least loss: after " +
                            std::to_string(epochs) + " of 80 epochs)\n"));
}

TEST_CASE("a training of parts went on without any drawing that has parts") {
  const TempDir dir;
  for (const char* end : {".png", ".mask.png", ".joints.json"})
    std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy" + std::string(end),
                               dir.file("cap_boy") + end);
  const std::string train = "parts --steps 1 --batch 4 -o " + dir.file("p.bin"),
                    drawings = " --drawings " + dir.path() + " --shapes " + dir.file("shapes");
  const ToolRun no_folder = run(train + drawings);
  CHECK(no_folder.exit_code == 2);
  CHECK(no_folder.err ==
        "skel-train: " + dir.file("shapes") + ": is no folder; script/shape-maps makes it\n");
  std::filesystem::create_directories(dir.file("shapes"));
  const ToolRun no_parts = run(train + drawings);
  CHECK(no_parts.exit_code == 2);
  CHECK(no_parts.err.starts_with("skel-train: " + dir.file("shapes") + ": 0 of 1 drawings have parts: "));
  CHECK(run(train + " --drawings " + dir.path()).exit_code == 1);
  CHECK_FALSE(std::filesystem::exists(dir.file("p.bin")));

  const ToolRun without = run(train);
  CHECK(without.exit_code == 0);
  CHECK(without.out.find("validation: loss -  limbs -  before - of 0  parts - - ") != std::string::npos);
  CHECK(without.out.ends_with("wrote " + dir.file("p.bin") + "\n"));
}
