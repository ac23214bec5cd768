// SPDX-License-Identifier: MIT
#include "FlyThrough.h"

#include <support/HeadlessViewer.h>
#include <support/ResidentMemory.h>

#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace
{

constexpr double Mebi = 1.0 / (1 << 20);

class Stopwatch
{
public:
    double milliseconds() const
    {
        const auto time = std::chrono::steady_clock::now() - _start;
        return std::chrono::duration<double, std::milli>(time).count();
    }

private:
    std::chrono::steady_clock::time_point _start = std::chrono::steady_clock::now();
};

/// The number after a word in a file of /proc; 0 where there is none.
double numberIn(const char* file, const std::string& word)
{
    std::ifstream in(file);
    double value = 0.0;
    for (std::string key; in >> key;)
        if (key == word)
            in >> value;
    return value;
}

double cpuSeconds()
{
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/// The least of the sorted values that is not below `share` of them.
double quantile(const std::vector<double>& sorted, double share)
{
    const auto rank = std::size_t(std::ceil(share * double(sorted.size())));
    return sorted.empty() ? 0.0 : sorted[std::max<std::size_t>(rank, 1) - 1];
}

std::size_t hashOf(const osg::Image& image)
{
    return std::hash<std::string_view>()(
        {reinterpret_cast<const char*>(image.data()), image.getTotalSizeInBytes()});
}

class Run
{
public:
    explicit Run(const FlyThrough& flight) : _flight(flight), _viewer(settingsOf(flight))
    {
        if (!_viewer.isValid())
            throw std::runtime_error(_viewer.getError());
    }

    std::vector<double> operator()()
    {
        const Stopwatch clock;
        _node = osgDB::readRefNodeFile(_flight.model);
        if (!_node)
            throw std::runtime_error("cannot read '" + _flight.model + "'");
        const double loaded = clock.milliseconds();
        draw(0.0);
        const double first = clock.milliseconds();
        const double startRest = first + settle(0.0, "start");
        const auto times = fly();
        const double endRest = settle(1.0, "end");
        return {loaded,
                first,
                startRest,
                quantile(times, 0.5),
                quantile(times, 0.99),
                quantile(times, 1.0),
                endRest,
                cpuSeconds(),
                support::residentMiB(),
                numberIn("/proc/self/status", "VmHWM:") / 1024.0,
                numberIn("/proc/self/io", "rchar:") * Mebi,
                numberIn("/proc/self/io", "read_bytes:") * Mebi};
    }

private:
    static support::HeadlessSettings settingsOf(const FlyThrough& flight)
    {
        support::HeadlessSettings settings;
        settings.width = flight.width;
        settings.height = flight.height;
        settings.smallFeatureCulling = true;
        return settings;
    }

    osg::ref_ptr<osg::Image> draw(double share)
    {
        osg::AnimationPath::ControlPoint place;
        const double begin = _flight.path->getFirstTime();
        _flight.path->getInterpolatedControlPoint(begin + share * _flight.path->getPeriod(), place);
        support::CameraSpec camera;
        place.getInverse(camera.view);
        camera.projection.makePerspective(60.0, double(_flight.width) / _flight.height, 0.5,
                                          5000.0);
        auto picture = _viewer.render(_node, camera, _flight.width, _flight.height);
        if (!picture)
            throw std::runtime_error("a frame was not drawn");
        return picture;
    }

    /// Milliseconds until the last change of the picture.
    double settle(double share, const char* name)
    {
        const Stopwatch clock;
        double changed = 0.0;
        auto picture = draw(share);
        std::size_t hash = hashOf(*picture);
        while (clock.milliseconds() < changed + 1e3 * _flight.restSeconds &&
               clock.milliseconds() < 1e3 * _flight.mostSeconds)
        {
            picture = draw(share);
            if (const std::size_t now = hashOf(*picture); now != hash)
            {
                hash = now;
                changed = clock.milliseconds();
            }
        }
        if (!_flight.pictures.empty())
            osgDB::writeImageFile(*picture, _flight.pictures + "-" + name + ".png");
        return changed;
    }

    std::vector<double> fly()
    {
        std::vector<double> times;
        for (int i = 0; i < _flight.frames; ++i)
        {
            const Stopwatch clock;
            draw(double(i) / std::max(1, _flight.frames - 1));
            times.push_back(clock.milliseconds());
        }
        std::sort(times.begin(), times.end());
        return times;
    }

    const FlyThrough& _flight;
    support::HeadlessViewer _viewer;
    osg::ref_ptr<osg::Node> _node;
};

} // namespace

const std::vector<std::string>& FlyThrough::columns()
{
    static const std::vector<std::string> names = {"load ms", "first ms", "rest ms",  "p50 ms",
                                                   "p99 ms",  "max ms",   "end ms",   "cpu s",
                                                   "rss MiB", "peak MiB", "read MiB", "disk MiB"};
    return names;
}

std::vector<double> FlyThrough::run() const
{
    return Run(*this)();
}
