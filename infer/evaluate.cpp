#include "infer/evaluate.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "infer/annotation.h"
#include "infer/rig_request.h"
#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/json_names.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/rng.h"
#include "libskel/core/text.h"
#include "libskel/draw/draw_skeleton.h"
#include "libskel/image/write_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/coco_of_others.h"
#include "libskel/labels/moved_in_skeleton.h"
#include "libskel/labels/twins.h"
#include "libskel/recognition/calibration.h"
#include "libskel/skeleton/body_plans.h"

namespace skel {
namespace {

using Json = nlohmann::ordered_json;

struct Row {
  std::string name;
  bool annotated = false, counts = true, found = false;
  Score score;
  std::string reason;                         // why nothing was found
  std::string other_plan;                     // whose joints it has; "": those of the one that is measured
  std::string overruled, overruled_skeleton;  // see MeasuredDrawing
  std::vector<std::string> outside;           // joints
  bool lacks_mask = false;                    // which --given-mask would hand over
  std::string image_sha256;
  NamedJoints joints;    // that are true
  double figure_px = 0;  // its long side
  std::optional<Error> failure;
};

std::string overlayFile(const EvaluateOptions& options, std::string name) {
  std::replace(name.begin(), name.end(), '/', '-');
  return options.overlays + "/" + name + ".png";
}

// Joints that are annotated outside of the picture: no skeleton can have them.
std::vector<std::string> outside(const MeasuredDrawing& truth) {
  std::vector<std::string> names;
  for (const auto& [name, place] : truth.joints)
    if (place && !isInPicture(*place, truth.image)) names.push_back(name);
  return names;
}

Row evaluateDrawing(const EvaluateOptions& options, const RigOptions& rig, const std::string& id) {
  MeasuredDrawing truth = readMeasuredDrawing(options.dir, id);
  Row row;
  row.name = nameOfDrawing(options.dir, id);
  row.annotated = !truth.joints.empty();
  row.overruled = truth.overruled;
  row.overruled_skeleton = truth.overruled_skeleton;
  row.counts = !options.opaque || (row.annotated && !isTransparent(truth.image));
  if (row.counts) row.other_plan = otherPlanOf(truth, rig.body_plan);
  if (!row.counts || !row.other_plan.empty()) return row;
  ensureJointsOf(rig.body_plan, {truth.joints.begin(), truth.joints.end()}, truth.joints_file);
  row.outside = outside(truth);
  turnClockwise(truth, options.turn_deg / 90);
  RigInput input;
  input.image = truth.image;
  input.file = row.name;
  if (options.given_mask) input.mask = truth.mask;  // without one it has to be found
  row.lacks_mask = options.given_mask && !truth.mask;
  const RiggedDrawing drawing = rigCharacter(std::move(input), rig);
  row.image_sha256 = truth.image_sha256;
  row.joints.assign(truth.joints.begin(), truth.joints.end());
  row.found = drawing.found();
  if (row.found) row.figure_px = kWorkingGridSize / drawing.silhouette.grid.scale;
  row.reason = drawing.silhouette.reason;
  if (row.annotated)
    row.score = score(truth, drawing.found() ? &drawing.recognition : nullptr, drawing.silhouette.mask,
                      rig.body_plan);
  else
    row.score.confidence = drawing.recognition.confidence, row.score.likeness = drawing.recognition.likeness;
  if (!options.overlays.empty() && row.found) {
    Image picture = drawing.image;
    drawSkeleton(picture, drawing.character.skeleton);
    writeFile(overlayFile(options, row.name), encodePng(picture));
  }
  return row;
}

// Of drawings that are one picture, and whose joints are not the same.
std::string apartSaid(const std::vector<Row>& rows) {
  std::vector<std::string> names, sha256s;
  std::vector<NamedJoints> joints;
  for (const Row& row : rows) {
    names.push_back(row.name);
    sha256s.push_back(row.image_sha256);
    joints.push_back(row.joints);
  }
  const std::string apart = twinJointsSaid(sha256s, joints, [&](std::size_t i) { return rows[i].figure_px; });
  return apart.empty() ? "" : twinsSaid("drawings", names, sha256s) + apart;
}

using Figure = std::optional<double>;  // none: there is nothing to measure by

// Over those that have one.
Figure mean(const std::vector<Row>& rows, const std::function<Figure(const Row&)>& value) {
  double sum = 0;
  int count = 0;
  for (const Row& row : rows)
    if (const Figure one = value(row)) sum += *one, ++count;
  return count > 0 ? Figure(sum / count) : std::nullopt;
}

Figure share(double part, double whole) { return whole > 0 ? Figure(part / whole) : std::nullopt; }

Json jsonOf(const Figure& figure) { return figure ? Json(*figure) : Json(nullptr); }

std::string shown(const Figure& figure, int decimals, int width = 0) {
  char text[32];
  if (figure)
    std::snprintf(text, sizeof text, "%*.*f", width, decimals, *figure);
  else
    std::snprintf(text, sizeof text, "%*s", width, "-");
  return text;
}

// 95 % interval of the mean, by bootstrap over characters.
std::string interval(const std::vector<Row>& rows, const std::function<double(const Row&)>& value) {
  Rng rng(1);
  std::vector<double> means(1000);
  for (double& m : means) {
    for (size_t i = 0; i < rows.size(); ++i)
      m += value(rows[rng.below(static_cast<std::uint32_t>(rows.size()))]);
    m /= static_cast<double>(rows.size());
  }
  std::sort(means.begin(), means.end());
  char text[32];
  std::snprintf(text, sizeof text, "[%.2f %.2f]", means[25], means[974]);
  return text;
}

}  // namespace

void bindEvaluateOptions(CLI::App& app, EvaluateOptions& options) {
  app.option_defaults()->always_capture_default();
  options.infer.body_plan = "biped";
  app.add_option("DIR", options.dir,
                 "Folder of drawings at any depth: folders of image.png, joints.json and mask.png, files "
                 "<name>.png,\n"
                 "<name>.joints.json and <name>.mask.png, or <name>.labels.json with joints that a person "
                 "has placed;\n"
                 "without a mask the silhouette is not measured")
      ->required();
  app.add_option("--json", options.json_file, "Write the figures to this file, too")
      ->always_capture_default(false)
      ->check(outputFile());
  app.add_option("--overlays", options.overlays, "Folder for a picture of each drawing with its skeleton")
      ->always_capture_default(false);
  app.add_flag("--given-mask", options.given_mask,
               "Hand the true mask over: judges everything after the silhouette");
  app.add_flag("--opaque", options.opaque, "Only annotated drawings whose silhouette has to be found");
  app.add_option("--rotate", options.turn_deg, "Turn all drawings clockwise first, degrees")
      ->check(oneOfNumbers({0, 90, 180, 270}));
  bindRecognitionOptions(app, options.infer);
  app.get_option("--template")
      ->description("Body plan that is measured against: biped, quadruped, or a .json file");
}

ExitCode runEvaluate(const EvaluateOptions& options) {
  if (options.infer.body_plan == "auto")
    throw UsageError("joints are measured against those of one body plan: name it by --template");
  RigOptions rig = rigOptions(options.infer);
  rig.last = LastStage::kJoints;
  noteUnusedWeights(options.infer);
  if (!options.overlays.empty()) ensureWritableFolder(options.overlays);
  keepCocoOfOthers(options.json_file, "name another file by --json");
  const std::vector<std::string> ids = findDrawings(options.dir);
  for (const std::string& id : ids) noteMeasuredFiles(options.dir, id);
  if (!options.overlays.empty())
    for (const std::string& id : ids) noteNamedOutput(overlayFile(options, nameOfDrawing(options.dir, id)));
  std::vector<Row> all(ids.size());
  {
    ProgressBar progress("evaluating", ids.size());
    parallelFor(ids.size(), options.infer.jobs, [&](std::size_t i) {
      try {
        all[i] = evaluateDrawing(options, rig, ids[i]);
      } catch (const OverwriteError&) {
        throw;
      } catch (...) {
        all[i].failure = caughtError(options.dir + "/" + ids[i]);
      }
      progress.advance();
    });
  }

  ExitCode code = ExitCode::kDone;
  for (const Row& row : all) {
    if (!row.failure) continue;
    std::fprintf(stderr, "skel-infer: %s\n", row.failure->what());
    if (code == ExitCode::kDone) code = row.failure->exitCode();
  }
  if (std::none_of(all.begin(), all.end(), [](const Row& row) { return row.counts; }))
    throw InputError(options.dir,
                     "holds no annotated drawing whose silhouette has to be found (--opaque): nothing to "
                     "measure");
  std::vector<std::string> overruled, overruled_skeletons;
  for (const Row& row : all) {
    if (!row.overruled.empty()) overruled.push_back(row.overruled);
    if (!row.overruled_skeleton.empty()) overruled_skeletons.push_back(row.overruled_skeleton);
  }
  if (!overruled.empty()) std::fprintf(stderr, "skel-infer: note: %s\n", overruledNote(overruled).c_str());
  if (!overruled_skeletons.empty())
    std::fprintf(stderr, "skel-infer: note: %s\n", movedInSkeletonNote(overruled_skeletons).c_str());
  std::vector<std::string> without_mask;
  for (const Row& row : all)
    if (row.lacks_mask) without_mask.push_back(row.name);
  if (!without_mask.empty())
    std::fprintf(stderr,
                 "skel-infer: note: %s: no mask to hand over (--given-mask), so the figure was found\n",
                 firstAndMore(without_mask).c_str());
  std::vector<std::string> outside;
  for (const Row& row : all)
    if (!row.outside.empty()) outside.push_back(row.name + " (" + joined(row.outside) + ")");
  if (!outside.empty())
    std::fprintf(stderr,
                 "skel-infer: note: joints that lie outside of the picture, measured as they are: %s\n",
                 printable(firstAndMore(outside)).c_str());
  for (const std::string& note : {apartSaid(all), unmeasuredAmong(options.dir)})
    if (!note.empty()) std::fprintf(stderr, "skel-infer: note: %s\n", printable(note).c_str());
  std::map<std::string, std::vector<std::string>> of_other_plans;
  for (const Row& row : all)
    if (!row.other_plan.empty()) of_other_plans[row.other_plan].push_back(row.name);
  for (const auto& [plan, drawings] : of_other_plans) {
    const InputError error(options.dir, otherPlanSaid(drawings, all.size(), plan, rig.body_plan.name) +
                                            ": not measured; --template " + plan + " measures them");
    std::fprintf(stderr, "skel-infer: %s\n", error.what());
    if (code == ExitCode::kDone) code = error.exitCode();
  }
  std::vector<Row> rows, hard;
  for (const Row& row : all)
    if (row.counts && !row.failure && row.other_plan.empty()) (row.annotated ? rows : hard).push_back(row);
  Json json;
  json["characters"] = Json::object();
  if (rows.empty() && !hard.empty())
    std::fprintf(stderr, "skel-infer: note: no joints are annotated in %s, so none are measured\n",
                 printable(options.dir).c_str());
  if (!rows.empty())
    std::printf("%-34s  PCK.05 PCK.10  error usable limbs inside   IoU  worst joint\n", "character");
  for (const Row& row : rows) {
    const Score& s = row.score;
    std::printf("%-34s  %6.2f %6.2f %6.3f %6.0f %s %s %s  %s\n", printable(row.name).c_str(), s.pck05,
                s.pck10, s.error, s.usable, shown(s.limbs, 2, 5).c_str(), shown(s.inside, 2, 6).c_str(),
                shown(s.iou, 2, 5).c_str(),
                !row.found              ? ("no skeleton: " + row.reason).c_str()
                : s.worst_joint.empty() ? "-"
                                        : s.worst_joint.c_str());
    json["characters"][jsonFromFileName(row.name)] = {
        {"joints", s.annotated},
        {"pck05", s.pck05},
        {"pck10", s.pck10},
        {"error", s.error},
        {"usable", s.usable},
        {"limbs", jsonOf(s.limbs)},
        {"inside", jsonOf(s.inside)},
        {"iou", jsonOf(s.iou)},
        {"confidence", s.confidence},
        {"likeness", s.likeness},
        {"worst_joint", s.worst_joint.empty() ? Json() : Json(s.worst_joint)}};
  }
  for (const Row& row : hard)
    std::printf(
        "hard case %s: %s\n", printable(row.name).c_str(),
        row.found ? ("confidence " + std::to_string(row.score.confidence)).c_str() : row.reason.c_str());
  if (!rows.empty()) {
    const auto of = [](double Score::*field) { return [field](const Row& row) { return row.score.*field; }; };
    const auto sum = [&](int Score::*field) {
      double total = 0;
      for (const Row& row : rows) total += row.score.*field;
      return total;
    };
    const auto pck05 = of(&Score::pck05), pck10 = of(&Score::pck10), usable = of(&Score::usable);
    const auto sharp = [](const Row& row) {
      return row.score.iou ? Figure(*row.score.iou >= 0.9 ? 1 : 0) : std::nullopt;
    };
    const auto maybe = [](std::optional<double> Score::*field) {
      return [field](const Row& row) { return row.score.*field; };
    };
    const auto confident = [](const Row& row) { return row.score.confidence >= 0.5 ? 1.0 : 0.0; };
    const auto whole = [](const Row& row) { return row.score.likeness >= 0.5 ? 1.0 : 0.0; };
    std::vector<Forecast> forecasts;  // of figures: that they are usable
    for (const Row& row : rows) forecasts.push_back({row.score.confidence, row.score.usable == 1});
    const double annotated = sum(&Score::annotated), sure = sum(&Score::sure),
                 right = sum(&Score::sure_right);
    const bool both_kinds =
        std::adjacent_find(forecasts.begin(), forecasts.end(), [](const Forecast& a, const Forecast& b) {
          return a.came_true != b.came_true;
        }) != forecasts.end();
    const std::vector<std::pair<const char*, Figure>> figures = {
        {"pck05", mean(rows, pck05)},
        {"pck10", mean(rows, pck10)},
        {"error", mean(rows, of(&Score::error))},
        {"usable", mean(rows, usable)},
        {"limbs", mean(rows, maybe(&Score::limbs))},
        {"inside", mean(rows, maybe(&Score::inside))},
        {"iou", mean(rows, maybe(&Score::iou))},
        {"iou90", mean(rows, sharp)},
        {"sure_share", share(sure, annotated)},
        {"sure_precision", share(right, sure)},
        {"confident_figures", mean(rows, confident)},
        {"whole_figures", mean(rows, whole)},
        {"confidence_auc", both_kinds ? Figure(areaUnderRoc(forecasts)) : std::nullopt},
        {"confidence_error", calibrationError(forecasts)}};
    json["mean"]["characters"] = rows.size();
    json["mean"]["joints"] = int(annotated);
    for (const auto& [key, value] : figures) json["mean"][key] = jsonOf(value);
    const auto figure = [&](std::string_view key, int decimals = 3) {
      const auto at =
          std::find_if(figures.begin(), figures.end(), [&](const auto& one) { return one.first == key; });
      return shown(at->second, decimals);
    };
    std::printf(
        "mean over %zu characters: PCK@.05 %s %s  PCK@.10 %s %s  error %s  usable %s %s  limbs %s  "
        "inside %s\n",
        rows.size(), figure("pck05").c_str(), interval(rows, pck05).c_str(), figure("pck10").c_str(),
        interval(rows, pck10).c_str(), figure("error").c_str(), figure("usable").c_str(),
        interval(rows, usable).c_str(), figure("limbs").c_str(), figure("inside").c_str());
    const auto with_mask =
        std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.score.iou.has_value(); });
    std::printf(
        "silhouette IoU %s, >= .9 in %s%s  |  confidence >= .8 for %s of joints, %s of those within "
        ".10; figure confidence >= .5 for %s, likeness for %s\n"
        "confidence against usable: area under ROC %s, calibration error %s\n",
        figure("iou").c_str(), figure("iou90").c_str(),
        with_mask > 0 && with_mask < std::ptrdiff_t(rows.size())
            ? (" (of the " + std::to_string(with_mask) + " with a true mask)").c_str()
            : "",
        figure("sure_share", 2).c_str(), figure("sure_precision").c_str(),
        figure("confident_figures", 2).c_str(), figure("whole_figures", 2).c_str(),
        figure("confidence_auc").c_str(), figure("confidence_error").c_str());
    constexpr double kMany = 0.1;
    if (const double same = sum(&Score::taken_over); same > kMany * annotated)
      std::fprintf(
          stderr,
          "skel-infer: note: %.0f of %.0f joints are annotated exactly where they are found now: taken "
          "over from such a run, they flatter it\n",
          same, annotated);
  }
  if (!hard.empty()) {
    const auto refused = std::count_if(hard.begin(), hard.end(), [](const Row& row) { return !row.found; });
    const auto unsure = std::count_if(hard.begin(), hard.end(),
                                      [](const Row& row) { return row.found && row.score.confidence < 0.5; });
    std::printf("hard cases: %td without a skeleton, %td of %td others with confidence < .5\n", refused,
                unsure, static_cast<std::ptrdiff_t>(hard.size()) - refused);
  }
  if (!options.json_file.empty()) writeFile(options.json_file, json.dump(1) + "\n");
  return code;
}

}  // namespace skel
