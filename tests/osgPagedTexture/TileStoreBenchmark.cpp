// SPDX-License-Identifier: MIT
// Builds the same tiles with osgtilestore and with other programs, in turns, each bound to one core
// unless it says otherwise, of one uncompressed picture that lies in memory.
#include "MosaicFile.h"

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/ContentHash.h>

#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace
{

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct Options
{
    int side = 8192;
    int rounds = 5;
    std::vector<int> tiles{256, 128};
    std::string csv;
    bool perTile = false; ///< Also one process a tile, which takes minutes.
    bool quick = false;   ///< None of those that run once.
    bool help = false;
};

constexpr char Help[] =
    R"(TileStoreBenchmark [--side 8192] [--rounds 5] [--tile 256]... [--per-tile | --quick] [--csv FILE]
CPU and wall seconds and bytes of building a pyramid of JPEG tiles, quality 85, 4:2:0. --quick
leaves out what takes ten times as long, --per-tile adds what takes a hundred times as long.
)";

double cpuOfChildren()
{
    rusage use{};
    getrusage(RUSAGE_CHILDREN, &use);
    const auto seconds = [](const timeval& t)
    { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(use.ru_utime) + seconds(use.ru_stime);
}

/// Children inherit it.
void useCores(int count)
{
    cpu_set_t cores;
    CPU_ZERO(&cores);
    for (int core = 0; core < count; ++core)
        CPU_SET(core, &cores);
    sched_setaffinity(0, sizeof cores, &cores);
}

void run(const Words& words, const std::string& magick)
{
    support::ChildProcess process;
    process.arguments = words;
    process.environment = {{"VIPS_CONCURRENCY", "1"},
                           {"MAGICK_CONFIGURE_PATH", magick},
                           {"MAGICK_THREAD_LIMIT", "1"},
                           {"OMP_NUM_THREADS", "1"}};
    process.timeoutSeconds = 3600.0;
    const auto result = process.run();
    if (result.exitCode != 0)
        throw std::runtime_error(words[0] + " failed: " + result.errors);
}

std::uint64_t bytesBelow(const fs::path& path)
{
    if (!fs::is_directory(path))
        return fs::exists(path) ? fs::file_size(path) : 0;
    std::uint64_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(path))
        bytes += entry.is_regular_file() ? entry.file_size() : 0;
    return bytes;
}

/// A way to build the tiles into `<folder>/out`, which is there and empty.
struct Contender
{
    std::string name;
    int cores = 1;
    bool once = false;
    std::function<void()> build;
};

struct Measured
{
    std::vector<double> cpu, wall;
    std::uint64_t bytes = 0;
};

class Benchmark
{
public:
    explicit Benchmark(const Options& options) : _options(options)
    {
        const int photos = writeMosaic(_input, options.side);
        std::printf("%d x %d pixels of %d photographs in cells of 2048, repeated\n", options.side,
                    options.side, photos);
        osgPagedTexture::AtlasLayout layout;
        layout.width = layout.height = options.side;
        osgPagedTexture::AtlasPhoto photo;
        photo.path = "mosaic.ppm";
        photo.width = photo.height = options.side;
        photo.bytes = fs::file_size(_input);
        photo.hash = osgPagedTexture::hashText(photo.path).text();
        layout.photos.push_back(photo);
        osgPagedTexture::writeAtlasLayout(_layout, layout);
        // Debian's own limits refuse pictures of this size.
        _folder.write("policy.xml", "<policymap>\n"
                                    "<policy domain=\"resource\" name=\"memory\" value=\"8GiB\"/>\n"
                                    "<policy domain=\"resource\" name=\"width\" value=\"1MP\"/>\n"
                                    "<policy domain=\"resource\" name=\"height\" value=\"1MP\"/>\n"
                                    "<policy domain=\"resource\" name=\"area\" value=\"8GP\"/>\n"
                                    "</policymap>\n");
    }

