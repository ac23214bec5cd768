// SPDX-License-Identifier: MIT
#include "ExitStatus.h"

#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <mutex>

namespace osgHeadless
{

void keepLibraryMapped()
{
    static std::once_flag once;
    std::call_once(once,
                   []
                   {
                       Dl_info info;
                       if (dladdr(reinterpret_cast<void*>(&keepLibraryMapped), &info))
                       {
                           dlopen(info.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
                       }
                   });
}

namespace
{
std::atomic<bool> failed{false};
}

bool willExitWithFailure()
{
    return failed;
}

void exitWithFailure()
{
    static std::once_flag once;
    failed = true;
    std::call_once(once,
                   []
                   {
                       keepLibraryMapped();
                       // A handler cannot change the status that exit() was given, but it can end
                       // the process.
                       std::atexit(
                           []
                           {
                               std::cout.flush();
                               std::cerr.flush();
                               std::fflush(nullptr);
                               _exit(EXIT_FAILURE);
                           });
                   });
}

} // namespace osgHeadless
