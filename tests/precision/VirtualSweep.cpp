// SPDX-License-Identifier: MIT
// How far pictures of a flight over a virtual texture are from those that wait for all pages, and
// what a frame costs.
#include "Sweep.h"

#include "../osgPagedTexture/FlightGround.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{

using precision::Outcome;
using Clock = std::chrono::steady_clock;

constexpr int Width = 640, Height = 360;
constexpr int Step = 24, First = 12; ///< Frames that are compared.
constexpr std::int64_t Side = 26000; ///< 2 GiB as RGB.
constexpr std::chrono::milliseconds Frame(33);

using Pictures = std::vector<osg::ref_ptr<osg::Image>>;

/// Mean difference of channels, of 255.
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

class Workshop
{
public:
    Workshop()
    {
        if (!_viewer.isValid())
            throw std::runtime_error(_viewer.getError());
    }

    std::string getRenderer() { return _viewer.getRenderer(); }

    /// A round at thirty frames a second; the error is the mean of the compared frames', the time
    /// that of a frame without what it waits for its turn.
    Outcome fly(const std::string& settings, int tileSide)
    {
        const Pictures& truth = getTruth(tileSide);
        const auto scene = makeScene(settings, tileSide);
        Outcome outcome;
        outcome.seconds = 0.0;
        Clock::time_point turn = Clock::now();
        for (int frame = 0; frame < flight::Frames; ++frame)
        {
            std::this_thread::sleep_until(turn);
            const Clock::time_point start = Clock::now();
            const auto picture = _viewer.render(scene, flight::cameraAt(frame), Width, Height);
            const std::chrono::duration<double> took = Clock::now() - start;
            turn = std::max(turn + Frame, Clock::now());
            outcome.seconds += took.count() / flight::Frames;
            if (frame % Step == First)
                outcome.number +=
                    meanDifference(*picture, *truth[std::size_t(frame / Step)]) / truth.size();
        }
        return outcome;
    }

private:
    osg::ref_ptr<osgPagedTexture::VirtualScene> makeScene(const std::string& settings, int tileSide)
    {
        const std::string store = _folder.file("ground" + std::to_string(tileSide));
        if (!std::filesystem::exists(store))
            flight::buildGround(store, Side, tileSide);
        return virtuals::makeScene(
            virtuals::makeFloor(virtuals::makeVirtualTexture(store), float(flight::Ground)),
            "aniso=8,quality=fast,watch=off," + settings, false);
    }

    /// All pages, not compressed. Stores of other tiles have another pattern.
    const Pictures& getTruth(int tileSide)
    {
        Pictures& truth = _truth[tileSide];
        if (!truth.empty())
            return truth;
        const auto scene = makeScene("gpu=512,cpu=512,compression=none,wait=on", tileSide);
        for (int frame = First; frame < flight::Frames; frame += Step)
            truth.push_back(_viewer.render(scene, flight::cameraAt(frame), Width, Height));
        return truth;
    }

    support::HeadlessViewer _viewer{{Width, Height}};
    support::TemporaryFolder _folder;
    std::map<int, Pictures> _truth; ///< By the side of tiles.
};

precision::Sweep makeSweep()
{
    const auto shop = std::make_shared<Workshop>();
    precision::Sweep sweep;
    sweep.name = "virtual-flight";
    sweep.title = "A flight over a texture of 26,000 x 26,000 texels, 640x360, 30 frames a second; "
                  "time of a frame";
    sweep.errorName = "mean difference of channels (of 255) from pictures with all pages";
    sweep.renderer = shop->getRenderer();
    sweep.errorEachRound = true;
    sweep.getError = [](const Outcome& outcome, const Outcome&) { return outcome.number; };
    const auto add = [&](const std::string& name, const std::string& knob,
                         const std::vector<double>& values,
                         const std::function<Outcome(double)>& run) {
        sweep.methods.push_back({name, knob, values, run});
    };
    const auto number = [](double value) { return std::to_string(int(value)); };
    add("budget", "MiB on the GPU", {1, 2, 4, 8, 32, 128},
        [=](double value) { return shop->fly("compression=blocks,gpu=" + number(value), 128); });
    add("feedback", "pixels a side", {2, 4, 16, 32},
        [=](double value)
        { return shop->fly("compression=blocks,gpu=32,feedback=" + number(value), 128); });
    add("pages", "texels a side", {64, 256},
        [=](double value) { return shop->fly("compression=blocks,gpu=32", int(value)); });
    add("not compressed", "MiB on the GPU", {8, 32, 128},
        [=](double value) { return shop->fly("compression=none,gpu=" + number(value), 128); });
    return sweep;
}

const precision::Registration registration("virtual-flight", makeSweep);

} // namespace
