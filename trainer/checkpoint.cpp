#include "trainer/checkpoint.h"

#include <unistd.h>

#include <filesystem>

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

}  // namespace

void goOnFrom(const std::string& checkpoint, ConvNetTrainer& trainer) {
  if (checkpoint.empty())
    return sayHowToGoOn("the same line begins anew; one with --checkpoint FILE can be gone on with");
  sayHowToGoOn("there was no report yet; the same line begins anew");
  if (std::filesystem::exists(checkpoint)) {
    const LookAtOutputs look;
    trainer.restore(readFile(checkpoint), checkpoint);
    if (trainer.done())
      throw InputError(checkpoint,
                       "has made all steps of its training, whose net was written then: name another, or "
                       "remove it to start anew");
    sayThatItGoesOn(checkpoint, trainer);
  }
  ensureWritableFile(checkpoint);
}

void keepCheckpoint(const std::string& checkpoint, const ConvNetTrainer& trainer) {
  if (checkpoint.empty()) return;
  writeFile(checkpoint, trainer.checkpoint());
  sayThatItGoesOn(checkpoint, trainer);
}

}  // namespace skel
