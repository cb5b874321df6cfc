// Trainings that may be stopped and gone on with.
#pragma once

#include <string>

#include "trainer/conv_net_trainer.h"
#include "trainer/made_by.h"

namespace skel {

// Goes on from that file if it is there, and has Ctrl+C say how to go on; steps that it was begun with come
// into `made_by` where they were fewer. "": there is none, which Ctrl+C says, too. One that has made all
// steps is said: its net is to be written as it was made. Throws InputError: no checkpoint of this net, one
// that was made by something else (made_by.h) or does not say by what; OutputError: it could not be written.
void goOnFrom(const std::string& checkpoint, MadeBy& made_by, ConvNetTrainer& trainer);

// Writes it, if there is one to be. To be called before the report is printed: who has seen a report may
// stop.
void keepCheckpoint(const std::string& checkpoint, const MadeBy& made_by, const ConvNetTrainer& trainer);

}  // namespace skel
