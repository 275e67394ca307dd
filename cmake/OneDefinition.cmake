# The target one_definition: every type that two sources name alike is the same one (-Wodr). The linker merges
# the types of all objects and stops there: no code is made. Needs GCC; objects with types take half as long
# again to make, so they have a build of their own.
if(NOT CROSSGRAIN_COMPARE_TYPES)
  add_custom_target(one_definition
    COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${PROJECT_BINARY_DIR}-types -G ${CMAKE_GENERATOR}
            -DCMAKE_BUILD_TYPE=Release -DCROSSGRAIN_COMPARE_TYPES=ON -DBUILD_TESTING=OFF
    COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR}-types --target one_definition
    USES_TERMINAL)
  return()
endif()
set(compared ${crossgrain_libraries})
list(REMOVE_ITEM compared crossgrain_options)  # has no code
list(TRANSFORM compared REPLACE "(.+)" "$<TARGET_FILE:\\1>")
add_custom_target(one_definition
  COMMAND ${CMAKE_CXX_COMPILER} -r -nostdlib -flinker-output=rel -flto -Wodr -Werror=odr
          $<TARGET_OBJECTS:crossgrain> -Wl,--whole-archive ${compared} -Wl,--no-whole-archive
          -o ${PROJECT_BINARY_DIR}/one_definition.o
  COMMAND_EXPAND_LISTS VERBATIM)
add_dependencies(one_definition crossgrain)
