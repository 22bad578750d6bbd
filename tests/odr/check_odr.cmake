# SPDX-License-Identifier: MIT
# cmake -D COMPILER=c++ -P check_odr.cmake ARCHIVE: links all of ARCHIVE, compiled with -g1 at least, and fails when a
# function of sateen is defined differently in two of its files.
cmake_minimum_required(VERSION 3.23)
math(EXPR last "${CMAKE_ARGC} - 1")
set(archive ${CMAKE_ARGV${last}})
# A shared library may leave symbols of other libraries open, and so needs none of them here.
execute_process(
  COMMAND ${COMPILER} -shared -fuse-ld=gold -Wl,--detect-odr-violations -Wl,--whole-archive ${archive} -Wl,--no-whole-archive -o ${archive}.odr
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
file(REMOVE ${archive}.odr)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "gold cannot link ${archive}:\n${output}")
endif()
# gold tells places apart by a file's last name and the line, and so misses two frame.h. Unoptimised destructors of one
# type are equally long wherever they are compiled.
execute_process(
  COMMAND sh -c "nm -S --defined-only '${archive}' | awk '$3 == \"W\" && $4 ~ /^_ZN6sateen.*D[12]Ev$/ { if ($4 in size && size[$4] != $2) print $4; size[$4] = $2 }' | sort -u | c++filt"
  OUTPUT_VARIABLE lengths COMMAND_ERROR_IS_FATAL ANY)
if(lengths)
  message(FATAL_ERROR "one name means two things; these destructors are not equally long everywhere:\n${lengths}")
endif()
# Inline functions of other libraries are not ours to mend.
string(REGEX MATCHALL "symbol '[^']*sateen::[^']*' defined in multiple places[^\n]*\n[^\n]*\n[^\n]*" clashes "${output}")
list(REMOVE_DUPLICATES clashes)
if(clashes)
  list(JOIN clashes "\n" text)
  message(FATAL_ERROR "one name means two things; the linker keeps one:\n${text}")
endif()
message("${archive}: no name means two things")
