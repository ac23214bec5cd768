// SPDX-License-Identifier: MIT
// Map labels that change while they are shown: styles, places, meshes before them, and by keys.
#include "MapPictures.h"

#include <support/NotifyCapture.h>

#include <osg/Camera>
#include <osg/LOD>
#include <osg/Switch>
#include <osg/ValueObject>
#include <osgGA/EventQueue>

#include <limits>

using namespace mapScene;
using osgLabels::LabelScene;

namespace
{

class MapChange : public MapTest
{
};

constexpr char Blue[] = "styles='blue:ink=#0000ff,plate=#0000ff'";

int bluePixels(const osg::Image& picture)
{
    int count = 0;
    for (int y = 0; y < picture.t(); ++y)
        for (int x = 0; x < picture.s(); ++x)
        {
            const osg::Vec4 color = picture.getColor(unsigned(x), unsigned(y));
            count += color.b() > 0.9f && color.r() < 0.1f && color.g() < 0.1f;
        }
    return count;
}

Picture drawOne(LabelScene& scene)
{
    return render(scene, labelScene::fromFront(), labelScene::Width, labelScene::Height, 1);
}

LabelScene::Picked pickAt(LabelScene& scene, double x, double y)
{
    scene.pick(x, y);
    drawOne(scene);
    return scene.takePicked().value_or(LabelScene::Picked{~0u, "no answer", ""});
}

/// In the viewer; returns what it prints.
support::NotifyCapture::Lines press(LabelScene& scene, char key)
{
    support::NotifyCapture capture(osg::NOTICE);
    osgGA::EventQueue& queue = *labelScene::viewer().getViewer().getEventQueue();
    queue.keyPress(key);
    queue.keyRelease(key);
    drawOne(scene);
    return capture.takeMessages();
}

osg::ref_ptr<LabelScene> withKeys(const std::vector<osg::ref_ptr<osg::Node>>& nodes)
{
    const auto top = scene(nodes);
    osgLabels::LabelSettings settings = top->getSettings();
    settings.keys = true;
    top->setSettings(settings);
    render(*top);
    return top;
}

osg::ref_ptr<osg::Geode> half()
{
    return box("half", {-0.5f, -1, 0}, {0.5f, 0.2f, 0.7f}, {0.4f, 0.5f, 0.6f, 1});
}

/// A closed cube around the origin, of triangles whose last two are its far side.
osg::ref_ptr<osg::Geometry> cube()
{
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (int i = 0; i < 8; ++i)
        corners->push_back({i & 1 ? 0.6f : -0.6f, i & 2 ? 0.6f : -0.6f, i & 4 ? 0.6f : -0.6f});
    const GLushort faces[] = {0, 1, 5, 0, 5, 4, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5,
                              0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 2, 6, 7, 2, 7, 3};
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(corners);
    geometry->addPrimitiveSet(new osg::DrawElementsUShort(GL_TRIANGLES, 36, faces));
    geometry->setUseVertexBufferObjects(true);
    geometry->setUseDisplayList(false);
    geometry->setDataVariance(osg::Object::DYNAMIC);
    return geometry;
}

} // namespace

TEST_F(MapChange, aStyleIsExchangedAtRunTime)
{
    osg::ref_ptr<osg::Geode> valued = box("own", {0, 1, -0.6f}, {0.2f, 0.1f, 0.2f});
    valued->setUserValue("label", std::string("by value"));
    const auto top = scene({label("text", {0, 0, 0.5}), valued}, std::string("map=values,") + Blue);
    const int red = redPixels(*render(*top));
    ASSERT_GT(red, 200);
    const auto byNode = pickAt(*top, 0.0, 0.5).identifier;
    const auto at = pixelOf({0, 1, -0.4});
    const auto byValue = pickAt(*top, 0.0, 2.0 * at.y() / labelScene::Height - 1.0).identifier;
    ASSERT_GE(byNode, 0x80000000u);
    ASSERT_GE(byValue, 0x80000000u);
    EXPECT_EQ(top->getStyle(byNode), "default");
    EXPECT_TRUE(top->setStyle(byNode, "blue"));
    EXPECT_EQ(top->getStyle(byNode), "blue");
    const Picture one = drawOne(*top);
    EXPECT_GT(redPixels(*one), 0);
    EXPECT_GT(bluePixels(*one), 0);
    EXPECT_EQ(bluePixels(*one) + redPixels(*one), red);
    EXPECT_TRUE(top->setStyle(byValue, "blue"));
    // Edges over the box lie the one or the other side of what counts as a colour.
    EXPECT_NEAR(bluePixels(*drawOne(*top)), red, 40);
    EXPECT_TRUE(top->setText(byValue, "by a longer value"));
    EXPECT_GT(bluePixels(*drawOne(*top)), red + 200) << "its plate is as long as its text";
    EXPECT_TRUE(top->setStyle(byNode, "default"));
    EXPECT_GT(redPixels(*drawOne(*top)), 0);
    EXPECT_FALSE(top->setStyle(0xF0000000u, "blue"));
    EXPECT_EQ(_notify.takeWarnings(), support::NotifyCapture::Lines());
}

