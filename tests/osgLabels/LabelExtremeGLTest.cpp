// SPDX-License-Identifier: MIT
// Degenerate and huge scenes: no GL error, no pixel that is no number, and the right letters.
#include "LabelPictures.h"

#include <support/NotifyCapture.h>

#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>

#include <cmath>
#include <limits>

using namespace labelScene;
using osgLabels::LabelScene;
using support::CameraSpec;

namespace
{

class LabelExtreme : public testing::Test
{
protected:
    void SetUp() override
    {
        OSGKITS_NEED_GL(viewer());
        viewer().getViewer().getCamera()->getGraphicsContext()->makeCurrent();
    }

    support::NotifyCapture _notify;
};

osg::ref_ptr<osg::Group> flat(osg::Node* node)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    if (node)
        group->addChild(node);
    return group;
}

/// As floats, each of which is a number.
Picture renderNumbers(osg::Node& node, const std::string& name,
                      const CameraSpec& camera = fromFront())
{
    const Picture picture = viewer().renderFloat(&node, camera, Width, Height, 2);
    if (!picture)
        return nullptr;
    keep(picture, "labelExtreme." + name);
    const auto* values = reinterpret_cast<const float*>(picture->data());
    std::size_t bad = 0;
    for (std::size_t i = 0; i < std::size_t(4) * Width * Height; ++i)
        bad += !std::isfinite(values[i]);
    EXPECT_EQ(bad, 0u) << name;
    return picture;
}

/// The labels' share of the picture; the model itself may show nothing.
double inkShare(osg::Node* model, const std::string& name, const CameraSpec& camera = fromFront(),
                const std::string& settings = Plain)
{
    const auto scene = labelled(model, settings);
    const Picture with = renderNumbers(*scene, name, camera);
    const Picture without = renderNumbers(*model, name + ".bare", camera);
    EXPECT_LE(countOf(*scene, "variants.failed"), 0.0) << name;
    return with && without ? changedShare(*with, *without) : -1.0;
}

osg::ref_ptr<osg::Geode> board(const std::string& text)
{
    return named(text,
                 rectangle({-1.2f, 0, -0.5f}, {2.4f, 0, 0}, {0, 0, 1}, {0.9f, 0.9f, 0.8f, 1}));
}

/// Looks at a place from a direction; near and far keep what lies between 1/100 and 100 times that.
CameraSpec lookFrom(const osg::Vec3d& eye, const osg::Vec3d& center, double distance)
{
    return CameraSpec::perspective(eye, center, {0, 0, 1}, 40.0, double(Width) / Height,
                                   distance / 100.0, distance * 100.0);
}

/// A cylinder along x around the x axis: from `left`, of that length.
osg::ref_ptr<osg::Geode> pipe(const std::string& name, double left, double length, float radius)
{
    constexpr int sides = 32;
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUShort> strip = new osg::DrawElementsUShort(GL_TRIANGLE_STRIP);
    for (int i = 0; i <= sides; ++i)
    {
        const double angle = 2.0 * osg::PI * i / sides;
        for (double x : {left, left + length})
        {
            vertices->push_back(osg::Vec3(float(x), float(radius * std::cos(angle)),
                                          float(radius * std::sin(angle))));
            strip->push_back(GLushort(vertices->size() - 1));
        }
    }
    geometry->setVertexArray(vertices);
    const osg::Vec4 color(0.9f, 0.85f, 0.8f, 1.0f);
    geometry->setColorArray(new osg::Vec4Array(1, &color), osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(strip);
    return named(name, geometry);
}

} // namespace

TEST_F(LabelExtreme, emptyAndBlankTextsAndScenesAreNothing)
{
    EXPECT_EQ(inkShare(flat(nullptr), "emptyScene"), 0.0);
    EXPECT_EQ(inkShare(flat(board("")), "noName"), 0.0);
    EXPECT_EQ(inkShare(flat(board("   ")), "blank"), 0.0);
    EXPECT_EQ(inkShare(flat(board("\xc2\xa0")), "noBreakSpace"), 0.0);
}

TEST_F(LabelExtreme, textsOfAThousandLettersAreShownInFull)
{
    std::string text;
    while (text.size() < 1024)
        text += "The quick brown fox 0123456789. ";
    const auto card =
        named(text, rectangle({-600, 0, -1}, {1200, 0, 0}, {0, 0, 2}, {0.9f, 0.9f, 0.8f, 1}));
    const osg::ref_ptr<osg::Group> model = flat(card);
    // There is room for two of them, with a gap in the middle.
    for (double x : {-520.0, 300.0, 520.0})
        EXPECT_GT(inkShare(model, "thousand", lookFrom({x, -4, 0}, {x, 0, 0}, 4.0)), 0.02) << x;
    text += "X";
    card->setName(text);
    EXPECT_GT(inkShare(model, "thousandAndOne", lookFrom({300, -4, 0}, {300, 0, 0}, 4.0)), 0.02);
    EXPECT_FALSE(_notify.takeWarnings().empty()) << "it is cut, and that is said";
}

