// SPDX-License-Identifier: MIT
// A flight over one picture of 26,000 x 26,000 texels (2 GiB as RGB) that is paged into 128 MiB and
// less, against no texture and a plain one. Run by hand; prints tables.
#include "FlightGround.h"

#include <osgPagedTexture/FrameTimes.h>

#include <support/CompareImage.h>

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

constexpr int Width = 640, Height = 360;
using flight::Frames;
using flight::Ground;

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point since)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - since).count();
}

class VirtualFlyThroughBenchmark : public testing::Test
{
protected:
    osg::ref_ptr<VirtualScene> makeScene(const std::string& settings, int tileSide = 128)
    {
        const std::string store = _folder.file("pattern" + std::to_string(tileSide));
        if (!std::filesystem::exists(store))
            flight::buildGround(store, 26000, tileSide);
        return virtuals::makeScene(
            virtuals::makeFloor(virtuals::makeVirtualTexture(store), float(Ground)),
            "compression=blocks,quality=fast,fade=0.25,watch=off," + settings, false);
    }

    FrameTimes fly(osg::Node* scene, const std::function<void(int)>& after = {}, int rounds = 2)
    {
        FrameTimes times = FrameTimes();
        for (int frame = 0; frame < rounds * Frames; ++frame)
        {
            const Clock::time_point start = Clock::now();
            _viewer.render(scene, flight::cameraAt(frame % Frames), Width, Height);
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
        _viewer.render(scene, flight::cameraAt(0), Width, Height);
    print("virtual, at rest",
          [&]
          {
              FrameTimes times = FrameTimes();
              for (int i = 0; i < 100; ++i)
              {
                  const Clock::time_point start = Clock::now();
                  _viewer.render(scene, flight::cameraAt(0), Width, Height);
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
        FrameTimes times = FrameTimes();
    };
    std::vector<Candidate> candidates;
    candidates.push_back({"untextured", virtuals::makeFloor(nullptr, float(Ground)), FrameTimes()});
    const auto levels = virtuals::makeLevels(4096, 4096);
    for (const float taps : {1.0f, 4.0f, 16.0f})
    {
        const auto texture = virtuals::makePlainTexture(levels);
        texture->setMaxAnisotropy(taps);
        candidates.push_back({"plain, " + std::to_string(int(taps)) + " taps",
                              virtuals::makeFloor(texture, float(Ground)), FrameTimes()});
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
            _viewer.render(candidate.scene, flight::cameraAt(0), Width, Height);
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
            _viewer.render(candidate.scene, flight::cameraAt(0), Width, Height);
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
        const support::CameraSpec camera = flight::cameraAt(jump * 37 % Frames);
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

// A photograph in the middle of the view is saved again and again.
TEST_F(VirtualFlyThroughBenchmark, framesUntilAnUpdateShows)
{
    OSGKITS_NEED_GL(_viewer);
    const auto scene = makeScene("gpu=128");
    const support::CameraSpec camera = flight::cameraAt(0);
    virtuals::settle(_viewer, *scene, scene, camera, Width, Height);
    const auto side = std::int64_t(26000);
    const auto texel = [&](double place) { return std::int64_t(place * double(side) / Ground); };
    // In front of the eye, whose place is (300, 0); the first row of a store lies at the far end.
    const PixelRect photograph{texel(Ground / 2.0 + 250.0), texel(Ground / 2.0 - 120.0), 2600,
                               2600};
    for (int round = 0; round < 6; ++round)
    {
        const auto before = _viewer.render(scene, camera, Width, Height);
        const auto shade = std::uint8_t(40 * round);
        flight::paintGround(_folder.file("pattern128"), photograph, {shade, 255, shade, 255});
        const double uploaded = virtuals::countOf(*scene, "pages.uploaded");
        const Clock::time_point start = Clock::now();
        scene->reload();
        int frames = 0;
        double share = 0.0;
        for (; share == 0.0 && frames < 500; ++frames)
        {
            std::this_thread::sleep_until(start + frames * std::chrono::milliseconds(33));
            const auto shown = _viewer.render(scene, camera, Width, Height);
            share = support::difference(*shown, *before, 16.0 / 255.0).getShareOver();
        }
        std::printf(
            "update %d: shown in frame %d, after %.0f ms, %.0f pages, %.0f %% of the view\n", round,
            frames, milliseconds(start), virtuals::countOf(*scene, "pages.uploaded") - uploaded,
            100.0 * share);
    }
}

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
