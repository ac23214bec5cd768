# cmake -DBUILD=<build tree> -DSOURCE=<project> -DSCRATCH=<folder> -DCOMPILER=<c++>
#   -DGENERATOR=<generator> -DLIBDIR=<lib> -P PackageTest.cmake
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(result)
        message(FATAL_ERROR "failed (${result}): ${ARGN}\n${output}")
    endif()
endfunction()
file(REMOVE_RECURSE ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE} -B ${SCRATCH}/build -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
# The installed plugins are found beside the installed libraries.
set(ENV{OSG_LIBRARY_PATH} ${SCRATCH}/prefix/${LIBDIR})
run(${SCRATCH}/build/consumer ${SCRATCH}/scene.osgt)
run(${SCRATCH}/build/consumer_labels ${SCRATCH}/labels.osgt)
run(${SCRATCH}/build/consumer_paged ${SCRATCH}/paged.osgt)
# No installed file may point back into the build tree.
file(GLOB_RECURSE configs ${SCRATCH}/prefix/*.cmake)
foreach(config IN LISTS configs)
    file(READ ${config} text)
    string(FIND "${text}" "${BUILD}/" position)
    if(NOT position EQUAL -1)
        message(FATAL_ERROR "${config} names the build tree")
    endif()
endforeach()