TEST_F(MapChange, labelsByValueGoWithTheirNodes)
{
    osg::ref_ptr<osg::Geode> valued = box("own", {0, 1, -0.6f}, {0.2f, 0.1f, 0.2f});
    valued->setUserValue("label", std::string("by value"));
    osg::ref_ptr<osg::Switch> choice = new osg::Switch;
    choice->addChild(valued);
    const auto top = scene({half(), choice}, "map=values");
    const int all = redPixels(*render(*top));
    EXPECT_GT(all, 100);
    choice->setAllChildrenOff();
    EXPECT_EQ(redPixels(*drawOne(*top)), 0) << "switched off";
    choice->setAllChildrenOn();
    EXPECT_EQ(redPixels(*drawOne(*top)), all);
    labelScene::viewer().getViewer().getCamera()->setCullMask(1u);
    valued->setNodeMask(2u);
    EXPECT_EQ(redPixels(*drawOne(*top)), 0) << "masked in this view";
    labelScene::viewer().getViewer().getCamera()->setCullMask(~0u);
    EXPECT_EQ(redPixels(*drawOne(*top)), all);
    choice->removeChild(valued);
    EXPECT_EQ(redPixels(*drawOne(*top)), 0) << "taken out, while somebody keeps it";
}

TEST_F(MapChange, labelsByValueGoWithLevelsOfDetail)
{
    osg::ref_ptr<osg::Geode> valued = box("own", {0, 1, -0.6f}, {0.2f, 0.1f, 0.2f});
    valued->setUserValue("label", std::string("by value"));
    osg::ref_ptr<osg::LOD> levels = new osg::LOD;
    levels->addChild(valued, 0.0f, 100.0f);
    const auto top = scene({half(), levels}, "map=values");
    const int all = redPixels(*render(*top));
    EXPECT_GT(all, 100);
    levels->setRange(0, 50.0f, 100.0f);
    EXPECT_EQ(redPixels(*drawOne(*top)), 0) << "too near";
    levels->setRangeMode(osg::LOD::PIXEL_SIZE_ON_SCREEN);
    levels->setRange(0, 1.0f, 1000.0f);
    EXPECT_EQ(redPixels(*drawOne(*top)), all);
    levels->setRange(0, 1000.0f, 2000.0f);
    EXPECT_EQ(redPixels(*drawOne(*top)), 0) << "too small";
}

TEST_F(MapChange, labelsByValueNeedNoDrawableInView)
{
    osg::ref_ptr<osg::Geode> valued = box("own", {0, 0, -1.35f}, {0.2f, 0.1f, 0.3f});
    valued->setUserValue("label", std::string("by value"));
    EXPECT_GT(redPixels(*render(*scene({valued}, "map=values,mapleader=60"))), 100);
}

TEST_F(MapChange, labelsByValueDieWithTheirNodes)
{
    const auto top = scene({half()}, "map=values");
    for (int i = 0; i < 5; ++i)
    {
        // Nodes that die leave their addresses to those that follow.
        osg::ref_ptr<osg::Geode> valued = box("own", {0, 1, -0.6f}, {0.2f, 0.1f, 0.2f});
        valued->setUserValue("label", std::string("by value"));
        top->addChild(valued);
        EXPECT_GT(redPixels(*render(*top)), 100) << "node " << i;
        top->removeChild(valued);
        valued = nullptr;
        EXPECT_EQ(redPixels(*render(*top)), 0) << "node " << i;
    }
}

TEST_F(MapChange, aPriorityByValueThatIsNoNumberIsNamed)
{
    osg::ref_ptr<osg::Geode> valued = box("own", {0, 1, -0.6f}, {0.2f, 0.1f, 0.2f});
    valued->setUserValue("label", std::string("by value"));
    valued->setUserValue("labelPriority", std::numeric_limits<double>::quiet_NaN());
    EXPECT_GT(redPixels(*render(*scene({valued}, "map=values"))), 100);
    EXPECT_EQ(_notify.takeWarnings(),
              support::NotifyCapture::Lines({"osgLabels::LabelScene: labelPriority of node 'own' "
                                             "is no finite number; it counts as 0"}));
}

TEST_F(MapChange, anInsetBelowTheSceneDoesNotMoveItsLabels)
{
    osg::ref_ptr<osg::Camera> inset = new osg::Camera;
    inset->setRenderOrder(osg::Camera::NESTED_RENDER);
    inset->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    inset->setViewport(0, 0, 40, 40);
    inset->addChild(box("hud", {0, 0, 0}, {0.5f, 0.5f, 0.5f}));
    const auto with = scene({inset, half(), label("text", {0.5, 0, 0.5})});
    const auto without = scene({half(), label("text", {0.5, 0, 0.5})});
    EXPECT_EQ(redPixels(*render(*with)), redPixels(*render(*without)));
}

