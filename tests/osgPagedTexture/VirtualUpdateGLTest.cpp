// SPDX-License-Identifier: MIT
// Stores that change while they are shown: each frame is looked at.
#include "VirtualScenes.h"

#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace
{

namespace fs = std::filesystem;
using namespace osgPagedTexture;

constexpr int Side = 1024;
const TileColor Red{230, 20, 20, 255}, Blue{20, 20, 230, 255};

support::CameraSpec lookFrom(const osg::Vec3d& eye)
{
    return support::CameraSpec::perspective(eye, {eye.x(), 0.0, 0.0}, {0.0, 1.0, 0.0}, 50.0,
                                            4.0 / 3.0, 0.01, 1e4);
}

struct Shown
{
    unsigned int red = 0, blue = 0, other = 0;
};

/// What a picture shows of the two colours; the background is neither.
Shown shownIn(const osg::Image& image)
{
    Shown shown;
    for (int y = 0; y < image.t(); ++y)
        for (int x = 0; x < image.s(); ++x)
        {
            const unsigned char* pixel = image.data(unsigned(x), unsigned(y));
            if (pixel[0] > 200 && pixel[2] < 60)
                ++shown.red;
            else if (pixel[2] > 200 && pixel[0] < 60)
                ++shown.blue;
            else if (pixel[1] < 40) // red and blue in one pixel; the background is greener
                ++shown.other;
        }
    return shown;
}

class VirtualUpdateGLTest : public testing::Test
{
protected:
    VirtualUpdateGLTest() { virtuals::buildStore(_store, virtuals::makePlain(Side, Side, Red)); }

    void paint(const TileColor& color)
    {
        TilePackWriter writer(_store, TilePackWriter::Options{});
        virtuals::writeTiles(writer, TileGrid(Side, Side, 64, 2),
                             virtuals::makePlain(Side, Side, color));
    }

    osg::ref_ptr<VirtualScene> makeScene(const std::string& settings)
    {
        return virtuals::makeScene(virtuals::makeFloor(virtuals::makeVirtualTexture(_store), 10.0f),
                                   settings, false);
    }

    /// Draws until the picture is blue alone; each frame has to be of one colour. Returns how many
    /// frames that took. The camera moves as said.
    int lookAtFrames(VirtualScene& scene, double speed)
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(40);
        for (int frame = 0; std::chrono::steady_clock::now() < end; ++frame)
        {
            const auto image =
                _viewer.render(&scene, lookFrom({speed * double(frame % 40), 0.0, 4.0}), 160, 120);
            const Shown shown = shownIn(*image);
            EXPECT_TRUE(shown.red == 0 || shown.blue == 0)
                << "frame " << frame << ": " << shown.red << " red, " << shown.blue << " blue";
            EXPECT_EQ(shown.other, 0u) << "frame " << frame;
            if (testing::Test::HasFailure())
            {
                support::writeImage(*image, "virtual.mixed");
                return frame;
            }
            if (shown.blue > 0)
                return frame;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        ADD_FAILURE() << "the change is never shown";
        return -1;
    }

    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
    const std::string _store = _folder.file("atlas");
};

} // namespace

TEST_F(VirtualUpdateGLTest, noFrameMixesOldAndNewPagesAtRest)
{
    OSGKITS_NEED_GL(_viewer);
    const auto scene = makeScene("watch=off");
    virtuals::settle(_viewer, *scene, scene, lookFrom({0.0, 0.0, 4.0}), 160, 120);
    paint(Blue);
    EXPECT_GT(shownIn(*_viewer.render(scene, lookFrom({0.0, 0.0, 4.0}), 160, 120)).red, 0u);
    scene->reload();
    RecordProperty("frames", lookAtFrames(*scene, 0.0));
}

TEST_F(VirtualUpdateGLTest, noFrameMixesOldAndNewPagesWhileTheCameraMoves)
{
    OSGKITS_NEED_GL(_viewer);
    // 0.01 ms: uploads trickle in. The last one: few slots, replaced in place.
    for (const char* const settings :
         {"watch=off", "watch=off,upload=0.01", "watch=off,fade=0.3", "watch=off,gpu=0.6"})
    {
        paint(Red);
        const auto scene = makeScene(settings);
        virtuals::settle(_viewer, *scene, scene, lookFrom({0.0, 0.0, 4.0}), 160, 120);
        paint(Blue);
        scene->reload();
        RecordProperty(std::string("frames.") + settings, lookAtFrames(*scene, 0.02));
    }
}