    void measure(int tile)
    {
        const std::vector<Contender> contenders = makeContenders(tile);
        std::map<std::string, Measured> results;
        // Each round begins with another one, so that none always follows the same one.
        for (std::size_t round = 0; round < std::size_t(_options.rounds); ++round)
            for (std::size_t i = 0; i < contenders.size(); ++i)
            {
                const Contender& contender = contenders[(round + i) % contenders.size()];
                if (!contender.once || (round == 0 && !_options.quick))
                    measureOnce(contender, results[contender.name]);
            }
        report(tile, contenders, results);
    }

    std::string getCsv() const { return _csv.str(); }

private:
    Contender ours(int tile, const std::string& name, Words more, int cores = 1) const
    {
        Words words{OSGKITS_OSGTILESTORE,
                    "build",
                    _layout,
                    "--store",
                    _out + "/a.tiles",
                    "--border",
                    "0",
                    "--threads",
                    std::to_string(cores),
                    "--tile-side",
                    std::to_string(tile)};
        words.insert(words.end(), more.begin(), more.end());
        return {name, cores, false, [this, words]() { run(words, folder()); }};
    }

    std::vector<Contender> makeContenders(int tile) const
    {
        const std::string side = std::to_string(tile);
        const Words light{"--no-sync", "--not-updatable"};
        const Words plain{"--no-sync", "--not-updatable", "--filter", "plain"};
        std::vector<Contender> contenders{
            ours(tile, "osgtilestore plain box", plain),
            ours(tile, "osgtilestore", light),
            ours(tile, "osgtilestore synced and updatable", {}),
            ours(tile, "osgtilestore plain box two cores", plain, 2),
            {"vips tiffsave", 1, false,
             [=]()
             {
                 run({"vips", "tiffsave", _input, _out + "/a.tif", "--tile", "--pyramid",
                      "--compression", "jpeg", "--Q", "85", "--tile-width", side, "--tile-height",
                      side},
                     folder());
             }},
            {"vips dzsave", 1, false,
             [=]()
             {
                 run({"vips", "dzsave", _input, _out + "/a", "--suffix", ".jpg[Q=85]",
                      "--tile-size", side, "--overlap", "0"},
                     folder());
             }},
            {"maketx, not compressed", 1, true,
             [=]()
             {
                 run({"maketx", _input, "-o", _out + "/a.tx", "--tile", side, side, "--filter",
                      "box", "--threads", "1", "--compression", "none"},
                     folder());
             }},
            {"ImageMagick crop and halve", 1, true, [=]() { cropAndHalve(tile, false); }}};
        if (_options.perTile)
            contenders.push_back(
                {"one converter process a tile", 1, true, [=]() { cropAndHalve(tile, true); }});
        return contenders;
    }

    /// As LibVT's scripts do: tiles without compression, then a process for each.
    void cropAndHalve(int tile, bool perTile) const
    {
        const std::string size = std::to_string(tile) + "x" + std::to_string(tile);
        const std::string ending = perTile ? ".bmp" : ".jpg";
        std::string picture = _input;
        for (int side = _options.side, level = 0;; side = (side + 1) / 2, ++level)
        {
            const std::string tiles = _out + "/" + std::to_string(level);
            fs::create_directories(tiles);
            run({"convert-im6.q16", picture, "-crop", size, "+repage", "+adjoin", "-quality", "85",
                 "-sampling-factor", "2x2", tiles + "/tile_%d" + ending},
                folder());
            if (side <= tile)
                break;
            const std::string next = _folder.file("level" + std::to_string(level % 2) + ".ppm");
            run({"convert-im6.q16", picture, "-filter", "box", "-resize", "50%", next}, folder());
            picture = next;
        }
        if (!perTile)
            return;
        std::vector<std::string> tiles;
        for (const auto& entry : fs::recursive_directory_iterator(_out))
            if (entry.path().extension() == ".bmp")
                tiles.push_back(entry.path().string());
        for (const std::string& path : tiles)
        {
            run({"mogrify-im6.q16", "-format", "jpg", "-quality", "85", "-sampling-factor", "2x2",
                 path},
                folder());
            fs::remove(path);
        }
    }

