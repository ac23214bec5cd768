// SPDX-License-Identifier: MIT
// How far pictures of a flight through a town of photographs are from those with all texels, by the
// memory that its textures may take and by the time that their uploads may.
#include "Flight.h"

#include "../osgPagedTexture/PagedScenes.h"

#include <support/ChildProcess.h>

#include <osg/AnimationPath>

#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>

namespace
{

using precision::Outcome;
using precision::Pictures;

constexpr int Width = 640, Height = 360;
constexpr int FramesPerSecond = 10; ///< llvmpipe draws some twenty.
constexpr double Start = 8.0;       ///< Seconds of the path before: there it is among the houses.
constexpr precision::Flight ThroughTown{5 * FramesPerSecond, 5, 4,
                                        std::chrono::milliseconds(1000 / FramesPerSecond)};

/// The town and what is known of it.
class Town
{
public:
    Town()
    {
        if (!_viewer.isValid())
            throw std::runtime_error(_viewer.getError());
        const std::string path = _folder.file("flight.path");
        support::ChildProcess program;
        program.arguments = {OSGKITS_OSGPHOTOCITY,     "--bytes", "30MiB", "--path", path,
                             _folder.file("town.osgb")};
        program.timeoutSeconds = 1200.0;
        const support::ProcessResult made = program.run();
        if (made.exitCode != 0)
            throw std::runtime_error("osgphotocity: " + made.errors);
        std::ifstream file(path);
        _path->read(file);
        take("compression=none,gpu=4096,cpu=1024,wait=on", _truth);
        Pictures filled; // The cache.
        take("gpu=4096,cpu=1024,wait=on", filled);
    }

    std::string getRenderer() { return _viewer.getRenderer(); }

    Outcome fly(const std::string& settings)
    {
        const auto scene = read(settings);
        return ThroughTown.fly(_truth, [&](int frame) { return draw(scene, frame); });
    }

private:
    osg::ref_ptr<osgPagedTexture::PagedScene> read(const std::string& settings)
    {
        return paged::read(_folder.file("town.osgb"),
                           "reload=off,cache=" + _folder.file("cache") + "," + settings);
    }

    void take(const std::string& settings, Pictures& pictures)
    {
        const auto scene = read(settings);
        pictures = ThroughTown.take([&](int frame) { return draw(scene, frame); });
    }

    osg::ref_ptr<osg::Image> draw(osg::Node* scene, int frame)
    {
        const double time = Start + double(frame) / FramesPerSecond;
        osg::Matrixd view;
        _path->getInverse(_path->getFirstTime() + time, view);
        _viewer.setSimulationTime(time);
        return _viewer.render(
            scene, {view, osg::Matrixd::perspective(60.0, double(Width) / Height, 0.5, 5000.0)},
            Width, Height);
    }

    support::HeadlessViewer _viewer{{Width, Height}};
    support::TemporaryFolder _folder;
    const osg::ref_ptr<osg::AnimationPath> _path = new osg::AnimationPath;
    Pictures _truth;
};

precision::Sweep makeSweep(const std::shared_ptr<Town>& town, const std::string& name,
                           const std::string& budget)
{
    precision::Sweep sweep;
    sweep.name = name;
    sweep.title = "5 s through a town with 30 MiB of JPEG files, 640x360, 10 frames a second";
    sweep.errorName = "mean difference of channels (of 255) from pictures with all texels";
    sweep.budgetName = budget;
    sweep.renderer = town->getRenderer();
    sweep.errorEachRound = true;
    sweep.getError = [](const Outcome& outcome, const Outcome&) { return outcome.number; };
    return sweep;
}

precision::Method method(const std::shared_ptr<Town>& town, const std::string& name,
                         const std::string& knob, const std::vector<double>& values,
                         const std::string& settings)
{
    return {name, knob, values,
            [=](double value) { return town->fly(settings + std::to_string(value)); }};
}

precision::Sweep makeMemorySweep()
{
    const auto town = std::make_shared<Town>();
    precision::Sweep sweep = makeSweep(town, "paged-memory", "textures on the GPU, MiB");
    const auto add =
        [&](const std::string& name, const std::vector<double>& values, const std::string& settings)
    { sweep.methods.push_back(method(town, name, "MiB", values, settings + "gpu=")); };
    // Frames wait: what is wrong is what the memory can't hold, not what has not come yet.
    add("compressed", {1, 4, 16, 64}, "wait=on,");
    add("not compressed", {4, 16, 64, 256}, "wait=on,compression=none,");
    return sweep;
}

precision::Sweep makeUploadSweep()
{
    const auto town = std::make_shared<Town>();
    precision::Sweep sweep = makeSweep(town, "paged-uploads", "uploads, ms a frame");
    const auto add =
        [&](const std::string& name, const std::vector<double>& values, const std::string& settings)
    { sweep.methods.push_back(method(town, name, "ms", values, settings + "upload=")); };
    add("cache filled", {0.1, 0.3, 1, 3, 10}, "");
    add("first start", {0.3, 3}, "cache=off,");
    add("cache filled, not compressed", {0.1, 0.3, 1, 3, 10}, "compression=none,");
    return sweep;
}

const precision::Registration memory("paged-memory", makeMemorySweep);
const precision::Registration uploads("paged-uploads", makeUploadSweep);

} // namespace
