#include "infer/run_report.h"

#include <cstdio>
#include <numbers>
#include <utility>

#include "infer/report_page.h"
#include "infer/result_file.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/pipeline/facing.h"

namespace skel {
namespace {

constexpr std::size_t kMostNames = 3;  // for one sentence about a list

std::string numberOf(const InferOptions& options, const FigureResult& figure) {
  return options.figure == "all" ? ", figure " + std::to_string(figure.number) : "";
}

// What is said of joints, if any were looked for.
std::string jointsText(const FigureResult& figure, bool tells_plan) {
  if (!figure.confidence) return "";
  char sure[32] = "  joints placed by hand";
  if (!figure.all_placed) std::snprintf(sure, sizeof sure, "  confidence %.2f", *figure.confidence);
  const std::string drawn = drawnFrom(figure.facing_deg.value_or(0) * std::numbers::pi / 180),
                    plan = tells_plan ? "  " + figure.body_plan : "";
  return sure + plan + (drawn == drawnFrom(0) ? "" : (tells_plan ? ", " : "  ") + drawn);
}

void print(const InferOptions& options, bool tells_plan, const DrawingResult& drawing) {
  for (const FigureResult& figure : drawing.figures) {
    std::printf("%s%s: %s%s%s\n", printable(drawing.source).c_str(), numberOf(options, figure).c_str(),
                figure.outputs.empty() ? "nothing to write" : printable(figure.outputs.front().path).c_str(),
                jointsText(figure, tells_plan).c_str(), drawing.kept ? "  (done before)" : "");
    if (!options.timings || drawing.kept) continue;
    double total = 0;
    for (const StageTime& time : figure.times) {
      std::printf("  %-12s %8.2f ms\n", time.stage.c_str(), time.time_s * 1e3);
      total += time.time_s;
    }
    std::printf("  %-12s %8.2f ms\n", "total", total * 1e3);
  }
  std::fflush(stdout);  // what is said of it on stderr comes after it in one file, too
}

// A line is whole or not there, also where several processes write to one file.
void printJson(const DrawingResult& drawing) {
  const std::string line = formatResult(drawing) + "\n";
  std::fwrite(line.data(), 1, line.size(), stdout);
  std::fflush(stdout);
}

// With --quiet only what was mended and is left out.
void sayNotes(const InferOptions& options, const DrawingResult& drawing) {
  for (const FigureResult& figure : drawing.figures) {
    const auto say = [&](const Note& note) {
      std::fprintf(stderr, "%s%s: note: %s\n", printable(drawing.source).c_str(),
                   numberOf(options, figure).c_str(), printable(noteText(note, figure.mend_file)).c_str());
    };
    if (options.quiet) {
      for (const Note& note : figure.left_out) say(note);
      continue;
    }
    for (const std::string& reason : figure.reasons) say({reason});
    for (const Note& note : figure.notes) say(note);
  }
}

}  // namespace

RunReport::RunReport(const InferOptions& options, const RigOptions& rig, bool many)
    : options_(options),
      tells_plan_(rig.otherwise.has_value()),
      many_(many),
      table_(options.figure == "all", options.list_file.empty() ? 0 : kMostNames) {}

void RunReport::add(DrawingResult drawing) {
  if (options_.list_file.empty()) noteTwin(drawing);
  if (options_.json_lines)
    printJson(drawing);
  else if (!options_.quiet)
    print(options_, tells_plan_, drawing);
  if (drawing.left_out) {
    if (left_out_++ == 0) first_left_out_ = drawing.source;
    return;
  }
  ++drawings_;
  if (options_.quiet || (!options_.json_lines && !many_)) sayNotes(options_, drawing);
  if (!drawing.error.empty()) std::fprintf(stderr, "skel-infer: %s\n", drawing.error.c_str());
  if (code_ == ExitCode::kDone) code_ = drawing.code;
  if (many_) table_.add(drawing);
  any_opened_ = any_opened_ || drawing.opened;
  if (!options_.report_file.empty()) shown_.push_back(std::move(drawing));
}

void RunReport::noteTwin(DrawingResult& drawing) {
  if (drawing.image_sha256.empty()) return;
  const auto [first, is_new] = drawings_by_hash_.emplace(drawing.image_sha256, drawing.source);
  if (is_new || first->second == drawing.source || drawing.figures.empty()) return;
  const std::string what = "as " + shellWord(first->second);
  drawing.figures.front().notes.push_back(
      {"the very same picture " + what, "the very same picture twice", what});
}

ExitCode RunReport::end() {
  if (drawings_ == 0 && left_out_ > 0)
    throw UsageError(first_left_out_ + " and all others of the list lie in the folder of the results, " +
                     options_.out_dir + ", or were made of drawings; name another folder by -o");
  if (!options_.quiet && many_) std::fputs(table_.text().c_str(), stderr);
  if (!options_.quiet && left_out_ > 0)
    std::fprintf(stderr,
                 "skel-infer: note: left out of the list, as they are results: %zu, the first is %s\n",
                 left_out_, printable(first_left_out_).c_str());
  if (!options_.report_file.empty() && !any_opened_) {
    if (!options_.quiet)
      std::fprintf(stderr, "skel-infer: note: no drawing could be opened, so %s is not written\n",
                   printable(options_.report_file).c_str());
  } else if (!options_.report_file.empty()) {
    writeFile(options_.report_file, reportPage(shown_));
    if (!options_.quiet && !options_.json_lines)
      std::printf("%s: the report\n", printable(options_.report_file).c_str());
  }
  return code_;
}

}  // namespace skel
