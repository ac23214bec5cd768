// SPDX-License-Identifier: MIT
// Texts change, go and come while they are shown, at the cost of what changed.
#include "LabelPictures.h"

#include <osgLabels/LabelResources.h>

#include <support/ResidentMemory.h>

#include <string>
#include <thread>

using namespace labelScene;
using osgLabels::LabelScene;

namespace
{

class LabelText : public PictureTest
{
};

osg::ref_ptr<osg::Group> board(const std::string& name)
{
    return unlit(named(
        name, rectangle({-1.2f, 0, -0.4f}, {2.4f, 0, 0}, {0, 0, 0.8f}, {0.9f, 0.9f, 0.8f, 1})));
}

/// Boards in rows, of 4 x `rows`, with different names.
osg::ref_ptr<osg::Group> boards(int rows)
{
    const osg::ref_ptr<osg::Group> group = unlit();
    const float height = 1.8f / float(rows);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < 4; ++i)
            group->addChild(
                named("T" + std::to_string(100 + 4 * j + i),
                      rectangle({-1.2f + 0.6f * float(i), 0, -0.9f + height * float(j)},
                                {0.58f, 0, 0}, {0, 0, 0.95f * height}, {0.9f, 0.9f, 0.8f, 1})));
    return group;
}

osgLabels::LabelBuffers::Traffic trafficOf(const LabelScene& scene)
{
    const unsigned int context =
        viewer().getViewer().getCamera()->getGraphicsContext()->getState()->getContextID();
    return scene.getResources()->buffers.getTraffic(context);
}

/// Objects that live in the context.
struct GLObjects
{
    unsigned int textures = 0, buffers = 0, framebuffers = 0, programs = 0;
};

GLObjects countObjects()
{
    osg::GraphicsContext& context = *viewer().getViewer().getCamera()->getGraphicsContext();
    context.makeCurrent();
    const auto* gl = context.getState()->get<osg::GLExtensions>();
    GLboolean(GL_APIENTRY * isFramebuffer)(GLuint) = nullptr;
    osg::setGLExtensionFuncPtr(isFramebuffer, "glIsFramebuffer");
    // Names are given in ascending order, far fewer than these.
    constexpr GLuint names = 20000;
    GLObjects objects;
    for (GLuint name = 1; name < names; ++name)
    {
        objects.textures += glIsTexture(name) == GL_TRUE;
        objects.buffers += gl->glIsBuffer(name) == GL_TRUE;
        objects.framebuffers += isFramebuffer(name) == GL_TRUE;
        objects.programs += gl->glIsProgram(name) == GL_TRUE;
    }
    return objects;
}

} // namespace

TEST_F(LabelText, changedByAnotherThreadShowsInTheNextFrame)
{
    const auto scene = labelled(board("OLD"));
    const Picture before = render(*scene);
    std::thread([&] { EXPECT_TRUE(scene->setText(1, "27.5 °C")); }).join();
    const Picture after = render(*scene, fromFront(), Width, Height, 1);
    EXPECT_EQ(scene->getText(1), "27.5 °C");
    const auto other = labelled(board("27.5 °C"));
    ASSERT_TRUE(before && after);
    // The other scene has its letters' images in another order, so that coordinates round
    // otherwise.
    EXPECT_TRUE((support::CompareImage{1.0 / 255.0, 0.0, 1.0 / 255.0}(after, render(*other),
                                                                      "labelText.changed")));
    EXPECT_GT(changedShare(*after, *before), 0.01);
}

TEST_F(LabelText, ofAnEmptyTextNothingIsLeft)
{
    const auto model = board("OLD");
    const auto scene = labelled(model);
    ASSERT_TRUE(render(*scene));
    EXPECT_TRUE(scene->setText(1, ""));
    EXPECT_TRUE(areAlike(render(*scene, fromFront(), Width, Height, 1), render(*model),
                         "labelText.removed"));
    EXPECT_FALSE(scene->setText(0, "x"));
    EXPECT_FALSE(scene->setText(2, "x")) << "no object has it";
    EXPECT_FALSE(scene->setText(0x7fffffffu, "x"));
}

