// SPDX-License-Identifier: MIT
// Labelled and other objects in one view hide each other, blend and obey their state as without
// labels.
#include "LabelPictures.h"

#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/Camera>
#include <osg/ClipNode>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/LogicOp>
#include <osg/PolygonMode>
#include <osg/PolygonOffset>
#include <osg/Scissor>
#include <osg/Stencil>

#include <functional>

using namespace labelScene;
using On = osg::StateAttribute;

namespace
{

class LabelSiblings : public PictureTest
{
};

const osg::Vec4 Red(0.8f, 0.2f, 0.2f, 1.0f), Green(0.2f, 0.8f, 0.2f, 1.0f),
    Blue(0.2f, 0.3f, 0.9f, 1.0f), White(0.9f, 0.9f, 0.9f, 1.0f);

/// Puts what a scene has into the group that has labels, and the rest beside it.
using Build = std::function<void(osg::Group& root, osg::Group& labels)>;

osg::ref_ptr<osg::Group> make(const Build& build, osg::Group* labels)
{
    const osg::ref_ptr<osg::Group> root = unlit();
    build(*root, *labels);
    return root;
}

void expectOwnLook(const Build& build, const std::string& name,
                   const support::CameraSpec& camera = fromFront())
{
    SCOPED_TRACE(name);
    const auto scene = labelled(nullptr, Invisible);
    // Both live until the end: osg::State takes what is new at an old address for what was there.
    const osg::ref_ptr<osg::Group> with = make(build, scene), without = make(build, new osg::Group);
    const Picture actual = render(*with, camera);
    EXPECT_GT(countOf(*scene, "labels.drawables"), 0.0) << decisionOf(*scene);
    EXPECT_EQ(countOf(*scene, "variants.failed"), 0.0);
    const Picture expected = render(*without, camera);
    ASSERT_TRUE(actual && expected);
    const Picture empty = render(*new osg::Group, camera);
    EXPECT_GT(changedShare(*expected, *empty), 0.02) << "nothing is shown";
    EXPECT_TRUE(areAlike(actual, expected, "labelSiblings." + name));
}

/// A named rectangle that faces the camera, at a depth, of side 1 around a place on the screen.
osg::ref_ptr<osg::Geode> card(float x, float depth, const osg::Vec4& color, float z = 0.0f)
{
    return named("Tag 42", rectangle({x - 0.5f, depth, z - 0.5f}, {1, 0, 0}, {0, 0, 1}, color));
}

/// One that crosses others: near at its left, far at its right.
osg::ref_ptr<osg::Geode> slanted(const osg::Vec4& color)
{
    return named("Tag 43", rectangle({-1, -0.5f, -0.3f}, {2, 1, 0}, {0, 0, 0.6f}, color));
}

void blend(osg::Node& node, int bin, const char* sort)
{
    osg::StateSet* state = node.getOrCreateStateSet();
    state->setAttributeAndModes(new osg::BlendFunc);
    state->setRenderBinDetails(bin, sort);
}

} // namespace

TEST_F(LabelSiblings, beforeBehindAndAcrossHideEachOther)
{
    expectOwnLook(
        [](osg::Group& root, osg::Group& labels)
        {
            root.addChild(card(-0.4f, -0.3f, Red));
            root.addChild(&labels);
            labels.addChild(card(0.0f, 0.0f, Green));
            labels.addChild(slanted(White));
            root.addChild(card(0.4f, 0.1f, Blue));
            root.addChild(card(0.2f, -0.2f, Red, 0.6f));
        },
        "across");
}

TEST_F(LabelSiblings, ofCoplanarSurfacesTheFirstOneDrawnShows)
{
    for (bool first : {true, false})
        expectOwnLook(
            [first](osg::Group& root, osg::Group& labels)
            {
                // Bins fix the order.
                const auto sibling = card(0.2f, 0.0f, Red);
                sibling->getOrCreateStateSet()->setRenderBinDetails(first ? -1 : 1, "RenderBin");
                root.addChild(sibling);
                root.addChild(&labels);
                labels.addChild(card(-0.2f, 0.0f, Green));
            },
            first ? "coplanarAfter" : "coplanarBefore");
}

