// A convolutional net of as few numbers as there can be: for tests of what holds for all.
#pragma once

#include "libskel/convnet/conv_net.h"

namespace skel {

inline ConvNet tinyNet() {
  ConvNetBuilder builder({2, 2, 8});
  builder.convolution(0, 16, 1, false);
  return builder.take();
}

}  // namespace skel
