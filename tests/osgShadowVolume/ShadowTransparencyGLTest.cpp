// SPDX-License-Identifier: MIT
#include "VolumePictures.h"

#include <support/NotifyCapture.h>

#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/Program>
#include <osg/Texture2D>
#include <osg/ValueObject>

#include <algorithm>
#include <cmath>

using namespace volumeScene;
using floorScene::fromAbove;
using osgShadowVolume::ShadowedScene;
using osgShadowVolume::TransparentCasters;
using Picture = osg::ref_ptr<osg::Image>;

namespace
{

class ShadowTransparency : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(floorScene::viewer()); }

    support::NotifyCapture _notify;
};

osg::ref_ptr<osg::Material> material(const osg::Vec3& color, float alpha)
{
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(color, alpha));
    material->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 0, 0, alpha));
    return material;
}

/// What casts nothing and is lit in `color`.
void color(osg::Node& node, const osg::Vec3& color)
{
    node.getOrCreateStateSet()->setAttribute(material(color, 1.0f));
    node.setUserValue("castShadow", false);
}

/// ... and adds its colour to what is behind, which is the same in any order.
void blend(osg::Node& node, const osg::Vec3& color, float alpha = 0.3f)
{
    osg::StateSet* state = node.getOrCreateStateSet();
    state->setAttribute(material(color, alpha));
    state->setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ONE));
    state->setAttribute(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
    state->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
}

/// A square over the whole picture.
osg::ref_ptr<osg::Geode> pane(float z)
{
    osg::ref_ptr<osg::Geode> pane = floorScene::rectangle({-4, -4, z}, {8, 0, 0}, {0, 8, 0});
    pane->setUserValue("castShadow", false);
    return pane;
}

/// A box at z = 5 under a slanted light: its shadow lies elsewhere at each height.
osg::ref_ptr<ShadowedScene> sceneWithBox()
{
    const auto scene = shadowed();
    scene->addChild(moved({1.5f, 0.3f, 5}, box({}, 1)));
    scene->addChild(floorScene::lightSource(0, osg::Vec4(0.6f, 0.1f, 1, 0)));
    return scene;
}

/// The channels of pictures of panes, each alone and opaque: what panes that add must sum up to.
Picture sumOf(const std::vector<Picture>& pictures)
{
    const Picture sum = new osg::Image(*pictures[0], osg::CopyOp::DEEP_COPY_ALL);
    for (std::size_t i = 1; i < pictures.size(); ++i)
        for (int y = 0; y < sum->t(); ++y)
            for (int x = 0; x < sum->s(); ++x)
                for (int c = 0; c < 3; ++c)
                    sum->data(x, y)[c] = static_cast<unsigned char>(
                        std::min(255, sum->data(x, y)[c] + pictures[i]->data(x, y)[c]));
    return sum;
}

const osg::Vec3 Colors[] = {{0.9f, 0, 0}, {0, 0.9f, 0}, {0, 0, 0.9f}, {0.4f, 0, 0}, {0, 0.4f, 0}};

/// Panes at 0, 1, 2, … seen from above, lowest first. The box covers part of them.
Picture panes(unsigned int count, bool blended, int only = -1, unsigned int layers = 4)
{
    const auto scene = sceneWithBox();
    scene->setTransparentLayers(layers);
    // The box itself is black: it only hides.
    scene->getChild(0)->getOrCreateStateSet()->setAttribute(material({}, 1.0f));
    osg::ref_ptr<osg::Geode> ground = pane(-1);
    color(*ground, {});
    scene->addChild(ground);
    for (unsigned int i = 0; i < count; ++i)
    {
        if (only >= 0 && only != int(i))
            continue;
        const auto one = pane(float(i) * 0.7f);
        if (blended)
            blend(*one, Colors[i]);
        else
            color(*one, Colors[i]);
        scene->addChild(one);
    }
    return render(*scene, fromAbove());
}

/// Pictures of each pane, opaque and alone, added.
Picture expectedPanes(unsigned int count)
{
    std::vector<Picture> alone;
    for (unsigned int i = 0; i < count; ++i)
        alone.push_back(panes(count, false, int(i)));
    return sumOf(alone);
}

/// Sums of rounded values: a step for each addend.
testing::AssertionResult areSums(const osg::Image* actual, const osg::Image* expected,
                                 const std::string& name)
{
    keep(actual, name);
    return support::CompareImage{3.0 / 255.0, 0.0, 3.0 / 255.0}(actual, expected, name);
}

} // namespace

TEST_F(ShadowTransparency, aPaneIsShadowedWhereAnOpaqueOneIs)
{
    const Picture expected = expectedPanes(1);
    ASSERT_TRUE(expected);
    EXPECT_GT(darkShare(*expected), 0.02);
    EXPECT_TRUE(areSums(panes(1, true), expected, "transparency.pane"));
}

TEST_F(ShadowTransparency, panesBehindEachOtherEachHaveTheirOwnShadow)
{
    for (unsigned int count : {2u, 3u, 4u})
        EXPECT_TRUE(areSums(panes(count, true), expectedPanes(count),
                            "transparency.panes" + std::to_string(count)));
}

