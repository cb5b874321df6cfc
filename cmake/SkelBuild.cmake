# What every target of skel shares: standard, warnings, and the functions that declare a room, a tool, a test.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(NOT DEFINED CMAKE_POSITION_INDEPENDENT_CODE)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
endif()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
# Eigen at -O0 is too slow to run the tests.
set(CMAKE_CXX_FLAGS_DEBUG "-Og -g")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

# What who uses the library gets: nothing but what its headers need.
add_library(skel_usage INTERFACE)
# The warnings of who embeds skel are not for its headers.
set(system "")
if(NOT PROJECT_IS_TOP_LEVEL)
  set(system SYSTEM)
endif()
target_include_directories(skel_usage ${system} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(skel_usage INTERFACE cxx_std_20)
# Eigen's fast square roots start from the CPU's own approximation, which differs between makers. Where two parts of a
# program disagree about it, the linker chooses.
target_compile_definitions(skel_usage INTERFACE EIGEN_FAST_MATH=0)
# Whatever vectors and sanitizers a project is built with, its Eigen lays out, takes and gives back memory as ours does.
if(CMAKE_SIZEOF_VOID_P EQUAL 8)
  target_compile_definitions(skel_usage INTERFACE EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# And what only our own files are compiled with.
add_library(skel_options INTERFACE)
target_link_libraries(skel_options INTERFACE skel_usage)
# No fused multiply-add unless written: results do not depend on the machine's instruction set.
target_compile_options(skel_options INTERFACE -Wall -Wextra -Wpedantic -ffp-contract=off)
# GCC sees uninitialised members in every moved std::optional of a struct of matrices, and strings that overlap where two
# are joined.
target_compile_options(skel_options INTERFACE "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-restrict>")
if(PROJECT_IS_TOP_LEVEL)
  target_compile_options(skel_options INTERFACE -Werror)
endif()
if(SKEL_SANITIZE)
  # Quick enough to run everything, with the lines of a report.
  set(options $<$<CONFIG:Debug>:-O1> $<$<CONFIG:Debug>:-g1> -fsanitize=${SKEL_SANITIZE} -fno-sanitize-recover=all
      -fno-omit-frame-pointer)
  target_link_options(skel_options INTERFACE -fsanitize=${SKEL_SANITIZE})
  if(SKEL_FUZZ)
    if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
      message(FATAL_ERROR "SKEL_FUZZ needs clang: use the preset fuzz")
    endif()
    # What no fuzzer runs is compiled all the same, since clang shall compile it, but with no pains taken; and with few
    # where it is a reader of small files in a large library.
    set(quick $<BOOL:$<TARGET_PROPERTY:NOT_FUZZED>>)
    set(options "$<${quick}:-O0;-g0>" "$<$<NOT:${quick}>:${options};-fsanitize=fuzzer-no-link>"
        $<$<BOOL:$<TARGET_PROPERTY:FUZZED_IN_PART>>:-O0>)
  endif()
  target_compile_options(skel_options INTERFACE "${options}")
endif()

# skel_room(NAME SOURCES file... [ROOMS room...] [PRIVATE lib...])
# A room is the static library skel_NAME. ROOMS are the rooms whose headers it may include; script/check-layers
# holds the include lines against this list. PRIVATE libraries are seen by its .cpp files alone.
function(skel_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "SOURCES;ROOMS;PRIVATE")
  add_library(skel_${name} STATIC ${ARG_SOURCES})
  skel_unity(skel_${name})
  list(TRANSFORM ARG_ROOMS PREPEND skel_)
  # Headers alone: whoever links the room does not need it.
  list(TRANSFORM ARG_PRIVATE REPLACE "^nlohmann_json::nlohmann_json$" "$<BUILD_INTERFACE:nlohmann_json::nlohmann_json>")
  target_link_libraries(skel_${name} PUBLIC skel_usage Eigen3::Eigen ${ARG_ROOMS}
                        PRIVATE $<BUILD_INTERFACE:skel_options> ${ARG_PRIVATE})
  # GCC makes vectors of most loops at -O3 alone: a tenth less time a drawing, 5 % more program. Clang makes them at -O2.
  target_compile_options(skel_${name} PRIVATE $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-O3>)
endfunction()

# skel_tool(NAME SOURCES file... [ROOMS room...] [PRIVATE lib...]): an executable of build/<preset>/bin.
function(skel_tool name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "SOURCES;ROOMS;PRIVATE")
  add_executable(${name} ${ARG_SOURCES})
  skel_unity(${name})
  list(TRANSFORM ARG_ROOMS PREPEND skel_)
  target_link_libraries(${name} PRIVATE skel_options ${ARG_ROOMS} ${ARG_PRIVATE})
  set_target_properties(${name} PROPERTIES NOT_FUZZED ON)
  if(name MATCHES "^skel-") # not the tools of the tests
    install(TARGETS ${name} COMPONENT skel)
    add_dependencies(skel-installed ${name})
  endif()
endfunction()

# skel_test(NAME SOURCES file... [ROOMS room...] [PRIVATE lib...] [TIMEOUT s]): Catch2 tests of one room, test_NAME.
function(skel_test name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "TIMEOUT" "SOURCES;ROOMS;PRIVATE")
  add_executable(test_${name} ${ARG_SOURCES})
  skel_unity(test_${name})
  list(TRANSFORM ARG_ROOMS PREPEND skel_)
  target_link_libraries(test_${name} PRIVATE skel_options ${ARG_ROOMS} ${ARG_PRIVATE} Catch2::Catch2WithMain)
  target_compile_definitions(test_${name} PRIVATE SKEL_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(SKEL_SANITIZE) # what they test is sanitized; their own code may not be
    target_compile_definitions(test_${name} PRIVATE SKEL_SANITIZED)
  endif()
  target_compile_options(test_${name} PRIVATE $<$<CONFIG:Release>:-O1>) # what they test is optimised, they need not be
  set_target_properties(test_${name} PROPERTIES NOT_FUZZED ON)
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  if(SKEL_SANITIZE)
    math(EXPR ARG_TIMEOUT "10 * ${ARG_TIMEOUT}")
  endif()
  # A test that looks at nothing cannot fail. Catch2 2 is content with a name that no test has, too; CMake cuts names at
  # semicolons.
  catch_discover_tests(test_${name} TEST_PREFIX "${name}: " EXTRA_ARGS --warn NoAssertions PROPERTIES TIMEOUT ${ARG_TIMEOUT}
    SKIP_REGULAR_EXPRESSION "SKIPPED" FAIL_REGULAR_EXPRESSION "No test cases matched")
endfunction()

# skel_embed(TARGET VARIABLE FILE): the bytes of FILE as `const std::string_view skel::embedded::VARIABLE`
# in TARGET, declared in the generated header embedded/VARIABLE.h.
function(skel_embed target variable file)
  set(dir ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  add_custom_command(
    OUTPUT ${dir}/${variable}.cpp ${dir}/${variable}.h
    COMMAND ${CMAKE_COMMAND} -DVARIABLE=${variable} -DINPUT=${file} -DOUTPUT_DIR=${dir}
            -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${file} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${dir}/${variable}.cpp)
  set_source_files_properties(${dir}/${variable}.cpp PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