TEST_F(LabelText, uploadsOnlyTheBytesThatChanged)
{
    const auto scene = labelled(boards(40));
    ASSERT_TRUE(render(*scene));
    const std::size_t held = trafficOf(*scene).bytesHeld;
    EXPECT_GT(held, 160u * 4);
    render(*scene, fromFront(), Width, Height, 1);
    EXPECT_EQ(trafficOf(*scene).bytesSent, 0u) << "nothing has changed";
    EXPECT_TRUE(scene->setText(77, "T999"));
    render(*scene, fromFront(), Width, Height, 1);
    // Four letters, and a row of 4 bytes.
    EXPECT_GT(trafficOf(*scene).bytesSent, 0u);
    EXPECT_LE(trafficOf(*scene).bytesSent, 16u);
    EXPECT_EQ(trafficOf(*scene).bytesHeld, held);
}

TEST_F(LabelText, manyThreadsMayChangeItWhileItIsDrawn)
{
    const auto scene = labelled(boards(10));
    ASSERT_TRUE(render(*scene));
    std::vector<std::thread> threads;
    for (unsigned int t = 0; t < 3; ++t)
        threads.emplace_back(
            [&scene, t]
            {
                for (unsigned int i = 0; i < 2000; ++i)
                    scene->setText(1 + (i * 3 + t) % 40, "V" + std::to_string(i));
            });
    for (int frame = 0; frame < 20; ++frame)
        render(*scene, fromFront(), Width, Height, 1);
    for (std::thread& thread : threads)
        thread.join();
    for (unsigned int i = 1; i <= 40; ++i)
        scene->setText(i, "T" + std::to_string(99 + i));
    EXPECT_TRUE(areEqual(render(*scene, fromFront(), Width, Height, 1),
                         render(*labelled(boards(10))), "labelText.threads"));
}

TEST_F(LabelText, aThousandTogglesLeaveNothingBehind)
{
    const auto model = boards(4);
    const auto scene = labelled(model);
    const Picture expected = render(*scene);
    const Picture bare = render(*model);
    const auto toggle = [&](int times)
    {
        for (int i = 0; i < times; ++i)
        {
            scene->setShown(i % 2 != 0);
            if (i % 8 == 0)
            {
                osgLabels::LabelSettings settings = scene->getSettings();
                settings.size = i % 16 ? 0.5f : 0.4f;
                scene->setSettings(settings);
            }
            render(*scene, fromFront(), Width, Height, 1);
        }
    };
    toggle(64);
    // OSG deletes what is not used within a few frames.
    const GLObjects before = countObjects();
    const double resident = support::residentMiB();
    toggle(1000);
    const GLObjects after = countObjects();
    EXPECT_GT(before.textures, 0u);
    EXPECT_LE(after.textures, before.textures + 16);
    EXPECT_LE(after.buffers, before.buffers + 16);
    EXPECT_LE(after.framebuffers, before.framebuffers + 8);
    EXPECT_LE(after.programs, before.programs + 16);
    // 125 new settings with an atlas of a few hundred KiB each: a leak of them is 20 MiB and more.
    EXPECT_LT(support::residentMiB() - resident, 8.0);
    scene->setShown(false);
    scene->setSettingsText("keys=off");
    EXPECT_TRUE(areEqual(render(*scene), bare, "labelText.hidden"));
    EXPECT_EQ(decisionOf(*scene), "dropped: they are not shown");
    scene->setShown(true);
    EXPECT_TRUE(areEqual(render(*scene), expected, "labelText.shownAgain"));
}

TEST_F(LabelText, aViewClosedAndOpenedAgainShowsTheSame)
{
    const auto scene = labelled(boards(4));
    const Picture expected = render(*scene);
    viewer().getViewer().setSceneData(nullptr);
    for (int i = 0; i < 3; ++i)
    {
        support::HeadlessViewer other({Width, Height});
        OSGKITS_NEED_GL(other);
        other.getViewer().setLightingMode(osg::View::NO_LIGHT);
        EXPECT_TRUE(areEqual(other.render(scene, fromFront(), Width, Height, 2), expected,
                             "labelText.opened" + std::to_string(i)));
        scene->setText(1, i % 2 ? "T100" : "T100 ");
        scene->setText(1, "T100");
    }
    EXPECT_TRUE(areEqual(render(*scene), expected, "labelText.first"));
}
