# SPDX-License-Identifier: MIT
# cmake -D COMPILER=c++ -P check_odr.cmake ARCHIVE: links all of ARCHIVE, whose objects were compiled with -flto, and fails
# when a type of sateen is defined differently in two of its files.
cmake_minimum_required(VERSION 3.23)
math(EXPR last "${CMAKE_ARGC} - 1")
set(archive ${CMAKE_ARGV${last}})
# Types are compared when objects are joined to one; no code needs to be made of it.
execute_process(
  COMMAND ${COMPILER} -r -nostdlib -O0 -flto -flinker-output=rel -Wodr
          -Wl,--whole-archive ${archive} -Wl,--no-whole-archive -o ${archive}.odr
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
file(REMOVE ${archive}.odr)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${archive} cannot be linked:\n${output}")
endif()
if(output MATCHES "-Wodr")
  message(FATAL_ERROR "one name means two things; the linker keeps one:\n${output}")
endif()
message("${archive}: no name means two things")
