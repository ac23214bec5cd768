// SPDX-License-Identifier: MIT
#include "PagedScenes.h"

#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <osgUtil/Optimizer>
#include <osgViewer/Viewer>

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace
{

using osgPagedTexture::PagedScene;

const support::CompareImage Exact{0.0, 0.0, 0.0};

class PagedFaultsGLTest : public testing::Test
{
protected:
    /// The middle of the picture.
    static osg::Vec4 middle(const osg::Image& picture)
    {
        return picture.getColor(unsigned(picture.s() / 2 + 3), unsigned(picture.t() / 2 + 3));
    }

    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
};

} // namespace

TEST_F(PagedFaultsGLTest, aDamagedFileIsNamedOnceAndShownAsAFault)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string picture = paged::writePicture(_folder, "cut.jpg", 256, 256);
    std::filesystem::resize_file(picture, std::filesystem::file_size(picture) / 2);
    const osg::ref_ptr<PagedScene> scene = paged::read(paged::writeSquare(_folder, picture));
    const osg::ref_ptr<osg::Image> shown = paged::settle(_viewer, *scene, paged::lookAlong());
    int magenta = 0;
    for (int y = 0; y < shown->t(); ++y)
        for (int x = 0; x < shown->s(); ++x)
        {
            const osg::Vec4 c = shown->getColor(unsigned(x), unsigned(y));
            magenta += c.r() > 0.9f && c.g() < 0.1f && c.b() > 0.9f;
        }
    EXPECT_GT(magenta, 1000);
    EXPECT_EQ(paged::countOf(*scene, "textures.failed"), 1.0);
    const support::NotifyCapture::Lines warnings = _notes.takeWarnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find(picture), std::string::npos) << warnings[0];
}

TEST_F(PagedFaultsGLTest, whatIsThereOfAFileThatVanishesStays)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string picture = paged::writePicture(_folder, "gone.png", 512, 512);
    const osg::ref_ptr<PagedScene> scene =
        paged::read(paged::writeSquare(_folder, picture), "gpu=1");
    paged::settle(_viewer, *scene, paged::lookAlong({0.0, -20.0, 0.0}));
    EXPECT_EQ(paged::countOf(*scene, "textures.resident"), 1.0);
    std::filesystem::remove(picture);
    for (int i = 0; i < 20; ++i)
        _viewer.render(scene, paged::lookAlong({0.0, 2.0, 0.0}), 320, 240);
    EXPECT_EQ(paged::countOf(*scene, "textures.resident"), 1.0);
    EXPECT_EQ(paged::countOf(*scene, "textures.failed"), 0.0);
}

TEST_F(PagedFaultsGLTest, aFileThatChangesIsShownAsItIsThen)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string picture = _folder.file("edited.png");
    const auto paint = [&](unsigned char grey, int side)
    {
        osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(side, side, 1, GL_RGB, GL_UNSIGNED_BYTE);
        std::fill_n(image->data(), image->getTotalSizeInBytes(), grey);
        ASSERT_TRUE(osgDB::writeImageFile(*image, picture));
    };
    paint(50, 64);
    const osg::ref_ptr<PagedScene> scene = paged::read(paged::writeSquare(_folder, picture));
    EXPECT_NEAR(middle(*paged::settle(_viewer, *scene, paged::lookAlong())).r(), 50.0 / 255, 0.01);
    paint(200, 128);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    float shown = 0.0f;
    while (shown < 0.7f && std::chrono::steady_clock::now() < end)
    {
        shown = middle(*_viewer.render(scene, paged::lookAlong(), 320, 240)).r();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_NEAR(shown, 200.0 / 255.0, 0.01);
}