TEST_F(VirtualUpdateGLTest, farAwayWhereOnePageIsTooFineTheChangeShowsToo)
{
    OSGKITS_NEED_GL(_viewer);
    const auto scene = makeScene("watch=off");
    const auto camera = lookFrom({0.0, 0.0, 500.0});
    EXPECT_GT(shownIn(*virtuals::settle(_viewer, *scene, scene, camera, 160, 120)).red, 0u);
    paint(Blue);
    scene->reload();
    EXPECT_GT(shownIn(*virtuals::settle(_viewer, *scene, scene, camera, 160, 120)).blue, 0u);
}

TEST_F(VirtualUpdateGLTest, anotherProcesssCommitShowsByItself)
{
    OSGKITS_NEED_GL(_viewer);
    const auto scene = makeScene("");
    virtuals::settle(_viewer, *scene, scene, lookFrom({0.0, 0.0, 4.0}), 160, 120);
    paint(Blue);
    lookAtFrames(*scene, 0.0);
}

TEST_F(VirtualUpdateGLTest, aStoreThatIsDeletedOrTruncatedKeepsItsPicture)
{
    OSGKITS_NEED_GL(_viewer);
    const auto scene = makeScene("watch=on");
    const auto camera = lookFrom({0.0, 0.0, 4.0});
    virtuals::settle(_viewer, *scene, scene, camera, 160, 120);
    fs::resize_file(_store, fs::file_size(_store) / 3);
    scene->reload();
    const auto lookAround = [&]
    {
        for (int frame = 0; frame < 60; ++frame)
        {
            const auto image = _viewer.render(scene, lookFrom({0.01 * frame, 0.0, 4.0}), 160, 120);
            ASSERT_GT(shownIn(*image).red, 10000u);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    };
    lookAround();
    fs::remove(_store);
    scene->reload();
    lookAround();
    // Back again, it is taken up.
    virtuals::buildStore(_store, virtuals::makePlain(Side, Side, Blue));
    scene->reload();
    lookAtFrames(*scene, 0.0);
    EXPECT_FALSE(_notes.takeWarnings().empty());
}

TEST_F(VirtualUpdateGLTest, aDamagedTileShowsTheCoarserPageAndIsNamedOnce)
{
    OSGKITS_NEED_GL(_viewer);
    {
        // In the middle of the picture.
        TilePackWriter writer(_store, TilePackWriter::Options{});
        for (int y = 7; y < 10; ++y)
            for (int x = 7; x < 10; ++x)
                writer.put({0, x, y}, TileData::encoded("no picture"));
        writer.commit();
    }
    const auto scene = makeScene("watch=off");
    for (const double height : {0.5, 2.0, 0.5})
    {
        const auto image =
            virtuals::settle(_viewer, *scene, scene, lookFrom({0.0, 0.0, height}), 160, 120);
        EXPECT_EQ(shownIn(*image).red, 160u * 120u);
    }
    const support::NotifyCapture::Lines warnings = _notes.takeWarnings();
    ASSERT_GE(warnings.size(), 1u);
    EXPECT_LE(warnings.size(), 9u) << "a tile is named more than once";
    EXPECT_NE(warnings[0].find("tile"), std::string::npos) << warnings[0];
}

TEST_F(VirtualUpdateGLTest, aStoreThatIsMissingIsNamedAndTheModelDrawn)
{
    OSGKITS_NEED_GL(_viewer);
    const auto scene = virtuals::makeScene(
        virtuals::makeFloor(virtuals::makeVirtualTexture(_folder.file("nothing")), 10.0f), "",
        false);
    const auto image =
        virtuals::settle(_viewer, *scene, scene, lookFrom({0.0, 0.0, 4.0}), 160, 120);
    EXPECT_EQ(image->data(80, 60)[0], 128);
    const support::NotifyCapture::Lines warnings = _notes.takeWarnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("nothing'"), std::string::npos) << warnings[0];
}
