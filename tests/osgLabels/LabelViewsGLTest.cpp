// SPDX-License-Identifier: MIT
// Views, windows and targets of all kinds show the labels that a window of the same size at its
// origin shows, and the look of the model where there are none.
#include "LabelPictures.h"

#include <support/WindowViews.h>

#include <osg/Depth>
#include <osg/Texture2D>

#include <algorithm>

using namespace labelScene;
using osgLabels::LabelScene;
using support::CameraSpec;

namespace
{

class LabelViews : public PictureTest
{
};

/// A board, a box before it and a transparent pane, each with a name.
osg::ref_ptr<osg::Group> plant()
{
    const osg::ref_ptr<osg::Group> group = unlit();
    group->addChild(named("P-101 A/B", rectangle({-1.2f, 0.3f, -0.2f}, {2.4f, 0, 0}, {0, 0, 0.9f},
                                                 {0.8f, 0.7f, 0.5f, 1.0f})));
    group->addChild(box("VESSEL", {0.0f, 0.0f, -0.55f}, {0.9f, 0.2f, 0.25f}));
    const auto pane = named("GLASS", rectangle({0.1f, -0.5f, -0.3f}, {0.7f, 0, 0}, {0, 0, 0.7f},
                                               {0.3f, 0.6f, 1, 0.5f}));
    pane->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    pane->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    group->addChild(pane);
    return group;
}

CameraSpec fromLeft()
{
    return CameraSpec::perspective({-2, -4, 1}, {0, 0, 0}, {0, 0, 1}, 30.0, double(Width) / Height,
                                   0.5, 20.0);
}

/// A camera that renders `node` into a texture of that format, which covers the view.
osg::ref_ptr<osg::Group> throughTexture(osg::Node* node, GLenum format, unsigned int samples)
{
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setTextureSize(Width, Height);
    texture->setInternalFormat(format);
    texture->setSourceFormat(GL_RGBA);
    texture->setSourceType(format == GL_RGBA8 ? GL_UNSIGNED_BYTE : GL_FLOAT);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    const osg::ref_ptr<osg::Camera> camera =
        support::makeTargetCamera(node, fromFront(), Width, Height);
    camera->attach(osg::Camera::COLOR_BUFFER, texture, 0, 0, false, samples, samples);
    const float aspect = float(Width) / Height;
    const auto screen =
        osg::createTexturedQuadGeometry({-aspect, 0, -1}, {2 * aspect, 0, 0}, {0, 0, 2});
    screen->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    screen->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(camera);
    root->addChild(screen);
    return root;
}

/// What a window without anything special shows, with letters in it.
Picture reference(LabelScene& scene, const CameraSpec& camera)
{
    const Picture labels = render(scene, camera);
    const Picture model = render(*scene.getChild(0), camera);
    if (!labels || !model)
        return nullptr;
    EXPECT_GT(changedShare(*labels, *model), 0.02) << "no letters: " << decisionOf(scene);
    return labels;
}

} // namespace

TEST_F(LabelViews, severalViewsInOneWindowEachHaveTheirLabels)
{
    const auto scene = labelled(plant());
    const support::WindowViews views(*scene, 2 * Width + 60, Height + 50,
                                     {{fromFront(), 13, 7, Width, Height, "left"},
                                      {fromLeft(), Width + 37, 41, Width, Height, "right"}});
    EXPECT_EQ(scene->getPlans().size(), 2u);
    const auto alone = labelled(plant());
    EXPECT_TRUE(areAlike(views.getPicture(0), reference(*alone, fromFront()), "labelViews.first"));
    EXPECT_TRUE(areAlike(views.getPicture(1), reference(*alone, fromLeft()), "labelViews.second"));
}

TEST_F(LabelViews, slaveCamerasShowPartsOfOnePicture)
{
    const auto scene = labelled(plant());
    const Picture joined = support::drawHalves(*scene, fromFront(), Width, Height);
    const auto alone = labelled(plant());
    const Picture whole = reference(*alone, fromFront());
    ASSERT_TRUE(whole && joined);
    EXPECT_TRUE(areAlike(joined, whole, "labelViews.slaves"));
}

TEST_F(LabelViews, texturesOfAnyPrecisionHoldTheLabels)
{
    const auto scene = labelled(plant());
    const Picture expected = reference(*scene, fromFront());
    for (const GLenum format : {GLenum(GL_RGBA8), GLenum(GL_RGBA16F_ARB), GLenum(GL_RGBA32F_ARB)})
        EXPECT_TRUE(areAlike(render(*throughTexture(scene, format, 0), fromFront()), expected,
                             "labelViews.texture" + std::to_string(format)));
}

TEST_F(LabelViews, floatTargetsKeepColorsBeyondOne)
{
    const auto card =
        named("Tag", rectangle({-1, 0, -0.5f}, {2, 0, 0}, {0, 0, 1}, {4.0f, 0.25f, 0.125f, 1}));
    card->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    viewer().getViewer().getCamera()->getGraphicsContext()->makeCurrent();
    const auto scene = labelled(card, Invisible);
    const Picture actual = viewer().renderFloat(scene, fromFront(), Width, Height, 2);
    const Picture expected = viewer().renderFloat(card, fromFront(), Width, Height, 2);
    ASSERT_TRUE(actual && expected);
    EXPECT_GT(countOf(*scene, "labels.drawables"), 0.0);
    EXPECT_TRUE((support::CompareImage{0.02, 0.001, 1.0}(actual, expected, "labelViews.float")));
}

