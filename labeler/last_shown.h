// Which model a window has shown last.
#pragma once

#include <memory>

#include "libskel/pipeline/rig_character.h"

namespace skel {

class LastShown {
 public:
  // Whether this is another one than the last, also where it lies at the address of the last, which is gone.
  bool isAnother(const std::shared_ptr<const RiggedDrawing>& model) {
    const bool another = last_.lock() != model;
    last_ = model;
    return another;
  }
  void forget() { last_.reset(); }

 private:
  std::weak_ptr<const RiggedDrawing> last_;
};

}  // namespace skel
