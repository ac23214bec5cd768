// SPDX-License-Identifier: MIT
// Time of a frame of Declutter on one core, over a view of 1920 x 1080 pixels.
#include "DeclutterScenes.h"

#include <benchmark/benchmark.h>

using namespace osgLabels;

namespace
{

const glm::vec2 View(1920.0f, 1080.0f);
constexpr int Frames = 64;

/// Of a camera that moves at 20 m/s, 30 frames a second.
std::vector<std::vector<DeclutterLabel>> makeFlight(std::size_t count)
{
    const CityFlight flight(count, View);
    std::vector<std::vector<DeclutterLabel>> frames;
    for (int i = 0; i < Frames; ++i)
        frames.push_back(flight.labelsAt(i / 30.0, 20.0));
    return frames;
}

void play(benchmark::State& state, const std::vector<std::vector<DeclutterLabel>>& frames)
{
    Declutter declutter;
    std::size_t frame = 0;
    for (auto step : state)
    {
        // There and back, so that nothing jumps.
        const std::size_t i = frame % (2 * Frames), at = i < Frames ? i : 2 * Frames - 1 - i;
        benchmark::DoNotOptimize(declutter.update(frames[at], View, double(frame) / 30.0).data());
        ++frame;
    }
    state.counters["shown"] = double(declutter.getNumShown());
    state.SetItemsProcessed(state.iterations() * std::int64_t(frames[0].size()));
}

/// Labels leave the view of the camera behind it, so that their set is another in many frames.
void flight(benchmark::State& state)
{
    play(state, makeFlight(std::size_t(state.range(0))));
}

/// All labels move by a pixel in each frame, and priorities change: all is sorted anew.
void reordered(benchmark::State& state)
{
    std::vector<std::vector<DeclutterLabel>> frames;
    for (int i = 0; i < Frames; ++i)
    {
        frames.push_back(crowd(std::size_t(state.range(0)), 1, View));
        for (DeclutterLabel& label : frames.back())
        {
            label.rectangle.low.x += float(i);
            label.rectangle.high.x += float(i);
            label.priority += double(i * label.key % 7);
        }
    }
    play(state, frames);
}

void onePoint(benchmark::State& state)
{
    std::vector<std::vector<DeclutterLabel>> frames(Frames);
    for (int i = 0; i < Frames; ++i)
        for (std::uint64_t k = 0; k < std::uint64_t(state.range(0)); ++k)
            frames[i].push_back(
                {{{900.0f + float(i), 500.0f}, {1000.0f + float(i), 516.0f}}, double(k % 7), k});
    play(state, frames);
}

void rest(benchmark::State& state)
{
    play(state, std::vector<std::vector<DeclutterLabel>>(
                    Frames, crowd(std::size_t(state.range(0)), 1, View)));
}

BENCHMARK(flight)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(reordered)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(onePoint)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(rest)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
