// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <ctime>

namespace osgPagedTexture
{

/// CPU time of the calling thread, so that what other programs take does not count; wall time where
/// there is no such clock. Milliseconds from any origin.
inline double threadMilliseconds()
{
#ifdef CLOCK_THREAD_CPUTIME_ID
    timespec time{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) == 0)
        return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
#endif
    return std::chrono::duration<double, std::milli>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

} // namespace osgPagedTexture