TEST_F(LabelExtreme, bytesThatAreNoTextAreReplaced)
{
    EXPECT_GT(inkShare(flat(board("A\xff\xfe\xc0 B")), "invalid"), 0.01);
    EXPECT_GT(inkShare(flat(board("\xed\xa0\x80\xf8\x88")), "surrogates"), 0.01);
    EXPECT_GT(inkShare(flat(board(std::string("A\0B", 3))), "null"), 0.01);
    _notify.takeWarnings(); // what the font lacks
}

TEST_F(LabelExtreme, aFontThatIsMissingIsNamedAndReplaced)
{
    EXPECT_GT(inkShare(flat(board("P-101")), "noFont", fromFront(),
                       std::string(Plain) + ",font=/nowhere/none.ttf"),
              0.01);
    const auto warnings = _notify.takeWarnings();
    ASSERT_FALSE(warnings.empty());
    EXPECT_NE(warnings.front().find("/nowhere/none.ttf"), std::string::npos) << warnings.front();
}

TEST_F(LabelExtreme, needlesAndSpecksDoNoHarm)
{
    const osg::ref_ptr<osg::Group> needle =
        flat(box("NEEDLE", {0, 0, 0}, {5000.0f, 0.0005f, 0.0005f}));
    EXPECT_GE(inkShare(needle, "needle"), 0.0);
    EXPECT_GT(inkShare(needle, "needleNear", lookFrom({0, -0.002, 0}, {0, 0, 0}, 0.002)), 0.02);
    EXPECT_GE(inkShare(flat(box("SPECK", {0, 0, 0}, {1e-20f, 1e-20f, 1e-20f})), "speck"), 0.0);
    EXPECT_GE(inkShare(flat(box("HUGE", {0, 1e15f, 0}, {1e15f, 1e15f, 1e15f})), "huge"), 0.0);
}

TEST_F(LabelExtreme, degenerateMeshesDoNoHarm)
{
    const auto mesh = [](const std::vector<osg::Vec3>& points)
    {
        osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setVertexArray(new osg::Vec3Array(unsigned(points.size()), points.data()));
        geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, int(points.size())));
        const auto root = flat(named("DEGENERATE", geometry));
        root->addChild(board("BOARD"));
        return root;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                inf = std::numeric_limits<float>::infinity();
    EXPECT_GT(inkShare(mesh({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), "point"), 0.01);
    EXPECT_GT(inkShare(mesh({{-1, -0.1f, 0}, {0, -0.1f, 0}, {1, -0.1f, 0}}), "line"), 0.01);
    EXPECT_GT(inkShare(mesh({{nan, 0, 0}, {0, -0.1f, 0}, {1, -0.1f, 1}}), "nan"), 0.01);
    EXPECT_GT(inkShare(mesh({{inf, 0, 0}, {0, -0.1f, 0}, {1, -0.1f, 1}}), "infinite"), 0.01);
    EXPECT_GT(inkShare(mesh({}), "empty"), 0.01);
    EXPECT_GT(inkShare(mesh({{3e38f, 0, 3e38f}, {-3e38f, 0, 3e38f}, {0, 0, -3e38f}}), "largest"),
              -0.5);
    _notify.takeWarnings(); // OSG on boxes that are no numbers
}

TEST_F(LabelExtreme, singularMatricesDoNoHarm)
{
    const osg::Matrix matrices[] = {osg::Matrix::scale(1, 0, 1), osg::Matrix::scale(0, 0, 0),
                                    osg::Matrix::scale(1, 1e-30, 1), osg::Matrix::scale(-1, 1, 1)};
    for (const osg::Matrix& matrix : matrices)
    {
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
        transform->addChild(board("FLAT"));
        EXPECT_GE(inkShare(flat(transform), "singular"), 0.0);
    }
    CameraSpec camera = fromFront();
    camera.projection.makeScale(1, 1, 0);
    EXPECT_GE(inkShare(flat(board("FLAT")), "singularProjection", camera), 0.0);
}

