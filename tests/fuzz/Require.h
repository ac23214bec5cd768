// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>

/// Ends the fuzzer with a finding where a claim does not hold.
inline void require(bool holds, const char* claim)
{
    if (!holds)
    {
        std::fprintf(stderr, "violated: %s\n", claim);
        std::abort();
    }
}
