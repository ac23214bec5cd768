// SPDX-License-Identifier: MIT
#pragma once

namespace osgShadowVolume
{

/// The digits of `i` in a prime base, mirrored at the point: low-discrepancy numbers in [0, 1).
/// With bases 2, 3 and 5 few samples cover a box evenly.
inline double radicalInverse(unsigned int i, unsigned int base)
{
    double result = 0.0, digit = 1.0 / base;
    for (; i; i /= base, digit /= base)
        result += digit * (i % base);
    return result;
}

} // namespace osgShadowVolume
