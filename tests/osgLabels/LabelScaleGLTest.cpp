// SPDX-License-Identifier: MIT
// Objects under matrices that scale unevenly have the labels that they would have if they were
// modelled as they are seen.
#include "LabelPictures.h"

#include <osgLabels/UnevenScale.h>

#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>

using namespace labelScene;
using osgLabels::unevenScaleOf;

namespace
{

osg::Matrixd turned(double degrees, const osg::Vec3d& axis)
{
    return osg::Matrixd::rotate(osg::inDegrees(degrees), axis);
}

/// Each as it stands in the view.
const std::pair<const char*, osg::Matrixd> Matrices[] = {
    {"flat", osg::Matrixd::scale(1.1, 1.1, 0.16)},
    {"high", osg::Matrixd::scale(0.3, 0.5, 0.9)},
    {"mirrored", osg::Matrixd::scale(-1.1, 0.6, 0.35)},
    {"turned", osg::Matrixd::scale(1.2, 0.5, 0.3) * turned(25.0, {0, 0, 1})},
    {"sheared",
     turned(20.0, {0, 0, 1}) * osg::Matrixd::scale(1.1, 0.5, 0.4) * turned(15.0, {0, 1, 0})}};

osg::ref_ptr<osg::Geometry> shaped(osg::Shape* shape)
{
    osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
    drawable->setColor(osg::Vec4(0.8f, 0.8f, 0.7f, 1.0f));
    return new osg::Geometry(*drawable, osg::CopyOp::DEEP_COPY_ALL);
}

osg::ref_ptr<osg::Node> under(const osg::Matrixd& matrix, osg::Node* node)
{
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
    transform->addChild(node);
    return unlit(transform);
}

/// As under(), by vertices of its own.
osg::ref_ptr<osg::Node> modelled(const osg::Matrixd& matrix, const osg::Geometry& geometry,
                                 const std::string& name)
{
    osg::ref_ptr<osg::Geometry> copy = new osg::Geometry(geometry, osg::CopyOp::DEEP_COPY_ALL);
    for (osg::Vec3& v : static_cast<osg::Vec3Array&>(*copy->getVertexArray()))
        v = v * matrix;
    return unlit(named(name, copy));
}

support::CameraSpec fromAbove()
{
    return support::CameraSpec::perspective({0.0, -3.2, 1.7}, {0, 0, 0}, {0, 0, 1}, 35.0,
                                            double(Width) / Height, 0.5, 20.0);
}

/// Records hold floats: the rim of a letter may be elsewhere by a hundredth of a pixel or two.
testing::AssertionResult areOfOneLook(const osg::Image* actual, const osg::Image* expected,
                                      const std::string& name)
{
    keep(actual, name);
    return support::CompareImage{8.0 / 255.0, 0.001, 1.0}(actual, expected, name);
}

constexpr char Settings[] = "plate=off,ink=#000000";

class LabelScaleGLTest : public PictureTest
{
};

} // namespace

TEST_F(LabelScaleGLTest, scaledShapesAreLabelledAsIfModelledSo)
{
    OSGKITS_NEED_GL(viewer());
    const std::pair<const char*, osg::ref_ptr<osg::Geometry>> shapes[] = {
        {"Box", shaped(new osg::Box(osg::Vec3(), 2.0f))},
        {"Sphere", shaped(new osg::Sphere(osg::Vec3(), 1.0f))},
        {"Cylinder", shaped(new osg::Cylinder(osg::Vec3(), 0.8f, 2.0f))}};
    for (const auto& [name, geometry] : shapes)
        for (const auto& [how, matrix] : Matrices)
        {
            const auto scaled = under(matrix, named(name, geometry));
            const Picture actual = render(*labelled(scaled, Settings), fromAbove());
            const Picture expected =
                render(*labelled(modelled(matrix, *geometry, name), Settings), fromAbove());
            const Picture bare = render(*scaled, fromAbove());
            EXPECT_TRUE(
                areOfOneLook(actual, expected, std::string("labelScale.") + name + "." + how));
            EXPECT_GT(changedShare(*actual, *bare), 0.002) << name << ", " << how;
        }
}

TEST_F(LabelScaleGLTest, instancesAreLabelledEachByItsScale)
{
    OSGKITS_NEED_GL(viewer());
    const auto geometry = shaped(new osg::Box(osg::Vec3(), 2.0f));
    const osg::ref_ptr<osg::Group> scaled = new osg::Group, expected = new osg::Group;
    const osg::ref_ptr<osg::Geode> one = named("Instance", geometry);
    for (int i = 0; i < 3; ++i)
    {
        const osg::Matrixd matrix = osg::Matrixd::scale(0.35, 0.2 + 0.1 * i, 0.45 - 0.15 * i) *
                                    osg::Matrixd::translate(0.8 * i - 0.8, 0.0, 0.0);
        scaled->addChild(under(matrix, one));
        expected->addChild(modelled(matrix, *geometry, "Instance"));
    }
    EXPECT_TRUE(areOfOneLook(render(*labelled(scaled, Settings), fromAbove()),
                             render(*labelled(expected, Settings), fromAbove()),
                             "labelScale.instances"));
}

TEST(UnevenScaleTest, isWhatSimilaritiesLeave)
{
    const osg::Matrixd turn = turned(37.0, {1, 2, 3});
    const osg::Matrixd stretch =
        turned(-20.0, {3, 1, 0}) * osg::Matrixd::scale(4.0, 1.0, 0.25) * turned(20.0, {3, 1, 0});
    const auto found = unevenScaleOf(stretch * turn * osg::Matrixd::scale(-7.0, 7.0, 7.0) *
                                     osg::Matrixd::translate(1e7, 5, 6));
    ASSERT_TRUE(found);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            EXPECT_NEAR((*found)(i, j), stretch(i, j), 1e-12) << i << ' ' << j;
}

TEST(UnevenScaleTest, isNoneForSimilaritiesAndWhatHasNoInverse)
{
    EXPECT_FALSE(unevenScaleOf(osg::Matrixd()));
    EXPECT_FALSE(unevenScaleOf(turned(37.0, {1, 2, 3}) * osg::Matrixd::scale(9.0, 9.0, 9.0)));
    EXPECT_FALSE(unevenScaleOf(osg::Matrixd::scale(-2.0, 2.0, 2.0)));
    EXPECT_FALSE(unevenScaleOf(osg::Matrixd::scale(1.0, 1.0, 0.0)));
    EXPECT_FALSE(unevenScaleOf(osg::Matrixd::scale(1.0, 1.0, 1e-9)));
    EXPECT_FALSE(unevenScaleOf(osg::Matrixd::scale(NAN, 1.0, 1.0)));
    EXPECT_TRUE(unevenScaleOf(osg::Matrixd::scale(1.0, 1.0, 1e-3)));
}
