// What a run says of its drawings: of each when it is done, of all at the end.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "infer/class_table.h"
#include "infer/figure_result.h"
#include "infer/infer_options.h"
#include "libskel/pipeline/rig_character.h"

namespace skel {

// Memory grows with the number of drawings where all are named at the end: not with --from.
class RunReport {
 public:
  // `many`: a table at the end, instead of notes on the one drawing.
  RunReport(const InferOptions& options, const RigOptions& rig, bool many);

  // In the order of the drawings.
  void add(DrawingResult drawing);

  // The table, the page. Returns the code of the first failure.
  ExitCode end();

 private:
  // A note on a picture that was there already, byte for byte.
  void noteTwin(DrawingResult& drawing);

  const InferOptions& options_;
  bool tells_plan_, many_;
  ClassTable table_;
  std::vector<DrawingResult> shown_;                     // on the page
  std::map<std::string, std::string> drawings_by_hash_;  // the first of each
  std::size_t left_out_ = 0;
  std::size_t drawings_ = 0;
  bool any_opened_ = false;
  std::string first_left_out_;
  ExitCode code_ = ExitCode::kDone;
};

}  // namespace skel
