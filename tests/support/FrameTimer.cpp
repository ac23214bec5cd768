// SPDX-License-Identifier: MIT
#include <support/FrameTimer.h>

#include <osg/Stats>
#include <osg/Timer>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>

namespace
{

support::HeadlessSettings settingsOf(int width, int height)
{
    support::HeadlessSettings settings;
    settings.width = width;
    settings.height = height;
    return settings;
}

} // namespace

FrameTimer::FrameTimer(const BenchmarkOptions& options)
    : _width(options.width), _height(options.height), _viewer(settingsOf(_width, _height))
{
    if (!isValid())
    {
        std::fprintf(stderr, "%s\n", _viewer.getError().c_str());
        return;
    }
    _viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    osg::Camera* const camera = _viewer.getViewer().getCamera();
    if (!camera->getStats())
        camera->setStats(new osg::Stats("camera"));
    camera->getStats()->collectStats("rendering", true);
}

FrameTime FrameTimer::draw(osg::Node& scene, const support::CameraSpec& camera,
                           const std::function<void()>& change)
{
    _viewer.render(&scene, camera, _width, _height);
    if (change)
        change();
    return drawOnce(scene, camera);
}

FrameTime FrameTimer::drawOnce(osg::Node& scene, const support::CameraSpec& camera)
{
    FrameTime time;
    const osg::Timer_t start = osg::Timer::instance()->tick();
    _viewer.render(&scene, camera, _width, _height);
    time.frame = osg::Timer::instance()->delta_m(start, osg::Timer::instance()->tick());
    osg::Stats& stats = *_viewer.getViewer().getCamera()->getStats();
    double seconds = 0.0;
    if (stats.getAttribute(stats.getLatestFrameNumber(), "Cull traversal time taken", seconds))
        time.cull = 1e3 * seconds;
    return time;
}

double getCpuMilliseconds()
{
    return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
}

void Table::add(const std::string& label, const std::vector<double>& values)
{
    _rows.emplace_back(label, values);
}

void Table::print() const
{
    const auto width = [this](std::size_t column)
    { return int(std::max<std::size_t>(16, _columns[column].size() + 2)); };
    for (std::size_t i = 0; i < _columns.size(); ++i)
        std::printf("%*s", width(i), _columns[i].c_str());
    std::printf("\n");
    for (const auto& [label, values] : _rows)
    {
        std::printf("%*s", width(0), label.c_str());
        for (std::size_t i = 0; i < values.size(); ++i)
            std::printf("%*.3f", width(i + 1), values[i]);
        std::printf("\n");
    }
}

int Table::report(const std::string& csv) const
{
    print();
    if (csv.empty() || write(csv))
        return 0;
    std::fprintf(stderr, "%s can't be written\n", csv.c_str());
    return 1;
}

bool Table::write(const std::string& name) const
{
    std::ofstream file(name);
    for (std::size_t i = 0; i < _columns.size(); ++i)
        file << (i ? "," : "") << _columns[i];
    file << '\n';
    for (const auto& [label, values] : _rows)
    {
        file << label;
        for (double value : values)
            file << ',' << value;
        file << '\n';
    }
    return file.good();
}

bool BenchmarkOptions::read(osg::ArgumentParser& arguments)
{
    arguments.read("--rounds", rounds);
    arguments.read("--csv", csv);
    std::string size;
    if (!arguments.read("--size", size) ||
        (std::sscanf(size.c_str(), "%dx%d", &width, &height) == 2 && width > 0 && height > 0))
        return true;
    std::fprintf(stderr, "--size wants WxH, not '%s'\n", size.c_str());
    return false;
}
