// SPDX-License-Identifier: MIT
// The built-in renderings compile, draw something sensible, smoothly; those of images what they
// should, to a step of 8 bits.
#include "osgMultiRender/RenderingScenes.h"

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/InventorModels.h>
#include <support/NotifyCapture.h>

#include <osgDB/ReadFile>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>

using osgMultiRender::BuiltInRendering;
using osgMultiRender::findBuiltInRendering;
using osgMultiRender::getBuiltInRenderings;
using support::CameraSpec;

namespace
{

constexpr int Size = 256;

/// Pictures side by side, row by row from the top.
class Sheet
{
public:
    Sheet(int size, int columns, int count)
        : _size(size), _columns(columns), _rows((count + columns - 1) / columns)
    {
        _image->allocateImage(columns * size, _rows * size, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    }
    void add(const osg::Image& picture)
    {
        const int x = _count % _columns * _size, y = (_rows - 1 - _count / _columns) * _size;
        ++_count;
        for (int row = 0; row < _size; ++row)
            std::copy_n(picture.data(0, row), _size * 4, _image->data(x, y + row));
    }
    void write(const std::string& name) const { support::writeImage(*_image, name); }

private:
    int _size, _columns, _rows, _count = 0;
    osg::ref_ptr<osg::Image> _image = new osg::Image;
};

/// The mean of blocks of pixels.
osg::ref_ptr<osg::Image> shrink(const osg::Image& large, int factor)
{
    const osg::ref_ptr<osg::Image> small = new osg::Image;
    small->allocateImage(large.s() / factor, large.t() / factor, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < small->t(); ++y)
        for (int x = 0; x < small->s(); ++x)
        {
            osg::Vec4 sum;
            for (int j = 0; j < factor; ++j)
                for (int i = 0; i < factor; ++i)
                    sum += large.getColor(x * factor + i, y * factor + j);
            small->setColor(sum / float(factor * factor), x, y);
        }
    return small;
}

double rms(const osg::Image& a, const osg::Image& b)
{
    double sum = 0.0;
    for (int y = 0; y < a.t(); ++y)
        for (int x = 0; x < a.s(); ++x)
            sum += (a.getColor(x, y) - b.getColor(x, y)).length2() / 3.0;
    return std::sqrt(sum / (double(a.s()) * a.t()));
}

std::size_t countColors(const osg::Image& image)
{
    std::set<unsigned int> colors;
    for (int y = 0; y < image.t(); ++y)
        for (int x = 0; x < image.s(); ++x)
            colors.insert(*reinterpret_cast<const unsigned int*>(image.data(x, y)));
    return colors.size();
}

class RenderingsGLTest : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(_viewer); }

    static support::HeadlessSettings makeSettings()
    {
        support::HeadlessSettings settings;
        settings.width = settings.height = 4 * Size;
        return settings;
    }

    /// Draws with the rendering above the node; what OSG warns of is a failure.
    osg::ref_ptr<osg::Image> draw(const BuiltInRendering& rendering, osg::Node* node,
                                  const CameraSpec& camera, int size,
                                  const std::function<void(osg::StateSet&)>& change = {})
    {
        const osg::ref_ptr<osg::Group> group = new osg::Group;
        group->setStateSet(makeRenderingState(rendering));
        if (change)
            change(*group->getStateSet());
        group->addChild(node);
        support::NotifyCapture capture;
        const osg::ref_ptr<osg::Image> picture = _viewer.render(group, camera, size, size);
        EXPECT_EQ(capture.takeWarnings(), support::NotifyCapture::Lines()) << rendering.name;
        return picture;
    }

    support::HeadlessViewer _viewer{makeSettings()};
    osg::ref_ptr<osg::Image> _image = makeSampleImage(64);
};

CameraSpec modelCamera()
{
    return CameraSpec::perspective({1.5, -7.0, 4.0}, {0.0, 0.0, -0.2}, {0.0, 0.0, 1.0}, 40.0, 1.0,
                                   0.5, 50.0);
}

