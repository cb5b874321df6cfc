// Scenes that are no whole human: what the recogniser must not be sure about.
#pragma once

#include "libskel/core/rng.h"
#include "trainer/figures/scene.h"

namespace skel {

// An animal, a plant, a thing, a face, or a mere shape.
Scene paintOther(Rng& rng);
// A human, a being without legs, a plant, a thing, a face, or a mere shape: what is no animal on four legs.
Scene paintNoAnimal(Rng& rng);

}  // namespace skel
