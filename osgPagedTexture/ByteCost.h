// SPDX-License-Identifier: MIT
// What memory costs by its size. Not installed.
#pragma once

#include <algorithm>
#include <cstdint>

namespace osgPagedTexture
{

/// Milliseconds to make memory, or to give it back. The slowest counts: memory that has been used
/// before costs little, but there may be none.
class ByteCost
{
public:
    /// Less is done in any frame, and says nothing about the cost of more.
    static constexpr std::uint64_t Small = 256 << 10;

    /// A guess, until the first is known.
    explicit ByteCost(double millisecondsOfMebibyte) : _each(millisecondsOfMebibyte / (1 << 20)) {}

    double of(std::uint64_t bytes) const { return bytes < Small ? 0.0 : _each * double(bytes); }

    void learn(std::uint64_t bytes, double milliseconds)
    {
        if (bytes < Small)
            return;
        const double each = milliseconds / double(bytes);
        _each = _isKnown ? std::max(_each, each) : each;
        _isKnown = true;
    }

private:
    double _each;
    bool _isKnown = false;
};

} // namespace osgPagedTexture
