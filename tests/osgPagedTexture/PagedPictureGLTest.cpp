// SPDX-License-Identifier: MIT
#include "PagedScenes.h"

#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <osgPagedTexture/Pager.h>

#include <gtest/gtest.h>

namespace
{

using osgPagedTexture::PagedScene;

/// Levels are whole numbers of texels, so that of sides that are no powers of two the ratio of two
/// levels is not exactly 2: rounding of the level that GL computes may show as one step.
const support::CompareImage Same{1.0 / 255.0, 0.0, 1.0 / 255.0};

class PagedPictureGLTest : public testing::Test
{
protected:
    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
};

} // namespace

TEST_F(PagedPictureGLTest, atRestThePictureIsThatOfTexturesThatAreThereWhole)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 4, 3, 512);
    // Encoded alike: levels that are read from a reduced picture are rounded in other places.
    const std::string cache = ",compression=none,cache=" + _folder.file("cache");
    const osg::ref_ptr<PagedScene> whole = paged::read(city, "gpu=256" + cache);
    const osg::ref_ptr<PagedScene> parts = paged::read(city, "gpu=6" + cache);
    paged::settle(_viewer, *whole, paged::lookAlong(osg::Vec3d(0.0, -30.0, 0.0)));
    for (const osg::Vec3d& eye : {osg::Vec3d(), osg::Vec3d(0.5, 2.0, 0.2), osg::Vec3d(0, -30, 0)})
    {
        const osg::ref_ptr<osg::Image> expected =
            paged::settle(_viewer, *whole, paged::lookAlong(eye));
        const osg::ref_ptr<osg::Image> actual =
            paged::settle(_viewer, *parts, paged::lookAlong(eye));
        EXPECT_TRUE(Same(actual, expected, "paged.rest"));
        EXPECT_EQ(paged::countOf(*parts, "levels.missing"), 0.0) << "no proof";
        EXPECT_LT(paged::countOf(*parts, "gpu.bytes"), paged::countOf(*whole, "gpu.bytes"));
    }
    EXPECT_EQ(paged::countOf(*whole, "textures.whole"), 1.0);
    EXPECT_EQ(paged::countOf(*parts, "textures.whole"), 0.0);
}

TEST_F(PagedPictureGLTest, sidesThatAreNoPowersOfTwoShowTheSameToo)
{
    OSGKITS_NEED_GL(_viewer);
    osg::ref_ptr<osg::Group> model = new osg::Group;
    const int sizes[][2] = {{333, 517}, {1, 1}, {1, 1000}, {1023, 3}, {640, 480}};
    float x = -5.0f;
    for (const auto& size : sizes)
    {
        const std::string name =
            "p" + std::to_string(size[0]) + "x" + std::to_string(size[1]) + ".png";
        paged::writePicture(_folder, name, size[0], size[1]);
        model->addChild(
            paged::makeSquare({x, 30.0f, 0.0f}, paged::makeTexture(_folder.file(name))));
        x += 2.5f;
    }
    const std::string file = _folder.file("sizes.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(*model, file));
    const std::string cache = "compression=none,cache=" + _folder.file("cache");
    const osg::ref_ptr<PagedScene> whole = paged::read(file, cache);
    const osg::ref_ptr<PagedScene> parts = paged::read(file, cache + ",gpu=0.5");
    ASSERT_EQ(paged::countOf(*parts, "textures"), 5.0);
    const auto expected = paged::settle(_viewer, *whole, paged::lookAlong());
    const auto actual = paged::settle(_viewer, *parts, paged::lookAlong());
    EXPECT_TRUE(Same(actual, expected, "paged.sizes"));
    EXPECT_EQ(paged::countOf(*parts, "levels.missing"), 0.0) << "no proof";
    EXPECT_LT(paged::countOf(*parts, "gpu.bytes"), paged::countOf(*whole, "gpu.bytes"));
}

TEST_F(PagedPictureGLTest, inBlocksThePictureAtRestIsTheSameToo)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 3, 3, 512);
    for (const char* const blocks : {"compression=blocks", "compression=best"})
    {
        const std::string settings =
            std::string(blocks) + ",cache=" + _folder.file(std::string("cache.") + blocks);
        const osg::ref_ptr<PagedScene> whole = paged::read(city, settings);
        const osg::ref_ptr<PagedScene> parts = paged::read(city, settings + ",gpu=0.8");
        const auto expected = paged::settle(_viewer, *whole, paged::lookAlong({0, -4, 0}));
        const auto actual = paged::settle(_viewer, *parts, paged::lookAlong({0, -4, 0}));
        EXPECT_TRUE(Same(actual, expected, "paged.blocks")) << blocks;
        EXPECT_EQ(paged::countOf(*parts, "levels.missing"), 0.0) << "no proof";
        EXPECT_LT(paged::countOf(*parts, "gpu.bytes"), paged::countOf(*whole, "gpu.bytes"));
    }
}

TEST_F(PagedPictureGLTest, waitingFramesAreTheSameAsThoseAtRest)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 2, 2, 256);
    const osg::ref_ptr<PagedScene> waits = paged::read(city, "wait=on");
    const osg::ref_ptr<osg::Image> first = _viewer.render(waits, paged::lookAlong(), 320, 240);
    const osg::ref_ptr<PagedScene> rests = paged::read(city);
    const osg::ref_ptr<osg::Image> last = paged::settle(_viewer, *rests, paged::lookAlong());
    EXPECT_TRUE(support::CompareImage({0.0, 0.0, 0.0})(first, last, "paged.wait"));
}

TEST_F(PagedPictureGLTest, greyAndTranslucentPicturesLookAsWithoutPaging)
{
    OSGKITS_NEED_GL(_viewer);
    osg::ref_ptr<osg::Group> model = new osg::Group;
    for (int channels = 1; channels <= 4; ++channels)
    {
        const std::string name = "c" + std::to_string(channels) + ".png";
        paged::writePicture(_folder, name, 256, 256, channels);
        model->addChild(paged::makeSquare({2.5f * float(channels) - 6.0f, 8.0f, 0.0f},
                                          paged::makeTexture(name)));
        model->getChild(unsigned(channels) - 1)
            ->getOrCreateStateSet()
            ->setMode(GL_BLEND, osg::StateAttribute::ON);
    }
    const std::string file = _folder.file("model.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(*model, file));
    const osg::ref_ptr<osg::Node> plain = osgDB::readRefNodeFile(file);
    const osg::ref_ptr<PagedScene> scene = paged::read(file, "compression=none,wait=on");
    const auto expected = _viewer.render(plain, paged::lookAlong(), 320, 240);
    const auto actual = _viewer.render(scene, paged::lookAlong(), 320, 240);
    // The driver averages sRGB values where our levels are averaged in linear light.
    EXPECT_TRUE(support::CompareImage({8.0 / 255.0, 0.01, 24.0 / 255.0})(actual, expected,
                                                                         "paged.channels"));
}
