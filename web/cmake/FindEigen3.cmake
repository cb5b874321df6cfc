skel_headers(Eigen3::Eigen eigen3/Eigen eigen3/unsupported)
# Sums in the order in which the native build makes them: through SSE, which emscripten turns into WebAssembly's own
# vectors. MMX, whose header Eigen asks for as well, is not there and not used; a GCC of 6.0 or newer would be handed
# inline assembly, one before 6.3 as well elsewhere, and Eigen counts 5.13 as 6.3 there.
file(CONFIGURE OUTPUT headers/Eigen3-Eigen/mmintrin.h CONTENT "" @ONLY)
set_property(TARGET Eigen3::Eigen PROPERTY INTERFACE_COMPILE_OPTIONS -fgnuc-version=5.13.0)
set(Eigen3_FOUND ON)
