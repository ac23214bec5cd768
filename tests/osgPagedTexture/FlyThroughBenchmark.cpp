// SPDX-License-Identifier: MIT
// A flight through a model with more texture than memory, in real time, for several ways to load
// it: frame times, memory, and the work of uploads.
//
//   osgPagedTexture.FlyThroughBenchmark --path FILE [--size WxH] [--seconds S] [--stand]
//       [--step S] [--rounds N] [--cache DIR] [--csv file] model...
//
// A model is a file as osgviewer takes it, "town.osgb" or "town.osgb.(gpu=64).pagedtexture", or
// "untextured:town.osgb". Each flies in a process of its own, one after the other. Paths are made
// by osgphotocity --path, or recorded by osgviewer with key z. --cache: folder of encoded textures,
// for XDG_CACHE_HOME; empty ones show a first start. --stand: stays at the start of the path, so
// that rest_s is what full quality takes. --step: each frame so many seconds farther along the
// path, however long it takes; with wait=on this fills the cache. --rounds: each model so often, in
// turns; medians.
//
// Columns: seconds to load, to the first picture, and from the end of the path until textures are
// at rest; frames and their times in ms; CPU time of uploads a frame in ms; of the texels that
// frames need, those that are not there, in percent: the mean, and what 99 % of the frames do not
// exceed; MiB of textures on the GPU as counted, of the process, both at most; MiB read from files,
// and files decoded; MiB uploaded; CPU time of looking ahead, ms a frame; of the longest frame the
// second of the path, and the CPU time of the thread that draws, of uploads and of the plan in ms.
#include <support/FrameTimer.h>

#include <osgPagedTexture/PagedScene.h>
#include <osgPagedTexture/ThreadClock.h>

