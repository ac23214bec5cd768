# Defines OSG::OSG. Debian ships no OpenSceneGraphConfig.cmake and CMake's module gives variables
# only; our build and the installed package config both include this file, so both see one target.
find_package(OpenSceneGraph 3.6 REQUIRED COMPONENTS osgDB osgUtil osgText osgGA osgViewer)
find_package(OpenGL REQUIRED COMPONENTS OpenGL)
if(NOT TARGET OSG::OSG)
    add_library(OSG::OSG INTERFACE IMPORTED)
    set_target_properties(OSG::OSG PROPERTIES
        INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${OPENSCENEGRAPH_INCLUDE_DIRS}"
        INTERFACE_INCLUDE_DIRECTORIES "${OPENSCENEGRAPH_INCLUDE_DIRS}")
    target_link_libraries(OSG::OSG INTERFACE ${OPENSCENEGRAPH_LIBRARIES} OpenGL::GL)
endif()
