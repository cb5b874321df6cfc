// What became of the drawings that were asked for.
#pragma once

#include <cstddef>
#include <optional>
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

struct WrittenFile {
  std::string path;
  std::size_t bytes = 0;
  std::string sha256;  // "": nobody asked for it
};

struct FigureResult {
  int number = 1;         // in the drawing
  std::string mend_file;  // what skel-label opens
  std::vector<WrittenFile> outputs;
  std::optional<double> confidence;  // in the joints, if any were looked for
  std::string body_plan;
  std::optional<double> facing_deg;  // of the model, where there is one: facing()
  std::vector<std::string> missing;  // joints that were not found
  long placed = 0;                   // joints that a person has placed
  bool all_placed = false;           // those that do not follow from others
  Verdict verdict = Verdict::kFine;
  std::vector<std::string> reasons;  // of the verdict
  std::vector<Note> notes;           // of what is no reason to doubt the figure
  std::vector<std::string> advice;   // the reasons in a teacher's words
  std::vector<Note> left_out;        // mended of a picture of this name, of `reasons`; not kept
  ReportPictures pictures;           // if a report is wanted
  std::vector<StageTime> times;
};

// The SHA-256 of what decides what is made of a drawing. "": nobody asked for it, or it could not be read.
struct Origin {
  std::string image;
  std::string mended;   // what a person has left beside the drawing; "": nothing
  std::string options;  // those that count, and the files that they name
  std::string nets;     // that are compiled in
  std::string version;  // of skel, as it is
  bool operator==(const Origin&) const = default;
};

struct DrawingResult {
  std::string source;                 // path
  std::vector<FigureResult> figures;  // that were written
  ExitCode code = ExitCode::kDone;
  std::string error;           // what() of what stopped it; "": nothing
  std::string problem;         // the same without the file's name, where the drawing itself is to blame
  bool nothing_found = false;  // which is that the picture shows no figure
  std::string picture;         // the same drawing's, if a report is wanted: data: address
  std::string image_sha256;    // of its bytes; "": none was needed, or it could not be read
  Origin origin;
  bool opened = false;    // its picture could be read, or none was needed
  bool kept = false;      // an earlier run has done it
  bool left_out = false;  // it is no drawing, but was made of one
};

}  // namespace skel
