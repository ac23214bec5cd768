// SPDX-License-Identifier: MIT
// The image renderings against the same operations on the CPU.
#include "osgMultiRender/ImageOperations.h"
#include "osgMultiRender/RenderingScenes.h"

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>

#include <osg/Group>

#include <functional>

namespace
{

constexpr int Size = 64;
using Image = osg::ref_ptr<osg::Image>;

class ImageRenderingsGLTest : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(_viewer); }

    void expectEqual(const std::string& name,
                     const std::function<osg::Vec4(const osg::Image&, int, int)>& reference)
    {
        const auto* const rendering = osgMultiRender::findBuiltInRendering(name);
        ASSERT_TRUE(rendering);
        const Image image = makeSampleImage(Size), expected = new osg::Image;
        // Noise as well, so that no neighbour is like another.
        unsigned int state = 7;
        for (int y = 0; y < Size / 2; ++y)
            for (int x = 0; x < Size * 4; ++x)
                if (x % 4 != 3)
                    image->data(0, y)[x] =
                        static_cast<unsigned char>((state = state * 1664525u + 1013904223u) >> 24);
        expected->allocateImage(Size, Size, 1, GL_RGBA, GL_UNSIGNED_BYTE);
        for (int y = 0; y < Size; ++y)
            for (int x = 0; x < Size; ++x)
                expected->setColor(reference(*image, x, y), x, y);
        const osg::ref_ptr<osg::Group> group = new osg::Group;
        group->addChild(makeImageQuad(*image));
        for (const float size : {float(Size), 0.0f}) // by texels, and by pixels of the screen
        {
            group->setStateSet(makeRenderingState(*rendering));
            if (osg::Uniform* uniform = group->getStateSet()->getUniform("imageSize"))
                uniform->set(osg::Vec2(size, size));
            const Image picture = _viewer.render(group, {}, Size, Size);
            // A step of 8 bits on any pixel; setColor() cuts off where GL rounds.
            support::CompareImage compare;
            compare.threshold = 1.0 / 255.0;
            compare.share = 0.0;
            compare.hardLimit = 1.0 / 255.0;
            EXPECT_TRUE(compare(picture, expected, "imageRendering-" + name)) << size;
        }
    }

    support::HeadlessViewer _viewer;
};

} // namespace

TEST_F(ImageRenderingsGLTest, luminance)
{
    expectEqual("luminance", [](const osg::Image& image, int x, int y)
                { return grey(luminance(at(image, x, y)), at(image, x, y).a()); });
}

TEST_F(ImageRenderingsGLTest, sepia)
{
    expectEqual("sepia",
                [](const osg::Image& image, int x, int y) { return sepia(at(image, x, y)); });
}

TEST_F(ImageRenderingsGLTest, sobel)
{
    expectEqual("sobel", sobel);
}

TEST_F(ImageRenderingsGLTest, dilation)
{
    expectEqual("dilation", [](const osg::Image& image, int x, int y)
                { return extreme(image, x, y, 1, true); });
}

TEST_F(ImageRenderingsGLTest, erosion)
{
    expectEqual("erosion", [](const osg::Image& image, int x, int y)
                { return extreme(image, x, y, 1, false); });
}

TEST_F(ImageRenderingsGLTest, blur)
{
    expectEqual("blur", [](const osg::Image& image, int x, int y) { return blur(image, x, y, 4); });
}

TEST_F(ImageRenderingsGLTest, sharpen)
{
    expectEqual("sharpen", sharpen);
}
