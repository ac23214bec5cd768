// SPDX-License-Identifier: MIT
#include <support/ResidentMemory.h>

#include <fstream>
#include <unistd.h>

double support::residentMiB()
{
    std::ifstream file("/proc/self/statm");
    double total = 0.0, resident = 0.0;
    file >> total >> resident;
    return resident * double(sysconf(_SC_PAGESIZE)) / (1 << 20);
}
