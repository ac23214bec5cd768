# cmake -DNAMESPACE=<ns> -DFILES=<a|b> -DOUTPUT=<header> -P EmbedShaders.cmake
# Writes each file as an inline constexpr raw string named after the file.
string(REPLACE "|" ";" FILES "${FILES}")
foreach(file IN LISTS FILES)
    file(READ "${file}" text)
    string(LENGTH "${text}" size)
    if(size GREATER 16000)
        message(FATAL_ERROR "${file}: a string literal holds 16 KB on MSVC; split the shader")
    endif()
    get_filename_component(name "${file}" NAME)
    string(MAKE_C_IDENTIFIER "${name}" id)
    string(APPEND body "inline constexpr char ${id}[] = R\"glsl(${text})glsl\";\n")
endforeach()
file(WRITE "${OUTPUT}" "#pragma once\nnamespace ${NAMESPACE}\n{\n${body}}\n")
