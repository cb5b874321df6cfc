// What became of the drawings that were asked for.
#pragma once

#include <string>
#include <vector>

#include "infer/report_pictures.h"
#include "libskel/core/error.h"
#include "libskel/pipeline/drawing_notes.h"

namespace skel {

// What a person should do with a figure.
enum class Verdict {
  kFine,
  kLookAt,  // something about it is unusual, or had to be guessed
  kRetake,  // it was not recognised, or is cut off, or cannot be told from the sheet
};

struct FigureResult {
  int number = 1;         // in the drawing
  std::string mend_file;  // what skel-label opens
  std::string written;    // the first of its files, "": none
  double confidence = 0;
  std::string body_plan;
  Verdict verdict = Verdict::kFine;
  std::vector<std::string> reasons;  // of the verdict
  std::vector<Note> notes;           // of what is no reason to doubt the figure
  std::vector<std::string> advice;   // the reasons in a teacher's words
  ReportPictures pictures;           // if a report is wanted
  std::vector<StageTime> times;
};

struct DrawingResult {
  std::string source;                 // path
  std::vector<FigureResult> figures;  // that were written
  ExitCode code = ExitCode::kDone;
  std::string error;    // what() of what stopped it; "": nothing
  std::string problem;  // the same without the file's name, where the drawing itself is to blame
};

}  // namespace skel
