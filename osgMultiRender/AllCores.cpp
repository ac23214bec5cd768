// SPDX-License-Identifier: MIT
#include <osgMultiRender/AllCores.h>

#ifdef __linux__
#include <filesystem>
#include <string>

#include <sched.h>
#endif

namespace osgMultiRender
{

#ifdef __linux__

namespace
{

struct Cores
{
    cpu_set_t set;
    bool known = false; ///< Not beyond the 1,024 cores that a cpu_set_t counts.
};

/// Of all threads, since a viewer may have bound the one that loads the library by now.
Cores coresOfProgram()
{
    Cores cores;
    CPU_ZERO(&cores.set);
    std::error_code error;
    std::filesystem::directory_iterator task("/proc/self/task", error);
    for (; task != std::filesystem::directory_iterator(); task.increment(error))
    {
        cpu_set_t set;
        if (sched_getaffinity(std::stoi(task->path().filename().string()), sizeof(set), &set) == 0)
        {
            CPU_OR(&cores.set, &cores.set, &set);
            cores.known = true;
        }
    }
    return cores;
}

const Cores programCores = coresOfProgram();

} // namespace

void useAllCores()
{
    if (programCores.known)
        sched_setaffinity(0, sizeof(programCores.set), &programCores.set);
}

#else

void useAllCores() {}

#endif

} // namespace osgMultiRender
