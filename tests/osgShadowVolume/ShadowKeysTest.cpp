// SPDX-License-Identifier: MIT
#include <osgShadowVolume/SceneOptions.h>
#include <osgShadowVolume/ShadowKeys.h>

#include <support/NotifyCapture.h>

#include <osg/ApplicationUsage>
#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osgGA/AnimationPathManipulator>
#include <osgGA/DriveManipulator>
#include <osgGA/FirstPersonManipulator>
#include <osgGA/FlightManipulator>
#include <osgGA/OrbitManipulator>
#include <osgGA/SphericalManipulator>
#include <osgGA/StateSetManipulator>
#include <osgGA/TerrainManipulator>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <gtest/gtest.h>

using namespace osgShadowVolume;
using Lines = support::NotifyCapture::Lines;

namespace
{

/// Remembers which key events reach the viewer's handlers unhandled.
class Listener : public osgGA::GUIEventHandler
{
public:
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override
    {
        if (event.getEventType() == event.KEYDOWN && !event.getHandled())
            heard += char(event.getKey());
        return false;
    }

    std::string heard;
};

osg::ref_ptr<osg::LightSource> makeLight(int number, const std::string& name = {})
{
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->getLight()->setLightNum(number);
    source->setName(name);
    return source;
}

/// Two scenes under a transform beside lights, in a viewer that takes events as osgviewer does.
class ShadowKeysTest : public testing::Test
{
protected:
    void SetUp() override
    {
        _viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
        osg::ref_ptr<osg::Group> root = new osg::Group;
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform;
        transform->addChild(_second);
        root->addChild(makeLight(9, "lamp"));
        root->addChild(_first);
        root->addChild(transform);
        _first->addChild(makeLight(3));
        _viewer.addEventHandler(_listener);
        _viewer.setSceneData(root);
        _viewer.setUpViewerAsEmbeddedInWindow(0, 0, 64, 48);
        const Lines lines = press('y');
        if (_list.empty())
            _list = lines;
        else
            EXPECT_EQ(lines, Lines{}) << "once a process";
    }

    /// Sends a key through the window's event queue; returns what is printed.
    Lines press(int key)
    {
        support::NotifyCapture capture(osg::NOTICE);
        auto* window =
            dynamic_cast<osgViewer::GraphicsWindow*>(_viewer.getCamera()->getGraphicsContext());
        window->getEventQueue()->keyPress(key);
        window->getEventQueue()->keyRelease(key);
        _viewer.advance();
        _viewer.eventTraversal();
        return capture.takeMessages();
    }

    osgViewer::Viewer _viewer;
    osg::ref_ptr<ShadowedScene> _first = new ShadowedScene, _second = new ShadowedScene;
    osg::ref_ptr<Listener> _listener = new Listener;
    static Lines _list; ///< What the first event of the process printed.
};

Lines ShadowKeysTest::_list;

} // namespace

TEST_F(ShadowKeysTest, eachPressGoesOnAndPrintsOneLine)
{
    EXPECT_EQ(press('D'), Lines{"osgShadowVolume: shadows=map"});
    EXPECT_EQ(_first->getShadows(), Shadows::MAP);
    EXPECT_EQ(press('D'), Lines{"osgShadowVolume: shadows=off"});
    EXPECT_EQ(press('D'), Lines{"osgShadowVolume: shadows=volumes"});
    EXPECT_EQ(_first->getShadows(), Shadows::VOLUMES);
    for (const char* name : {"tess", "geometry", "cpu", "auto"})
        EXPECT_EQ(press('T'), Lines{std::string("osgShadowVolume: technique=") + name});
    EXPECT_EQ(press('E'), Lines{"osgShadowVolume: headlight=shadow"});
    EXPECT_TRUE(_first->getHeadlightShadow());
}

TEST_F(ShadowKeysTest, whatIsShownIsToggled)
{
    EXPECT_EQ(press('V'), Lines{"osgShadowVolume: show=volumes"});
    EXPECT_EQ(press('M'), Lines{"osgShadowVolume: show=mask"});
    EXPECT_EQ(_first->getShow(), Show::MASK);
    EXPECT_EQ(press('V'), Lines{"osgShadowVolume: show=volumes"});
    EXPECT_EQ(press('V'), Lines{"osgShadowVolume: show=picture"});
}

TEST_F(ShadowKeysTest, lightsOfTheWholeViewAreShownOneByOne)
{
    EXPECT_EQ(press('N'), Lines{"osgShadowVolume: light=0 (of the viewer), of 3"});
    EXPECT_EQ(press('N'), Lines{"osgShadowVolume: light=3, of 3"});
    EXPECT_EQ(press('N'), Lines{"osgShadowVolume: light=9 (lamp), of 3"});
    EXPECT_EQ(_first->getLightShown(), 9);
    EXPECT_EQ(press('N'), Lines{"osgShadowVolume: light=all, of 3"});
    EXPECT_EQ(press('B'), Lines{"osgShadowVolume: light=9 (lamp), of 3"});
    EXPECT_EQ(press('A'), Lines{"osgShadowVolume: light=all, of 3"});
    EXPECT_EQ(_first->getLightShown(), -1);
    _viewer.setLightingMode(osg::View::NO_LIGHT);
    EXPECT_EQ(press('N'), Lines{"osgShadowVolume: light=3, of 2"});
}

