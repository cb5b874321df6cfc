#include "libskel/convnet/conv_kernels_sets.h"

namespace {

struct FourFloats {
  static constexpr int kLanes = 4;
  // A vector extension of GCC and Clang: SSE on x86, NEON on ARM.
  typedef float Vector __attribute__((vector_size(16)));
  typedef float Unaligned __attribute__((vector_size(16), aligned(4)));
  static Vector load(const float* p) { return *reinterpret_cast<const Unaligned*>(p); }
  static void store(float* p, Vector v) { *reinterpret_cast<Unaligned*>(p) = v; }
  static Vector broadcast(float x) { return Vector{x, x, x, x}; }
  static Vector zero() { return Vector{0, 0, 0, 0}; }
  static Vector add(Vector a, Vector b) { return a + b; }
  static Vector subtract(Vector a, Vector b) { return a - b; }
  static Vector maximum(Vector a, Vector b) { return a > b ? a : b; }
  static Vector multiplyAdd(Vector a, Vector b, Vector c) { return a * b + c; }
};

}  // namespace

#define SKEL_VECTOR FourFloats
#define SKEL_ROWS 4
#define SKEL_GRADIENT_ROWS 4
#include "libskel/convnet/conv_kernels_impl.h"
#include "libskel/convnet/winograd_impl.h"

namespace skel {
const ConvKernels kBaselineKernels = {convolvePixels, gradientPixels, transformTiles, untransformTiles};
}  // namespace skel
