// SPDX-License-Identifier: MIT
// Texts, meshes and matrices that are none: no GL error, no pixel that is no number, the right
// letters or none. Places of the eye: LabelDistanceGLTest.
#include "ExtremePictures.h"

#include <osg/MatrixTransform>

#include <cmath>
#include <limits>
#include <set>

using namespace labelScene;
using support::CameraSpec;

namespace
{

class LabelExtreme : public PictureTest
{
};

/// Of that board, to compare with.
Picture pictureOf(const std::string& text)
{
    return drawInk(unlit(board(text)), "expected").with;
}

} // namespace

TEST_F(LabelExtreme, emptyAndBlankTextsAndScenesAreNothing)
{
    EXPECT_TRUE(
        areEqual(render(*labelled(unlit(), Plain)), render(*unlit()), "labelExtreme.empty"));
    for (const char* text : {"", "   ", "\xc2\xa0"})
    {
        const InkPictures blank = drawInk(unlit(board(text)), "blank");
        EXPECT_GT(blank.modelShare(), 0.4);
        EXPECT_EQ(blank.inkShare(), 0.0) << '"' << text << '"';
    }
}

TEST_F(LabelExtreme, textsOfAThousandLettersAreShownInFull)
{
    std::string text;
    while (text.size() < 1024)
        text += "The quick brown fox 0123456789. ";
    const auto card =
        named(text, rectangle({-600, 0, -1}, {1200, 0, 0}, {0, 0, 2}, {0.9f, 0.9f, 0.8f, 1}));
    const osg::ref_ptr<osg::Group> model = unlit(card);
    // There is room for two of them, with a gap in the middle.
    for (double x : {-520.0, 300.0, 520.0})
        EXPECT_GT(drawInk(model, "thousand", lookFrom({x, -4, 0}, {x, 0, 0}, 4.0)).inkShare(), 0.02)
            << x;
    EXPECT_EQ(drawInk(model, "thousandGap", lookFrom({0, -4, 0}, {0, 0, 0}, 4.0)).inkShare(), 0.0);
    const Picture expected =
        drawInk(model, "thousandCut", lookFrom({300, -4, 0}, {300, 0, 0}, 4.0)).with;
    text += "X";
    card->setName(text);
    EXPECT_TRUE(
        areEqual(drawInk(model, "thousandAndOne", lookFrom({300, -4, 0}, {300, 0, 0}, 4.0)).with,
                 expected, "labelExtreme.thousandAndOne"));
    EXPECT_FALSE(_notify.takeWarnings().empty()) << "it is cut, and that is said";
}

TEST_F(LabelExtreme, bytesThatAreNoTextAreReplaced)
{
    const std::string replaced = "\xef\xbf\xbd";
    const auto expectAs =
        [](const std::string& bytes, const std::string& text, const std::string& name)
    {
        const InkPictures actual = drawInk(unlit(board(bytes)), name);
        EXPECT_GT(actual.inkShare(), 0.01) << name;
        EXPECT_TRUE(areEqual(actual.with, pictureOf(text), "labelExtreme." + name));
    };
    expectAs("A\xff\xfe\xc0 B", "A" + replaced + replaced + replaced + " B", "invalid");
    expectAs("\xed\xa0\x80\xf8\x88", replaced + replaced + replaced + replaced + replaced,
             "surrogates");
    expectAs(std::string("A\0B", 3), "A B", "null");
    _notify.takeWarnings(); // what the font lacks
}

TEST_F(LabelExtreme, aFontThatIsMissingIsNamedAndReplaced)
{
    const InkPictures actual = drawInk(unlit(board("P-101")), "noFont", fromFront(),
                                       std::string(Plain) + ",font=/nowhere/none.ttf");
    const auto warnings = _notify.takeWarnings();
    ASSERT_FALSE(warnings.empty());
    EXPECT_NE(warnings.front().find("/nowhere/none.ttf"), std::string::npos) << warnings.front();
    EXPECT_GT(actual.inkShare(), 0.01);
    EXPECT_TRUE(areEqual(actual.with, pictureOf("P-101"), "labelExtreme.noFont"));
}

TEST_F(LabelExtreme, aNeedleHasTextNearByAndATintFromAfar)
{
    const osg::ref_ptr<osg::Group> needle =
        unlit(box("NEEDLE", {0, 0, 0}, {5000.0f, 0.0005f, 0.0005f}));
    const InkPictures near =
        drawInk(needle, "needleNear", lookFrom({0, -0.002, 0}, {0, 0, 0}, 0.002));
    EXPECT_GT(near.inkShare(), 0.05);
    // Raised by half a pixel it shows in one row of them. Twenty letters lie in each of its pixels:
    // what lies on text has the tint of all letters, and what lies between texts none.
    osg::ref_ptr<osg::MatrixTransform> raised =
        new osg::MatrixTransform(osg::Matrix::translate(0, 0, 1.0 / Height));
    raised->addChild(needle);
    const InkPictures far = drawInk(raised, "needle");
    ASSERT_TRUE(far.with && far.without);
    EXPECT_DOUBLE_EQ(far.modelShare(), 1.0 / Height);
    EXPECT_GT(far.inkShare(), 0.3 / Height);
    EXPECT_LT(far.inkShare(), 0.9 / Height);
    const float bare = far.without->getColor(0, Height / 2).r();
    std::set<int> tints;
    for (int x = 0; x < Width; ++x)
        tints.insert(
            int(std::lround(100.0f * far.with->getColor(unsigned(x), Height / 2).r() / bare)));
    ASSERT_EQ(tints.size(), 2u);
    EXPECT_EQ(*tints.rbegin(), 100);
    EXPECT_GT(*tints.begin(), 60);
    EXPECT_LT(*tints.begin(), 90);
}

