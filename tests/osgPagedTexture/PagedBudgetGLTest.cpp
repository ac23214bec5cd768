// SPDX-License-Identifier: MIT
#include "PagedScenes.h"

#include <osgPagedTexture/Pager.h>
#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <osgViewer/Viewer>

#include <gtest/gtest.h>

namespace
{

using osgPagedTexture::PagedScene;

/// Texels of all textures of the context, as GL tells their sizes.
class TextureBytes : public osg::Camera::DrawCallback
{
public:
    void operator()(osg::RenderInfo&) const override
    {
        constexpr GLenum Compressed = 0x86A1, CompressedBytes = 0x86A0;
        GLint bound = 0;
        glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
        bytes = 0;
        for (GLuint name = 1; name < 4000; ++name)
        {
            if (!glIsTexture(name))
                continue;
            glBindTexture(GL_TEXTURE_2D, name);
            if (glGetError() != GL_NO_ERROR)
                continue; // Of another kind.
            for (GLint level = 0; level < 15; ++level)
            {
                GLint width = 0, height = 0, compressed = 0, size = 0;
                glGetTexLevelParameteriv(GL_TEXTURE_2D, level, GL_TEXTURE_WIDTH, &width);
                glGetTexLevelParameteriv(GL_TEXTURE_2D, level, GL_TEXTURE_HEIGHT, &height);
                if (width == 0 || height == 0)
                    break;
                glGetTexLevelParameteriv(GL_TEXTURE_2D, level, Compressed, &compressed);
                if (compressed)
                    glGetTexLevelParameteriv(GL_TEXTURE_2D, level, CompressedBytes, &size);
                else
                    for (const GLenum channel : {0x805Cu, 0x805Du, 0x805Eu, 0x805Fu, 0x8060u})
                    {
                        GLint bits = 0;
                        glGetTexLevelParameteriv(GL_TEXTURE_2D, level, channel, &bits);
                        size += width * height * bits / 8;
                    }
                bytes += std::uint64_t(size);
            }
        }
        glBindTexture(GL_TEXTURE_2D, GLuint(bound));
    }
    mutable std::uint64_t bytes = 0;
};

class PagedBudgetGLTest : public testing::Test
{
protected:
    void SetUp() override
    {
        if (_viewer.isValid())
            _viewer.getViewer().getCamera()->addPostDrawCallback(_bytes);
    }

    std::uint64_t bytesInGL(PagedScene& scene, const osg::Vec3d& eye)
    {
        _viewer.render(&scene, paged::lookAlong(eye), 320, 240);
        return _bytes->bytes;
    }

    osg::ref_ptr<TextureBytes> _bytes = new TextureBytes;
    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
};

} // namespace

TEST_F(PagedBudgetGLTest, alongAFlightMemoryStaysWithinTheBudgetAndOnePage)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 8, 6, 256);
    const double page = 256 * 256 * 4 * 4 / 3.0;
    const double budget = 1048576.0;
    const std::uint64_t before = bytesInGL(*osg::ref_ptr<PagedScene>(new PagedScene), {});
    const osg::ref_ptr<PagedScene> scene =
        paged::read(city, "gpu=1,cpu=8,upload=20,compression=none");
    bool isFull = false, isChanged = false;
    double last = 0.0, most = 0.0;
    for (int i = 0; i < 250; ++i)
    {
        const std::uint64_t bytes = bytesInGL(*scene, {0.0, 0.25 * i, 0.05 * i}) - before;
        const double counted = paged::countOf(*scene, "gpu.bytes");
        // One texel for each colour of what is not there is not counted.
        ASSERT_LE(double(bytes), budget + page + 4096.0) << "frame " << i;
        ASSERT_LE(paged::countOf(*scene, "gpu.bytes.peak"), budget + page);
        isFull = isFull || counted > 0.7 * budget;
        isChanged = isChanged || (i > 50 && counted < last);
        last = counted;
        most = std::max(most, counted);
    }
    EXPECT_TRUE(isFull && isChanged) << "no proof: " << most;
    EXPECT_LE(paged::countOf(*scene, "cpu.bytes.peak"), 8.0 * 1048576.0 * 0.75);
    EXPECT_LE(paged::countOf(*scene, "levels.missing"), 2.0);
}

