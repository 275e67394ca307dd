# Layout of `cmake --install` and `cpack`:
#   bin/crossgrain                 the program; finds share/crossgrain beside its own folder, so a prefix can be moved
#   share/crossgrain/cases, engines  read at run time
#   share/crossgrain/examples      engines of one's own to begin with; engines/python and engines/cpp are their helpers
#   share/crossgrain/python        crossgrain.py reads results and snapshots
#   share/…                        completion in bash, zsh and fish, where each looks for it
#   share/man                      what --help says
#   share/doc/crossgrain           the documents; html/index.html where Sphinx is
#   lib, include/crossgrain        the libraries, for find_package(crossgrain)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS crossgrain RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(engine bullet chipmunk mujoco ode)
  if(TARGET crossgrain-${engine})
    install(TARGETS crossgrain-${engine} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()
foreach(place bash:bash-completion/completions/crossgrain zsh:zsh/vendor-completions/_crossgrain
        fish:fish/vendor_completions.d/crossgrain.fish)
  string(REGEX MATCH "(.*):(.*)/(.*)" place ${place})
  install(FILES ${CMAKE_BINARY_DIR}/completion.${CMAKE_MATCH_1} RENAME ${CMAKE_MATCH_3}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/${CMAKE_MATCH_2})
endforeach()
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/crossgrain
        FILES_MATCHING PATTERN "*.toml" PATTERN "*.md" PATTERN "*.csv" PATTERN "*.py")
# grain and box2d are part of the program.
install(DIRECTORY engines DESTINATION ${CMAKE_INSTALL_DATADIR}/crossgrain
        FILES_MATCHING PATTERN "*.py" PATTERN "*.mjs" PATTERN "*.json" PATTERN "*.toml"
        PATTERN node_modules EXCLUDE PATTERN grain EXCLUDE PATTERN box2d EXCLUDE)
install(DIRECTORY engines/cpp DESTINATION ${CMAKE_INSTALL_DATADIR}/crossgrain/engines FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/crossgrain
        FILES_MATCHING PATTERN "*.py" PATTERN "*.cpp" PATTERN "*.ipynb" PATTERN "*.toml" PATTERN "*.lmp")
install(FILES python/crossgrain.py python/pyproject.toml DESTINATION ${CMAKE_INSTALL_DATADIR}/crossgrain/python)
install(FILES README.md LICENSE CHANGELOG.md CITATION.cff CONTRIBUTING.md SECURITY.md adapters/worker/protocol.schema.json cmake/copyright
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
# Targets of these pages' links, at the places where the links point.
file(GLOB_RECURSE crossgrain_pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
     adapters/*.md averaging/*.md cases/*.md engines/*.md oracle/*.md papers/*.md reports/curated/*.md tests/*.md)
list(FILTER crossgrain_pages EXCLUDE REGEX node_modules)
foreach(page ${crossgrain_pages} reports/curated/cost/cost_collision.png reports/curated/effects/effects_1_cost.png
        reports/curated/full/overview.png reports/curated/stability/stability_map.png examples/import/box.toml papers/laetzel-2003/figure_6_7.png
        examples/starts/on-dem.toml)
  cmake_path(GET page PARENT_PATH folder)
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endforeach()

set(crossgrain_libraries crossgrain_options crossgrain_support crossgrain_law grain box2d_granular crossgrain_adapters crossgrain_files
    crossgrain_worker crossgrain_engines crossgrain_oracle crossgrain_stability crossgrain_averaging
    crossgrain_cases crossgrain_results crossgrain_reports crossgrain_studies)
install(TARGETS ${crossgrain_libraries} EXPORT crossgrain
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/crossgrain)
foreach(folder support law adapters oracle stability averaging cases engines/grain engines/box2d results reports studies)
  install(DIRECTORY ${folder}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/crossgrain/${folder}
          FILES_MATCHING PATTERN "*.hpp" PATTERN "curated" EXCLUDE PATTERN "templates" EXCLUDE)
endforeach()
install(EXPORT crossgrain NAMESPACE crossgrain:: FILE crossgrainTargets.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/crossgrain)
configure_package_config_file(cmake/crossgrainConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/crossgrainConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/crossgrain)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/crossgrainConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/crossgrainConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/crossgrainConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/crossgrain)

# The manual page says what --help says; without help2man there is none.
find_program(HELP2MAN help2man)
if(HELP2MAN)
  set(manual ${CMAKE_CURRENT_BINARY_DIR}/crossgrain.1)
  add_custom_command(OUTPUT ${manual} DEPENDS crossgrain
    COMMAND ${CMAKE_COMMAND} -E env COLUMNS=80 ${HELP2MAN} --no-info --output ${manual}
            --name "compare granular and rigid-body engines on one scene" $<TARGET_FILE:crossgrain>)
  add_custom_target(manual ALL DEPENDS ${manual})
  install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

# The documents as pages that can be searched without a network; without Sphinx they are Markdown alone.
find_program(SPHINX_BUILD sphinx-build)
if(SPHINX_BUILD)
  set(site ${CMAKE_CURRENT_BINARY_DIR}/site)
  file(GLOB crossgrain_documents CONFIGURE_DEPENDS docs/*.md docs/*.png docs/pictures/* *.md)
  add_custom_command(OUTPUT ${site}/index.html DEPENDS ${crossgrain_documents} ${crossgrain_pages} docs/conf.py
    COMMAND ${SPHINX_BUILD} -q -c docs . ${site} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  add_custom_target(site ALL DEPENDS ${site}/index.html)
  install(DIRECTORY ${site}/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/html PATTERN .doctrees EXCLUDE PATTERN .buildinfo EXCLUDE)
endif()

# Pictures of the gallery, by the commands that it names: half an hour.
add_custom_target(pictures
  COMMAND python3 ${PROJECT_SOURCE_DIR}/docs/pictures.py $<TARGET_FILE:crossgrain> ${CMAKE_CURRENT_BINARY_DIR}/gallery
  DEPENDS crossgrain USES_TERMINAL)

# Removes what the last installation of this build folder has put there; folders stay.
add_custom_target(uninstall
  COMMAND ${CMAKE_COMMAND} -DMANIFEST=${CMAKE_BINARY_DIR}/install_manifest.txt -P ${PROJECT_SOURCE_DIR}/cmake/Uninstall.cmake)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The crossgrain developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Validation harness for granular (DEM) simulation engines")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # the shared libraries that the program is linked to
set(CPACK_DEBIAN_PACKAGE_DEPENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS yade)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
include(CPack)
