# OpenCV's modules as imported targets opencv_<module>, for machines that have the per-module packages but not
# libopencv-dev, whose OpenCVConfig.cmake names every module there is.
find_path(OpenCVLite_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
set(_required OpenCVLite_INCLUDE_DIR)
foreach(_module ${OpenCVLite_FIND_COMPONENTS})
  find_library(OpenCVLite_${_module}_LIBRARY opencv_${_module})
  list(APPEND _required OpenCVLite_${_module}_LIBRARY)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVLite REQUIRED_VARS ${_required})
if(OpenCVLite_FOUND)
  foreach(_module ${OpenCVLite_FIND_COMPONENTS})
    if(NOT TARGET opencv_${_module})
      add_library(opencv_${_module} UNKNOWN IMPORTED)
      set_target_properties(opencv_${_module} PROPERTIES
        IMPORTED_LOCATION ${OpenCVLite_${_module}_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${OpenCVLite_INCLUDE_DIR})
    endif()
  endforeach()
endif()