TEST_F(PagedBudgetGLTest, aBudgetBelowOnePageShowsWhatFits)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 1, 1, 512);
    for (const char* const budget : {"gpu=0.001", "gpu=0"})
    {
        const osg::ref_ptr<PagedScene> scene = paged::read(city, budget);
        paged::settle(_viewer, *scene, paged::lookAlong());
        EXPECT_LE(paged::countOf(*scene, "gpu.bytes"), 1049.0);
        EXPECT_EQ(paged::countOf(*scene, "textures.failed"), 0.0);
    }
}

TEST_F(PagedBudgetGLTest, whatIsNotInViewIsNotReadAndStartsNoThread)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 1, 2, 64);
    const osg::ref_ptr<PagedScene> scene = paged::read(city);
    support::CameraSpec away = paged::lookAlong({0.0, 100.0, 0.0});
    for (int i = 0; i < 5; ++i)
        _viewer.render(scene, away, 320, 240);
    const osgPagedTexture::PagerStatistics statistics = scene->getStatistics();
    EXPECT_EQ(statistics.loader.requests, 0u);
    EXPECT_EQ(statistics.upload.bytes, 0u);
    EXPECT_EQ(statistics.inView, 0u);
}

TEST_F(PagedBudgetGLTest, texturesOfOneFileAreReadAndKeptOnce)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string file = paged::writePicture(_folder, "one.png", 256, 256);
    osg::ref_ptr<osg::Group> model = new osg::Group;
    for (int i = 0; i < 5; ++i)
        model->addChild(
            paged::makeSquare({2.5f * float(i) - 5.0f, 12.0f, 0.0f}, paged::makeTexture(file)));
    ASSERT_TRUE(osgDB::writeNodeFile(*model, _folder.file("five.osgt")));
    const osg::ref_ptr<PagedScene> scene = paged::read(_folder.file("five.osgt"));
    paged::settle(_viewer, *scene, paged::lookAlong());
    EXPECT_EQ(paged::countOf(*scene, "textures"), 1.0);
    EXPECT_LE(paged::countOf(*scene, "gpu.bytes"), 256 * 256 * 4 * 4 / 3.0 + 8.0);
}

TEST_F(PagedBudgetGLTest, thousandsOfLoadsAndEvictionsLeaveNothingBehind)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 2, 2, 64);
    const std::uint64_t before = bytesInGL(*osg::ref_ptr<PagedScene>(new PagedScene), {});
    {
        const osg::ref_ptr<PagedScene> scene = paged::read(city, "gpu=0.02,compression=none");
        for (int i = 0; i < 20; ++i)
            paged::settle(_viewer, *scene, paged::lookAlong({0.0, i % 2 ? 0.0 : 8.0, 0.0}));
    }
    const osg::ref_ptr<PagedScene> empty = new PagedScene;
    bytesInGL(*empty, {});
    bytesInGL(*empty, {});
    EXPECT_EQ(bytesInGL(*empty, {}), before);
}

TEST_F(PagedBudgetGLTest, memoryThatTakesLongerThanAFrameMayIsMadeOutsideOfFrames)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string city = paged::writeCity(_folder, 1, 3, 1024);
    const osg::ref_ptr<PagedScene> plain = paged::read(city, "compression=none,wait=on");
    const auto expected = paged::settle(_viewer, *plain, paged::lookAlong());
    // 5.6 MiB each, of which 5 us can't make a thousandth.
    const osg::ref_ptr<PagedScene> scene =
        paged::read(city, "compression=none,upload=0.01,threads=1");
    osgPagedTexture::PagedSettings settings = scene->getSettings();
    // Budgets that come and go take textures back at any stage.
    for (int frame = 0; frame < 60; ++frame)
    {
        settings.gpuMegabytes = frame / 7 % 2 ? 0.5 : 100.0;
        scene->setSettings(settings);
        _viewer.render(scene, paged::lookAlong(), 320, 240);
    }
    settings.gpuMegabytes = 100.0;
    settings.uploadMilliseconds = 1.0;
    scene->setSettings(settings);
    const auto shown = paged::settle(_viewer, *scene, paged::lookAlong());
    EXPECT_TRUE(support::CompareImage({0.0, 0.0, 0.0})(shown, expected, "paged.aside"));
    EXPECT_GE(paged::countOf(*scene, "upload.madeAside"), 3.0);
}
