// SPDX-License-Identifier: MIT
// Ink that chooses itself: one colour a letter, whatever crosses it, and always to be read.
#include "InkReadings.h"

#include <osg/Light>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/ShapeDrawable>
#include <osg/Texture2D>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <vector>

using namespace inkReadings;
using labelScene::fromFront;
using labelScene::named;
using labelScene::rectangle;
using labelScene::unlit;

namespace
{

/// Letters that hang together. A plate ends with its text, so that at the rim of a sphere less than
/// a pixel of it would be beside the last letter.
constexpr char Name[] = " HELUNTS ";

osg::ref_ptr<osg::Texture2D> greyTexture(const std::function<float(float, float)>& grey)
{
    constexpr int Texels = 256;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(Texels, Texels, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < Texels; ++y)
        for (int x = 0; x < Texels; ++x)
        {
            const float value = grey((float(x) + 0.5f) / Texels, (float(y) + 0.5f) / Texels);
            std::fill_n(image->data(x, y), 3,
                        static_cast<unsigned char>(std::lround(255.0f * value)));
        }
    return new osg::Texture2D(image);
}

/// With a picture on it, not lit.
osg::ref_ptr<osg::Node> textured(osg::Geometry* geometry, osg::Vec2Array* at,
                                 const std::function<float(float, float)>& grey)
{
    geometry->setTexCoordArray(0, at);
    const auto geode = named(Name, geometry);
    geode->getOrCreateStateSet()->setTextureAttributeAndModes(0, greyTexture(grey));
    geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    return geode;
}

/// A board.
osg::ref_ptr<osg::Node> painted(const std::function<float(float, float)>& grey)
{
    const auto quad = rectangle({-1.2f, 0, -0.8f}, {2.4f, 0, 0}, {0, 0, 1.6f}, {1, 1, 1, 1});
    osg::ref_ptr<osg::Vec2Array> at = new osg::Vec2Array;
    for (const osg::Vec3& v : static_cast<const osg::Vec3Array&>(*quad->getVertexArray()))
        at->push_back({(v.x() + 1.2f) / 2.4f, (v.z() + 0.8f) / 1.6f});
    return textured(quad, at, grey);
}

/// A sheet that is bent by three quarters of a turn around z, open to where y is greatest.
osg::ref_ptr<osg::Node> arch(const std::function<float(float, float)>& grey)
{
    constexpr int Steps = 60;
    osg::ref_ptr<osg::Vec3Array> points = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec2Array> at = new osg::Vec2Array;
    for (int i = 0; i <= Steps; ++i)
        for (const float t : {0.0f, 1.0f})
        {
            const float s = float(i) / Steps, angle = 1.5f * float(osg::PI) * (s - 0.5f);
            points->push_back({0.9f * std::sin(angle), -0.9f * std::cos(angle), 1.2f * t - 0.6f});
            at->push_back({s, t});
        }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(points);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, GLsizei(points->size())));
    return textured(geometry, at, grey);
}

/// A lit dark shape, with a highlight that is white.
osg::ref_ptr<osg::Node> shiny(osg::Shape* shape)
{
    osg::ref_ptr<osg::TessellationHints> fine = new osg::TessellationHints;
    fine->setDetailRatio(3.0f);
    const auto geode = named(Name, new osg::ShapeDrawable(shape, fine));
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0.25f, 0.3f, 0.5f, 1));
    material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, 1));
    material->setShininess(osg::Material::FRONT_AND_BACK, 12.0f);
    osg::ref_ptr<osg::Group> group = new osg::Group;
    osg::ref_ptr<osg::LightSource> lamp = new osg::LightSource;
    lamp->getLight()->setPosition(osg::Vec4(-0.6f, -1.0f, 0.5f, 0.0f));
    lamp->getLight()->setDiffuse(osg::Vec4(1, 1, 1, 1));
    lamp->getLight()->setSpecular(osg::Vec4(1, 1, 1, 1));
    osg::StateSet& state = *group->getOrCreateStateSet();
    state.setAttributeAndModes(material, osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
    state.setMode(GL_LIGHTING, osg::StateAttribute::ON);
    lamp->setStateSetModes(state, osg::StateAttribute::ON);
    group->addChild(lamp);
    group->addChild(geode);
    return group;
}

