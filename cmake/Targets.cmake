# The functions that make every other list data: osgkits_add_nodekit, osgkits_add_plugin,
# osgkits_add_program, osgkits_add_test.

function(osgkits_target_options target)
    target_compile_features(${target} PUBLIC cxx_std_17)
    if(MSVC)
        target_compile_options(${target} PRIVATE /W4 $<$<BOOL:${OSGKITS_WERROR}>:/WX>)
    else()
        # Decisions that must agree to the last bit in several places forbid contraction.
        target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -ffp-contract=off
            $<$<BOOL:${OSGKITS_WERROR}>:-Werror>)
        if(OSGKITS_SANITIZE)
            target_compile_options(${target} PRIVATE -fsanitize=${OSGKITS_SANITIZE}
                -fno-sanitize-recover=undefined -fno-omit-frame-pointer -g)
            target_link_options(${target} PRIVATE -fsanitize=${OSGKITS_SANITIZE})
        endif()
    endif()
endfunction()

function(osgkits_embed_shaders target)
    if(NOT ARGN)
        return()
    endif()
    set(header ${PROJECT_BINARY_DIR}/include/${target}/Shaders.h)
    list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/shaders/ OUTPUT_VARIABLE files)
    list(JOIN files "|" joined)
    add_custom_command(OUTPUT ${header}
        COMMAND ${CMAKE_COMMAND} -DNAMESPACE=${target}::shaders "-DFILES=${joined}"
            -DOUTPUT=${header} -P ${PROJECT_SOURCE_DIR}/cmake/EmbedShaders.cmake
        DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/EmbedShaders.cmake VERBATIM)
    target_sources(${target} PRIVATE ${header})
endfunction()

# A nodekit: a shared library whose folder, namespace and META_ library name are its name.
function(osgkits_add_nodekit name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;HEADERS;SHADERS;LIBRARIES")
    add_library(${name} SHARED ${arg_SOURCES} ${arg_HEADERS})
    add_library(osgKits::${name} ALIAS ${name})
    osgkits_target_options(${name})
    set_target_properties(${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR} INSTALL_RPATH "$ORIGIN")
    generate_export_header(${name} EXPORT_FILE_NAME ${PROJECT_BINARY_DIR}/include/${name}/Export.h)
    target_include_directories(${name} PUBLIC
        $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(${name} PUBLIC OSG::OSG ${arg_LIBRARIES})
    osgkits_embed_shaders(${name} ${arg_SHADERS})
    install(TARGETS ${name} EXPORT osgKitsTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(FILES ${arg_HEADERS} ${PROJECT_BINARY_DIR}/include/${name}/Export.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${name})
endfunction()

# A plugin: a module where OSG looks for it, osgPlugins-<version>/<file name>.so.
function(osgkits_add_plugin name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
    set(folder osgPlugins-${OPENSCENEGRAPH_VERSION})
    add_library(${name} MODULE ${arg_SOURCES})
    osgkits_target_options(${name})
    set_target_properties(${name} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden
        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${folder} INSTALL_RPATH "$ORIGIN/..")
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/include)
    target_link_libraries(${name} PRIVATE OSG::OSG ${arg_LIBRARIES})
    install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/${folder})
endfunction()

# A program of examples/, installed.
function(osgkits_add_program name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
    add_executable(${name} ${arg_SOURCES})
    osgkits_target_options(${name})
    set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/include)
    target_link_libraries(${name} PRIVATE OSG::OSG ${arg_LIBRARIES})
    install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# One class, one executable, one CTest entry <kit>.<name>. The suffix of the name is the need:
# *Test runs on the CPU, *GLTest needs a context (label gl), *Benchmark is not run by CTest.
# LONG: also entered as <kit>.<name>.long (label long), with OSGKITS_LONG=1, for run.sh --long.
function(osgkits_add_test kit name)
    cmake_parse_arguments(PARSE_ARGV 2 arg "LONG" "TIMEOUT" "SOURCES;LIBRARIES")
    set(target ${kit}.${name})
    add_executable(${target} ${name}.cpp ${arg_SOURCES})
    osgkits_target_options(${target})
    set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
    target_link_libraries(${target} PRIVATE osgKitsTestSupport ${arg_LIBRARIES} GTest::gtest)
    if(name MATCHES "Benchmark$")
        return()
    endif()
    target_link_libraries(${target} PRIVATE GTest::gtest_main)
    if(NOT arg_TIMEOUT)
        set(arg_TIMEOUT 300)
    endif()
    add_test(NAME ${target} COMMAND ${target} WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
    set_tests_properties(${target} PROPERTIES TIMEOUT ${arg_TIMEOUT}
        ENVIRONMENT "OSG_LIBRARY_PATH=${CMAKE_LIBRARY_OUTPUT_DIRECTORY};OSG_NOTIFY_LEVEL=WARN")
    if(name MATCHES "GLTest$")
        set_tests_properties(${target} PROPERTIES LABELS gl)
    endif()
    if(arg_LONG)
        add_test(NAME ${target}.long COMMAND ${target} WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
        set_tests_properties(${target}.long PROPERTIES TIMEOUT 7200 LABELS long
            ENVIRONMENT "OSG_LIBRARY_PATH=${CMAKE_LIBRARY_OUTPUT_DIRECTORY};OSG_NOTIFY_LEVEL=WARN;OSGKITS_LONG=1")
    endif()
endfunction()
