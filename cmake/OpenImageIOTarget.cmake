# OpenImageIO::OpenImageIO, in a form that Debian 12's package can be linked in: its exported target
# names the include folder of OpenCV, which the package does not depend on and which none of
# OpenImageIO's own headers but one needs.
find_package(OpenImageIO 2.4 REQUIRED)
foreach(target OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util)
    get_target_property(directories ${target} INTERFACE_INCLUDE_DIRECTORIES)
    set(existing)
    foreach(directory IN LISTS directories)
        if(EXISTS "${directory}")
            list(APPEND existing "${directory}")
        endif()
    endforeach()
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${existing}")
endforeach()
