// SPDX-License-Identifier: MIT
// Ink that chooses itself: one colour a letter, whatever crosses it, and always to be read.
#include "LabelPictures.h"

#include <support/NotifyCapture.h>

#include <osg/Light>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/ShapeDrawable>
#include <osg/Texture2D>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <tuple>
#include <vector>

using namespace labelScene;

namespace
{

constexpr int Wide = 480, High = 360;
constexpr char Marked[] = "ink=#ff00ff,plate=off"; // a colour that no scene has

/// Letters that hang together. A plate ends with its text, so that at the rim of a sphere less than
/// a pixel of it would be beside the last letter.
constexpr char Name[] = " HELUNTS ";

support::HeadlessViewer& inkViewer()
{
    static support::HeadlessViewer theViewer({Wide, High});
    theViewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    return theViewer;
}

double luminanceOf(const osg::Vec4& color)
{
    const auto linear = [](double c)
    { return c < 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b());
}

double contrast(double a, double b)
{
    return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

/// What shows that a model's letters can be read.
struct Readings
{
    int letters = 0, black = 0, white = 0; ///< Black and white pixels of ink.
    int twoColored = 0;                    ///< Letters.
    double worst = 21.0;                   ///< Contrast of ink to what surrounds it.
};

/// Pixels that are ink through and through, by letters, which are those that hang together.
std::vector<std::vector<int>> lettersOf(const osg::Image& marked)
{
    const auto isInk = [&](int at)
    { return marked.getColor(unsigned(at % Wide), unsigned(at / Wide)) == osg::Vec4(1, 0, 1, 1); };
    std::vector<bool> seen(std::size_t(Wide) * High);
    std::vector<std::vector<int>> letters;
    for (int start = 0; start < Wide * High; ++start)
    {
        if (seen[std::size_t(start)] || !isInk(start))
            continue;
        std::vector<int> letter, open{start};
        seen[std::size_t(start)] = true;
        while (!open.empty())
        {
            const int at = open.back();
            open.pop_back();
            letter.push_back(at);
            for (const int next : {at - 1, at + 1, at - Wide, at + Wide})
                if (next >= 0 && next < Wide * High && !seen[std::size_t(next)] && isInk(next))
                {
                    seen[std::size_t(next)] = true;
                    open.push_back(next);
                }
        }
        if (letter.size() > 8)
            letters.push_back(letter);
    }
    return letters;
}

/// Compares the model's labels in ink that chooses itself with the same in a colour of their own.
Readings readingsOf(osg::Node* model, const support::CameraSpec& camera, const std::string& name,
                    const std::string& settings = "")
{
    const std::string both = Marked + (settings.empty() ? "" : "," + settings);
    const Picture marked = inkViewer().render(labelled(model, both), camera, Wide, High, 2);
    const Picture picture = inkViewer().render(labelled(model, settings), camera, Wide, High, 2);
    keep(picture, "labelInk." + name);
    const auto at = [](const osg::Image& image, int pixel)
    { return image.getColor(unsigned(pixel % Wide), unsigned(pixel / Wide)); };
    // Without any ink, as far as 8 bits tell.
    const Picture bare = inkViewer().render(model, camera, Wide, High, 2);
    const auto isBare = [&](int pixel) { return at(*marked, pixel) == at(*bare, pixel); };
    // Where a bent surface turns away, what is beside a letter may be beside its text.
    Picture plates;
    if (!settings.empty())
        plates = inkViewer().render(labelled(model, "ink=#00ff00,plate=#00ff00," + settings),
                                    camera, Wide, High, 2);
    const auto isBeside = [&](int pixel)
    { return plates && at(*plates, pixel) != osg::Vec4(0, 1, 0, 1); };
    // What surrounds a pixel of ink: the first ones without any, beyond an edge that is smoothed
    // over a pixel or two.
    const auto worstAround = [&](int pixel, double ink)
    {
        double worst = 21.0;
        for (int direction = 0; direction < 9; ++direction)
            for (int step = 1; step <= 3; ++step)
            {
                const int x = pixel % Wide + step * (direction % 3 - 1);
                const int y = pixel / Wide + step * (direction / 3 - 1);
                const int next = y * Wide + x;
                if (x < 0 || x >= Wide || y < 0 || y >= High || !isBare(next))
                    continue;
                if (isBeside(next))
                    break;
                worst = std::min(worst, contrast(ink, luminanceOf(at(*picture, next))));
                break;
            }
        return worst;
    };
    Readings found;
    for (const std::vector<int>& letter : lettersOf(*marked))
    {
        int black = 0, white = 0;
        for (const int pixel : letter)
        {
            const double ink = luminanceOf(at(*picture, pixel));
            black += ink < 0.01;
            white += ink > 0.99;
            found.worst = std::min(found.worst, worstAround(pixel, ink));
        }
        EXPECT_EQ(std::size_t(black + white), letter.size()) << name << ": ink is black or white";
        found.twoColored += black && white;
        found.black += black;
        found.white += white;
        ++found.letters;
    }
    return found;
}

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

void expectReadable(const Readings& found, const std::string& name)
{
    EXPECT_GE(found.letters, 7) << name;
    EXPECT_EQ(found.twoColored, 0) << name << ": letters of two colours";
    EXPECT_GE(found.worst, 4.5) << name;
    std::cout << name << ": " << found.letters << " letters, contrast at least " << found.worst
              << ", " << found.black << " black and " << found.white << " white pixels\n";
}

/// That, and that no pixel of the model has another ink.
void expectOneInk(Readings found, const std::string& name, int leastLetters)
{
    EXPECT_EQ(std::min(found.black, found.white), 0) << name;
    EXPECT_GE(found.letters, leastLetters) << name;
    found.letters = std::max(found.letters, 7); // some are turned away
    expectReadable(found, name);
}

support::CameraSpec from(const osg::Vec3d& eye)
{
    return support::CameraSpec::perspective(eye, {0, 0, 0}, {0, 0, 1}, 35.0, double(Wide) / High,
                                            0.1, 20.0);
}

class LabelInk : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(inkViewer()); }

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
        expectReadable(readingsOf(painted(grey), fromFront(), name), name);
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
            Readings found = readingsOf(shiny(shape), camera, each);
            found.letters = std::max(found.letters, 7); // some are turned away
            expectReadable(found, each);
        }
}

TEST_F(LabelInk, surfacesThatAreLabelledAsTheyAreDrawnHaveOneInk)
{
    const auto board = painted([](float x, float) { return x; });
    board->getOrCreateStateSet()->setRenderBinDetails(10, "DepthSortedBin");
    expectReadable(readingsOf(board, fromFront(), "sorted"), "sorted");
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
                each, "texcoord=0");
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
        const Readings found = readingsOf(group, from({0.4, -3.2, 0.3}), name, "texcoord=0");
        EXPECT_EQ(std::min(found.black, found.white), 0) << name;
        EXPECT_GT(found.letters, 0) << name;
    }
}
