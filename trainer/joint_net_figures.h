// skel-train figures: pictures of what the generator draws, to look at beside real drawings.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "libskel/core/error.h"

namespace skel {

struct FigureSheetOptions {
  std::string body_plan = "biped";
  std::string output = "out/figures.png";
  std::uint64_t seed = 1;
  int columns = 16, rows = 9;
  double other_share = 0;
  std::string drawings;  // folder of annotated drawings to warp; "": none
  bool plain = false;    // without joints
};

void bindFigureSheetOptions(CLI::App& command, FigureSheetOptions& options);
ExitCode runFigureSheet(const FigureSheetOptions& options);

}  // namespace skel
