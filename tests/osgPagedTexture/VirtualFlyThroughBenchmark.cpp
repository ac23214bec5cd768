// SPDX-License-Identifier: MIT
// A flight over one picture of 26,000 x 26,000 texels (2 GiB as RGB) that is paged into 128 MiB and
// less, against no texture and a plain one. Run by hand; prints tables.
#include "VirtualScenes.h"

#include <osgPagedTexture/FrameTimes.h>

#include <osg/Material>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <thread>

namespace
{

using namespace osgPagedTexture;

constexpr int Width = 640, Height = 360, Frames = 240;
constexpr double Ground = 1000.0; ///< Units of a side.

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point since)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - since).count();
}

/// A pattern whose detail ends at the texels of a level.
Pixels patternTile(const PixelRect& rect, int level, double side)
{
    Pixels tile(int(rect.width), int(rect.height), 3);
    const double scale = std::ldexp(1.0, level);
    for (int y = 0; y < tile.height; ++y)
        for (int x = 0; x < tile.width; ++x)
        {
            const double u = (double(rect.x) + x + 0.5) * scale / side;
            const double v = (double(rect.y) + y + 0.5) * scale / side;
            double sum[3] = {};
            // Each octave is left out where it is finer than two texels of the level.
            for (double wave = 8.0; wave * scale < side / 4.0; wave *= 2.7)
                for (int c = 0; c < 3; ++c)
                    sum[c] += std::sin(wave * 6.28 * (u + 0.3 * c) + std::sin(wave * 4.1 * v)) *
                              std::cos(wave * 6.1 * v + c);
            for (int c = 0; c < 3; ++c)
                tile.row(tile.height - 1 - y)[3 * x + c] =
                    std::uint8_t(std::clamp(127.5 + 26.0 * sum[c], 0.0, 255.0));
        }
    return tile;
}

/// A store of that pattern. The same few hundred tiles stand for all of a level: their bytes are as
/// many and as different as those of photographs, and painting them takes seconds, not minutes.
void buildPattern(const std::string& path, std::int64_t side, int tileSide)
{
    TileStoreSettings settings;
    settings.grid = TileGrid(side, side, tileSide, 4);
    TilePackWriter::Options options;
    options.durable = false;
    TilePackWriter writer(path, settings, options);
    for (int level = 0; level < settings.grid.getLevels(); ++level)
    {
        std::map<std::pair<int, int>, std::string> painted;
        for (std::int64_t y = 0; y < settings.grid.getRows(level); ++y)
            for (std::int64_t x = 0; x < settings.grid.getColumns(level); ++x)
            {
                std::string& bytes = painted[{int(x % 16), int(y % 16)}];
                if (bytes.empty())
                    bytes = virtuals::encodePng(patternTile(
                        settings.grid.getPixels({level, x % 16, y % 16}), level, double(side)));
                writer.put({level, x, y}, TileData::encoded(bytes));
            }
    }
    writer.commit();
}

support::CameraSpec cameraAt(int frame)
{
    const double t = 2.0 * 3.14159265 * frame / Frames;
    const osg::Vec3d eye(300.0 * std::cos(t), 300.0 * std::sin(2.0 * t),
                         12.0 + 8.0 * std::cos(3 * t));
    const osg::Vec3d ahead(-300.0 * std::sin(t), 600.0 * std::cos(2.0 * t), 0.0);
    return support::CameraSpec::perspective(eye, eye + ahead * 0.1 - osg::Vec3d(0, 0, 10.0),
                                            {0.0, 0.0, 1.0}, 55.0, double(Width) / Height, 0.5,
                                            3000.0);
}

class VirtualFlyThroughBenchmark : public testing::Test
{
protected:
    osg::ref_ptr<VirtualScene> makeScene(const std::string& settings, int tileSide = 128)
    {
        const std::string store = _folder.file("pattern" + std::to_string(tileSide));
        if (!std::filesystem::exists(store))
            buildPattern(store, 26000, tileSide);
        return virtuals::makeScene(
            virtuals::makeFloor(virtuals::makeVirtualTexture(store), float(Ground)),
            "compression=blocks,quality=fast,fade=0.25,watch=off," + settings, false);
    }

