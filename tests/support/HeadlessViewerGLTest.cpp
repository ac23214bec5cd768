// SPDX-License-Identifier: MIT
#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/ShapeDrawable>

#include <gtest/gtest-spi.h>

#include <cmath>

using support::CameraSpec;
using support::HeadlessSettings;
using support::HeadlessViewer;

namespace
{

/// An unlit square that fills the middle half of the picture, of a color that may be above 1.
osg::ref_ptr<osg::Node> square(const osg::Vec4& color)
{
    osg::ref_ptr<osg::Geometry> quad = osg::createTexturedQuadGeometry(
        osg::Vec3(-0.5f, -0.5f, 0.0f), osg::Vec3(1, 0, 0), osg::Vec3(0, 1, 0));
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(osg::Array::BIND_OVERALL, 1);
    colors->front() = color;
    quad->setColorArray(colors);
    quad->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    quad->getOrCreateStateSet()->setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
    return quad;
}

const CameraSpec Flat = {osg::Matrixd(), osg::Matrixd::ortho(-1, 1, -1, 1, -1, 1)};

osg::Vec4 pixel(const osg::Image* image, int x, int y)
{
    return image ? image->getColor(x, y) : osg::Vec4(-1, -1, -1, -1);
}

osg::Vec4i bytes(const osg::Image* image, int x, int y)
{
    const osg::Vec4 color = pixel(image, x, y) * 255.0f;
    return osg::Vec4i(std::lround(color.r()), std::lround(color.g()), std::lround(color.b()),
                      std::lround(color.a()));
}

/// Raises GL_INVALID_ENUM when drawn.
class BrokenDrawable : public osg::Drawable
{
public:
    void drawImplementation(osg::RenderInfo&) const override { glEnable(GL_RGBA); }
    osg::BoundingBox computeBoundingBox() const override { return {-1, -1, -1, 1, 1, 1}; }
};

} // namespace

TEST(HeadlessViewer, showsTheSquareAndTheClearColor)
{
    support::NotifyCapture notify;
    HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const auto image = viewer.render(square({1, 0.4f, 0, 1}), Flat, 64, 32);
    EXPECT_EQ(image->s(), 64);
    EXPECT_EQ(bytes(image, 32, 16), osg::Vec4i(255, 102, 0, 255));
    EXPECT_EQ(bytes(image, 5, 16), osg::Vec4i(51, 51, 102, 255));
}

TEST(HeadlessViewer, floatPicturesOfAnySizeAndNumberOfFramesFollowEachOther)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    for (int round = 0; round < 3; ++round)
        for (const int size : {16, 64, 40})
            for (const unsigned int frames : {1u, 2u, 3u})
            {
                const auto floats =
                    viewer.renderFloat(square({1, 0.25f, 0, 1}), Flat, size, size, frames);
                EXPECT_EQ(pixel(floats, size / 2, size / 2), osg::Vec4(1, 0.25f, 0, 1))
                    << size << " " << frames;
                const auto bytes = viewer.render(square({0, 1, 0, 1}), Flat, size, size, frames);
                EXPECT_EQ(pixel(bytes, size / 2, size / 2), osg::Vec4(0, 1, 0, 1)) << size;
            }
}

TEST(HeadlessViewer, floatPictureKeepsValuesAboveOneAndTheByteOneComesBack)
{
    HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    viewer.getViewer().getCamera()->setClearColor({0.3f, 5.0f, 0.0f, 1.0f});
    const auto floats = viewer.renderFloat(square({1, 0.4f, 0, 1}), Flat, 64, 32);
    EXPECT_EQ(pixel(floats, 5, 16), osg::Vec4(0.3f, 5.0f, 0.0f, 1.0f));
    EXPECT_EQ(pixel(floats, 32, 16), osg::Vec4(1, 0.4f, 0, 1));
    const auto image = viewer.render(square({0, 1, 0, 1}), Flat, 64, 32);
    EXPECT_EQ(pixel(image, 32, 16), osg::Vec4(0, 1, 0, 1));
}

TEST(HeadlessViewer, allThreadingModelsAndTwoViewersAtOnceGiveTheSamePicture)
{
    osg::ref_ptr<osg::Node> sphere = new osg::ShapeDrawable(new osg::Sphere(osg::Vec3(), 1.0f));
    const CameraSpec camera = CameraSpec::overview(*sphere, 4.0 / 3.0);
    HeadlessViewer single;
    OSGKITS_NEED_GL(single);
    const auto expected = single.render(sphere, camera, 160, 120);
    using Base = osgViewer::ViewerBase;
    for (auto model : {Base::CullDrawThreadPerContext, Base::DrawThreadPerContext,
                       Base::CullThreadPerCameraDrawThreadPerContext})
    {
        HeadlessSettings settings;
        settings.threading = model;
        HeadlessViewer viewer(settings);
        const auto actual = viewer.render(sphere, camera, 160, 120, 3);
        EXPECT_TRUE((support::CompareImage{0.0, 0.0, 0.0}(actual, expected, "threadingModel")));
    }
}

TEST(HeadlessViewer, samplesSmoothTheEdge)
{
    HeadlessSettings settings;
    settings.samples = 4;
    HeadlessViewer viewer(settings);
    OSGKITS_NEED_GL(viewer);
    const CameraSpec shifted = {osg::Matrixd::translate(0.5 / 32, 0, 0), Flat.projection};
    const auto image = viewer.render(square({1, 1, 1, 1}), shifted, 64, 32);
    const float edge = pixel(image, 16, 16).r();
    EXPECT_GT(edge, 0.3f);
    EXPECT_LT(edge, 0.9f);
}

TEST(HeadlessViewer, errorOfGLFailsTheTest)
{
    static HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    static osg::ref_ptr<osg::Drawable> broken = new BrokenDrawable;
    broken->setUseDisplayList(false);
    EXPECT_NONFATAL_FAILURE(viewer.render(broken, Flat, 8, 8), "GL error 0x500");
}

TEST(HeadlessViewer, pictureLargerThanTheContextIsRefused)
{
    static HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    EXPECT_NONFATAL_FAILURE(viewer.render(new osg::Group, Flat, 321, 8),
                            "a picture of 321x8 does not fit the context of 320x240");
}