TEST_F(LabelExtreme, anySizeShowsTheSame)
{
    const auto draw = [](float size, const std::string& name)
    {
        return drawInk(unlit(box("SIZE", {0, 0, 0}, osg::Vec3(1.0f, 0.4f, 0.5f) * size)), name,
                       lookFrom(osg::Vec3d(-1, -4, 1) * size, {0, 0, 0}, 4.0 * size));
    };
    const InkPictures expected = draw(1.0f, "size");
    EXPECT_GT(expected.inkShare(), 0.01);
    // Powers of two, so that nothing is rounded.
    for (int power : {-50, -40, -20, 20, 40, 50})
        EXPECT_TRUE(areAlike(draw(std::ldexp(1.0f, power), "size").with, expected.with,
                             "labelExtreme.size" + std::to_string(power)));
}

TEST_F(LabelExtreme, aSpeckIsNotSeen)
{
    const InkPictures speck =
        drawInk(unlit(box("SPECK", {0, 0, 0}, {1e-20f, 1e-20f, 1e-20f})), "speck");
    EXPECT_EQ(speck.modelShare(), 0.0);
    EXPECT_EQ(speck.inkShare(), 0.0);
}

TEST_F(LabelExtreme, betweenTwoHugeLettersLiesNothing)
{
    const InkPictures huge =
        drawInk(unlit(box("HUGE", {0, 1e15f, 0}, {1e15f, 1e15f, 1e15f})), "huge");
    EXPECT_GT(huge.modelShare(), 0.4);
    EXPECT_EQ(huge.inkShare(), 0.0);
}

TEST_F(LabelExtreme, degenerateMeshesDoNoHarm)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                inf = std::numeric_limits<float>::infinity();
    const std::pair<const char*, std::vector<osg::Vec3>> meshes[] = {
        {"point", {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}},
        {"line", {{-1, -0.1f, 0}, {0, -0.1f, 0}, {1, -0.1f, 0}}},
        {"nan", {{nan, 0, 0}, {0, -0.1f, 0}, {1, -0.1f, 1}}},
        {"infinite", {{inf, 0, 0}, {0, -0.1f, 0}, {1, -0.1f, 1}}},
        {"none", {}},
        {"largest", {{3e38f, 0, 3e38f}, {-3e38f, 0, 3e38f}, {0, 0, -3e38f}}}};
    const Picture alone = pictureOf("BOARD");
    for (const auto& [name, points] : meshes)
    {
        osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setVertexArray(new osg::Vec3Array(unsigned(points.size()), points.data()));
        geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, int(points.size())));
        const auto root = unlit(named("DEGENERATE", geometry));
        root->addChild(board("BOARD"));
        // None of them covers a pixel, so that the board looks as it does alone.
        EXPECT_TRUE(areEqual(drawInk(root, name).with, alone, std::string("labelExtreme.") + name));
    }
    _notify.takeWarnings(); // OSG on boxes that are no numbers
}

TEST_F(LabelExtreme, matricesWithoutAnInverseKeepTheLook)
{
    const auto draw = [](const osg::Vec3d& scale, const std::string& name)
    {
        osg::ref_ptr<osg::MatrixTransform> transform =
            new osg::MatrixTransform(osg::Matrix::scale(scale));
        transform->addChild(board("FLAT"));
        return drawInk(unlit(transform), name);
    };
    // The board has no depth to lose: it looks as one that is not squeezed, without its text where
    // nothing says any more where a point lies.
    for (double depth : {0.0, 1e-300, 1e-30, 1e-12})
    {
        const InkPictures flat = draw({1, depth, 1}, "singularFlat");
        EXPECT_GT(flat.modelShare(), 0.4) << depth;
        EXPECT_EQ(flat.inkShare(), 0.0) << depth;
    }
    const Picture expected = pictureOf("FLAT");
    for (double depth : {1e-8, 1e-5})
        EXPECT_TRUE(areAlike(draw({1, depth, 1}, "thin").with, expected, "labelExtreme.thin"));
    EXPECT_TRUE(areAlike(draw({-1, 1, 1}, "mirror").with, expected, "labelExtreme.mirror"));
    const InkPictures point = draw({0, 0, 0}, "singularPoint");
    EXPECT_EQ(point.modelShare(), 0.0);
    EXPECT_EQ(point.inkShare(), 0.0);
    CameraSpec camera = fromFront();
    camera.projection.makeScale(1, 1, 0);
    const InkPictures projected = drawInk(unlit(board("FLAT")), "singularProjection", camera);
    EXPECT_GT(projected.modelShare(), 0.4);
    EXPECT_EQ(projected.inkShare(), 0.0);
}

TEST_F(LabelExtreme, aMirroredBoardIsReadableFromBothSides)
{
    // Text is laid out as the viewer sees it, so reflecting the model changes nothing.
    osg::ref_ptr<osg::MatrixTransform> mirror =
        new osg::MatrixTransform(osg::Matrix::scale(-1, 1, 1));
    mirror->addChild(board("READ ME"));
    const Picture actual = render(*labelled(unlit(mirror), Plain));
    const Picture expected = render(*labelled(unlit(board("READ ME")), Plain));
    EXPECT_TRUE(areAlike(actual, expected, "labelExtreme.mirrored"));
}
