// What `skel-train --report DIR` writes.
#pragma once

#include <string>

#include "trainer/evaluation.h"
#include "trainer/training.h"

namespace skel {

// loss.png, confusion.png, and report.json with the numbers of both. Throws OutputError.
void writeReport(const std::string& dir, const Training& training, const Evaluation& evaluation);

}  // namespace skel
