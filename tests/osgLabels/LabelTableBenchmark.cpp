// SPDX-License-Identifier: MIT
// Time and traffic of a LabelTable: building it, and 100,000 changes a second for ten seconds.
#include "TableMirror.h"

#include <chrono>
#include <cstdio>
#include <thread>

using osgLabels::LabelTable;

namespace
{

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A text of `length` codes over 63 glyphs, another for each number.
LabelTable::Codes tag(std::uint64_t number, std::size_t length)
{
    LabelTable::Codes codes(length);
    for (std::size_t i = 0; i < length; ++i, number = number / 63 + (number % 63 << 40))
        codes[i] = static_cast<std::uint32_t>(number % 63);
    return codes;
}

void build(std::uint32_t count)
{
    LabelTable table;
    table.reserveCodes(62);
    auto start = Clock::now();
    for (std::uint32_t id = 1; id <= count; ++id)
        table.setCodes(id, tag(id, 20));
    const double set = secondsSince(start);
    TableMirror mirror(table);
    start = Clock::now();
    mirror.take();
    const auto sizes = table.getSizes();
    std::printf("%u texts: set in %.3f s, sent in %.3f s; GPU %.2f MiB, main memory %.2f MiB\n",
                count, set, secondsSince(start), (sizes.textBytes + sizes.rowBytes) / 1048576.0,
                sizes.mainBytes / 1048576.0);
}

void change(std::uint32_t count, int perSecond, int seconds)
{
    constexpr int framesPerSecond = 60;
    constexpr std::size_t budget = std::size_t(4) << 20;
    LabelTable table;
    table.reserveCodes(62);
    for (std::uint32_t id = 1; id <= count; ++id)
        table.setCodes(id, tag(id, 8));
    TableMirror mirror(table);
    mirror.take();
    const auto before = table.getSizes();
    std::thread setter(
        [&]
        {
            auto next = Clock::now();
            std::uint64_t number = count;
            for (int tick = 0; tick < seconds * 1000; ++tick)
            {
                for (int i = 0; i < perSecond / 1000; ++i, ++number)
                    table.setCodes(static_cast<std::uint32_t>(1 + number * 7919 % count),
                                   tag(number, 8));
                next += std::chrono::milliseconds(1);
                std::this_thread::sleep_until(next);
            }
        });
    std::size_t sent = 0, most = 0, calls = 0;
    double worst = 0.0, total = 0.0;
    const int frames = seconds * framesPerSecond;
    for (int frame = 0; frame < frames; ++frame)
    {
        std::this_thread::sleep_for(std::chrono::microseconds(1000000 / framesPerSecond));
        const auto start = Clock::now();
        mirror.take(budget);
        const double time = secondsSince(start);
        worst = std::max(worst, time);
        total += time;
        sent += mirror.sent;
        calls += mirror.calls;
        most = std::max(most, mirror.sent);
    }
    setter.join();
    const auto after = table.getSizes();
    std::printf("%d changes a second of %u labels for %d s: %.1f KiB and %.0f writes a frame "
                "(most %.1f KiB), %.2f bytes a change, taking %.3f ms a frame (most %.3f ms); "
                "GPU %.2f -> %.2f MiB, main memory %.2f -> %.2f MiB\n",
                perSecond, count, seconds, sent / 1024.0 / frames, double(calls) / frames,
                most / 1024.0, double(sent) / (double(perSecond) * seconds),
                1000.0 * total / frames, 1000.0 * worst,
                (before.textBytes + before.rowBytes) / 1048576.0,
                (after.textBytes + after.rowBytes) / 1048576.0, before.mainBytes / 1048576.0,
                after.mainBytes / 1048576.0);
}

} // namespace

int main()
{
    for (const std::uint32_t count : {10'000u, 300'000u, 2'000'000u})
        build(count);
    change(10'000, 100'000, 10);
    change(300'000, 100'000, 10);
}
