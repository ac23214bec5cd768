// SPDX-License-Identifier: MIT
// Map labels in a viewer of one's own: on houses, on what moves, and a click that asks.
#include <osgLabels/LabelOptions.h>
#include <osgLabels/LabelScene.h>
#include <osgLabels/MapLabels.h>

#include <osg/AnimationPath>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <iostream>

namespace
{

using namespace osgLabels;

void add(osg::Group& parent, const std::string& name, osg::Shape* shape, const osg::Vec4& color)
{
    osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
    drawable->setName(name);
    drawable->setColor(color);
    parent.addChild(drawable);
}

/// Houses and trees. One node has the labels of all houses; each names what never hides it.
osg::ref_ptr<osg::Group> makeTown()
{
    osg::ref_ptr<osg::Group> town = new osg::Group;
    add(*town, "ground", new osg::Box({0, 0, -0.5f}, 120, 120, 1), {0.5f, 0.58f, 0.42f, 1});
    std::vector<MapLabel> labels;
    for (int i = 0; i < 25; ++i)
    {
        const osg::Vec3 at(float(i % 5) * 18.0f - 36.0f, float(i / 5) * 18.0f - 36.0f, 0.0f);
        const float height = 4.0f + float(i * 7 % 11);
        const osg::Vec3 middle = at + osg::Vec3(0, 0, 0.5f * height);
        const std::string name = "House " + std::to_string(i + 1);
        add(*town, name, new osg::Box(middle, 9, 8, height), {0.7f, 0.55f, 0.4f, 1});
        add(*town, "tree", new osg::Sphere(at + osg::Vec3(8, 5, 2.5f), 2.2f),
            {0.2f, 0.5f, 0.2f, 1});
        labels.push_back({middle, name, height, {}, name});
    }
    town->addChild(new MapLabels(labels));
    return town;
}

/// A bus that drives around the town; its label moves with it.
osg::ref_ptr<osg::Node> makeBus()
{
    osg::ref_ptr<osg::AnimationPath> path = new osg::AnimationPath;
    const osg::Vec3d corners[] = {{-27, -27, 0}, {27, -27, 0}, {27, 27, 0}, {-27, 27, 0}};
    for (int i = 0; i <= 4; ++i)
        path->insert(5.0 * i, osg::AnimationPath::ControlPoint(corners[i % 4]));
    osg::ref_ptr<osg::MatrixTransform> bus = new osg::MatrixTransform;
    bus->setName("bus");
    bus->setUpdateCallback(new osg::AnimationPathCallback(path));
    add(*bus, "body", new osg::Box({0, 0, 1.5f}, 3, 3, 3), {0.9f, 0.75f, 0.1f, 1});
    bus->addChild(new MapLabels({{{0, 0, 3}, "Bus 7", 100, {}, "bus"}}));
    return bus;
}

/// Prints the label or object under a click of the left button.
struct Asker : osgGA::GUIEventHandler
{
    explicit Asker(LabelScene& scene) : _scene(&scene) {}
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer) override
    {
        if (event.getEventType() == event.PUSH && event.getButton() == event.LEFT_MOUSE_BUTTON)
        {
            _scene->pick(event.getXnormalized(), event.getYnormalized());
            viewer.requestRedraw(); // It is answered by the next picture.
        }
        if (const auto picked = _scene->takePicked(); picked && picked->identifier)
            std::cout << picked->text << std::endl;
        return false;
    }
    const osg::ref_ptr<LabelScene> _scene;
};

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    osg::ApplicationUsage& usage = *arguments.getApplicationUsage();
    usage.addCommandLineOption("-h or --help", "This");
    usage.addCommandLineOption("-s <name=value>", "A setting of .labels, as mapaction=fade");
    osgViewer::Viewer viewer(arguments); // Takes -e, --window and others.
    if (arguments.read("-h") || arguments.read("--help"))
        return usage.write(std::cout), 0;
    LabelSettings settings;
    settings.surface = SurfaceLabels::Off;
    settings.mapClass = "tree:fade";
    std::string setting, error;
    while (arguments.read("-s", setting))
    {
        const std::size_t equals = setting.find('=');
        const std::string value = equals < setting.size() ? setting.substr(equals + 1) : "";
        if (!setLabelOption(settings, setting.substr(0, equals), value, error))
            return std::cerr << "embed_maplabels: " << error << std::endl, 2;
    }
    arguments.reportRemainingOptionsAsUnrecognized();
    if (arguments.errors())
        return arguments.writeErrorMessages(std::cerr), 2;
    osg::ref_ptr<LabelScene> scene = new LabelScene;
    scene->setSettings(settings);
    scene->addChild(makeTown());
    scene->addChild(makeBus());
    viewer.setCameraManipulator(new osgGA::TrackballManipulator);
    viewer.getCameraManipulator()->setHomePosition({-40, -75, 40}, {0, 0, 0}, {0, 0, 1});
    viewer.setSceneData(scene);
    viewer.addEventHandler(new Asker(*scene));
    viewer.addEventHandler(new osgViewer::HelpHandler); // h shows the keys for labels, too.
    return viewer.run();
}
