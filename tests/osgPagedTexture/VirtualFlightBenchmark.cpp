// SPDX-License-Identifier: MIT
// A flight over a plane with a virtual texture, in real time but without graphics: what is asked
// for, how much of it is there, and how long a jump stays blurred, over budget, page side and size
// of the feedback picture.
//
//   osgPagedTexture.VirtualFlightBenchmark [--side TEXELS] [--seconds S] [--jumps N]
//       [--budgets MiB,...] [--pages SIDE,...] [--reductions N,...] [--upload KiB] [--format BC1]
//
// The store has JPEG tiles of quality 85 and is made anew, in the temporary folder: about 0.7 bytes
// a texel. A frame takes 1/60 s, as on a machine whose time is spent elsewhere; where the computing
// of the feedback picture takes longer, the flight is slower and the column "frame" says it.
//
// Columns: MiB of slots, page side, feedback 1/n; pages needed a frame and the bias, on average;
// pixels whose page is there, and levels that pixels lack on average, both over the flight; pages
// uploaded a frame on average and at most; pages that came from memory; CPU ms of advance() and
// takeUploads() on average and at most; worker threads' load; ms of a frame; seconds from a jump
// until all is sharp, median and most.
#include "PictureFiles.h"
#include "PlaneFlight.h"

#include <osgPagedTexture/ThreadClock.h>
#include <osgPagedTexture/TilePack.h>
#include <osgPagedTexture/VirtualPager.h>

#include <support/TemporaryFolder.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <thread>

using namespace osgPagedTexture;

namespace
{

using Clock = std::chrono::steady_clock;

struct Options
{
    std::int64_t side = 16384;
    double seconds = 20.0;
    int jumps = 12;
    std::vector<int> budgets{16, 32, 64, 128};
    std::vector<int> pages{128};
    std::vector<int> reductions{8};
    int uploadKiB = 512;
    BlockFormat format = BlockFormat::BC1;
};

struct Case
{
    int budget = 0;
    int page = 0;
    int reduction = 0;
};

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Tiles of the sides that photographs have, out of 64 different ones.
void buildStore(const std::string& path, std::int64_t side, int page)
{
    TileStoreSettings settings;
    settings.grid = TileGrid(side, side, page, 4);
    std::vector<std::string> tiles;
    for (unsigned int i = 0; i < 64; ++i)
    {
        JpegOptions options;
        options.quality = 85;
        options.fullChroma = false;
        tiles.push_back(encodeJpeg(samplePicture(page, page, 3, i + 1), options));
    }
    TilePackWriter::Options options;
    options.durable = false;
    TilePackWriter writer(path, settings, options);
    std::size_t next = 0;
    for (int level = 0; level < settings.grid.getLevels(); ++level)
    {
        for (std::int64_t y = 0; y < settings.grid.getRows(level); ++y)
        {
            for (std::int64_t x = 0; x < settings.grid.getColumns(level); ++x)
            {
                writer.put({level, x, y}, TileData::encoded(tiles[next++ % tiles.size()]));
            }
        }
    }
    writer.commit();
}

/// The page table as a context has it.
class Tables
{
public:
    void apply(const PageUploads& uploads)
    {
        for (const TablePatch& patch : uploads.tables)
        {
            if (patch.layout)
            {
                _layout = *patch.layout;
                _entries.resize(std::size_t(_layout.width) * _layout.height);
            }
            for (int y = 0; y < patch.rect.height; ++y)
            {
                std::copy_n(patch.entries.begin() + std::ptrdiff_t(y) * patch.rect.width,
                            patch.rect.width,
                            _entries.begin() + std::ptrdiff_t(patch.rect.y + y) * _layout.width +
                                patch.rect.x);
            }
        }
    }
    int levelAt(const PageKey& page) const
    {
        if (_entries.empty())
        {
            return 30;
        }
        const PageKey held = page.ancestor(std::max(0, _layout.finest - page.level));
        const PageTableLayout::Level& place = _layout.at(held.level);
        return PageEntry::levelOf(
            _entries[std::size_t(place.y + held.y) * _layout.width + place.x + held.x]);
    }

private:
    PageTableLayout _layout;
    std::vector<std::uint32_t> _entries;
};

struct Sum
{
    double total = 0.0, most = 0.0;
    std::size_t count = 0;
    void add(double value)
    {
        total += value;
        most = std::max(most, value);
        ++count;
    }
    double mean() const { return count == 0 ? 0.0 : total / double(count); }
};

class Flight
{
public:
    Flight(const Options& options, const Case& task, const std::string& store)
        : _options(options), _task(task), _pager(settingsOf(options, task)),
          _texture(_pager.addTexture(store)), _view(_pager.getGrid(_texture), 8.0)
    {
    }

    void fly()
    {
        const Clock::time_point start = Clock::now();
        const int frames = int(_options.seconds * 60.0);
        for (int i = 0; i < frames; ++i)
        {
            frame(cameraAt(i / 60.0));
            lookAt(cameraAt(i / 60.0));
        }
        _frameTime = 1000.0 * secondsSince(start) / frames;
        _load = _pager.getStatistics().workerSeconds / secondsSince(start);
    }

