// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>

/// The same numbers on every machine, which distributions of the standard library are not.
class CityRandom
{
public:
    explicit CityRandom(std::uint32_t seed) : _engine(seed) {}

    /// From `low` to below `high`.
    double operator()(double low, double high)
    {
        return low + (high - low) * 0x1p-32 * double(_engine());
    }
    /// From 0 to count - 1.
    unsigned int choice(unsigned int count) { return static_cast<unsigned int>(_engine() % count); }

private:
    std::mt19937 _engine;
};