#include <osg/AnimationPath>
#include <osg/Timer>
#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numeric>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace
{

struct Task
{
    std::string model, path, cache;
    double seconds = 0.0; ///< Of the flight at most; 0: all of it.
    double step = 0.0;    ///< Seconds of the path a frame; 0: in real time.
    bool stands = false;
    BenchmarkOptions options;
};

class NoImages : public osgDB::ReadFileCallback
{
public:
    osgDB::ReaderWriter::ReadResult readImage(const std::string&, const osgDB::Options*) override
    {
        return osgDB::ReaderWriter::ReadResult::FILE_NOT_FOUND;
    }
};

double quantile(std::vector<double> values, double share)
{
    if (values.empty())
        return 0.0;
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
}

double mean(const std::vector<double>& values)
{
    return values.empty() ? 0.0
                          : std::accumulate(values.begin(), values.end(), 0.0) / values.size();
}

/// The number behind `name` in a file of /proc, 0 where there is none.
double procNumber(const char* file, const std::string& name)
{
    std::ifstream lines(file);
    for (std::string word; lines >> word;)
        if (word == name + ":")
        {
            double number = 0.0;
            lines >> number;
            return number;
        }
    return 0.0;
}

osg::ref_ptr<osg::Node> load(const std::string& model)
{
    const std::string untextured = "untextured:";
    if (model.compare(0, untextured.size(), untextured) != 0)
        return osgDB::readRefNodeFile(model);
    osgDB::Registry::instance()->setReadFileCallback(new NoImages);
    return osgDB::readRefNodeFile(model.substr(untextured.size()));
}

double secondsSince(osg::Timer_t start)
{
    return osg::Timer::instance()->delta_s(start, osg::Timer::instance()->tick());
}

class Flight
{
public:
    explicit Flight(const Task& task) : _task(task), _viewer(settingsOf(task)) {}

    /// Empty, and a line on the error stream, where it can't be flown.
    std::vector<double> fly()
    {
        const osg::ref_ptr<osg::AnimationPath> path = readPath();
        if (path->empty() || !_viewer.isValid())
            return fail(path->empty() ? _task.path + " is no path" : _viewer.getError());
        const osg::Timer_t start = osg::Timer::instance()->tick();
        _model = load(_task.model);
        if (!_model)
            return fail(_task.model + " can't be read");
        _scene = dynamic_cast<osgPagedTexture::PagedScene*>(_model.get());
        const double loaded = secondsSince(start);
        show(*path, 0.0);
        const double first = secondsSince(start);
        _frames.clear();
        _uploads.clear();
        _missing.clear();
        const osg::Timer_t takeOff = osg::Timer::instance()->tick();
        const double end = _task.stands          ? 0.0
                           : _task.seconds > 0.0 ? std::min(_task.seconds, path->getPeriod())
                                                 : path->getPeriod();
        for (double time = 0.0;
             time<end; time = _task.step> 0.0 ? time + _task.step : secondsSince(takeOff))
            show(*path, time);
        const osg::Timer_t landing = osg::Timer::instance()->tick();
        const std::size_t frames = _frames.size();
        const Longest longest = _longest;
        // The need of a frame is known in the next one, and GL's abilities after the first.
        for (int calm = 0; _scene && calm < 4 && secondsSince(landing) < 120.0;
             calm = _scene->isAtRest() ? calm + 1 : 0)
            show(*path, end);
        const double rest = secondsSince(landing);
        _frames.resize(_task.stands ? _frames.size() : frames);
        _missing.resize(std::min(_missing.size(), frames));
        return {loaded,
                first,
                rest,
                double(frames),
                quantile(_frames, 0.5),
                quantile(_frames, 0.99),
                quantile(_frames, 1.0),
                quantile(_uploads, 0.5),
                quantile(_uploads, 0.99),
                quantile(_uploads, 0.999),
                quantile(_uploads, 1.0),
                100.0 * mean(_missing),
                100.0 * quantile(_missing, 0.99),
                gpuMiB(),
                procNumber("/proc/self/status", "VmHWM") / 1024.0,
                procNumber("/proc/self/io", "rchar") / (1 << 20),
                _scene ? double(_scene->getStatistics().loader.filesDecoded) : 0.0,
                _scene ? double(_scene->getStatistics().upload.uploaded) / (1 << 20) : 0.0,
                mean(_ahead),
                longest.at,
                longest.cpu,
                longest.upload,
                longest.plan};
    }

private:
    static support::HeadlessSettings settingsOf(const Task& task)
    {
        support::HeadlessSettings settings;
        settings.width = task.options.width;
        settings.height = task.options.height;
        return settings;
    }

    /// AnimationPath::read() never ends on what is no number, or no file.
    osg::ref_ptr<osg::AnimationPath> readPath() const
    {
        osg::ref_ptr<osg::AnimationPath> path = new osg::AnimationPath;
        std::ifstream file(_task.path);
        std::array<double, 8> n;
        while (std::all_of(n.begin(), n.end(), [&file](double& x) { return bool(file >> x); }))
            path->insert(n[0], osg::AnimationPath::ControlPoint(osg::Vec3d(n[1], n[2], n[3]),
                                                                osg::Quat(n[4], n[5], n[6], n[7])));
        return path;
    }

    std::vector<double> fail(const std::string& why)
    {
        std::fprintf(stderr, "%s\n", why.c_str());
        return {};
    }

    double gpuMiB() const
    {
        return _scene ? double(_scene->getStatistics().upload.peakBytes) / (1 << 20) : 0.0;
    }

    void show(const osg::AnimationPath& path, double time)
    {
        osg::Matrixd view;
        path.getInverse(path.getFirstTime() + time, view);
        support::CameraSpec camera;
        const double aspect = double(_task.options.width) / _task.options.height;
        camera.view = view;
        camera.projection = osg::Matrixd::perspective(60.0, aspect, 0.5, 5000.0);
        _viewer.setSimulationTime(time);
        const osg::Timer_t start = osg::Timer::instance()->tick();
        const double worked = osgPagedTexture::threadMilliseconds();
        _viewer.render(_model, camera, _task.options.width, _task.options.height);
        const double took = 1e3 * secondsSince(start);
        osgPagedTexture::PagerStatistics statistics;
        if (_scene)
            statistics = _scene->getStatistics();
        if (_frames.empty() || took > *std::max_element(_frames.begin(), _frames.end()))
            _longest = {time, osgPagedTexture::threadMilliseconds() - worked,
                        statistics.upload.lastMilliseconds, statistics.planMilliseconds};
        _frames.push_back(took);
        if (!_scene)
            return;
        _uploads.push_back(statistics.upload.lastMilliseconds);
        _missing.push_back(statistics.missingTexels / std::max(1.0, statistics.neededTexels));
        _ahead.push_back(statistics.prefetchMilliseconds);
    }

    const Task& _task;
    support::HeadlessViewer _viewer;
    osg::ref_ptr<osg::Node> _model;
    osgPagedTexture::PagedScene* _scene = nullptr;
    std::vector<double> _frames, _uploads, _missing, _ahead;
    struct Longest
    {
        double at = 0.0, cpu = 0.0, upload = 0.0, plan = 0.0;
    } _longest; ///< Seconds on the path, then milliseconds, of the longest frame.
};

/// In a process of its own, so that memory is that of this way alone.
std::vector<double> flyApart(const Task& task)
{
    int ends[2];
    if (pipe(ends) != 0)
        return {};
    const pid_t child = fork();
    if (child == 0)
    {
        if (!task.cache.empty())
            setenv("XDG_CACHE_HOME", task.cache.c_str(), 1);
        const std::vector<double> row = Flight(task).fly();
        const ssize_t bytes = ssize_t(row.size() * sizeof(double));
        const bool written = write(ends[1], row.data(), std::size_t(bytes)) == bytes;
        _exit(written && bytes ? 0 : 1);
    }
    close(ends[1]);
    std::vector<double> row(64);
    const ssize_t bytes = child > 0 ? read(ends[0], row.data(), row.size() * sizeof(double)) : 0;
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status))
        std::fprintf(stderr, "%s: killed by signal %d, for want of memory where it is 9\n",
                     task.model.c_str(), WTERMSIG(status));
    row.resize(bytes > 0 ? std::size_t(bytes) / sizeof(double) : 0);
    return row;
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    Task task;
    arguments.read("--path", task.path);
    arguments.read("--cache", task.cache);
    arguments.read("--seconds", task.seconds);
    arguments.read("--step", task.step);
    task.stands = arguments.read("--stand");
    task.options.rounds = 1;
    if (!task.options.read(arguments))
        return 2;
    Table table({"way",         "load_s",     "first_s",    "rest_s",       "frames",
                 "p50_ms",      "p99_ms",     "max_ms",     "upload_p50",   "upload_p99",
                 "upload_p999", "upload_max", "missing_%",  "missing_p99",  "gpu_MiB",
                 "process_MiB", "read_MiB",   "decoded",    "uploaded_MiB", "ahead_ms",
                 "max_at_s",    "max_cpu",    "max_upload", "max_plan"});
    int failures = 0;
    std::map<int, std::vector<std::vector<double>>> columns; // Of each model, values of the rounds.
    for (int round = 0; round < task.options.rounds; ++round)
        for (int i = 1; i < arguments.argc(); ++i)
        {
            task.model = arguments[i];
            const std::vector<double> row = flyApart(task);
            failures += row.empty();
            columns[i].resize(row.size());
            for (std::size_t c = 0; c < row.size(); ++c)
                columns[i][c].push_back(row[c]);
        }
    for (const auto& [i, values] : columns)
    {
        std::vector<double> row;
        addMedians(row, values);
        if (!row.empty())
            table.add(osgDB::getSimpleFileName(arguments[i]), row);
    }
    return table.report(task.options.csv) || failures;
}
