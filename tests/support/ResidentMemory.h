// SPDX-License-Identifier: MIT
#pragma once

namespace support
{

/// Memory of this process that is not swapped out, in MiB.
double residentMiB();

} // namespace support
