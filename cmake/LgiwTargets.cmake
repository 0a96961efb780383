# Targets of this project: lgiw_library(room SOURCES... LIBS...), lgiw_tool(name ...), lgiw_test(name ...).

add_library(lgiw_options INTERFACE)
target_include_directories(lgiw_options INTERFACE ${PROJECT_SOURCE_DIR}/lib)
target_compile_options(lgiw_options INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wno-unknown-pragmas $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>>  # GCC 12 warns of its own std::string (bug 105651)
  $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<BOOL:${LGIW_WERROR}>>:-Werror>)
if(LGIW_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
    message(FATAL_ERROR "LGIW_FUZZ=ON (libFuzzer is clang's) set CMAKE_CXX_COMPILER=clang++")
  endif()
  set(LGIW_SANITIZE address)
  target_compile_options(lgiw_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(LGIW_SANITIZE)
  set(sanitizers address,undefined)
  if(LGIW_SANITIZE STREQUAL "thread")
    set(sanitizers thread)
  endif()
  target_compile_options(lgiw_options INTERFACE -fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(lgiw_options INTERFACE -fsanitize=${sanitizers})
endif()

function(lgiw_library room)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS;PRIVATE_LIBS" ${ARGN})
  add_library(lgiw_${room} STATIC ${ARG_SOURCES})
  target_link_libraries(lgiw_${room} PUBLIC lgiw_options ${ARG_LIBS} PRIVATE ${ARG_PRIVATE_LIBS})
endfunction()

function(lgiw_tool name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE lgiw_options ${ARG_LIBS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
endfunction()

# A GoogleTest program of its own; its cases appear one by one in ctest. LGIW_TEST_DATA is tests/data, LGIW_SOURCE_DIR the
# repository. COMPUTES: has the physics in its own code, and is optimized like the tools; of the others that would be a
# third of the time they take to compile.
function(lgiw_test name)
  cmake_parse_arguments(ARG "COMPUTES" "TIMEOUT" "SOURCES;LIBS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE lgiw_options ${ARG_LIBS} GTest::gtest_main)
  if(NOT ARG_COMPUTES)
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  if(LGIW_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 with sanitizers takes what the standard library's <regex> moves for uninitialized.
    target_compile_options(${name} PRIVATE -Wno-maybe-uninitialized)
  endif()
  target_compile_definitions(${name} PRIVATE
    LGIW_SOURCE_DIR="${PROJECT_SOURCE_DIR}" LGIW_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data"
    LGIW_BIN_DIR="${PROJECT_BINARY_DIR}/bin")
  include(GoogleTest)
  gtest_discover_tests(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} DISCOVERY_TIMEOUT 60)
endfunction()