TEST_F(ShadowKeysTest, allScenesOfAViewFollowTheFirst)
{
    _second->setShadows(Shadows::OFF);
    EXPECT_EQ(press('D'), Lines{"osgShadowVolume: shadows=map"});
    EXPECT_EQ(_first->getShadows(), Shadows::MAP);
    EXPECT_EQ(_second->getShadows(), Shadows::MAP);
    EXPECT_EQ(press('N').size(), 1u);
    EXPECT_EQ(_second->getLightShown(), _first->getLightShown());
}

TEST_F(ShadowKeysTest, aSceneWithoutKeysStaysAsItIs)
{
    _first->setKeys(false);
    EXPECT_EQ(press('D'), Lines{"osgShadowVolume: shadows=map"});
    EXPECT_EQ(_first->getShadows(), Shadows::VOLUMES);
    EXPECT_EQ(_second->getShadows(), Shadows::MAP);
    _second->setKeys(false);
    EXPECT_EQ(press('D'), Lines{});
}

TEST_F(ShadowKeysTest, otherKeysAreLeftToTheViewer)
{
    _listener->heard.clear();
    EXPECT_EQ(press('s'), Lines{});
    press('D');
    press('d');
    EXPECT_EQ(_listener->heard, "sd");
}

TEST_F(ShadowKeysTest, aKeyThatAnotherNodeHasTakenDoesNothing)
{
    struct Taker : osgGA::GUIEventHandler
    {
        bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&, osg::Object*,
                    osg::NodeVisitor*) override
        {
            return event.getEventType() == event.KEYDOWN;
        }
    };
    _viewer.getSceneData()->asGroup()->getChild(0)->setEventCallback(new Taker);
    EXPECT_EQ(press('D'), Lines{});
    EXPECT_EQ(_first->getShadows(), Shadows::VOLUMES);
}

TEST_F(ShadowKeysTest, copiesAnswerToo)
{
    osg::ref_ptr<ShadowedScene> copy = new ShadowedScene(*_first);
    _viewer.setSceneData(copy);
    EXPECT_EQ(press('D'), Lines{"osgShadowVolume: shadows=map"});
    EXPECT_EQ(copy->getShadows(), Shadows::MAP);
}

TEST_F(ShadowKeysTest, aWindowBringsTheListOfKeysOnce)
{
    Lines expected = {"osgShadowVolume: keys for shadows, with shift"};
    for (const ShadowKey& key : shadowKeys())
        expected.push_back(std::string("  ") + key.key + "  " + key.help);
    EXPECT_EQ(_list, expected);
}

TEST_F(ShadowKeysTest, thePlanSaysWhereThereIsNone)
{
    _second->setKeys(false);
    EXPECT_EQ(press('P'), Lines{"osgShadowVolume: no frame has been drawn, so no plan"});
}

TEST(ShadowKeysListTest, keysAreNoneOfOsgviewersOwn)
{
    osg::ref_ptr<osg::ApplicationUsage> usage = new osg::ApplicationUsage;
    const osg::ref_ptr<osgGA::GUIEventHandler> handlers[] = {
        new osgGA::TrackballManipulator,
        new osgGA::FlightManipulator,
        new osgGA::DriveManipulator,
        new osgGA::TerrainManipulator,
        new osgGA::OrbitManipulator,
        new osgGA::FirstPersonManipulator,
        new osgGA::SphericalManipulator,
        new osgGA::AnimationPathManipulator(new osg::AnimationPath),
        new osgGA::StateSetManipulator,
        new osgViewer::ThreadingHandler,
        new osgViewer::WindowSizeHandler,
        new osgViewer::StatsHandler,
        new osgViewer::HelpHandler,
        new osgViewer::RecordCameraPathHandler,
        new osgViewer::LODScaleHandler,
        new osgViewer::ScreenCaptureHandler,
        new osgViewer::ToggleSyncToVBlankHandler};
    for (const auto& handler : handlers)
        handler->getUsage(*usage);
    ASSERT_GT(usage->getKeyboardMouseBindings().size(), 30u);
    std::string own;
    for (const auto& binding : usage->getKeyboardMouseBindings())
    {
        // "s", "Flight: q"; not "Drive: Space".
        const std::size_t colon = binding.first.rfind(": ");
        const std::string name =
            colon == std::string::npos ? binding.first : binding.first.substr(colon + 2);
        if (name.size() == 1)
            own += name;
    }
    EXPECT_NE(own.find('q'), std::string::npos);
    for (const ShadowKey& key : shadowKeys())
        EXPECT_EQ(own.find(key.key), std::string::npos) << key.key << " of " << own;
}

TEST(ShadowKeysListTest, keysAreInTheViewersHelp)
{
    const auto& bindings = osg::ApplicationUsage::instance()->getKeyboardMouseBindings();
    ASSERT_FALSE(shadowKeys().empty());
    for (const ShadowKey& key : shadowKeys())
    {
        const auto found = bindings.find(std::string(1, key.key));
        ASSERT_NE(found, bindings.end()) << key.key;
        EXPECT_EQ(found->second, key.help);
    }
}

TEST(ShadowKeysListTest, valuesOfKeysAreValuesOfTheirSettings)
{
    ASSERT_FALSE(shadowKeys().empty());
    for (const ShadowKey& key : shadowKeys())
    {
        if (!key.setting)
            continue;
        const SceneOption* option = findSceneOption(key.setting);
        ASSERT_TRUE(option) << key.key;
        osg::ref_ptr<ShadowedScene> scene = new ShadowedScene;
        for (const std::string& value : key.values)
            EXPECT_EQ(option->parse(*scene, value), "") << key.key;
    }
}
