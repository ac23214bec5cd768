// SPDX-License-Identifier: MIT
// Shadows in a viewer of one's own: a ShadowedScene over the scene, and that is all.
#include <osgShadowVolume/SceneOptions.h>
#include <osgShadowVolume/ShadowedScene.h>

#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgGA/StateSetManipulator>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <cstdio>
#include <iostream>

namespace
{

osg::ref_ptr<osg::ShapeDrawable> makeShape(osg::Shape* shape, const osg::Vec4& color)
{
    osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
    drawable->setColor(color);
    return drawable;
}

/// Things on a floor of 10 x 10 units, z up.
osg::ref_ptr<osg::Node> makeThings()
{
    osg::ref_ptr<osg::Group> things = new osg::Group;
    things->addChild(makeShape(new osg::Box({0, 0, -0.1f}, 10, 10, 0.2f), {0.6f, 0.6f, 0.58f, 1}));
    things->addChild(makeShape(new osg::Sphere({-1.5f, 0.5f, 1}, 1), {0.8f, 0.3f, 0.2f, 1}));
    things->addChild(makeShape(new osg::Box({1.5f, 1, 0.75f}, 1.5f), {0.2f, 0.5f, 0.8f, 1}));
    things->addChild(
        makeShape(new osg::Cone({0.4f, -1.6f, 0.4f}, 0.7f, 1.6f), {0.3f, 0.7f, 0.3f, 1}));
    return things;
}

/// A light at `position`, for all of `scene`. w is 1 for a lamp and 0 for a sun.
osg::ref_ptr<osg::LightSource> makeLight(unsigned int number, const osg::Vec4& position,
                                         const osg::Vec4& color, osg::Group& scene)
{
    osg::ref_ptr<osg::Light> light = new osg::Light(number);
    light->setPosition(position);
    light->setDiffuse(color);
    light->setAmbient({0.08f, 0.08f, 0.08f, 1});
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(light);
    source->setStateSetModes(*scene.getOrCreateStateSet(), osg::StateAttribute::ON);
    return source;
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    osg::ApplicationUsage& usage = *arguments.getApplicationUsage();
    usage.setCommandLineUsage("embed_shadows [switches] [model]...");
    usage.addCommandLineOption("-s <name=value>", "A setting of .shadowvolume, as shadows=map");
    usage.addCommandLineOption("-h or --help", "This");
    osgViewer::Viewer viewer(arguments); // Takes -e, --window and others.
    if (arguments.read("-h") || arguments.read("--help"))
        return usage.write(std::cout), 0;

    // From here to setSceneData() is what an application needs.
    osg::ref_ptr<osgShadowVolume::ShadowedScene> scene = new osgShadowVolume::ShadowedScene;
    std::string setting, error;
    while (arguments.read("-s", setting))
    {
        const std::size_t equals = setting.find('=');
        const std::string value = equals < setting.size() ? setting.substr(equals + 1) : "";
        if (!setSceneOption(*scene, setting.substr(0, equals), value, error))
            return std::fprintf(stderr, "embed_shadows: %s\n", error.c_str()), 2;
    }
    arguments.reportRemainingOptionsAsUnrecognized();
    if (arguments.errors())
        return arguments.writeErrorMessages(std::cerr), 2;
    osg::ref_ptr<osg::Node> things =
        arguments.argc() > 1 ? osgDB::readRefNodeFiles(arguments) : makeThings();
    if (!things)
        return std::fprintf(stderr, "embed_shadows: no model could be read\n"), 1;
    scene->addChild(things);

    // A warm lamp above the scene that goes round, and a dim blue sky light from the side.
    const osg::BoundingSphere bound = scene->getBound();
    const float radius = bound.radius();
    osg::ref_ptr<osg::MatrixTransform> round = new osg::MatrixTransform;
    round->setUpdateCallback(new osg::AnimationPathCallback(bound.center(), osg::Z_AXIS, 0.5f));
    const osg::Vec4 lamp(bound.center() + osg::Vec3(0.4f, -0.3f, 0.7f) * radius, 1);
    round->addChild(makeLight(1, lamp, {1, 0.85f, 0.6f, 1}, *scene));
    scene->addChild(round);
    scene->addChild(makeLight(2, {-0.6f, -0.3f, 0.9f, 0}, {0.3f, 0.35f, 0.5f, 1}, *scene));
    // Without the viewer's headlight, and so with lighting switched on by the scene itself.
    viewer.setLightingMode(osg::View::NO_LIGHT);
    scene->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    viewer.setSceneData(scene);

    osg::ref_ptr<osgGA::TrackballManipulator> trackball = new osgGA::TrackballManipulator;
    trackball->setHomePosition(bound.center() + osg::Vec3(0.5f, -1.9f, 1.5f) * radius,
                               bound.center(), osg::Z_AXIS);
    viewer.setCameraManipulator(trackball);
    viewer.addEventHandler(
        new osgGA::StateSetManipulator(viewer.getCamera()->getOrCreateStateSet()));
    viewer.addEventHandler(new osgViewer::StatsHandler);
    viewer.addEventHandler(
        new osgViewer::HelpHandler(&usage)); // h shows the keys for shadows, too.
    return viewer.run();
}
