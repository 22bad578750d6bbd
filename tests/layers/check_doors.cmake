# SPDX-License-Identifier: MIT
# cmake -P check_doors.cmake FOLDER: fails when a file in FOLDER goes around a function that is the only way to do something.
cmake_minimum_required(VERSION 3.22)
get_filename_component(source ${CMAKE_ARGV3} ABSOLUTE)
# What must stand in one place only, that place, and what to use instead.
set(doors
  "json::parse *\\(|\\.dump *\\(" "io/json.cpp" "io::parse_json, io::json_text: depth and bytes that are no UTF-8 are looked after there"
  "tbb::parallel_(for|reduce|sort|invoke|scan)|std::for_each\\(std::execution" "core/parallel.cpp" "parallel_for: it is never cut short without a word"
  "fs::rename|std::rename|filesystem::rename" "io/temporary.cpp" "io::write_atomically"
  "ofstream" "none" "io::write_atomically, io::write_bytes, io::write_text")
set(faults 0)
file(GLOB_RECURSE files RELATIVE ${source} ${source}/*.h ${source}/*.cpp)
list(LENGTH doors count)
math(EXPR last "${count} - 1")
foreach(file ${files})
  file(READ ${source}/${file} text)
  foreach(i RANGE 0 ${last} 3)
    math(EXPR j "${i} + 1")
    math(EXPR k "${i} + 2")
    list(GET doors ${i} pattern)
    list(GET doors ${j} place)
    list(GET doors ${k} instead)
    if(text MATCHES "${pattern}" AND NOT file STREQUAL place)
      message(SEND_ERROR "${file}: \"${CMAKE_MATCH_0}\": use ${instead}")
      math(EXPR faults "${faults} + 1")
    endif()
  endforeach()
endforeach()
list(LENGTH files count)
message("${count} files, ${faults} ways around a door")
