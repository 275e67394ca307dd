# Headers of libraries that cost more to read than most of our sources to compile are read once for
# each set of flags: one for the program, one for its tests. Every source still includes what it uses.
option(CROSSGRAIN_PRECOMPILED_HEADERS "Read large headers of libraries once" ON)

set(crossgrain_precompiled
  <algorithm> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional> <set> <string>
  <vector> <fmt/format.h> <fmt/ranges.h> <nlohmann/json.hpp> <Eigen/Core>)

# add_precompiled_headers(NAME LIBRARIES … HEADERS …): what use_precompiled_headers(NAME …) reads.
function(add_precompiled_headers name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBRARIES;HEADERS")
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Exists for its precompiled headers.\n" @ONLY)
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${source})
  target_link_libraries(${name} PRIVATE crossgrain_options ${arg_LIBRARIES})
  target_precompile_headers(${name} PRIVATE ${crossgrain_precompiled} ${arg_HEADERS})
endfunction()

function(use_precompiled_headers name)
  if(NOT CROSSGRAIN_PRECOMPILED_HEADERS)
    return()
  endif()
  foreach(target ${ARGN})
    target_precompile_headers(${target} REUSE_FROM ${name})
  endforeach()
endfunction()