TEST_F(LabelSiblings, depthFunctionsAndRangesCount)
{
    struct Case
    {
        const char* name;
        osg::Depth::Function function;
        double low, high;
        bool writes;
    };
    const Case cases[] = {{"lequal", osg::Depth::LEQUAL, 0.0, 1.0, true},
                          {"greater", osg::Depth::GREATER, 0.0, 1.0, true},
                          {"gequal", osg::Depth::GEQUAL, 0.0, 1.0, true},
                          {"always", osg::Depth::ALWAYS, 0.0, 1.0, true},
                          {"equal", osg::Depth::EQUAL, 0.0, 1.0, true},
                          {"notequal", osg::Depth::NOTEQUAL, 0.0, 1.0, true},
                          {"never", osg::Depth::NEVER, 0.0, 1.0, true},
                          {"nearRange", osg::Depth::LESS, 0.0, 0.5, true},
                          {"reversedRange", osg::Depth::LESS, 1.0, 0.0, true},
                          {"withoutWriting", osg::Depth::LESS, 0.0, 1.0, false}};
    for (const Case& c : cases)
        expectOwnLook(
            [c](osg::Group& root, osg::Group& labels)
            {
                const auto before = card(-0.5f, -0.2f, Red);
                before->getOrCreateStateSet()->setRenderBinDetails(-1, "RenderBin");
                root.addChild(before);
                const auto coplanar = card(0.4f, 0.0f, Blue);
                coplanar->getOrCreateStateSet()->setRenderBinDetails(-1, "RenderBin");
                root.addChild(coplanar);
                root.addChild(&labels);
                const auto own = card(0.0f, 0.0f, Green);
                own->getOrCreateStateSet()->setAttributeAndModes(
                    new osg::Depth(c.function, c.low, c.high, c.writes));
                labels.addChild(own);
                labels.addChild(card(1.0f, 0.0f, White, 0.5f));
                const auto after = card(0.0f, -0.1f, White, -0.7f);
                after->getOrCreateStateSet()->setRenderBinDetails(1, "RenderBin");
                root.addChild(after);
            },
            std::string("depth.") + c.name);
}

TEST_F(LabelSiblings, reversedDepthKeepsItsLook)
{
    osg::Camera& camera = *viewer().getViewer().getCamera();
    camera.setClearDepth(0.0);
    expectOwnLook(
        [](osg::Group& root, osg::Group& labels)
        {
            root.getOrCreateStateSet()->setAttributeAndModes(
                new osg::Depth(osg::Depth::GREATER, 1.0, 0.0, true));
            root.addChild(card(-0.4f, -0.3f, Red));
            root.addChild(&labels);
            labels.addChild(card(0.0f, 0.0f, Green));
            root.addChild(slanted(White));
        },
        "reversedDepth");
    camera.setClearDepth(1.0);
}

TEST_F(LabelSiblings, binsKeepTheirOrder)
{
    // What is drawn into one bin may not be put over what siblings have drawn since an earlier one.
    expectOwnLook(
        [](osg::Group& root, osg::Group& labels)
        {
            const auto glass = card(0.0f, -0.3f, {0.9f, 0.9f, 0.1f, 0.5f});
            blend(*glass, 5, "DepthSortedBin");
            glass->getOrCreateStateSet()->setAttributeAndModes(
                new osg::Depth(osg::Depth::LESS, 0, 1, false));
            root.addChild(glass);
            const auto overlay = card(0.3f, 0.5f, Red, -0.4f);
            overlay->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, On::OFF);
            overlay->getOrCreateStateSet()->setRenderBinDetails(6, "RenderBin");
            root.addChild(overlay);
            root.addChild(&labels);
            int bin = -1;
            for (float x : {-0.8f, 0.0f, 0.8f})
            {
                const auto own = card(x, 0.0f, bin < 0 ? Red : bin < 10 ? Green : Blue, x * 0.3f);
                own->getOrCreateStateSet()->setRenderBinDetails(bin, "RenderBin");
                labels.addChild(own);
                bin += 11;
            }
        },
        "bins");
}

TEST_F(LabelSiblings, transparentOnesAreSortedTogether)
{
    expectOwnLook(
        [](osg::Group& root, osg::Group& labels)
        {
            const auto glass = [](float x, float depth, osg::Vec4 color)
            {
                color.a() = 0.5f;
                const auto geode = card(x, depth, color);
                blend(*geode, 10, "DepthSortedBin");
                return geode;
            };
            root.addChild(glass(-0.3f, -0.4f, Red));
            root.addChild(&labels);
            labels.addChild(card(0.0f, 0.2f, White, -0.2f));
            labels.addChild(glass(0.0f, -0.2f, Green));
            labels.addChild(glass(0.2f, -0.6f, Blue));
            root.addChild(glass(0.3f, 0.0f, White));
        },
        "transparent");
}