    FrameTimes fly(osg::Node* scene, const std::function<void(int)>& after = {}, int rounds = 2)
    {
        FrameTimes times;
        for (int frame = 0; frame < rounds * Frames; ++frame)
        {
            const Clock::time_point start = Clock::now();
            _viewer.render(scene, cameraAt(frame % Frames), Width, Height);
            times.add(milliseconds(start));
            if (after)
                after(frame);
        }
        return times;
    }

    static void print(const char* what, const FrameTimes& times)
    {
        std::printf("%-28s p50 %6.1f  p99 %6.1f  max %6.1f ms\n", what, times.getPercentile(50.0),
                    times.getPercentile(99.0), times.getLargest());
    }

    support::HeadlessViewer _viewer{{Width, Height}};
    support::TemporaryFolder _folder;
};

/// Mean difference of channels.
double errorOf(const osg::Image& a, const osg::Image& b)
{
    double sum = 0.0;
    for (int y = 0; y < a.t(); ++y)
        for (int x = 0; x < a.s(); ++x)
            for (unsigned int c = 0; c < 3; ++c)
                sum += std::abs(int(a.data(unsigned(x), unsigned(y))[c]) -
                                int(b.data(unsigned(x), unsigned(y))[c]));
    return sum / (3.0 * a.s() * a.t());
}

} // namespace

TEST_F(VirtualFlyThroughBenchmark, frameTimes)
{
    OSGKITS_NEED_GL(_viewer);
    const auto bare = virtuals::makeFloor(nullptr, float(Ground));
    print("untextured", fly(bare));
    const auto plain = virtuals::makeFloor(
        virtuals::makePlainTexture(virtuals::makeLevels(4096, 4096)), float(Ground));
    print("plain texture, 4096 x 4096", fly(plain));
    const auto scene = makeScene("gpu=128");
    double most = 0.0, sum = 0.0;
    print("virtual, 26000 x 26000",
          fly(scene,
              [&](int)
              {
                  const double pages = virtuals::countOf(*scene, "pages.uploadedThisFrame");
                  most = std::max(most, pages);
                  sum += pages;
              }));
    std::printf("pages a frame: mean %.2f, most %.0f; needed %.0f of %.0f slots\n",
                sum / (2 * Frames), most, virtuals::countOf(*scene, "pages.needed"),
                virtuals::countOf(*scene, "pages.slots"));
    for (int i = 0; i < 30; ++i)
        _viewer.render(scene, cameraAt(0), Width, Height);
    print("virtual, at rest",
          [&]
          {
              FrameTimes times;
              for (int i = 0; i < 100; ++i)
              {
                  const Clock::time_point start = Clock::now();
                  _viewer.render(scene, cameraAt(0), Width, Height);
                  times.add(milliseconds(start));
              }
              return times;
          }());
}