TEST_F(MapChange, labelsThatAreSetAnewKeepTheirIdentifiers)
{
    osg::ref_ptr<osgLabels::MapLabels> labels = new osgLabels::MapLabels;
    const auto set = [&](double x, int count)
    {
        std::vector<osgLabels::MapLabel> all;
        for (int i = 0; i < count; ++i)
            all.push_back({{x, 0, 0.6 - 0.4 * i}, "ship " + std::to_string(i), 0, {}, {}});
        labels->setLabels(all);
    };
    set(-0.5, 3);
    const auto top = scene({labels});
    render(*top);
    const auto identifiersAt = [&](double x)
    {
        std::vector<std::uint32_t> found;
        for (int i = 0; i < 3; ++i)
            found.push_back(pickAt(*top, x / (4.0 / 3.0), 0.6 - 0.4 * i).identifier);
        return found;
    };
    const std::vector<std::uint32_t> first = identifiersAt(-0.5);
    ASSERT_GE(first[0], 0x80000000u);
    set(0.0, 3);
    EXPECT_EQ(identifiersAt(0.0), first);
    set(0.3, 2);
    set(0.5, 3);
    const std::vector<std::uint32_t> last = identifiersAt(0.5);
    EXPECT_EQ(last[0], first[0]);
    EXPECT_EQ(last[1], first[1]);
    EXPECT_EQ(pickAt(*top, 0.5 / (4.0 / 3.0), -0.2).text, "ship 2");
}

TEST_F(MapChange, labelsOfOneNodeInTwoPlacesKeepTheirOwnStates)
{
    // Twice the same labels, of which one hides; then one label that is seen.
    const auto pair = label("a", {0, 0, 0});
    const auto top = scene({half(), pair, pair, label("b", {0.5, 0, 0}), label("c", {-0.5, 0, 0})},
                           "maptest=anchor");
    Picture first;
    for (int i = 0; i < 5; ++i)
    {
        labelScene::viewer().setSimulationTime(1.0 + 0.1 * i);
        support::CameraSpec camera = labelScene::fromFront();
        camera.view.preMultTranslate(osg::Vec3d(1e-5 * i, 0, 0));
        const Picture now = render(*top, camera, labelScene::Width, labelScene::Height, 1);
        first = first ? first : now;
        EXPECT_NEAR(redPixels(*now), redPixels(*first), 2) << i;
    }
}

TEST_F(MapChange, aMeshThatIsOpenedIsJudgedAgain)
{
    const auto mesh = cube();
    const auto top = scene({labelScene::named("cube", mesh), label("inside", {0, 0, 0})});
    EXPECT_GT(redPixels(*render(*top)), 100) << "the camera's rays haven't left the cube";
    auto& faces = static_cast<osg::DrawElementsUShort&>(*mesh->getPrimitiveSet(0));
    const std::vector<GLushort> last(faces.end() - 6, faces.end());
    faces.resize(30);
    faces.dirty();
    EXPECT_EQ(redPixels(*render(*top)), 0) << "of an open mesh both sides count";
    faces.insert(faces.end(), last.begin(), last.end());
    faces.dirty();
    EXPECT_GT(redPixels(*render(*top)), 100);
}

TEST_F(MapChange, keysChangeTestActionDeclutteringAndWhetherThereAreLabels)
{
    const auto top = withKeys({half(), label("longer text", {-0.1, 0, 0}),
                               label("longer text", {-0.1, 0, 0.05}, "", 1.0)});
    const auto settings = [&] { return top->getSettings(); };
    using Lines = support::NotifyCapture::Lines;
    const auto both = redPixels(*drawOne(*top));
    EXPECT_EQ(press(*top, 'G'), Lines({"osgLabels: declutter=on"}));
    EXPECT_TRUE(settings().declutter);
    const int one = redPixels(*drawOne(*top));
    EXPECT_LT(one, both);
    EXPECT_GT(one, 50);
    EXPECT_EQ(press(*top, 'U'), Lines({"osgLabels: maptest=anchor"}));
    EXPECT_EQ(settings().mapTest, osgLabels::MapTest::Anchor);
    EXPECT_EQ(redPixels(*drawOne(*top)), 0) << "anchors are behind";
    EXPECT_EQ(press(*top, 'O'), Lines({"osgLabels: mapaction=outline"}));
    EXPECT_EQ(press(*top, 'O'), Lines({"osgLabels: mapaction=recolor"}));
    EXPECT_EQ(press(*top, 'O'), Lines({"osgLabels: mapaction=fade"}));
    EXPECT_EQ(press(*top, 'O'), Lines({"osgLabels: mapaction=ignore"}));
    EXPECT_GT(redPixels(*drawOne(*top)), one) << "nothing hides any more";
    EXPECT_EQ(press(*top, 'O'), Lines({"osgLabels: mapaction=hide"}));
    EXPECT_EQ(press(*top, 'U'), Lines({"osgLabels: maptest=share"}));
    EXPECT_EQ(press(*top, 'U'), Lines({"osgLabels: maptest=pixel"}));
    EXPECT_EQ(press(*top, 'G'), Lines({"osgLabels: declutter=off"}));
    EXPECT_EQ(redPixels(*drawOne(*top)), both);
    press(*top, 'L');
    EXPECT_EQ(redPixels(*drawOne(*top)), 0);
    press(*top, 'L');
    EXPECT_EQ(redPixels(*drawOne(*top)), both);
}