/// A texel is a pixel.
const CameraSpec ImageCamera{};

TEST_F(RenderingsGLTest, eachDrawsAPictureOfItsOwnWithoutWarnings)
{
    const osg::ref_ptr<osg::Node> model = makeSampleModel(*_image), quad = makeImageQuad(*_image);
    Sheet sheet(Size, 7, 21);
    std::vector<osg::ref_ptr<osg::Image>> pictures;
    for (const BuiltInRendering& rendering : getBuiltInRenderings())
    {
        SCOPED_TRACE(rendering.name);
        const osg::ref_ptr<osg::Image> picture = rendering.isImage
                                                     ? draw(rendering, quad, ImageCamera, Size)
                                                     : draw(rendering, model, modelCamera(), Size);
        ASSERT_TRUE(picture);
        sheet.add(*picture);
        EXPECT_GT(countColors(*picture), 50u);
        for (const auto& other : pictures)
            EXPECT_GT(rms(*picture, *other), 0.01);
        pictures.push_back(picture);
    }
    EXPECT_EQ(pictures.size(), 21u);
    sheet.write("renderings");
}

TEST_F(RenderingsGLTest, surfacesAreAntialiased)
{
    const osg::ref_ptr<osg::Node> model = makeSampleModel(*_image);
    for (const BuiltInRendering& rendering : getBuiltInRenderings())
    {
        if (rendering.isImage)
            continue;
        const osg::ref_ptr<osg::Image> picture = draw(rendering, model, modelCamera(), Size);
        // What is measured in pixels of the screen is four times as wide there.
        const auto widen = [](osg::StateSet& stateSet)
        {
            for (const char* name : {"width", "outline", "spacing"})
                if (osg::Uniform* uniform = stateSet.getUniform(name))
                {
                    float value = 0.0f;
                    uniform->get(value);
                    uniform->set(4.0f * value);
                }
        };
        const osg::ref_ptr<osg::Image> large =
            draw(rendering, model, modelCamera(), 4 * Size, widen);
        ASSERT_TRUE(picture && large);
        const double error = rms(*picture, *shrink(*large, 4));
        std::printf("%-10s differs from its supersampled picture by %.2f %% RMS\n",
                    rendering.name.c_str(), 100.0 * error);
        // Edges of triangles, which no shader can soften, are some 1 to 2 %. A checker board
        // without its filter is at 4.7.
        EXPECT_LT(error, 0.045) << rendering.name;
    }
}

TEST_F(RenderingsGLTest, drawAModelOfManyParts)
{
    const std::string path = support::inventorModel("household/teapot.iv");
    const osg::ref_ptr<osg::Node> model = path.empty() ? nullptr : osgDB::readRefNodeFile(path);
    if (!model)
        GTEST_SKIP() << "NOT TESTED: Debian's inventor-data is not installed";
    const double size = model->getBound().radius();
    Sheet sheet(Size, 7, 14);
    for (const BuiltInRendering& rendering : getBuiltInRenderings())
    {
        if (rendering.isImage)
            continue;
        const auto scale = [&](osg::StateSet& stateSet)
        {
            for (const char* name : {"rings", "dents", "bricks", "squares", "lines"})
                if (osg::Uniform* uniform = stateSet.getUniform(name))
                {
                    float value = 0.0f;
                    uniform->get(value);
                    uniform->set(float(value * 2.5 / size));
                }
            if (osg::Uniform* uniform = stateSet.getUniform("farthest"))
                uniform->set(float(5.0 * size));
            if (osg::Uniform* uniform = stateSet.getUniform("nearest"))
                uniform->set(float(1.5 * size));
        };
        const osg::ref_ptr<osg::Image> picture =
            draw(rendering, model, CameraSpec::overview(*model, 1.0), Size, scale);
        ASSERT_TRUE(picture);
        if (rendering.name != "textured") // it has no texture
        {
            EXPECT_GT(countColors(*picture), 30u) << rendering.name;
        }
        sheet.add(*picture);
    }
    sheet.write("renderings-model");
}

} // namespace