TEST_F(PagedFaultsGLTest, aSceneThatGoesWhileItLoadsLeavesNoThreadAndNoCrash)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 3, 3, 256);
    for (int frames = 1; frames < 12; ++frames)
    {
        const osg::ref_ptr<PagedScene> scene = paged::read(city);
        for (int i = 0; i < frames; ++i)
            _viewer.render(scene, paged::lookAlong(), 320, 240);
    }
    const osg::ref_ptr<PagedScene> last = paged::read(city);
    {
        support::HeadlessViewer other;
        other.render(last, paged::lookAlong(), 320, 240);
        other.render(last, paged::lookAlong(), 320, 240);
    }
    paged::settle(_viewer, *last, paged::lookAlong());
    EXPECT_EQ(paged::countOf(*last, "textures.resident"), 9.0);
}

TEST_F(PagedFaultsGLTest, eachThreadingModelShowsTheSame)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 2, 2, 128);
    const osg::ref_ptr<PagedScene> expected = paged::read(city);
    const osg::ref_ptr<osg::Image> truth = paged::settle(_viewer, *expected, paged::lookAlong());
    for (const auto model : {osgViewer::ViewerBase::CullDrawThreadPerContext,
                             osgViewer::ViewerBase::DrawThreadPerContext,
                             osgViewer::ViewerBase::CullThreadPerCameraDrawThreadPerContext})
    {
        support::HeadlessSettings settings;
        settings.threading = model;
        support::HeadlessViewer viewer(settings);
        const osg::ref_ptr<PagedScene> scene = paged::read(city);
        EXPECT_TRUE(
            Exact(paged::settle(viewer, *scene, paged::lookAlong()), truth, "paged.threads"))
            << int(model);
    }
}

TEST_F(PagedFaultsGLTest, theOptimizerChangesNothing)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 2, 2, 128);
    const osg::ref_ptr<PagedScene> plain = paged::read(city);
    const osg::ref_ptr<osg::Image> truth = paged::settle(_viewer, *plain, paged::lookAlong());
    const osg::ref_ptr<PagedScene> scene = paged::read(city);
    osgUtil::Optimizer optimizer;
    optimizer.optimize(scene, osgUtil::Optimizer::ALL_OPTIMIZATIONS);
    const osg::ref_ptr<osg::Image> shown = paged::settle(_viewer, *scene, paged::lookAlong());
    EXPECT_EQ(paged::countOf(*scene, "textures.resident"), 4.0);
    // Merged squares are rasterized with other roundings at their edges.
    EXPECT_TRUE(support::CompareImage({1.0 / 255.0, 0.02, 1.0})(shown, truth, "paged.optimizer"));
}

TEST_F(PagedFaultsGLTest, twoContextsShowTheSame)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 2, 2, 128);
    const osg::ref_ptr<PagedScene> scene = paged::read(city);
    support::HeadlessViewer other;
    for (int i = 0; i < 6000 && paged::countOf(*scene, "textures.resident") < 4.0; ++i)
    {
        _viewer.render(scene, paged::lookAlong(), 320, 240);
        other.render(scene, paged::lookAlong(), 320, 240);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    for (int i = 0; i < 5; ++i)
    {
        _viewer.render(scene, paged::lookAlong(), 320, 240);
        other.render(scene, paged::lookAlong(), 320, 240);
    }
    EXPECT_TRUE(Exact(other.render(scene, paged::lookAlong(), 320, 240),
                      _viewer.render(scene, paged::lookAlong(), 320, 240), "paged.contexts"));
}

TEST_F(PagedFaultsGLTest, frozenScenesChangeNothing)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 2, 2, 128);
    const osg::ref_ptr<PagedScene> scene = paged::read(city, "freeze=on");
    for (int i = 0; i < 10; ++i)
        _viewer.render(scene, paged::lookAlong(), 320, 240);
    EXPECT_EQ(paged::countOf(*scene, "textures.resident"), 0.0);
    osgPagedTexture::PagedSettings settings = scene->getSettings();
    settings.freeze = false;
    settings.graph = true;
    scene->setSettings(settings);
    const auto shown = paged::settle(_viewer, *scene, paged::lookAlong());
    support::writeImage(*shown, "paged.graph");
    EXPECT_EQ(paged::countOf(*scene, "textures.resident"), 4.0);
}
