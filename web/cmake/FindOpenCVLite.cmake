# The parts of OpenCV's core and imgproc that the rooms use, built from its source for WebAssembly without its own
# CMake files, which would build four times as much. SKEL_WEB_SOURCES holds Debian's source packages.
file(GLOB _opencv LIST_DIRECTORIES true ${SKEL_WEB_SOURCES}/opencv-4*)
set(_generated ${CMAKE_BINARY_DIR}/opencv)

set(_core
  alloc arithm arithm.dispatch array buffer_area channels check convert.dispatch convert_scale.dispatch copy
  count_non_zero.dispatch datastructs lapack logger mathfuncs mathfuncs_core.dispatch matmul.dispatch matrix matrix_c
  matrix_decomp matrix_expressions matrix_iterator matrix_operations matrix_transform matrix_wrap mean.dispatch minmax
  merge.dispatch parallel parallel/parallel rand softfloat split.dispatch sum.dispatch system tables types umatrix utils/logtagconfigparser
  utils/logtagmanager)
set(_imgproc
  approx box_filter.dispatch canny connectedcomponents contours convhull deriv distransform filter.dispatch floodfill hough
  imgwarp morph.dispatch resize segmentation shapedescr smooth.dispatch tables thresh utils)

# What OpenCV's own CMake would have written.
function(_generate name)
  file(CONFIGURE OUTPUT ${_generated}/${name} CONTENT "${ARGN}" @ONLY)
endfunction()
_generate(cvconfig.h "#pragma once\n#define CV_ENABLE_INTRINSICS\n")
_generate(cv_cpu_config.h "#define CV_CPU_BASELINE_FEATURES 0\n#define CV_CPU_DISPATCH_FEATURES 0\n")
_generate(custom_hal.hpp "")
_generate(opencv_data_config.hpp "")
_generate(version_string.inc "\"\"\n")
_generate(opencv2/opencv_modules.hpp "#define HAVE_OPENCV_CORE\n#define HAVE_OPENCV_IMGPROC\n")

foreach(_module core imgproc)
  set(_root ${_opencv}/modules/${_module})
  set(_out ${_generated}/${_module})
  _generate(${_module}/opencl_kernels_${_module}.hpp
    "#include \"opencv2/core/ocl.hpp\"\n#include \"opencv2/core/ocl_genbase.hpp\"\n#include \"opencv2/core/opencl/ocl_defs.hpp\"\n")
  file(GLOB _simd RELATIVE ${_root}/src ${_root}/src/*.simd.hpp)
  foreach(_file ${_simd})
    string(REGEX REPLACE "\\.hpp$" "" _name ${_file})
    _generate(${_module}/${_name}_declarations.hpp
      "#define CV_CPU_SIMD_FILENAME \"${_root}/src/${_file}\"\n#define CV_CPU_DISPATCH_MODES_ALL BASELINE\n#undef CV_CPU_SIMD_FILENAME\n")
  endforeach()
  set(_files ${_${_module}})
  list(TRANSFORM _files REPLACE "(.+)" "${_root}/src/\\1.cpp")
  add_library(opencv_${_module} STATIC ${_files})
  target_compile_definitions(opencv_${_module} PRIVATE __OPENCV_BUILD=1 CVAPI_EXPORTS OPENCV_DISABLE_THREAD_SUPPORT)
  target_compile_options(opencv_${_module} PRIVATE -O2 -w)
  target_include_directories(opencv_${_module} SYSTEM PUBLIC
    ${_opencv}/modules/core/include ${_opencv}/modules/imgproc/include ${_generated})
  target_include_directories(opencv_${_module} SYSTEM PRIVATE ${_root}/src ${_out})
endforeach()
target_link_libraries(opencv_imgproc PUBLIC opencv_core)
set(OpenCVLite_FOUND ON)