TEST_F(LabelViews, samplesKeepTheLookAndNeverMixIdentifiers)
{
    support::HeadlessSettings settings{Width, Height};
    settings.samples = 4;
    support::HeadlessViewer smooth(settings);
    OSGKITS_NEED_GL(smooth);
    smooth.getViewer().setLightingMode(osg::View::NO_LIGHT);
    // Many thin edges between identifiers that are far apart: a mean would be a third label.
    const osg::ref_ptr<osg::Group> bars = unlit();
    for (int i = 0; i < 24; ++i)
        bars->addChild(named(i % 3 ? "I" : "MMMMMMMMMM",
                             rectangle({-1.2f + 0.1f * float(i), 0.01f * float(i % 5), -0.9f},
                                       {0.13f, 0, 0.1f}, {0.2f, 0, 1.7f},
                                       {0.9f, 0.9f - 0.03f * float(i), 0.7f, 1.0f})));
    const auto invisible = labelled(bars, Invisible);
    const Picture actual = smooth.render(invisible, fromFront(), Width, Height, 2);
    const Picture expected = smooth.render(bars, fromFront(), Width, Height, 2);
    EXPECT_GT(countOf(*invisible, "labels.drawables"), 20.0);
    EXPECT_TRUE(areAlike(actual, expected, "labelViews.samples"));
    // Letters too: no pixel lies outside of what four samples of its surfaces can be.
    const auto scene = labelled(plant(), Plain);
    const Picture letters = smooth.render(scene, fromFront(), Width, Height, 2);
    const Picture single = render(*labelled(plant(), Plain), fromFront());
    ASSERT_TRUE(letters && single);
    keep(letters, "labelViews.samplesLetters");
    EXPECT_LT(changedShare(*letters, *single), 0.08) << "edges alone differ";
    smooth.getViewer().setSceneData(nullptr);
}

TEST_F(LabelViews, texturesWithSamplesShowTheSame)
{
    const auto model = plant();
    const auto scene = labelled(model, Invisible);
    const Picture actual = render(*throughTexture(scene, GL_RGBA8, 4), fromFront());
    EXPECT_GT(countOf(*scene, "labels.drawables"), 0.0);
    const Picture expected = render(*throughTexture(model, GL_RGBA8, 4), fromFront());
    EXPECT_TRUE(areAlike(actual, expected, "labelViews.textureSamples"));
}

TEST_F(LabelViews, parallelViewsShowTheLabelsOfDistantOnes)
{
    // At 4 units a board at the same depth all over looks the same in both.
    const auto board = named("P-101 A/B", rectangle({-1.2f, 0, -0.4f}, {2.4f, 0, 0}, {0, 0, 0.9f},
                                                    {0.8f, 0.7f, 0.5f, 1.0f}));
    board->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    const auto scene = labelled(board);
    const Picture expected = reference(*scene, fromFront());
    EXPECT_TRUE(areAlike(render(*scene, parallel()), expected, "labelViews.parallel"));
    board->getOrCreateStateSet()->setAttributeAndModes(
        new osg::Depth(osg::Depth::LESS, 0.25, 0.5, true));
    EXPECT_TRUE(areAlike(render(*scene, parallel()), expected, "labelViews.parallelRange"));
}

TEST_F(LabelViews, aViewportInsideOfTheWindowShowsTheSame)
{
    // That of a camera between the view's and the scene, which its leaves draw into.
    const auto scene = labelled(plant());
    const Picture expected = reference(*scene, fromFront());
    osg::ref_ptr<osg::Camera> inner = new osg::Camera;
    inner->setRenderOrder(osg::Camera::NESTED_RENDER);
    inner->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    inner->setViewMatrix(fromFront().view);
    inner->setProjectionMatrix(fromFront().projection);
    inner->setViewport(Width / 4, Height / 4, Width / 2, Height / 2);
    inner->addChild(scene);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(inner);
    const Picture actual = render(*root);
    const auto half = labelled(plant());
    const Picture small = render(*half, fromFront(), Width / 2, Height / 2);
    ASSERT_TRUE(actual && small && expected);
    const Picture cut = new osg::Image;
    cut->allocateImage(Width / 2, Height / 2, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < Height / 2; ++y)
        std::copy_n(actual->data(Width / 4, y + Height / 4), 4 * Width / 2, cut->data(0, y));
    EXPECT_TRUE(areAlike(cut, small, "labelViews.nestedViewport"));
}

TEST_F(LabelViews, threadsDoNotChangeThePicture)
{
    const auto alone = labelled(plant());
    const Picture expected = reference(*alone, fromFront());
    for (const auto threading : {osgViewer::ViewerBase::DrawThreadPerContext,
                                 osgViewer::ViewerBase::CullDrawThreadPerContext,
                                 osgViewer::ViewerBase::CullThreadPerCameraDrawThreadPerContext})
    {
        support::HeadlessSettings settings{Width, Height};
        settings.threading = threading;
        support::HeadlessViewer threaded(settings);
        OSGKITS_NEED_GL(threaded);
        threaded.getViewer().setLightingMode(osg::View::NO_LIGHT);
        const auto scene = labelled(plant());
        const Picture actual = threaded.render(scene, fromFront(), Width, Height, 8);
        EXPECT_TRUE(areAlike(actual, expected, "labelViews.threads" + std::to_string(threading)));
    }
}
