// Compiled with -mavx512f.
#include <immintrin.h>

#include "libskel/convnet/conv_kernels_sets.h"

namespace {

struct SixteenFloats {
  static constexpr int kLanes = 16;
  using Vector = __m512;
  static Vector load(const float* p) { return _mm512_loadu_ps(p); }
  static void store(float* p, Vector v) { _mm512_storeu_ps(p, v); }
  static Vector broadcast(float x) { return _mm512_set1_ps(x); }
  static Vector zero() { return _mm512_setzero_ps(); }
  static Vector add(Vector a, Vector b) { return _mm512_add_ps(a, b); }
  static Vector subtract(Vector a, Vector b) { return _mm512_sub_ps(a, b); }
  // _mm512_max_ps has GCC 12 warn of its own undefined operand.
  static Vector maximum(Vector a, Vector b) { return a > b ? a : b; }
  static Vector multiplyAdd(Vector a, Vector b, Vector c) { return _mm512_fmadd_ps(a, b, c); }
};

}  // namespace

#define SKEL_VECTOR SixteenFloats
#define SKEL_ROWS 12
#define SKEL_GRADIENT_ROWS 8
#include "libskel/convnet/conv_kernels_impl.h"
#include "libskel/convnet/winograd_impl.h"

namespace skel {
const ConvKernels kAvx512Kernels = {convolvePixels, gradientPixels, transformTiles, untransformTiles};
}  // namespace skel
