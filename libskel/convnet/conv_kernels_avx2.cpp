// Compiled with -mavx2 -mfma.
#include <immintrin.h>

#include "libskel/convnet/conv_kernels_sets.h"

namespace {

struct EightFloats {
  static constexpr int kLanes = 8;
  using Vector = __m256;
  static Vector load(const float* p) { return _mm256_loadu_ps(p); }
  static void store(float* p, Vector v) { _mm256_storeu_ps(p, v); }
  static Vector broadcast(float x) { return _mm256_set1_ps(x); }
  static Vector zero() { return _mm256_setzero_ps(); }
  static Vector add(Vector a, Vector b) { return _mm256_add_ps(a, b); }
  static Vector subtract(Vector a, Vector b) { return _mm256_sub_ps(a, b); }
  static Vector maximum(Vector a, Vector b) { return _mm256_max_ps(a, b); }
  static Vector multiplyAdd(Vector a, Vector b, Vector c) { return _mm256_fmadd_ps(a, b, c); }
};

}  // namespace

#define SKEL_VECTOR EightFloats
#define SKEL_ROWS 6
#define SKEL_GRADIENT_ROWS 4
#include "libskel/convnet/conv_kernels_impl.h"
#include "libskel/convnet/winograd_impl.h"

namespace skel {
const ConvKernels kAvx2Kernels = {convolvePixels, gradientPixels, transformTiles, untransformTiles};
}  // namespace skel