TEST_F(ShadowTransparency, panesBeyondTheLimitTakeTheNearestLayersShadow)
{
    // Seen from above the topmost two have their own; the lowest takes that of the second.
    const Picture three = panes(3, true, -1, 2), exact = expectedPanes(3);
    ASSERT_TRUE(three && exact);
    keep(three, "transparency.limit");
    int greenAndBlue = 0, redAsGreen = 0, redLit = 0;
    for (int y = 0; y < three->t(); ++y)
        for (int x = 0; x < three->s(); ++x)
        {
            const unsigned char *actual = three->data(x, y), *truth = exact->data(x, y);
            greenAndBlue +=
                std::abs(actual[1] - truth[1]) > 3 || std::abs(actual[2] - truth[2]) > 3;
            redLit += actual[0] > 100;
            redAsGreen += (actual[0] > 100) == (actual[1] > 100);
        }
    EXPECT_EQ(greenAndBlue, 0);
    EXPECT_EQ(redAsGreen, three->s() * three->t());
    EXPECT_GT(redLit, 1000);
    // The limit raised, all are exact.
    EXPECT_TRUE(areSums(panes(5, true, -1, 5), expectedPanes(5), "transparency.five"));
}

TEST_F(ShadowTransparency, withoutLayersTransparentSurfacesKeepTheirLight)
{
    const Picture none = panes(2, true, -1, 0);
    ASSERT_TRUE(none);
    keep(none, "transparency.noLayers");
    int dark = 0;
    for (int y = 0; y < none->t(); ++y)
        for (int x = 0; x < none->s(); ++x)
            dark += none->data(x, y)[0] < 100 || none->data(x, y)[1] < 100;
    EXPECT_EQ(dark, 32 * 32) << "only the box is black";
}

TEST_F(ShadowTransparency, lightsOfManyWordsReachEachLayer)
{
    // 40 lights are two words of the mask.
    const auto build = [](bool blended, int only)
    {
        const auto scene = shadowed();
        scene->addChild(moved({0, 0, 4}, box({}, 1)));
        scene->getChild(0)->getOrCreateStateSet()->setAttribute(material({}, 1.0f));
        for (unsigned int i = 0; i < 40; ++i)
        {
            const double angle = 0.157 * i;
            scene->addChild(floorScene::lightSource(
                i, osg::Vec4(0.6 * std::cos(angle), 0.6 * std::sin(angle), 1, 0), 0.025f));
        }
        const auto ground = pane(-1);
        color(*ground, {});
        scene->addChild(ground);
        for (int i = 0; i < 2; ++i)
        {
            if (only >= 0 && only != i)
                continue;
            const auto one = pane(i ? 1.0f : 0.0f);
            blended ? blend(*one, Colors[i]) : color(*one, Colors[i]);
            scene->addChild(one);
        }
        return render(*scene, fromAbove());
    };
    EXPECT_TRUE(
        areSums(build(true, -1), sumOf({build(false, 0), build(false, 1)}), "transparency.words"));
}

TEST_F(ShadowTransparency, transparentCastersFollowTheRule)
{
    const std::pair<TransparentCasters, const char*> rules[] = {
        {TransparentCasters::NONE, "none"},
        {TransparentCasters::ALL, "all"},
        {TransparentCasters::BY_ALPHA, "alpha"}};
    for (const auto& [rule, name] : rules)
        for (const float alpha : {0.2f, 0.49f, 0.5f, 0.8f, 1.0f})
        {
            const auto scene = shadowed();
            scene->setTransparentCasters(rule);
            scene->addChild(pane(0));
            scene->addChild(floorScene::lightSource(0, osg::Vec4(1, 0, 1, 0)));
            const auto caster = moved({0, 0, 3}, box({}, 1));
            blend(*caster, {1, 1, 1}, alpha);
            scene->addChild(caster);
            const Picture picture = render(*scene, fromAbove());
            ASSERT_TRUE(picture);
            const bool casts = rule == TransparentCasters::ALL || alpha == 1.0f ||
                               (rule == TransparentCasters::BY_ALPHA && alpha >= 0.5f);
            EXPECT_NEAR(darkShare(*picture), casts ? 2.0 / 64.0 : 0.0, casts ? 0.006 : 0.0)
                << name << ", " << alpha;
        }
}

TEST_F(ShadowTransparency, aBlendedLeafInTheOpaqueBinIsAReceiverToo)
{
    const auto build = [](bool blended)
    {
        const auto scene = sceneWithBox();
        scene->getChild(0)->getOrCreateStateSet()->setAttribute(material({}, 1.0f));
        const auto one = pane(0);
        color(*one, Colors[0]);
        if (blended)
            one->getOrCreateStateSet()->setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ZERO));
        scene->addChild(one);
        return render(*scene, fromAbove());
    };
    EXPECT_TRUE(areEqual(build(true), build(false), "transparency.blendedOpaque"));
}

