// SPDX-License-Identifier: MIT
// How far pictures of a flight over a virtual texture are from those that wait for all pages, and
// what a frame costs.
#include "Flight.h"
#include "Sweep.h"

#include "../osgPagedTexture/FlightGround.h"

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using precision::Outcome;
using precision::Pictures;

constexpr int Width = 640, Height = 360;
constexpr std::int64_t Side = 26000; ///< 2 GiB as RGB.
constexpr precision::Flight OverGround{flight::Frames, 24, 12, std::chrono::milliseconds(33)};

class Workshop
{
public:
    Workshop()
    {
        if (!_viewer.isValid())
            throw std::runtime_error(_viewer.getError());
    }

    std::string getRenderer() { return _viewer.getRenderer(); }

    /// A round at thirty frames a second.
    Outcome fly(const std::string& settings, int tileSide)
    {
        const Pictures& truth = getTruth(tileSide);
        const auto scene = makeScene(settings, tileSide);
        return OverGround.fly(truth, [&](int frame) { return draw(scene, frame); });
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
        return truth = OverGround.take([&](int frame) { return draw(scene, frame); });
    }

    osg::ref_ptr<osg::Image> draw(osg::Node* scene, int frame)
    {
        return _viewer.render(scene, flight::cameraAt(frame), Width, Height);
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
