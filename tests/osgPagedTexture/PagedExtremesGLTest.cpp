// SPDX-License-Identifier: MIT
#include "PagedScenes.h"
#include "PictureFiles.h"

#include <support/CompareImage.h>
#include <support/NotifyCapture.h>
#include <support/ResidentMemory.h>

#include <osg/Material>

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <sys/resource.h>

using osgPagedTexture::PagedScene;
using osgPagedTexture::Pixels;

namespace
{

const support::CompareImage Exact{0.0, 0.0, 0.0};

class PagedExtremesGLTest : public testing::Test
{
protected:
    /// Shows a grey picture of a ramp along its longer side.
    osg::ref_ptr<osg::Image> showRamp(int width, int height, const std::string& settings)
    {
        Pixels ramp(width, height, 1);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                ramp.row(y)[x] = static_cast<unsigned char>(width > height ? x * 256LL / width
                                                                           : y * 256LL / height);
        _folder.write("ramp.jpg", encodeJpeg(ramp));
        ramp = Pixels();
        _scene = paged::read(paged::writeSquare(_folder, _folder.file("ramp.jpg")), settings);
        return paged::settle(_viewer, *_scene, paged::lookAlong());
    }

    static float red(const osg::Image& picture, unsigned int x, unsigned int y)
    {
        return picture.getColor(x, y).r();
    }

    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
    osg::ref_ptr<PagedScene> _scene;
};

} // namespace

TEST_F(PagedExtremesGLTest, picturesOfOneColumnAndOneRowAreShown)
{
    OSGKITS_NEED_GL(_viewer);
    // The square reaches from 96 to 224 pixels along x and from 56 to 184 along y.
    const auto column = showRamp(1, 16384, "");
    EXPECT_NEAR(red(*column, 160, 120), 0.5f, 0.03f);
    EXPECT_NEAR(red(*column, 160, 150) - red(*column, 160, 90), 60.0f / 128.0f, 0.05f);
    const auto row = showRamp(16384, 1, "");
    EXPECT_NEAR(red(*row, 160, 120), 0.5f, 0.03f);
    EXPECT_NEAR(red(*row, 190, 120) - red(*row, 130, 120), 60.0f / 128.0f, 0.05f);
}

TEST_F(PagedExtremesGLTest, aPictureOf16384TexelsASideIsShownWithinSmallBudgets)
{
    OSGKITS_NEED_GL(_viewer);
    const auto shown = showRamp(16384, 16384, "gpu=1,cpu=64");
    EXPECT_NEAR(red(*shown, 160, 120), 0.5f, 0.03f);
    EXPECT_LE(paged::countOf(*_scene, "gpu.bytes.peak"), 1048576.0);
    EXPECT_LE(paged::countOf(*_scene, "cpu.bytes.peak"), 64.0 * 1048576.0);
    EXPECT_EQ(paged::countOf(*_scene, "levels.missing"), 0.0);
}

TEST_F(PagedExtremesGLTest, withoutAWritableCacheThePictureIsTheSameAndTheCauseIsNamedOnce)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 2, 2, 128);
    const osg::ref_ptr<PagedScene> plain = paged::read(city);
    const auto expected = paged::settle(_viewer, *plain, paged::lookAlong());
    EXPECT_TRUE(_notes.takeWarnings().empty());
    const osg::ref_ptr<PagedScene> scene = paged::read(city, "cache=/proc/osgkits/cache");
    EXPECT_TRUE(
        Exact(paged::settle(_viewer, *scene, paged::lookAlong()), expected, "paged.readonly"));
    const support::NotifyCapture::Lines warnings = _notes.takeWarnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("/proc/osgkits/cache"), std::string::npos) << warnings[0];
}

TEST_F(PagedExtremesGLTest, withAFullDiskThePictureIsTheSameAndTheCauseIsNamedOnce)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 2, 2, 128);
    const osg::ref_ptr<PagedScene> plain = paged::read(city);
    const auto expected = paged::settle(_viewer, *plain, paged::lookAlong());
    const std::string cache = _folder.file("cache");
    // No file of this process may grow beyond 1000 bytes.
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit low{1000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &low);
    const osg::ref_ptr<PagedScene> scene = paged::read(city, "cache=" + cache);
    const auto actual = paged::settle(_viewer, *scene, paged::lookAlong());
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_TRUE(Exact(actual, expected, "paged.full"));
    EXPECT_EQ(_notes.takeWarnings().size(), 1u);
    const osg::ref_ptr<PagedScene> again = paged::read(city, "cache=" + cache);
    EXPECT_TRUE(
        Exact(paged::settle(_viewer, *again, paged::lookAlong()), expected, "paged.afterwards"));
}