support::CameraSpec from(const osg::Vec3d& eye)
{
    return support::CameraSpec::perspective(eye, {0, 0, 0}, {0, 0, 1}, 35.0, double(Wide) / High,
                                            0.1, 20.0);
}

class LabelInk : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(viewer()); }

    support::NotifyCapture _notify;
};

} // namespace

TEST_F(LabelInk, edgesAndRampsDoNotSplitALetter)
{
    const std::pair<const char*, std::function<float(float, float)>> pictures[] = {
        {"ramp", [](float x, float) { return x; }},
        {"slope", [](float x, float y) { return 0.5f * x + 0.5f * y; }},
        {"edge", [](float x, float) { return x < 0.46f ? 0.05f : 0.9f; }},
        {"level", [](float, float y) { return y < 0.52f ? 0.05f : 0.9f; }},
        {"highlight",
         [](float x, float y)
         {
             return std::min(
                 0.2f + std::exp(-60.0f * (std::pow(x - 0.35f, 2.0f) + std::pow(y - 0.5f, 2.0f))),
                 1.0f);
         }},
        {"stripes", [](float x, float) { return 0.5f + 0.5f * std::sin(60.0f * x); }}};
    for (const auto& [name, grey] : pictures)
        expectReadable(readingsOf(painted(grey), fromFront(), name), name, 7);
}

TEST_F(LabelInk, blackOnWhiteAndWhiteOnBlackAreLeftAsTheyAre)
{
    const Readings dark =
        readingsOf(painted([](float, float) { return 0.1f; }), fromFront(), "dark");
    EXPECT_EQ(dark.black, 0);
    EXPECT_GT(dark.white, 0);
    const Readings bright =
        readingsOf(painted([](float, float) { return 0.9f; }), fromFront(), "bright");
    EXPECT_EQ(bright.white, 0);
    EXPECT_GT(bright.black, 0);
    EXPECT_NEAR(bright.worst, contrast(0.0, luminanceOf({0.9f, 0.9f, 0.9f, 1})), 0.3)
        << "no plate where none is needed";
}

TEST_F(LabelInk, highlightsOnRoundShapesDoNotSplitALetter)
{
    const std::pair<const char*, osg::ref_ptr<osg::Shape>> shapes[] = {
        {"cylinder", new osg::Cylinder(osg::Vec3(), 0.6f, 1.6f)},
        {"sphere", new osg::Sphere(osg::Vec3(), 0.9f)},
        {"cone", new osg::Cone(osg::Vec3(0, 0, -0.2f), 0.9f, 1.6f)},
        {"box", new osg::Box(osg::Vec3(), 1.6f, 1.0f, 1.2f)}};
    for (const auto& [name, shape] : shapes)
        for (int turn = 0; turn < 4; ++turn)
        {
            const double angle = 0.7 * turn - 1.0;
            const auto camera = support::CameraSpec::perspective(
                {3.2 * std::sin(angle), -3.2 * std::cos(angle), 0.5 * turn - 0.4}, {0, 0, 0},
                {0, 0, 1}, 35.0, double(Wide) / High, 0.5, 20.0);
            const std::string each = std::string(name) + std::to_string(turn);
            expectReadable(readingsOf(shiny(shape), camera, each), each, 7);
        }
}

TEST_F(LabelInk, surfacesThatAreLabelledAsTheyAreDrawnHaveOneInk)
{
    const auto board = painted([](float x, float) { return x; });
    board->getOrCreateStateSet()->setRenderBinDetails(10, "DepthSortedBin");
    expectReadable(readingsOf(board, fromFront(), "sorted"), "sorted", 7);
}

