# `cmake --install BUILD --prefix P`: the tools, a manual page each, completion for bash, the documentation.
#
# The pages are made by help2man of what the tools say with --help, and of tools/TOOL/TOOL.h2m and tools/common.h2m: what an option
# does is written in one place. Where help2man is missing, all but the pages is built and installed.

include(GNUInstallDirs)
set(LGIW_TOOLS dem2particles lgiw-run gauges deposit-volume impulse-wave convergence)

install(TARGETS ${LGIW_TOOLS} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# bash-completion looks for a file of the command's name.
foreach(tool ${LGIW_TOOLS})
  install(FILES tools/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ${tool})
endforeach()
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})

find_program(LGIW_HELP2MAN help2man)
if(LGIW_SANITIZE)
  message(STATUS "Manual pages: left out of a build with sanitizers")
elseif(NOT LGIW_HELP2MAN)
  message(STATUS "Manual pages: left out, as help2man is not installed")
else()
  foreach(tool ${LGIW_TOOLS})
    set(page ${PROJECT_BINARY_DIR}/man/${tool}.1)
    set(texts ${PROJECT_SOURCE_DIR}/tools/${tool}/${tool}.h2m ${PROJECT_SOURCE_DIR}/tools/common.h2m)
    list(TRANSFORM texts PREPEND --include= OUTPUT_VARIABLE includes)
    add_custom_command(OUTPUT ${page}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/man
      COMMAND ${LGIW_HELP2MAN} --no-info --section=1 --version-string=${PROJECT_VERSION} --source=lgiw\ ${PROJECT_VERSION}
              ${includes} --output=${page} $<TARGET_FILE:${tool}>
      DEPENDS ${tool} ${texts} VERBATIM)
    list(APPEND pages ${page})
  endforeach()
  add_custom_target(manuals ALL DEPENDS ${pages})
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
