// SPDX-License-Identifier: MIT
#include "Flight.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace precision
{

namespace
{

double meanDifference(const osg::Image& a, const osg::Image& b)
{
    double sum = 0.0;
    for (int y = 0; y < a.t(); ++y)
        for (int x = 0; x < a.s(); ++x)
            for (unsigned int c = 0; c < 3; ++c)
                sum += std::abs(int(a.data(unsigned(x), unsigned(y))[c]) -
                                int(b.data(unsigned(x), unsigned(y))[c]));
    return sum / (3.0 * a.s() * a.t());
}

} // namespace

Pictures Flight::take(const std::function<osg::ref_ptr<osg::Image>(int)>& draw) const
{
    Pictures pictures;
    for (int i = first; i < frames; i += step)
        pictures.push_back(draw(i));
    return pictures;
}

Outcome Flight::fly(const Pictures& truth,
                    const std::function<osg::ref_ptr<osg::Image>(int)>& draw) const
{
    using Clock = std::chrono::steady_clock;
    Outcome outcome;
    outcome.seconds = 0.0;
    Clock::time_point turn = Clock::now();
    for (int i = 0; i < frames; ++i)
    {
        std::this_thread::sleep_until(turn);
        const Clock::time_point start = Clock::now();
        const osg::ref_ptr<osg::Image> picture = draw(i);
        const std::chrono::duration<double> took = Clock::now() - start;
        turn = std::max(turn + frame, Clock::now());
        outcome.seconds += took.count() / frames;
        if (i >= first && (i - first) % step == 0)
            outcome.number +=
                meanDifference(*picture, *truth[std::size_t((i - first) / step)]) / truth.size();
    }
    return outcome;
}

} // namespace precision
