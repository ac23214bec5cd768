// SPDX-License-Identifier: MIT
// Who may ask what lies under a point, and which picture answers.
#include "LabelPictures.h"

#include <osgLabels/LabelOptions.h>
#ifdef OSGKITS_SHADOWVOLUME
#include <osgShadowVolume/ShadowedScene.h>
#endif

#include <support/NotifyCapture.h>

#include <osg/Camera>
#include <osg/Material>
#include <osg/Texture2D>

using namespace labelScene;
using osgLabels::LabelScene;
using osgLabels::PickAsker;

namespace
{

class LabelAsk : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(viewer()); }

    support::NotifyCapture _notify;
};

osg::ref_ptr<osg::Geode> board(const std::string& name, float left, float width)
{
    return named(name,
                 rectangle({left, 0, -0.5f}, {width, 0, 0}, {0, 0, 1.0f}, {0.9f, 0.8f, 0.7f, 1}));
}

osg::ref_ptr<osg::Group> twoBoards()
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(board("LEFT", -1.2f, 1.1f));
    group->addChild(board("RIGHT", 0.1f, 1.1f));
    return group;
}

std::string textAt(LabelScene& scene, double x, osg::Node& root)
{
    scene.pick(x, 0.0);
    render(root, fromFront(), Width, Height, 1);
    const auto picked = scene.takePicked();
    return picked ? picked->text : "no answer";
}

/// Draws a frame in which a key is pressed over the left board; returns what is printed.
support::NotifyCapture::Lines frameWithKey(LabelScene& scene, int key)
{
    support::NotifyCapture capture(osg::NOTICE);
    osgGA::EventQueue& queue = *viewer().getViewer().getEventQueue();
    queue.mouseMotion(-0.4f, 0.0f);
    if (key)
        queue.keyPress(key);
    render(scene, fromFront(), Width, Height, 1);
    return capture.takeMessages();
}

/// Sees the node from the other side, into a texture, before the view.
osg::ref_ptr<osg::Camera> fromBehind(osg::Node* node)
{
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setRenderOrder(osg::Camera::PRE_RENDER);
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    camera->setViewport(0, 0, Width, Height);
    camera->setViewMatrixAsLookAt({0, 4, 0}, {0, 0, 0}, {0, 0, 1});
    camera->setProjectionMatrix(fromFront().projection);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setTextureSize(Width, Height);
    texture->setInternalFormat(GL_RGBA8);
    camera->attach(osg::Camera::COLOR_BUFFER, texture);
    camera->addChild(node);
    return camera;
}

} // namespace

TEST_F(LabelAsk, aTextureInTheViewAnswersWhereItsCameraIsNamedAlone)
{
    const auto scene = labelled(twoBoards());
    const auto camera = fromBehind(scene);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(camera);
    root->addChild(scene);
    render(*root);
    EXPECT_EQ(textAt(*scene, -0.4, *root), "LEFT");
    EXPECT_EQ(textAt(*scene, 0.4, *root), "RIGHT");
    scene->pick(-0.4, 0.0, camera);
    render(*root);
    const auto picked = scene->takePicked();
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->text, "RIGHT") << "left in the texture";
    scene->pick(-0.4, 0.0, viewer().getViewer().getCamera());
    render(*root);
    const auto inView = scene->takePicked();
    ASSERT_TRUE(inView);
    EXPECT_EQ(inView->text, "LEFT");
}

#ifdef OSGKITS_SHADOWVOLUME
TEST_F(LabelAsk, aMirrorInTheViewDoesNotAnswer)
{
    // The mirror fills the view; in its picture another board is where the left one is.
    const auto model = twoBoards();
    const auto glass =
        named("GLASS", rectangle({-3, 1, -2}, {6, 0, 0}, {0, 0, 4}, {0.5f, 0.5f, 0.5f, 1}));
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setName("mirror");
    glass->getOrCreateStateSet()->setAttributeAndModes(material);
    glass->getDrawable(0)->getOrCreateStateSet()->setAttributeAndModes(material);
    model->addChild(glass);
    const auto near =
        named("BEHIND YOU", rectangle({3, -6, -2}, {-6, 0, 0}, {0, 0, 4}, {0.9f, 0.8f, 0.7f, 1}));
    model->addChild(near);
    const auto scene = labelled(model);
    osg::ref_ptr<osgShadowVolume::ShadowedScene> shadows = new osgShadowVolume::ShadowedScene;
    shadows->setKeys(false);
    shadows->setMirrors(true);
    shadows->addChild(scene);
    keep(render(*shadows), "labelAsk.mirror");
    double mirrors = 0.0;
    for (osgMultiRender::Plan& plan : shadows->getPlans())
        mirrors += plan.counts["mirrors.passes"];
    ASSERT_GT(mirrors, 0.0) << "no picture of a mirror was drawn";
    EXPECT_EQ(textAt(*scene, -0.4, *shadows), "LEFT");
    EXPECT_EQ(textAt(*scene, 0.4, *shadows), "RIGHT");
}
#endif

TEST_F(LabelAsk, aQuestionFromBeforeTheFirstFrameIsAnswered)
{
    const auto scene = labelled(twoBoards());
    EXPECT_EQ(textAt(*scene, -0.4, *scene), "LEFT");
}

TEST_F(LabelAsk, aQuestionOutlivesNewSettings)
{
    const auto scene = labelled(twoBoards());
    render(*scene);
    scene->pick(0.4, 0.0);
    scene->setSettingsText("keys=off,size=0.2");
    render(*scene);
    const auto picked = scene->takePicked();
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->text, "RIGHT");
}

TEST_F(LabelAsk, anAnswerOutlivesNewSettings)
{
    const auto scene = labelled(twoBoards());
    render(*scene);
    scene->pick(0.4, 0.0);
    render(*scene);
    scene->setSettingsText("keys=off,size=0.2");
    const auto picked = scene->takePicked();
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->text, "RIGHT");
}

TEST_F(LabelAsk, hidingLabelsAnswersNothing)
{
    const auto scene = labelled(twoBoards());
    render(*scene);
    scene->pick(0.4, 0.0);
    scene->setShown(false);
    render(*scene);
    const auto picked = scene->takePicked();
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->identifier, 0u);
}

TEST_F(LabelAsk, keysAndTheApplicationDoNotTakeEachOthersAnswers)
{
    const auto scene = labelled(twoBoards());
    osgLabels::LabelSettings settings = scene->getSettings();
    settings.keys = true;
    scene->setSettings(settings);
    render(*scene);
    scene->pick(0.4, 0.0); // of the application, while the key asks too
    EXPECT_TRUE(frameWithKey(*scene, 'I').empty());
    const auto lines = frameWithKey(*scene, 0);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("'LEFT'"), std::string::npos) << lines[0];
    const auto picked = scene->takePicked();
    ASSERT_TRUE(picked) << "the key's printer took it";
    EXPECT_EQ(picked->text, "RIGHT");
    EXPECT_FALSE(scene->takePicked(PickAsker::Keys));
}