    void measureOnce(const Contender& contender, Measured& measured) const
    {
        fs::remove_all(_out);
        fs::create_directories(_out);
        ::sync(); // what the one before has written is not for this one to wait for
        useCores(contender.cores);
        const double before = cpuOfChildren();
        const auto start = std::chrono::steady_clock::now();
        contender.build();
        measured.wall.push_back(
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        measured.cpu.push_back(cpuOfChildren() - before);
        measured.bytes = bytesBelow(_out);
        fs::remove_all(_out);
    }

    static double median(std::vector<double> values)
    {
        std::sort(values.begin(), values.end());
        return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2.0;
    }

    void report(int tile, const std::vector<Contender>& contenders,
                std::map<std::string, Measured>& results)
    {
        const Measured& ours = results[contenders[0].name];
        for (const Contender& contender : contenders)
        {
            const Measured& measured = results[contender.name];
            if (measured.cpu.empty())
                continue;
            // Of the same round each, so that a slow minute falls on both.
            std::vector<double> cpu, wall;
            for (std::size_t i = 0; i < measured.cpu.size(); ++i)
            {
                cpu.push_back(measured.cpu[i] / ours.cpu[i]);
                wall.push_back(measured.wall[i] / ours.wall[i]);
            }
            char line[256];
            std::snprintf(line, sizeof line, "%d,%d,%s,%.3f,%.3f,%.2f,%.2f,%llu,%zu\n",
                          _options.side, tile, contender.name.c_str(), median(measured.cpu),
                          median(measured.wall), median(cpu), median(wall),
                          static_cast<unsigned long long>(measured.bytes), measured.cpu.size());
            std::string name = contender.name;
            std::replace(name.begin(), name.end(), ',', ';');
            std::string text = line;
            text.replace(text.find(contender.name), name.size(), name);
            std::fputs(text.c_str(), stdout);
            std::fflush(stdout);
            _csv << text;
        }
    }

    std::string folder() const { return _folder.getPath().string(); }

    const Options _options;
    support::TemporaryFolder _folder;
    const std::string _input = _folder.file("mosaic.ppm"), _out = _folder.file("out"),
                      _layout = _folder.file("mosaic.layout.json");
    std::ostringstream _csv;
};

Options parse(const Words& words)
{
    Options options;
    bool tilesGiven = false;
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        const std::string next = i + 1 < words.size() ? words[i + 1] : "";
        if (words[i] == "--help")
            options.help = true;
        else if (words[i] == "--per-tile")
            options.perTile = true;
        else if (words[i] == "--quick")
            options.quick = true;
        else if (words[i] == "--csv" && !next.empty())
            options.csv = words[++i];
        else if (words[i] == "--tile" && std::atoi(next.c_str()) > 0)
        {
            if (!tilesGiven)
                options.tiles.clear();
            tilesGiven = true;
            options.tiles.push_back(std::atoi(words[++i].c_str()));
        }
        else if (words[i] == "--side" && std::atoi(next.c_str()) > 0)
            options.side = std::atoi(words[++i].c_str());
        else if (words[i] == "--rounds" && std::atoi(next.c_str()) > 0)
            options.rounds = std::atoi(words[++i].c_str());
        else
            throw std::runtime_error("bad option '" + words[i] + "'; see --help");
    }
    return options;
}

} // namespace

int main(int argc, char** argv)
{
    try
    {
        const Options options = parse({argv + 1, argv + argc});
        if (options.help)
            return std::fputs(Help, stdout) < 0;
        const std::string head =
            "side,tile,method,cpu_s,wall_s,cpu_ratio,wall_ratio,bytes,rounds\n";
        Benchmark benchmark(options);
        std::fputs(head.c_str(), stdout);
        for (const int tile : options.tiles)
            benchmark.measure(tile);
        if (!options.csv.empty())
            std::ofstream(options.csv) << head << benchmark.getCsv();
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "TileStoreBenchmark: %s\n", error.what());
        return 1;
    }
    return 0;
}