TEST_F(LabelInk, whatHidesALineDoesNotChooseItsInk)
{
    // Over the middle of the line, all along or but for an end, a bar of the opposite brightness.
    for (const float grey : {0.1f, 0.9f})
        for (const float left : {-1.3f, -0.7f})
        {
            const osg::ref_ptr<osg::Group> group = new osg::Group;
            group->addChild(painted([&](float, float) { return grey; }));
            const float other = 1.0f - grey;
            group->addChild(unlit(named("", rectangle({left, -0.5f, -0.04f}, {2.6f, 0, 0},
                                                      {0, 0, 0.08f}, {other, other, other, 1}))));
            const std::string name = "barred" + std::to_string(int(100.0f * (grey + left)));
            const Readings found = readingsOf(group, fromFront(), name);
            EXPECT_GE(found.letters, 7) << name;
            EXPECT_EQ(grey < 0.5f ? found.black : found.white, 0) << name;
            EXPECT_GT(grey < 0.5f ? found.white : found.black, 100) << name;
        }
}

TEST_F(LabelInk, alongTextureCoordinatesOnFlatSurfacesATextHasOneInk)
{
    const auto ramp = [](float x, float) { return x; };
    const auto edge = [](float x, float) { return x < 0.46f ? 0.05f : 0.9f; };
    const std::tuple<const char*, osg::ref_ptr<osg::Node>, support::CameraSpec> models[] = {
        {"frontal", painted(ramp), fromFront()},
        {"oblique", painted(ramp), from({2.6, -2.2, 0.3})},
        {"near", painted(edge), from({1.6, -0.8, 0.2})}};
    for (const auto& [name, model, camera] : models)
        expectOneInk(readingsOf(model, camera, std::string("textured.") + name, "texcoord=0"), name,
                     7);
}

TEST_F(LabelInk, alongTextureCoordinatesOnBentSurfacesAnObjectHasOneInk)
{
    const std::pair<const char*, osg::ref_ptr<osg::Node>> models[] = {
        {"cylinder", shiny(new osg::Cylinder(osg::Vec3(), 0.6f, 1.6f))},
        {"sphere", shiny(new osg::Sphere(osg::Vec3(), 0.9f))},
        {"cone", shiny(new osg::Cone(osg::Vec3(0, 0, -0.2f), 0.9f, 1.6f))},
        {"arch", arch([](float x, float) { return x; })},
        {"stripedArch", arch([](float x, float) { return 0.5f + 0.5f * std::sin(60.0f * x); })}};
    for (const auto& [name, model] : models)
    {
        int letters = 0;
        for (int turn = 0; turn < 6; ++turn)
        {
            const std::string each = std::string("textured.") + name + std::to_string(turn);
            const double angle = turn;
            const Readings found = readingsOf(
                model, from({3.2 * std::sin(angle), -3.2 * std::cos(angle), 0.8 - 0.4 * turn}),
                each, "texcoord=0", Beside::Plates);
            expectOneInk(found, each, 0);
            letters += found.letters;
        }
        EXPECT_GE(letters, 7) << name;
    }
}

TEST_F(LabelInk, whatHidesTheMiddleOfABentSurfaceDoesNotSplitItsInk)
{
    // Bars of the opposite brightness, over a part of the places that are asked, and over all.
    for (const float half : {0.05f, 0.12f, 0.3f})
    {
        const osg::ref_ptr<osg::Group> group = new osg::Group;
        group->addChild(arch([](float x, float) { return x; }));
        group->addChild(unlit(named("", rectangle({-0.5f, -2.0f, -half}, {1.0f, 0, 0},
                                                  {0, 0, 2.0f * half}, {0, 0, 0, 1}))));
        const std::string name = "barredArch" + std::to_string(int(100.0f * half));
        const Readings found =
            readingsOf(group, from({0.4, -3.2, 0.3}), name, "texcoord=0", Beside::Plates);
        EXPECT_EQ(std::min(found.black, found.white), 0) << name;
        EXPECT_GT(found.letters, 0) << name;
    }
}
