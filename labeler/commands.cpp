#include "labeler/commands.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "labeler/document.h"
#include "labeler/label_report.h"
#include "labeler/labeling_window.h"
#include "labeler/make_motion.h"
#include "libskel/classifier/weights_file.h"
#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/labels/coco_of_others.h"
#include "libskel/skeleton/motion_file.h"

namespace skel {
namespace {

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

OnError complaints() {
  return [](const Error& error) { std::fprintf(stderr, "skel-label: %s\n", error.what()); };
}

ExitCode report(const ImportCounts& counts) {
  print(std::to_string(counts.made) + " label files made, " + std::to_string(counts.kept) +
        " kept as they were, " + std::to_string(counts.failed) + " failed\n");
  return counts.exit_code;
}

void noteKept(const std::vector<std::string>& kept, const char* how) {
  if (kept.empty()) return;
  std::fprintf(stderr, "skel-label: note: %s: kept, %s, and drops joints set by hand\n",
               firstAndMore(kept).c_str(), how);
}

void notePassedOver(const std::set<std::string>& exports) {
  if (exports.empty()) return;
  std::fprintf(stderr,
               "skel-label: note: %s: exported from label files, not imported beside what it was made of; "
               "skel-label import FILE takes it\n",
               firstAndMore({exports.begin(), exports.end()}).c_str());
}

void noteLacking(const ImportCounts& counts) {
  if (counts.lacking.empty()) return;
  const std::string without_class =
      counts.without_class > 0 ? ": " + std::to_string(counts.without_class) + " candidates have no class"
                               : "";
  std::fprintf(stderr, "skel-label: note: %s: no place for %s%s\n", firstAndMore(counts.lacking).c_str(),
               joined({counts.missing_joints.begin(), counts.missing_joints.end()}).c_str(),
               without_class.c_str());
}

void noteUnknownJoints(const ImportCounts& counts) {
  for (const auto& [source, names] : counts.unknown_joints)
    std::fprintf(stderr, "skel-label: note: %s: not known as joints, and left out: %s\n",
                 printable(source).c_str(), firstFew({names.begin(), names.end()}, 8).c_str());
}

std::string namesOf(const std::set<std::string>& folders) {
  constexpr std::size_t kMostNamed = 4;
  std::vector<std::string> names;
  for (const std::string& folder : folders)
    if (names.size() < kMostNamed) names.push_back(shellWord(folder));
  const std::size_t more = folders.size() - names.size();
  return joined(names) + (more > 0 ? " and " + std::to_string(more) + " more folders" : "");
}

void noteWithoutLimb(const ImportCounts& counts) {
  for (const auto& [limb, files] : counts.without_limb)
    std::fprintf(
        stderr,
        "skel-label: note: %s: no candidate is of the class %s, though all joints of such a limb are "
        "placed: where it does not lie before the body, look at the mask\n",
        firstAndMore(files).c_str(), kJointClassNames[static_cast<std::size_t>(limb)]);
}

Mlp mlpOf(const LabelerOptions& options) {
  return options.weights.empty() ? defaultMlp() : readMlp(options.weights);
}

Recognizer recognizerOf(const LabelerOptions& options) {
  return options.recognizer == "paper" ? Recognizer::kPaper : Recognizer::kTree;
}

ExitCode openWindow(const LabelerOptions& options) {
  if (options.path.empty())
    throw UsageError("name a folder of pictures, a picture, a skeleton file or a motion file (see --help)");
  return runLabelingWindow(options.path,
                           {mlpOf(options), bodyPlans(options.body_plan), recognizerOf(options)});
}

ExitCode motion(const LabelerOptions& options) {
  const MotionCounts counts =
      makeMotion(options.dir,
                 {options.output, options.frame_rate, options.force, mlpOf(options),
                  bodyPlans(options.body_plan), recognizerOf(options)},
                 [](const Error& error) { std::fprintf(stderr, "%s\n", error.what()); });
  print(printable(counts.output) + ": " + std::to_string(counts.frames) + " frames, " +
        std::to_string(counts.without_figure) + " without a figure\n");
  return ExitCode::kDone;
}

ExitCode check(const LabelerOptions& options) {
  const std::vector<std::string> lines = checkLabels(options.dir, bodyPlans(options.body_plan));
  for (const std::string& line : lines) std::fprintf(stderr, "skel-label: %s\n", messageLine(line).c_str());
  for (const std::string& note : {twinsAmong(options.dir), unlabelledAmong(options.dir)})
    if (!note.empty()) std::fprintf(stderr, "skel-label: note: %s\n", note.c_str());
  if (lines.empty()) print("no inconsistencies\n");
  return lines.empty() ? ExitCode::kDone : ExitCode::kInput;
}

ExitCode exportLabels(const LabelerOptions& options) {
  if (options.coco == options.csv) throw UsageError("export needs either --coco or --csv");
  const std::string output = !options.output.empty() ? options.output
                             : options.coco          ? "out/labels.coco.json"
                                                     : "out/labels.csv";
  noteOutput(output);
  if (!options.force) keepCocoOfOthers(output, "name another file by -o, or replace it by --force");
  ExitCode code = ExitCode::kDone;
  const OnError on_error = [&](const Error& error) {
    complaints()(error);
    if (code == ExitCode::kDone) code = error.exitCode();
  };
  const std::string text = options.coco ? labelsAsCoco(options.dir, bodyPlans(options.body_plan), on_error)
                                        : labelsAsCsv(options.dir, bodyPlans(options.body_plan), on_error);
  if (text.empty()) return code;
  writeFile(output, text);
  print(printable(output) + "\n");
  for (const std::string& note : overruledAmong(options.dir))
    std::fprintf(stderr, "skel-label: note: %s\n", note.c_str());
  return code;
}

}  // namespace

void bindCommands(CLI::App& app, LabelerOptions& options, std::function<ExitCode()>& run) {
  run = [&] { return openWindow(options); };
  app.add_option("path", options.path,
                 "Folder of pictures (any depth), picture, skeleton file or motion file to open in a window");
  app.add_option("--weights", options.weights, "Weights that suggest labels (default: those built in)");
  app.add_option(
         "--template", options.body_plan,
         "Body plan: a name, a file, or auto: biped or quadruped, as each drawing's files or the nets say")
      ->capture_default_str();
  app.add_option("--recognizer", options.recognizer, "How joints are found")
      ->check(CLI::IsMember({"paper", "tree"}))
      ->capture_default_str();
  app.require_subcommand(0, 1);

  const auto command = [&](const char* name, const char* description, std::function<ExitCode()> action) {
    CLI::App* sub = app.add_subcommand(name, description);
    sub->add_option("dir", options.dir,
                    std::string_view(name) == "import" ? "Folder, at any depth, or a COCO file"
                                                       : "Folder, at any depth")
        ->required();
    sub->fallthrough();
    sub->parse_complete_callback([&run, action] { run = action; });
    return sub;
  };
  command("candidates",
          "Make an empty label file for every picture that has none; one that was renamed gets its labels",
          [&] {
            const ImportCounts counts = makeLabelFiles(options.dir, complaints());
            for (const std::string& note : counts.former)
              std::fprintf(stderr, "skel-label: note: %s\n", printable(note).c_str());
            return report(counts);
          });
  CLI::App* import =
      command("import",
              "Make label files from annotations: char_cfg.yaml, joints.json, "
              "<stem>.joints.json, COCO keypoints, and "
              "from skeletons that skel-infer has found",
              [&] {
                const ImportCounts counts =
                    importLabels(options.dir, bodyPlans(options.body_plan), options.import, complaints());
                const ExitCode code = report(counts);
                if (counts.labelled > 0)
                  print("classes by placed joints in " + std::to_string(counts.labelled) +
                        " label files that had none\n");
                if (counts.masks_taken > 0)
                  print("the mask beside the picture taken in " + std::to_string(counts.masks_taken) +
                        " label files that had none\n");
                notePassedOver(counts.passed_over);
                noteKept(counts.earlier,
                         "but the picture has changed since it was labelled; --force makes the labels anew");
                noteKept(counts.other_mask,
                         "but the mask has changed since it was labelled; --force makes the labels anew");
                noteKept(counts.differing,
                         "with other joints (elsewhere, or placed by hand) than what is to be imported; "
                         "--force takes the latter");
                noteLacking(counts);
                noteUnknownJoints(counts);
                if (!counts.outside_mask.empty())
                  std::fprintf(stderr, "skel-label: note: %s\n", firstAndMore(counts.outside_mask).c_str());
                noteWithoutLimb(counts);
                if (counts.made > 0)
                  print(std::to_string(counts.joints_placed) + " joints placed, " +
                        std::to_string(counts.joints_found) + " found" +
                        (counts.classes_kept > 0
                             ? "; classes set by hand and kept: " + std::to_string(counts.classes_kept)
                             : "") +
                        (counts.classes_dropped > 0
                             ? "; classes dropped with candidates that the figure has no longer: " +
                                   std::to_string(counts.classes_dropped)
                             : "") +
                        "\nwritten into " + namesOf(counts.folders) + "\n");
                return code;
              });
  import->add_option("-o,--output", options.import.output,
                     "Copy pictures and masks here, with their label files");
  import->add_flag("--force", options.import.force,
                   "Make label files anew that exist already, also over masks and copies of other content; "
                   "classes set by hand stay");
  command("check", "Name every inconsistency of the label files", [&] { return check(options); });
  command("stats", "Count drawings, candidates and labels", [&] {
    print(labelStats(options.dir));
    return ExitCode::kDone;
  });
  CLI::App* motion_of = command("motion", "Find the joints in every frame of a video (a folder of pictures)",
                                [&] { return motion(options); });
  motion_of->add_option("-o,--output", options.output, "File (default: out/<folder>.motion.json)")
      ->check(outputFile("skel-motion"));
  motion_of->add_option("--frame-rate", options.frame_rate, "Frames a second")
      ->check(numberIn(kMinFrameRate, kMaxFrameRate))
      ->capture_default_str();
  motion_of->add_flag("--force", options.force, "Also over joints that were placed by hand");
  CLI::App* exported =
      command("export", "Write labels for other programs", [&] { return exportLabels(options); });
  exported->add_flag("--coco", options.coco, "COCO keypoints: joints and outline of every drawing");
  exported->add_flag("--csv", options.csv, "A table: a row a candidate with features and label");
  exported
      ->add_option("-o,--output", options.output, "File (default: out/labels.coco.json or out/labels.csv)")
      ->check(outputFile());
  exported->add_flag("--force", options.force, "Also over COCO annotations of others");
}

}  // namespace skel
