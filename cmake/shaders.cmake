# SPDX-License-Identifier: MIT
# sateen_shaders(TARGET): validates every file of shaders/, and those generated from the table of surface fields, in both
# dialects and embeds them all in TARGET. A shader that does not compile fails the build. Files are known by their names
# without folder: each name stands once.
find_program(GLSLANG_VALIDATOR glslangValidator)
if(NOT GLSLANG_VALIDATOR)
  message(FATAL_ERROR "glslangValidator is missing; install the package glslang-tools")
endif()

function(sateen_shaders target)
  set(directory ${PROJECT_SOURCE_DIR}/shaders)
  set(output ${PROJECT_BINARY_DIR}/shaders)
  set(generated ${output}/generated)
  set(fields ${PROJECT_SOURCE_DIR}/src/appearance/surface_fields.h)
  file(MAKE_DIRECTORY ${output} ${generated})
  file(GLOB_RECURSE shaders CONFIGURE_DEPENDS ${directory}/*.glsl ${directory}/*.vert ${directory}/*.frag)
  set(made)
  foreach(name surface surface_attributes surface_varyings surface_packed)
    list(APPEND made ${generated}/${name}.glsl)
  endforeach()
  add_custom_command(
    OUTPUT ${made}
    COMMAND ${CMAKE_COMMAND} -D FIELDS=${fields} -D OUTPUT=${generated} -P ${PROJECT_SOURCE_DIR}/cmake/surface_fields.cmake
    DEPENDS ${fields} ${PROJECT_SOURCE_DIR}/cmake/surface_fields.cmake
    COMMENT "Surface fields for GLSL" VERBATIM)
  list(APPEND shaders ${made})
  string(REPLACE ";" "," all "${shaders}")
  set(stamps)
  foreach(shader ${shaders})
    get_filename_component(name ${shader} NAME)
    set(stamp ${output}/${name}.valid)
    add_custom_command(
      OUTPUT ${stamp}
      COMMAND ${CMAKE_COMMAND} -D VALIDATOR=${GLSLANG_VALIDATOR} -D FILE=${name} -D SHADERS=${all}
              -D OUTPUT=${output} -P ${PROJECT_SOURCE_DIR}/cmake/validate_shader.cmake
      COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
      DEPENDS ${shaders} ${PROJECT_SOURCE_DIR}/cmake/validate_shader.cmake
      COMMENT "Validating ${name}" VERBATIM)
    list(APPEND stamps ${stamp})
  endforeach()
  set(embedded ${output}/embedded.cpp)
  add_custom_command(
    OUTPUT ${embedded}
    COMMAND ${CMAKE_COMMAND} -D "FILES=${shaders}" -D OUTPUT=${embedded}
            -P ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake
    DEPENDS ${shaders} ${stamps} ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake
    COMMENT "Embedding shaders" VERBATIM)
  target_sources(${target} PRIVATE ${embedded})
endfunction()