TEST_F(LabelExtreme, aMirroredBoardIsReadableFromBothSides)
{
    // Text is laid out as the viewer sees it, so reflecting the model changes nothing.
    osg::ref_ptr<osg::MatrixTransform> mirror =
        new osg::MatrixTransform(osg::Matrix::scale(-1, 1, 1));
    mirror->addChild(board("READ ME"));
    const Picture actual = render(*labelled(flat(mirror), Plain));
    const Picture expected = render(*labelled(flat(board("READ ME")), Plain));
    EXPECT_TRUE(areAlike(actual, expected, "labelExtreme.mirrored"));
}

TEST_F(LabelExtreme, grazingViewsAreSmooth)
{
    const auto model = flat(board("GRAZING"));
    for (double degrees : {80.0, 89.0, 89.9, 90.0})
    {
        const double angle = osg::DegreesToRadians(degrees);
        EXPECT_GE(inkShare(model, "grazing" + std::to_string(degrees),
                           lookFrom({2.0 * std::sin(angle), -2.0 * std::cos(angle), 0.1}, {0, 0, 0},
                                    2.0)),
                  0.0);
    }
}

TEST_F(LabelExtreme, theEyeMayTouchTheSurface)
{
    const auto model = flat(board("TOUCH"));
    for (double distance : {1e-3, 1e-6, 0.0, -1e-6})
        EXPECT_GE(inkShare(model, "touch" + std::to_string(distance),
                           CameraSpec::perspective({0.3, -distance, 0.1}, {0.3, 1, 0.1}, {0, 0, 1},
                                                   40.0, double(Width) / Height, 1e-4, 10.0)),
                  0.0);
    EXPECT_GE(inkShare(model, "inPlane",
                       CameraSpec::perspective({0, 0, 0}, {1, 0.02, 0}, {0, 0, 1}, 40.0,
                                               double(Width) / Height, 1e-4, 10.0)),
              0.0);
}

TEST_F(LabelExtreme, aModelFarFromTheOriginHasTheSameLabels)
{
    const Picture expected = render(*labelled(flat(board("P-101")), Plain));
    const osg::Vec3d far(1e7, -2e7, 3e6);
    osg::ref_ptr<osg::MatrixTransform> transform =
        new osg::MatrixTransform(osg::Matrix::translate(far));
    transform->addChild(board("P-101"));
    CameraSpec camera = fromFront();
    camera.view = osg::Matrixd::translate(-far) * camera.view;
    EXPECT_TRUE(
        areAlike(render(*labelled(flat(transform), Plain), camera), expected, "labelExtreme.far"));
}

TEST_F(LabelExtreme, oneGlyphOfALongPipeLiesWhereItDoesNearTheOrigin)
{
    // A glyph fills the picture. The same pipe, modelled so that what is seen lies at the origin,
    // is the truth; a millionth of the pipe would be several letters.
    const double length = 65536.0;
    const auto longPipe = labelled(flat(pipe("P-101-A", -length / 2, length, 1.0f)), Plain);
    unsigned int marked = 0;
    for (double at : {0.0, 8192.0, 20480.0, 32000.0})
    {
        const auto nearPipe =
            labelled(flat(pipe("P-101-A", -length / 2 - at, length, 1.0f)), Plain);
        for (double step : {0.0, 0.37, 0.81})
        {
            const auto camera = [&](double x) {
                return lookFrom({x + step, -2.2, 0}, {x + step, 0, 0}, 1.2);
            };
            const Picture actual = render(*longPipe, camera(at));
            const Picture expected = render(*nearPipe, camera(0.0));
            ASSERT_TRUE(actual && expected);
            keep(expected, "labelExtreme.pipe");
            marked += changedShare(*actual, *render(*longPipe->getChild(0), camera(at))) > 0.01;
            // A pixel along the outline of letters may differ.
            EXPECT_LE(support::difference(*actual, *expected, 0.25).getShareOver(), 0.005)
                << at << " + " << step;
        }
    }
    EXPECT_GT(marked, 6u) << "most of the places have a letter";
}

TEST_F(LabelExtreme, aMillionRepetitionsAreEachInPlace)
{
    // Letters of height 1, 5.6 from text to text.
    const double length = 6e6;
    const auto scene = labelled(flat(pipe("P-101-A", -length / 2, length, 1.0f)), Plain);
    for (double x : {0.0, 1e6, -2.9e6})
    {
        const Picture picture = renderNumbers(*scene, "million" + std::to_string(int(x)),
                                              lookFrom({x, -9, 0}, {x, 0, 0}, 9.0));
        ASSERT_TRUE(picture);
        EXPECT_GT(changedShare(*picture, *renderNumbers(*scene->getChild(0), "million.bare",
                                                        lookFrom({x, -9, 0}, {x, 0, 0}, 9.0))),
                  0.002)
            << x;
    }
}
