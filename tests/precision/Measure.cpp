// SPDX-License-Identifier: MIT
#include <precision/Measure.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

namespace precision
{

namespace
{

using Clock = std::chrono::steady_clock;

struct Pair
{
    const Method* method;
    Measurement measurement;
    int errors = 0;
};

void runOnce(const Sweep& sweep, const Outcome& reference, bool isTimed, Pair& pair)
{
    Measurement& measurement = pair.measurement;
    try
    {
        const Clock::time_point start = Clock::now();
        const Outcome outcome = pair.method->run(measurement.value);
        const std::chrono::duration<double> elapsed = Clock::now() - start;
        if (!isTimed)
        {
            return;
        }
        measurement.seconds.push_back(outcome.seconds < 0.0 ? elapsed.count() : outcome.seconds);
        if (pair.errors == 0 || sweep.errorEachRound)
        {
            const double error = sweep.getError(outcome, reference);
            measurement.error += (error - measurement.error) / ++pair.errors;
        }
        if (!std::isfinite(measurement.error))
        {
            measurement.failure = "the error is not finite";
        }
    }
    catch (const std::exception& exception)
    {
        measurement.failure = *exception.what() ? exception.what() : "failed without a reason";
    }
}

} // namespace

std::vector<Measurement> measure(const Sweep& sweep, const Rounds& rounds,
                                 const std::function<void(int round, int count)>& progress)
{
    std::vector<Pair> pairs;
    for (const Method& method : sweep.methods)
    {
        for (double value : method.values)
        {
            Pair pair{&method, {}, 0};
            pair.measurement.method = method.name;
            pair.measurement.knob = method.knob;
            pair.measurement.value = value;
            pairs.push_back(pair);
        }
    }
    const Outcome reference = sweep.makeReference ? sweep.makeReference() : Outcome();
    const int count = rounds.warmUps + rounds.timed;
    for (int round = 0; round < count; ++round)
    {
        for (Pair& pair : pairs)
        {
            if (!pair.measurement.hasFailed())
            {
                runOnce(sweep, reference, round >= rounds.warmUps, pair);
            }
        }
        if (progress)
        {
            progress(round + 1, count);
        }
    }
    std::vector<Measurement> measurements;
    for (Pair& pair : pairs)
    {
        measurements.push_back(std::move(pair.measurement));
    }
    return measurements;
}

double getQuantile(std::vector<double> values, double share)
{
    if (values.empty())
    {
        return 0.0;
    }
    std::sort(values.begin(), values.end());
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    const double fraction = place - static_cast<double>(below);
    return values[below] + fraction * (values[above] - values[below]);
}

} // namespace precision
