# SPDX-License-Identifier: MIT

# Warnings and sanitizers every target of the project is built with.
add_library(sateen_options INTERFACE)
target_compile_options(sateen_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual)
if(SATEEN_WERROR)
  target_compile_options(sateen_options INTERFACE -Werror)
endif()
# GCC tidies up its memory a tenth of its time; it has enough to do so less often.
target_compile_options(sateen_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)
# Builds that look for faults check every access.
target_compile_definitions(sateen_options INTERFACE $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)
if(SATEEN_SANITIZE)
  # Line numbers are all a report needs of debug information. The checks left out double the time files take to compile,
  # and where a bad pointer matters the address sanitizer stops too.
  target_compile_options(sateen_options INTERFACE
    -fsanitize=${SATEEN_SANITIZE} -fno-sanitize=null,alignment,object-size,vptr,pointer-overflow
    -fno-sanitize-recover=all -fno-omit-frame-pointer -UNDEBUG -D_GLIBCXX_ASSERTIONS -DSATEEN_SANITIZED)
  if(SATEEN_SANITIZE STREQUAL thread)
    target_compile_definitions(sateen_options INTERFACE SATEEN_SANITIZED_THREADS)
  endif()
  target_link_options(sateen_options INTERFACE -fsanitize=${SATEEN_SANITIZE})
endif()

# sateen_test(NAME SOURCES...): a GoogleTest program test_NAME whose cases ctest lists as NAME.Suite.Case, or, with
# SATEEN_TEST_SHARDS, as NAME.1, NAME.2 and so on, each a share of them. Most tests wait for their compiler more than for
# their own code; those that compute for long say so: sateen_test(NAME COMPUTES SOURCES...).
function(sateen_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "COMPUTES" "" "")
  add_executable(test_${name} ${test_UNPARSED_ARGUMENTS})
  target_link_libraries(test_${name} PRIVATE sateen sateen_options sateen_test_support GTest::gtest_main GTest::gmock)
  target_compile_options(test_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(NOT test_COMPUTES)
    if(SATEEN_SANITIZE)
      target_compile_options(test_${name} PRIVATE -O0)
    endif()
    # These all have the same flags, so the first one's precompiled headers serve them.
    get_property(first GLOBAL PROPERTY sateen_first_test)
    if(first)
      target_precompile_headers(test_${name} REUSE_FROM ${first})
    else()
      set_property(GLOBAL PROPERTY sateen_first_test test_${name})
      target_precompile_headers(test_${name} PRIVATE
        <gmock/gmock.h> <gtest/gtest.h> <Eigen/Geometry> <fmt/format.h> <filesystem> <functional> <string> <vector>)
    endif()
  endif()
  if(SATEEN_TEST_SHARDS)
    foreach(shard RANGE 1 ${SATEEN_TEST_SHARDS})
      math(EXPR index "${shard} - 1")
      add_test(NAME ${name}.${shard} COMMAND test_${name})
      set_tests_properties(${name}.${shard} PROPERTIES
        ENVIRONMENT "GTEST_TOTAL_SHARDS=${SATEEN_TEST_SHARDS};GTEST_SHARD_INDEX=${index}" TIMEOUT 1200)
    endforeach()
  else()
    gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 300)
  endif()
endfunction()

# sateen_bench(NAME SOURCES...): a Google Benchmark program bench_NAME.
function(sateen_bench name)
  add_executable(bench_${name} ${ARGN})
  target_link_libraries(bench_${name} PRIVATE sateen sateen_options sateen_test_support benchmark::benchmark_main)
endfunction()
