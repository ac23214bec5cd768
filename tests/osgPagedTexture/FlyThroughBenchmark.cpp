// SPDX-License-Identifier: MIT
// A model along a camera path as each of several readers loads it, each time in a process of its
// own, so that no memory is mixed; rounds take turns. Milliseconds of the clock: until the model is
// loaded, until its first picture, until the picture at the path's start rests, of frames along the
// path, until the picture at its end rests. MiB: resident at the end and at most, read by calls,
// read from the disk.
#include "FlyThrough.h"

#include <support/ChildProcess.h>
#include <support/FrameTimer.h>

#include <osg/ArgumentParser>
#include <osgDB/fstream>

#include <sys/resource.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>
#include <sstream>
#include <stdexcept>

namespace
{

constexpr char Help[] =
    R"(osgPagedTexture.FlyThroughBenchmark [options] --path FILE MODEL
  --readers A,B,...  suffixes of pseudo-loaders; "stock" is none (default stock,pagedtexture)
  --frames N         along the path (default 600)
  --rounds N         of all readers (default 1)
  --size WxH         of the picture (default 800x600)
  --memory GiB       that a process may take (default three quarters of what is free)
  --rest SECONDS     that a picture must stay the same (default 1)
  --pictures PREFIX  writes the pictures at rest, PREFIX-READER-start.png and -end.png
  --csv FILE         the table
)";

constexpr char ResultMark[] = "RESULT";

struct Options
{
    BenchmarkOptions common;
    FlyThrough flight;
    std::string readers = "stock,pagedtexture", path, child;
    double memory = 0.0; ///< GiB
};

double freeGiB()
{
    std::ifstream in("/proc/meminfo");
    double kibibytes = 0.0;
    for (std::string key; in >> key;)
        if (key == "MemAvailable:")
            in >> kibibytes;
    return kibibytes / (1 << 20);
}

bool read(osg::ArgumentParser& arguments, Options& options)
{
    options.common.width = 800;
    options.common.height = 600;
    options.common.rounds = 1;
    arguments.read("--readers", options.readers);
    arguments.read("--path", options.path);
    arguments.read("--frames", options.flight.frames);
    arguments.read("--memory", options.memory);
    arguments.read("--rest", options.flight.restSeconds);
    arguments.read("--pictures", options.flight.pictures);
    arguments.read("--child", options.child);
    if (!options.common.read(arguments))
        return false;
    if (arguments.argc() != 2 || options.path.empty() || options.flight.frames < 1)
    {
        std::fputs(Help, stderr);
        return false;
    }
    options.flight.model = arguments[1];
    options.flight.width = options.common.width;
    options.flight.height = options.common.height;
    if (options.memory <= 0.0)
        options.memory = 0.75 * freeGiB();
    return true;
}

/// What takes more fails here, before the machine swaps.
void limitMemory(double gibibytes)
{
    rlimit limit;
    getrlimit(RLIMIT_DATA, &limit);
    limit.rlim_cur = rlim_t(gibibytes * (1 << 30));
    setrlimit(RLIMIT_DATA, &limit);
}

osg::ref_ptr<osg::AnimationPath> pathOf(const std::string& file)
{
    osgDB::ifstream in(file.c_str());
    osg::ref_ptr<osg::AnimationPath> path = new osg::AnimationPath;
    path->read(in);
    if (path->empty())
        throw std::runtime_error("'" + file + "' is no camera path");
    return path;
}

int runChild(Options& options)
{
    FlyThrough& flight = options.flight;
    try
    {
        limitMemory(options.memory);
        flight.path = pathOf(options.path);
        if (options.child != "stock")
            flight.model += "." + options.child;
        if (!flight.pictures.empty())
            flight.pictures += "-" + options.child;
        const std::vector<double> values = flight.run();
        std::printf("%s", ResultMark);
        for (const double value : values)
            std::printf(" %.6g", value);
        std::printf("\n");
        return 0;
    }
    catch (const std::bad_alloc&)
    {
        std::fprintf(stderr, "it takes more than %.1f GiB\n", options.memory);
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "%s\n", error.what());
    }
    return 1;
}

std::vector<double> valuesIn(const std::string& output)
{
    const std::size_t at = output.rfind(ResultMark);
    std::vector<double> values;
    if (at == std::string::npos)
        return values;
    std::istringstream line(output.substr(at + sizeof ResultMark - 1));
    for (double value; line >> value;)
        values.push_back(value);
    return values;
}

/// Infinite values for one that failed, which the error stream is told.
std::vector<double> runOne(const std::vector<std::string>& arguments, const std::string& reader)
{
    support::ChildProcess process;
    process.arguments = arguments;
    process.arguments[0] = std::filesystem::read_symlink("/proc/self/exe").string();
    process.arguments.insert(process.arguments.end(), {"--child", reader});
    process.timeoutSeconds = 3600.0;
    const support::ProcessResult result = process.run();
    std::vector<double> values = valuesIn(result.output);
    if (result.exitCode == 0 && values.size() == FlyThrough::columns().size())
        return values;
    std::fprintf(stderr, "%s failed%s, exit status %d: %s\n", reader.c_str(),
                 result.timedOut ? " (an hour has passed)" : "", result.exitCode,
                 result.errors.c_str());
    values.assign(FlyThrough::columns().size(), std::numeric_limits<double>::infinity());
    return values;
}

} // namespace

int main(int argc, char** argv)
{
    const std::vector<std::string> given(argv, argv + argc);
    osg::ArgumentParser arguments(&argc, argv);
    Options options;
    if (!read(arguments, options))
        return 1;
    if (!options.child.empty())
        return runChild(options);
    std::vector<std::string> columns = FlyThrough::columns();
    columns.insert(columns.begin(), "reader");
    Table table(columns);
    bool failed = false;
    for (int round = 0; round < options.common.rounds; ++round)
    {
        std::istringstream readers(options.readers);
        for (std::string reader; std::getline(readers, reader, ',');)
        {
            const auto values = runOne(given, reader);
            failed = failed || values[0] == std::numeric_limits<double>::infinity();
            table.add(reader, values);
        }
    }
    return table.report(options.common.csv) || failed;
}
