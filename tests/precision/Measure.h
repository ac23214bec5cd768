// SPDX-License-Identifier: MIT
#pragma once

#include <precision/Sweep.h>

#include <functional>
#include <string>
#include <vector>

namespace precision
{

/// A method under one value of its knob, measured.
struct Measurement
{
    std::string method;
    std::string knob;
    double value = 0.0;
    double error = 0.0;
    std::vector<double> seconds; ///< One a round, in the order of the rounds; warm-ups left out.
    std::string failure;         ///< What went wrong; empty for a pair that ran.

    bool hasFailed() const { return !failure.empty(); }
};

struct Rounds
{
    int timed = 15;  ///< At least 1.
    int warmUps = 2; ///< Untimed rounds before: shaders are compiled, caches filled.
};

/// Runs all (method, value) pairs round robin, so that a slow minute of the machine falls on all.
/// The result is in the order of the sweep; progress is told after each round, with its number.
std::vector<Measurement> measure(const Sweep& sweep, const Rounds& rounds,
                                 const std::function<void(int round, int count)>& progress = {});

/// The value below which a share of 0 to 1 of the values lies, linear between neighbours.
/// 0 for no values.
double getQuantile(std::vector<double> values, double share);

} // namespace precision