// What a frame at rest costs where the camera looks along the ground, interleaved.
TEST_F(VirtualFlyThroughBenchmark, costOfSamplingAtRest)
{
    OSGKITS_NEED_GL(_viewer);
    struct Candidate
    {
        std::string name;
        osg::ref_ptr<osg::Node> scene;
        FrameTimes times{};
    };
    std::vector<Candidate> candidates;
    candidates.push_back({"untextured", virtuals::makeFloor(nullptr, float(Ground)), FrameTimes()});
    const auto levels = virtuals::makeLevels(4096, 4096);
    for (const float taps : {1.0f, 4.0f, 16.0f})
    {
        const auto texture = virtuals::makePlainTexture(levels);
        texture->setMaxAnisotropy(taps);
        candidates.push_back({"plain, " + std::to_string(int(taps)) + " taps",
                              virtuals::makeFloor(texture, float(Ground)),
                              {}});
    }
    for (const char* const settings :
         {"compression=none,aniso=1", "compression=none,aniso=4", "compression=none,aniso=16",
          "aniso=1", "aniso=4", "aniso=16"})
        candidates.push_back(
            {settings, makeScene(std::string("gpu=128,") + settings), FrameTimes()});
    for (Candidate& candidate : candidates)
    {
        for (int i = 0; i < 200; ++i)
        {
            _viewer.render(candidate.scene, cameraAt(0), Width, Height);
            const auto* scene = dynamic_cast<const VirtualScene*>(candidate.scene.get());
            if (!scene || (i > 20 && virtuals::countOf(*scene, "feedback") == 0.0 &&
                           virtuals::countOf(*scene, "pages.missing") == 0.0))
                break;
        }
    }
    for (int round = 0; round < 15; ++round)
        for (Candidate& candidate : candidates)
        {
            const Clock::time_point start = Clock::now();
            _viewer.render(candidate.scene, cameraAt(0), Width, Height);
            candidate.times.add(milliseconds(start));
        }
    const double bare = candidates.front().times.getPercentile(50.0);
    for (const Candidate& candidate : candidates)
        std::printf("%-28s %6.1f ms, %5.1f ns a pixel more than untextured\n",
                    candidate.name.c_str(), candidate.times.getPercentile(50.0),
                    (candidate.times.getPercentile(50.0) - bare) * 1e6 / (Width * Height));
}

TEST_F(VirtualFlyThroughBenchmark, timeUntilSharpAfterAJump)
{
    OSGKITS_NEED_GL(_viewer);
    const auto scene = makeScene("gpu=32,cpu=16");
    for (int jump = 0; jump < 8; ++jump)
    {
        const support::CameraSpec camera = cameraAt(jump * 37 % Frames);
        const Clock::time_point start = Clock::now();
        int frames = 0;
        do
        {
            _viewer.render(scene, camera, Width, Height);
            ++frames;
        } while ((frames < 4 || virtuals::countOf(*scene, "pages.missing") > 0.0) && frames < 500);
        std::printf("jump %d: sharp after %.0f ms, %d frames, %.0f pages needed\n", jump,
                    milliseconds(start), frames, virtuals::countOf(*scene, "pages.needed"));
    }
}

TEST_F(VirtualFlyThroughBenchmark, errorOverBudgetFeedbackAndPageSize)
{
    OSGKITS_NEED_GL(_viewer);
    const auto run = [&](const std::string& settings, int tileSide)
    {
        const auto truth = makeScene("gpu=256,wait=on", tileSide);
        const auto scene = makeScene(settings, tileSide);
        double error = 0.0;
        int compared = 0;
        std::vector<osg::ref_ptr<osg::Image>> pictures;
        const Clock::time_point start = Clock::now();
        for (int frame = 0; frame < Frames; ++frame)
        {
            const auto picture = _viewer.render(scene, cameraAt(frame), Width, Height);
            if (frame % 24 == 12)
                pictures.push_back(picture);
        }
        const double time = milliseconds(start) / Frames;
        for (int frame = 12; frame < Frames; frame += 24)
            error += errorOf(*_viewer.render(truth, cameraAt(frame), Width, Height),
                             *pictures[std::size_t(compared++)]);
        std::printf("%-32s tiles %3d: mean error %5.2f of 255, %5.1f ms a frame\n",
                    settings.c_str(), tileSide, error / compared, time);
    };
    for (const char* const budget : {"gpu=2", "gpu=8", "gpu=32", "gpu=128"})
        run(budget, 128);
    for (const char* const feedback :
         {"gpu=32,feedback=2", "gpu=32,feedback=4", "gpu=32,feedback=16", "gpu=32,feedback=32"})
        run(feedback, 128);
    for (const int side : {64, 256})
        run("gpu=32", side);
}

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
