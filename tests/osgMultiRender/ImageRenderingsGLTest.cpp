// SPDX-License-Identifier: MIT
// The image renderings against the same operations on the CPU.
#include "osgMultiRender/RenderingScenes.h"

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>

#include <osg/Group>

#include <algorithm>
#include <cmath>
#include <functional>

namespace
{

constexpr int Size = 64;
using Image = osg::ref_ptr<osg::Image>;

/// Of the nearest pixel, as CLAMP_TO_EDGE.
osg::Vec4 at(const osg::Image& image, int x, int y)
{
    return image.getColor(std::clamp(x, 0, Size - 1), std::clamp(y, 0, Size - 1));
}

double luminance(const osg::Vec4& color)
{
    return 0.2126 * color.r() + 0.7152 * color.g() + 0.0722 * color.b();
}

osg::Vec4 grey(double value, double alpha = 1.0)
{
    const auto v = float(std::clamp(value, 0.0, 1.0));
    return {v, v, v, float(alpha)};
}

osg::Vec4 extreme(const osg::Image& image, int x, int y, int radius, bool isMost)
{
    osg::Vec4 result = at(image, x, y);
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i)
            for (int channel = 0; channel < 4; ++channel)
            {
                const float value = at(image, x + i, y + j)[channel];
                result[channel] =
                    isMost ? std::max(result[channel], value) : std::min(result[channel], value);
            }
    return result;
}

osg::Vec4 sobel(const osg::Image& image, int x, int y)
{
    const int mask[3][3] = {{-1, 0, 1}, {-2, 0, 2}, {-1, 0, 1}};
    double dx = 0.0, dy = 0.0;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
        {
            const double bright = luminance(at(image, x + i - 1, y + j - 1));
            dx += mask[j][i] * bright;
            dy += mask[i][j] * bright;
        }
    return grey(0.5 * std::hypot(dx, dy));
}

osg::Vec4 sepia(const osg::Vec4& color)
{
    const double bright = 1.15 * luminance(color);
    return {float(std::min(bright, 1.0)), float(std::min(0.84 * bright, 1.0)),
            float(std::min(0.62 * bright, 1.0)), color.a()};
}

osg::Vec4 blur(const osg::Image& image, int x, int y, int radius)
{
    osg::Vec4d sum;
    double weights = 0.0;
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i)
        {
            const double weight = std::exp(-2.0 * (i * i + j * j) / (radius * radius));
            sum += osg::Vec4d(at(image, x + i, y + j)) * weight;
            weights += weight;
        }
    return osg::Vec4(sum / weights);
}

osg::Vec4 sharpen(const osg::Image& image, int x, int y)
{
    const int mask[] = {1, 2, 1};
    osg::Vec4d mean;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            mean += osg::Vec4d(at(image, x + i - 1, y + j - 1)) * (mask[i] * mask[j] / 16.0);
    const osg::Vec4 middle = at(image, x, y);
    osg::Vec4 result;
    for (int channel = 0; channel < 3; ++channel)
        result[channel] = float(std::clamp(2.0 * middle[channel] - mean[channel], 0.0, 1.0));
    result.a() = middle.a();
    return result;
}

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
