// SPDX-License-Identifier: MIT
// Labels in a viewer of one's own: a LabelScene over the scene, texts that change, a click that
// asks.
#include <osgLabels/LabelOptions.h>
#include <osgLabels/LabelScene.h>

#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgGA/GUIEventHandler>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <cmath>
#include <cstdio>
#include <iostream>

namespace
{

using osgLabels::LabelScene;

void add(osg::Group& parent, const char* name, osg::Shape* shape, const osg::Vec4& color)
{
    osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
    drawable->setName(name);
    drawable->setColor(color);
    parent.addChild(drawable);
}

/// A small plant, z up, in metres.
osg::ref_ptr<osg::Node> makePlant()
{
    osg::ref_ptr<osg::Group> plant = new osg::Group;
    add(*plant, "T-101", new osg::Cylinder({-3, 0, 2}, 1.2f, 4), {0.75f, 0.75f, 0.72f, 1});
    add(*plant, "S-102", new osg::Sphere({0.5f, 1, 1.5f}, 1.5f), {0.8f, 0.6f, 0.2f, 1});
    add(*plant, "E-103", new osg::Box({3.5f, 0, 1}, 2, 3, 2), {0.25f, 0.4f, 0.55f, 1});
    osg::ref_ptr<osg::Cylinder> pipe = new osg::Cylinder({0, -2, 0.5f}, 0.3f, 10);
    pipe->setRotation(osg::Quat(osg::PI_2, osg::Y_AXIS));
    add(*plant, "P-104", pipe, {0.2f, 0.5f, 0.3f, 1});
    return plant;
}

/// Gives the first object a new text each second, as a control system would, and prints what a
/// click of the left button hits.
class Operator : public osgGA::GUIEventHandler
{
public:
    explicit Operator(LabelScene& scene) : _scene(&scene) {}

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer) override
    {
        if (event.getEventType() == osgGA::GUIEventAdapter::PUSH &&
            event.getButton() == osgGA::GUIEventAdapter::LEFT_MOUSE_BUTTON)
        {
            _scene->pick(event.getXnormalized(), event.getYnormalized());
            viewer.requestRedraw();
        }
        if (event.getEventType() == osgGA::GUIEventAdapter::FRAME)
            handleFrame(event.getTime());
        return false;
    }

private:
    void handleFrame(double seconds)
    {
        if (const auto picked = _scene->takePicked(); picked && picked->identifier)
            std::printf("%u '%s' %s\n", picked->identifier, picked->text.c_str(),
                        picked->path.c_str());
        if (_name.empty())
            _name = _scene->getText(1); // objects are numbered from 1 when the first frame is drawn
        if (_name.empty() || seconds < _next)
            return;
        _next = std::floor(seconds) + 1.0;
        _scene->setText(1, _name + " " + std::to_string(80 + int(_next * 7) % 11) + "\u00b0C");
    }

    const osg::ref_ptr<LabelScene> _scene;
    std::string _name;
    double _next = 0.0;
};

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    osg::ApplicationUsage& usage = *arguments.getApplicationUsage();
    usage.setCommandLineUsage("embed_labels [switches] [model]...");
    usage.addCommandLineOption("-s <name=value>", "A setting of .labels, as size=0.3");
    usage.addCommandLineOption("-h or --help", "This");
    osgViewer::Viewer viewer(arguments); // Takes -e, --window and others.
    if (arguments.read("-h") || arguments.read("--help"))
        return usage.write(std::cout), 0;

    osgLabels::LabelSettings settings;
    std::string setting, error;
    while (arguments.read("-s", setting))
    {
        const std::size_t equals = setting.find('=');
        const std::string value = equals < setting.size() ? setting.substr(equals + 1) : "";
        if (!setLabelOption(settings, setting.substr(0, equals), value, error))
            return std::fprintf(stderr, "embed_labels: %s\n", error.c_str()), 2;
    }
    arguments.reportRemainingOptionsAsUnrecognized();
    if (arguments.errors())
        return arguments.writeErrorMessages(std::cerr), 2;
    osg::ref_ptr<osg::Node> model =
        arguments.argc() > 1 ? osgDB::readRefNodeFiles(arguments) : makePlant();
    if (!model)
        return std::fprintf(stderr, "embed_labels: no model could be read\n"), 1;

    osg::ref_ptr<LabelScene> scene = new LabelScene;
    scene->setSettings(settings);
    scene->addChild(model);
    viewer.setSceneData(scene);
    viewer.addEventHandler(new Operator(*scene));
    viewer.addEventHandler(new osgViewer::HelpHandler(&usage)); // h shows the keys for labels, too.
    return viewer.run();
}
