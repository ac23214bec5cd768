// SPDX-License-Identifier: MIT
#include "PagedScenes.h"

#include <support/NotifyCapture.h>

#include <osgPagedTexture/PagedOptions.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

using osgPagedTexture::PagedScene;

namespace
{

/// OSGKITS_FLY_SECONDS of the environment: long flights are for sanitizers.
double flySeconds()
{
    const char* text = std::getenv("OSGKITS_FLY_SECONDS");
    return text ? std::atof(text) : 4.0;
}

class RandomFlyGLTest : public testing::Test
{
protected:
    /// Something that users do: settings, files that change, break, vanish, come back.
    void disturb(PagedScene& scene)
    {
        const std::string file = _folder.file("house" + std::to_string(_random() % 24) + ".png");
        const char* const settings[] = {"gpu='0.1'",     "gpu='4'",       "upload='0.1'",
                                        "show='levels'", "graph='on'",    "freeze='on'",
                                        "prefetch='0'",  "preview='4'",   "prefetch='2'",
                                        "upload='4'",    "show='picture'"};
        switch (_random() % 5)
        {
        case 0:
            scene.setSettingsText(std::string(settings[_random() % 11]) + ",cache='" +
                                  _folder.file("cache") + "'");
            break;
        case 1:
            paged::writePicture(_folder, std::filesystem::path(file).filename(),
                                32 << _random() % 4, 64, 1 + int(_random() % 4),
                                unsigned(_random()));
            break;
        case 2:
            std::filesystem::remove(file);
            break;
        case 3:
            std::ofstream(file) << "no picture";
            break;
        default:
            scene.getPlans();
        }
    }

    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
    std::mt19937 _random{7};
};

} // namespace

TEST_F(RandomFlyGLTest, whateverHappensOnTheWayMemoryStaysWithinItsBudget)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 6, 4, 256);
    const auto start = std::chrono::steady_clock::now();
    osg::Vec3d eye, velocity;
    int frames = 0, scenes = 0;
    while (std::chrono::steady_clock::now() - start < std::chrono::duration<double>(flySeconds()))
    {
        ++scenes;
        for (int house = 0; house < 24; ++house)
            paged::writePicture(_folder, "house" + std::to_string(house) + ".png", 256, 256, 3,
                                unsigned(house));
        const osg::ref_ptr<PagedScene> scene =
            paged::read(city, "gpu=1,cpu=8,cache=" + _folder.file("cache"));
        const int last = frames + 20 + int(_random() % 200);
        for (; frames < last; ++frames)
        {
            for (int c = 0; c < 3; ++c)
                velocity[c] = 0.9 * velocity[c] + double(_random() % 201) / 1000.0 - 0.1;
            eye += velocity;
            eye = osg::Vec3d(std::clamp(eye.x(), -6.0, 6.0), std::clamp(eye.y(), -30.0, 50.0),
                             std::clamp(eye.z(), -2.0, 10.0));
            _viewer.render(scene, paged::lookAlong(eye), 128, 96);
            if (_random() % 10 == 0)
                disturb(*scene);
            // 4 MiB at most, and one page of 256 x 256.
            ASSERT_LE(scene->getStatistics().upload.peakBytes, (4u << 20) + 350000u);
        }
    }
    EXPECT_GT(frames, 20);
    RecordProperty("frames", frames);
    RecordProperty("scenes", scenes);
    _notes.takeWarnings(); // Broken files are named.
}
