# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN} ended with ${result}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --component development --prefix ${WORK}/prefix)

# The README's two programs have to compile as they stand there.
file(READ ${README} readme)
if(NOT readme MATCHES "```cpp\n([^`]+)```.*```cpp\n([^`]+)```")
  message(FATAL_ERROR "${README} has not two C++ programs")
endif()
file(WRITE ${WORK}/consumer/readme_picture.cpp "${CMAKE_MATCH_1}")
file(WRITE ${WORK}/consumer/readme.cpp "${CMAKE_MATCH_2}")
file(COPY ${CONSUMER}/ DESTINATION ${WORK}/consumer)

run(${CMAKE_COMMAND} -S ${WORK}/consumer -B ${WORK}/build -G Ninja -D CMAKE_PREFIX_PATH=${WORK}/prefix
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer ${WORK}/texture.ktx2)
run(${WORK}/build/stranger)
run(${WORK}/build/readme_picture ${EXAMPLES}/garment/jacket.obj ${EXAMPLES}/matcaps/jade.exr ${WORK}/jacket.png)
file(REMOVE_RECURSE ${WORK})