TEST_F(LabelSiblings, rasterStateOfSurfacesCounts)
{
    const auto state = [](const std::string& name, const std::function<void(osg::StateSet&)>& set,
                          bool onRoot = false)
    {
        expectOwnLook(
            [&](osg::Group& root, osg::Group& labels)
            {
                const auto before = card(-0.4f, 0.3f, Red);
                before->getOrCreateStateSet()->setRenderBinDetails(-1, "RenderBin");
                root.addChild(before);
                root.addChild(&labels);
                labels.addChild(card(0.0f, 0.0f, {0.3f, 0.8f, 0.5f, 0.6f}));
                // Bins fix the order, which some of these depend on.
                labels.addChild(slanted(White));
                labels.getChild(1)->getOrCreateStateSet()->setRenderBinDetails(1, "RenderBin");
                set(onRoot ? *root.getOrCreateStateSet()
                           : *labels.getChild(0)->getOrCreateStateSet());
            },
            name + (onRoot ? "Above" : ""));
    };
    for (bool above : {false, true})
    {
        state(
            "colorMask",
            [](osg::StateSet& s)
            { s.setAttributeAndModes(new osg::ColorMask(true, false, true, true)); },
            above);
        state(
            "lines",
            [](osg::StateSet& s)
            {
                s.setAttributeAndModes(
                    new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE),
                    On::ON | On::OVERRIDE);
            },
            above);
        state(
            "scissor",
            [](osg::StateSet& s) { s.setAttributeAndModes(new osg::Scissor(60, 40, 100, 90)); },
            above);
        state(
            "logic",
            [](osg::StateSet& s)
            { s.setAttributeAndModes(new osg::LogicOp(osg::LogicOp::COPY_INVERTED)); },
            above);
        state(
            "alphaTest",
            [](osg::StateSet& s)
            { s.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.7f)); },
            above);
    }
    state("points",
          [](osg::StateSet& s)
          {
              s.setAttributeAndModes(
                  new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::POINT));
          });
    state("offset",
          [](osg::StateSet& s) { s.setAttributeAndModes(new osg::PolygonOffset(-1.0f, -64.0f)); });
    state("culled", [](osg::StateSet& s) { s.setAttributeAndModes(new osg::CullFace); });
    state("stencil",
          [](osg::StateSet& s)
          {
              osg::ref_ptr<osg::Stencil> stencil = new osg::Stencil;
              stencil->setFunction(osg::Stencil::EQUAL, 0, ~0u);
              stencil->setOperation(osg::Stencil::KEEP, osg::Stencil::KEEP, osg::Stencil::INCR);
              s.setAttributeAndModes(stencil);
          });
}

TEST_F(LabelSiblings, stencilsThatOthersReadAreWritten)
{
    expectOwnLook(
        [](osg::Group& root, osg::Group& labels)
        {
            root.addChild(&labels);
            const auto writer = card(0.0f, 0.0f, Green);
            osg::ref_ptr<osg::Stencil> write = new osg::Stencil;
            write->setFunction(osg::Stencil::ALWAYS, 1, ~0u);
            write->setOperation(osg::Stencil::KEEP, osg::Stencil::KEEP, osg::Stencil::REPLACE);
            writer->getOrCreateStateSet()->setAttributeAndModes(write);
            labels.addChild(writer);
            const auto reader = card(0.4f, -0.2f, Red);
            osg::ref_ptr<osg::Stencil> read = new osg::Stencil;
            read->setFunction(osg::Stencil::NOTEQUAL, 1, ~0u);
            reader->getOrCreateStateSet()->setAttributeAndModes(read);
            reader->getOrCreateStateSet()->setRenderBinDetails(1, "RenderBin");
            root.addChild(reader);
        },
        "stencilWriter");
}

TEST_F(LabelSiblings, clipPlanesCut)
{
    expectOwnLook(
        [](osg::Group& root, osg::Group& labels)
        {
            osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
            clip->addClipPlane(new osg::ClipPlane(0, 1, 0, 0.4, 0.1));
            clip->setStateSetModes(*clip->getOrCreateStateSet(), On::ON);
            clip->addChild(card(0.0f, 0.0f, Green));
            labels.addChild(clip);
            labels.addChild(card(-0.6f, 0.2f, Blue, 0.4f));
            root.addChild(&labels);
        },
        "clipped");
}

TEST_F(LabelSiblings, camerasBelowAndAboveKeepTheirLook)
{
    const auto camera = [](osg::Camera::RenderOrder order, int x)
    {
        osg::ref_ptr<osg::Camera> inner = new osg::Camera;
        inner->setRenderOrder(order);
        inner->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
        inner->setViewMatrix(fromFront().view);
        inner->setProjectionMatrix(fromFront(1.0).projection);
        inner->setViewport(x, 16, 96, 96);
        inner->setClearMask(GL_DEPTH_BUFFER_BIT);
        inner->setColorMask(true, order != osg::Camera::POST_RENDER, true, true);
        return inner;
    };
    for (const auto order : {osg::Camera::NESTED_RENDER, osg::Camera::POST_RENDER})
    {
        const std::string name = order == osg::Camera::NESTED_RENDER ? "nested" : "post";
        expectOwnLook(
            [&](osg::Group& root, osg::Group& labels)
            {
                const auto inner = camera(order, 20);
                inner->addChild(card(0.2f, -0.1f, White, 0.3f));
                labels.addChild(card(0.0f, 0.0f, Green));
                labels.addChild(inner);
                root.addChild(&labels);
            },
            name + "Below");
        expectOwnLook(
            [&](osg::Group& root, osg::Group& labels)
            {
                const auto inner = camera(order, 120);
                inner->addChild(card(-0.2f, 0.2f, Red));
                inner->addChild(&labels);
                labels.addChild(card(0.2f, 0.0f, White, 0.3f));
                root.addChild(inner);
                root.addChild(card(0.0f, 0.0f, Blue));
            },
            name + "Above");
    }
}