    void jump()
    {
        for (int i = 0; i < _options.jumps; ++i)
        {
            const PlaneCamera camera = cameraAt(1000.0 + 17.0 * i);
            const Clock::time_point start = Clock::now();
            int still = 0;
            double sharp = 0.0;
            // The feedback picture sees other pixels each time: sharp is what stays so.
            while (still < 8 && secondsSince(start) < 30.0)
            {
                frame(camera);
                still = _pager.isAtRest() ? still + 1 : 0;
                sharp = still == 1 ? secondsSince(start) : sharp;
            }
            _sharp.push_back(sharp);
        }
        std::sort(_sharp.begin(), _sharp.end());
    }

    void print()
    {
        const VirtualPagerStatistics statistics = _pager.getStatistics();
        const double asked = double(statistics.cacheHits + statistics.cacheMisses);
        std::printf("%5d %5d  1/%-2d %7.0f %5.2f  %6.2f%% %6.3f  %6.1f %5.0f  %5.1f%%  %5.2f %5.1f "
                    " %5.2f %5.1f  %5.2f %5.2f\n",
                    _task.budget, _task.page, _task.reduction, _needed.mean(), _bias.mean(),
                    100.0 * _there.mean(), _lack.mean(), _uploads.mean(), _uploads.most,
                    asked > 0 ? 100.0 * double(statistics.cacheHits) / asked : 0.0, _work.mean(),
                    _work.most, _load, _frameTime, _sharp[_sharp.size() / 2], _sharp.back());
        std::fflush(stdout);
    }

private:
    static VirtualPagerSettings settingsOf(const Options& options, const Case& task)
    {
        VirtualPagerSettings settings;
        settings.format = options.format;
        const std::uint64_t page = levelBytes(options.format, task.page, task.page);
        settings.slots = int((std::uint64_t(task.budget) << 20) / page);
        settings.watchSeconds = 0.0;
        return settings;
    }

    void frame(const PlaneCamera& camera)
    {
        const Clock::time_point start = Clock::now();
        _pager.report(0, _view.feedback(camera, _task.reduction, _random));
        const double work = threadMilliseconds();
        _pager.advance(++_frame);
        const PageUploads uploads = _pager.takeUploads(0, std::uint64_t(_options.uploadKiB) << 10);
        _work.add(threadMilliseconds() - work);
        _tables.apply(uploads);
        _uploads.add(double(uploads.pages.size()));
        const VirtualPagerStatistics statistics = _pager.getStatistics();
        _needed.add(double(statistics.neededPages));
        _bias.add(statistics.bias);
        std::this_thread::sleep_until(start + std::chrono::microseconds(16667));
    }

    /// Whether what pixels of the picture want is there, whatever the feedback picture saw.
    void lookAt(const PlaneCamera& camera)
    {
        for (int i = 0; i < 2000; ++i)
        {
            if (const auto want = _view.at(camera, _random() % PlaneView::Width + 0.5,
                                           _random() % PlaneView::Height + 0.5))
            {
                const int lack = _tables.levelAt(want->page) - want->page.level;
                _there.add(lack <= 0);
                _lack.add(std::clamp(lack, 0, 10));
            }
        }
    }

    const Options& _options;
    const Case _task;
    VirtualPager _pager;
    const std::uint32_t _texture;
    const PlaneView _view;
    Tables _tables;
    std::mt19937 _random{1};
    unsigned int _frame = 0;
    Sum _needed, _bias, _there, _lack, _uploads, _work;
    double _load = 0.0, _frameTime = 0.0;
    std::vector<double> _sharp;
};

std::vector<int> numbersOf(const std::string& text)
{
    std::vector<int> numbers;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, ',');)
    {
        numbers.push_back(std::max(1, std::atoi(part.c_str())));
    }
    return numbers;
}

bool readOptions(int argc, char** argv, Options& options)
{
    for (int i = 1; i + 1 < argc; i += 2)
    {
        const std::string name = argv[i], value = argv[i + 1];
        if (name == "--side")
            options.side = std::max(256, std::atoi(value.c_str()));
        else if (name == "--seconds")
            options.seconds = std::atof(value.c_str());
        else if (name == "--jumps")
            options.jumps = std::max(1, std::atoi(value.c_str()));
        else if (name == "--budgets")
            options.budgets = numbersOf(value);
        else if (name == "--pages")
            options.pages = numbersOf(value);
        else if (name == "--reductions")
            options.reductions = numbersOf(value);
        else if (name == "--upload")
            options.uploadKiB = std::max(1, std::atoi(value.c_str()));
        else if (name == "--format")
            options.format = value == "BC7"     ? BlockFormat::BC7
                             : value == "RGBA8" ? BlockFormat::RGBA8
                                                : BlockFormat::BC1;
        else
            return false;
    }
    return argc % 2 == 1;
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    if (!readOptions(argc, argv, options))
    {
        std::fprintf(stderr, "options stand at the top of VirtualFlightBenchmark.cpp\n");
        return 1;
    }
    const support::TemporaryFolder folder;
    std::printf("  MiB  page  feed  needed  bias   there   lack  pages  most   memory  work  most  "
                " load frame  sharp  most\n");
    for (const int page : options.pages)
    {
        const std::string store = folder.file("flight" + std::to_string(page) + ".tiles");
        buildStore(store, options.side, page);
        for (const int budget : options.budgets)
        {
            for (const int reduction : options.reductions)
            {
                Flight flight(options, {budget, page, reduction}, store);
                flight.fly();
                flight.jump();
                flight.print();
            }
        }
    }
    return 0;
}
