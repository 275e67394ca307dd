# The target one_definition: every type that two sources name alike is the same one (-Wodr). The linker merges
# the types of all objects and stops there: no code is made. Needs CROSSGRAIN_COMPARE_TYPES and GCC.
set(compared ${crossgrain_libraries})
list(REMOVE_ITEM compared crossgrain_options)  # has no code
list(TRANSFORM compared REPLACE "(.+)" "$<TARGET_FILE:\\1>")
add_custom_target(one_definition
  COMMAND ${CMAKE_CXX_COMPILER} -r -nostdlib -flinker-output=rel -flto -Wodr -Werror=odr
          $<TARGET_OBJECTS:crossgrain> -Wl,--whole-archive ${compared} -Wl,--no-whole-archive
          -o ${PROJECT_BINARY_DIR}/one_definition.o
  COMMAND_EXPAND_LISTS VERBATIM)
add_dependencies(one_definition crossgrain)
