#include "trainer/checkpoint.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/temporary_file.h"
#include "libskel/core/text.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

void sayHowToGoOn(const std::string& how) {
  sayOnInterrupt((isatty(STDERR_FILENO) ? "\n" : "") + std::string("skel-train: interrupted; ") + how + "\n");
}

void sayThatItGoesOn(const std::string& checkpoint, const ConvNetTrainer& trainer) {
  sayHowToGoOn("the same line goes on from step " + std::to_string(trainer.steps()) + ", as " +
               printable(checkpoint) + " has it");
}

void restore(const std::string& checkpoint, MadeBy& made_by, ConvNetTrainer& trainer) {
  const std::string bytes = readFile(checkpoint);
  const std::optional<MadeBy> was = parseMadeBy(bytes, checkpoint);
  if (!was) {
    trainer.restore(bytes, checkpoint);
    throw InputError(
        checkpoint,
        "comes from a former version of skel-train, which did not keep by what it was made: go on "
        "with that version, or remove it to start anew");
  }
  ensureSame(*was, made_by, checkpoint);
  const std::size_t line = bytes.find('\n');
  const std::string state = line == std::string::npos ? "" : bytes.substr(line + 1);
  if (state.size() < trainer.checkpoint().size())
    throw InputError(checkpoint, "is cut off: remove it to start anew");
  trainer.restore(state, checkpoint);
  const int steps = made_by.steps.back();
  made_by.steps = was->steps;
  if (steps != made_by.steps.back()) made_by.steps.push_back(steps);
}

}  // namespace

void goOnFrom(const std::string& checkpoint, MadeBy& made_by, ConvNetTrainer& trainer) {
  if (checkpoint.empty())
    return sayHowToGoOn("the same line begins anew; one with --checkpoint FILE can be gone on with");
  sayHowToGoOn("there was no report yet; the same line begins anew");
  if (std::filesystem::exists(checkpoint)) {
    const LookAtOutputs look;
    restore(checkpoint, made_by, trainer);
    if (trainer.done())
      std::fprintf(
          stderr,
          "skel-train: note: %s: has made all steps of its training; its net is written as it was made "
          "(more --steps go on, without the file it starts anew)\n",
          printable(checkpoint).c_str());
    sayThatItGoesOn(checkpoint, trainer);
  }
  ensureWritableFile(checkpoint);
}

void keepCheckpoint(const std::string& checkpoint, const MadeBy& made_by, const ConvNetTrainer& trainer) {
  if (checkpoint.empty()) return;
  writeFile(checkpoint, formatMadeBy(made_by) + trainer.checkpoint());
  sayThatItGoesOn(checkpoint, trainer);
}

}  // namespace skel