TEST_F(ShadowTransparency, holesOfAlphaTestShowTheShadowBehind)
{
    // A checked pane: where it is cut away, the floor is seen with its own shadow.
    osg::ref_ptr<osg::Image> checks = new osg::Image;
    checks->allocateImage(8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            checks->setColor(osg::Vec4(1, 1, 1, (x + y) % 2 ? 1.0f : 0.0f), x, y);
    const auto build = [&](bool upper, bool lower)
    {
        const auto scene = sceneWithBox();
        scene->getChild(0)->getOrCreateStateSet()->setAttribute(material({}, 1.0f));
        const auto floor = pane(0);
        color(*floor, Colors[1]);
        const auto cut = pane(2);
        color(*cut, Colors[0]);
        osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(checks);
        texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
        texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
        if (lower)
        {
            cut->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
            cut->getOrCreateStateSet()->setAttributeAndModes(
                new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
            scene->addChild(floor);
        }
        if (upper)
            scene->addChild(cut);
        else
            scene->addChild(floor);
        return render(*scene, fromAbove());
    };
    const Picture both = build(true, true), upper = build(true, false), floor = build(false, false);
    ASSERT_TRUE(both && upper && floor);
    keep(both, "transparency.alphaTest");
    int wrong = 0, holes = 0;
    for (int y = 0; y < both->t(); ++y)
        for (int x = 0; x < both->s(); ++x)
        {
            const bool isHole = (x / 32 + y / 32) % 2 == 0;
            const osg::Image& expected = isHole ? *floor : *upper;
            holes += isHole;
            for (int c = 0; c < 3; ++c)
                wrong += std::abs(both->data(x, y)[c] - expected.data(x, y)[c]) > 1;
        }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(holes, both->s() * both->t() / 2);
}

TEST_F(ShadowTransparency, unlitSurfacesStayAsTheyAre)
{
    const auto build = [](osgShadowVolume::Shadows shadows)
    {
        const auto scene = sceneWithBox();
        scene->setShadows(shadows);
        const auto one = pane(0);
        one->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        scene->addChild(one);
        scene->getChild(0)->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        return render(*scene, fromAbove());
    };
    EXPECT_TRUE(areEqual(build(osgShadowVolume::Shadows::VOLUMES),
                         build(osgShadowVolume::Shadows::OFF), "transparency.unlit"));
}

TEST_F(ShadowTransparency, aModelsOwnProgramDrawsWhatItDraws)
{
    // It casts; its own colour is left alone.
    const auto scene = sceneWithBox();
    scene->addChild(pane(0));
    const auto own = moved({-2, -2, 0.5f}, box({}, 1));
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT,
                                       "void main() { gl_FragColor = vec4(0.0, 0.5, 1.0, 1.0); }"));
    own->getOrCreateStateSet()->setAttribute(program);
    scene->addChild(own);
    const Picture picture = render(*scene, fromAbove());
    ASSERT_TRUE(picture);
    keep(picture, "transparency.program");
    int own128 = 0;
    for (int y = 0; y < picture->t(); ++y)
        for (int x = 0; x < picture->s(); ++x)
            own128 += picture->data(x, y)[2] == 255 &&
                      std::abs(picture->data(x, y)[1] - 128) <= 1 && picture->data(x, y)[0] == 0;
    EXPECT_EQ(own128, 32 * 32);
    // Shadows of the box (1 by 1 plus what its height of 1 adds) and of the one with the program.
    EXPECT_GT(darkShare(*picture), 2.0 / 64.0);
}

TEST_F(ShadowTransparency, sortedSurfacesKeepTheOrderOfOsg)
{
    // Blended by alpha the order counts: without any shadow both pictures are the same.
    const auto build = [](osgShadowVolume::Shadows shadows)
    {
        const auto scene = shadowed();
        scene->setShadows(shadows);
        const auto ground = pane(-1);
        scene->addChild(ground);
        scene->addChild(moved({20, 0, 3}, box({}, 1)));
        scene->addChild(floorScene::lightSource(0, osg::Vec4(0.1f, 0.1f, 1, 0)));
        for (int i : {2, 0, 3, 1})
        {
            const auto one =
                floorScene::rectangle({-3 + i * 0.5f, -3, i * 0.5f}, {4, 0, 0}, {0, 6, 0});
            one->setUserValue("castShadow", false);
            blend(*one, Colors[i], 0.5f);
            one->getStateSet()->setAttribute(
                new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
            scene->addChild(one);
        }
        // Far away, so that there is a shadow, but not here.
        if (shadows != osgShadowVolume::Shadows::OFF)
            forgetBounds(*scene->getChild(1));
        const Picture picture = render(*scene, fromAbove());
        if (shadows != osgShadowVolume::Shadows::OFF)
        {
            EXPECT_GT(countOf(*scene, "shadows.transparentLayers"), 3.0);
        }
        return picture;
    };
    EXPECT_TRUE(areEqual(build(osgShadowVolume::Shadows::VOLUMES),
                         build(osgShadowVolume::Shadows::OFF), "transparency.order"));
}
