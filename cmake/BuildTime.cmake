# Measures that keep a full build short. Most of its time goes to headers and templates that many
# sources share (nlohmann's JSON, Eigen, fmt), so they are read once, compiled several sources at a
# time, and optimised as little as their use allows.

option(CROSSGRAIN_UNITY_BUILD "Compile several sources of a library in one go" ON)
set(CMAKE_UNITY_BUILD ${CROSSGRAIN_UNITY_BUILD})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 16)

# compile_together(TARGET SOURCES…): one go for these, where a target has helpers of equal names. Sources in no such
# group are compiled alone.
function(compile_together target)
  list(GET ARGN 0 group)
  cmake_path(GET group STEM group)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${group})
endfunction()

# By itself GCC collects its garbage from 128 MB on, which takes a twentieth of its time. Results then take 1.2 GB, not 1.0.
add_compile_options("$<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=1048576>")

# One for the program, one for its tests. Every source still includes what it uses.
option(CROSSGRAIN_PRECOMPILED_HEADERS "Read large headers of libraries once" ON)

set(crossgrain_precompiled
  <algorithm> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional> <set> <string>
  <vector> <fmt/format.h> <fmt/ranges.h> <nlohmann/json.hpp> <Eigen/Core>)

# GCC keeps the optimisation of precompiled headers for all that reads them: it must be the same.
set(crossgrain_quick_to_build $<$<CONFIG:Release>:-O1>)

# add_precompiled_headers(NAME LIBRARIES … HEADERS …): what quick_to_build(NAME …) reads.
function(add_precompiled_headers name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBRARIES;HEADERS")
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Exists for its precompiled headers.\n" @ONLY)
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${source})
  target_link_libraries(${name} PRIVATE crossgrain_options ${arg_LIBRARIES})
  target_compile_options(${name} PRIVATE ${crossgrain_quick_to_build})
  target_precompile_headers(${name} PRIVATE ${crossgrain_precompiled} ${arg_HEADERS})
endfunction()

# For code that computes little: files, results, reports, commands. Step, averages and oracle keep -O2.
function(quick_to_build headers)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE ${crossgrain_quick_to_build})
    if(CROSSGRAIN_PRECOMPILED_HEADERS)
      target_precompile_headers(${target} REUSE_FROM ${headers})
    endif()
  endforeach()
endfunction()