TEST_F(PagedExtremesGLTest, threeDsModelsArePaged)
{
    OSGKITS_NEED_GL(_viewer);
    paged::writePicture(_folder, "wall.png", 256, 256);
    const osg::ref_ptr<osg::Geode> square =
        paged::makeSquare({0.0f, 4.0f, 0.0f}, paged::makeTexture("wall.png"));
    square->getOrCreateStateSet()->setAttribute(new osg::Material);
    const std::string file = _folder.file("model.3ds");
    ASSERT_TRUE(osgDB::writeNodeFile(*square, file));
    const osg::ref_ptr<osg::Node> plain = osgDB::readRefNodeFile(file);
    ASSERT_TRUE(plain);
    const osg::ref_ptr<PagedScene> scene = paged::read(file, "compression=none,wait=on");
    EXPECT_EQ(paged::countOf(*scene, "textures"), 1.0);
    const auto expected = _viewer.render(plain, paged::lookAlong(), 320, 240);
    // Mip levels are averaged in linear light here.
    EXPECT_TRUE(support::CompareImage({8.0 / 255.0, 0.01, 24.0 / 255.0})(
        _viewer.render(scene, paged::lookAlong(), 320, 240), expected, "paged.3ds"));
}

TEST_F(PagedExtremesGLTest, fiftyThousandTexturesCostNoSquareOfTheirNumber)
{
    OSGKITS_NEED_GL(_viewer);
    constexpr int side = 224; // 50,176 of them.
    const std::filesystem::path first = paged::writePicture(_folder, "first.png", 16, 16);
    const osg::ref_ptr<osg::Group> model = new osg::Group;
    for (int i = 0; i < side * side; ++i)
    {
        const std::string name = _folder.file(std::to_string(i) + ".png");
        std::filesystem::create_hard_link(first, name);
        model->addChild(paged::makeSquare(
            {float(i % side - side / 2) * 2.0f, 480.0f, float(i / side - side / 2) * 2.0f},
            paged::makeTexture(name)));
    }
    const std::string file = _folder.file("many.osgb");
    ASSERT_TRUE(osgDB::writeNodeFile(*model, file));
    const osg::ref_ptr<PagedScene> scene = paged::read(file, "gpu=4,reload=off");
    // Those that are neither in view nor there are not looked at.
    for (int i = 0; i < 4; ++i)
        _viewer.render(scene, paged::lookAlong({0.0, 460.0, 0.0}), 320, 240);
    EXPECT_GT(paged::countOf(*scene, "textures.inView"), 50.0) << "no proof";
    EXPECT_LT(paged::countOf(*scene, "textures.considered"), 1000.0);
    RecordProperty("planOfFewMilliseconds", std::to_string(paged::countOf(*scene, "plan.ms")));
    // Where something goes through all textures for each of them these frames take longer than the
    // suite lets a test run.
    for (int i = 0; i < 12; ++i)
        _viewer.render(scene, paged::lookAlong(), 320, 240);
    EXPECT_GT(paged::countOf(*scene, "textures.inView"), 40000.0) << "no proof";
    RecordProperty("planMilliseconds", std::to_string(paged::countOf(*scene, "plan.ms")));
}

TEST_F(PagedExtremesGLTest, tenThousandLoadsAndEvictionsLeaveMemoryAsItWas)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 4, 4, 16);
    const osg::ref_ptr<PagedScene> scene = paged::read(city, "upload=100");
    osgPagedTexture::PagedSettings settings = scene->getSettings();
    // Without a budget all 16 go, with one all come.
    const auto showUntil = [&](double megabytes, std::size_t resident)
    {
        settings.gpuMegabytes = megabytes;
        scene->setSettings(settings);
        for (int i = 0; i < 5000 && scene->getStatistics().resident != resident; ++i)
            _viewer.render(scene, paged::lookAlong({0.0, -30.0, 0.0}), 64, 48);
        EXPECT_EQ(scene->getStatistics().resident, resident);
    };
    double before = 0.0;
    for (int loads = 0; loads < 10000 && !HasFailure(); loads += 16)
    {
        showUntil(1.0, 16);
        showUntil(0.0, 0);
        if (loads == 1600)
            before = support::residentMiB();
    }
    EXPECT_GE(scene->getStatistics().loader.completed, 10000u) << "no proof";
    // A leak of 1 KiB a load would be 8 MiB.
    EXPECT_LT(support::residentMiB(), before + 4.0);
}
