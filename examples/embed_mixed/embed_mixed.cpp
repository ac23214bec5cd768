// SPDX-License-Identifier: MIT
// Mixed renderings in a viewer of one's own: what is near a point that moves is shown in full, the
// rest as a drawing, and a shader that the program brings along is one of the renderings.
#include <osgMultiRender/Import.h>
#include <osgMultiRender/MixOptions.h>
#include <osgMultiRender/MixedScene.h>
#include <osgMultiRender/PseudoLoader.h>

#include <osg/ArgumentParser>
#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgGA/GUIEventHandler>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <cmath>
#include <iostream>

namespace
{

using osgMultiRender::MixedScene;

/// A row of houses, in metres.
osg::ref_ptr<osg::Node> makeStreet()
{
    osg::ref_ptr<osg::Group> street = new osg::Group;
    const auto add = [&](osg::Shape* shape, const osg::Vec4& color)
    {
        osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
        drawable->setColor(color);
        street->addChild(drawable);
    };
    add(new osg::Box({0, 0, -0.5f}, 80, 40, 1), {0.6f, 0.62f, 0.6f, 1});
    for (int i = -4; i <= 4; ++i)
    {
        const float height = 6.0f + 3.0f * float((i + 9) % 4), x = 8.5f * float(i);
        add(new osg::Box({x, 0, 0.5f * height}, 7, 9, height), {0.8f, 0.6f, 0.45f, 1});
        add(new osg::Sphere({x, -9, 1.5f}, 1.5f), {0.3f, 0.6f, 0.3f, 1});
    }
    return street;
}

/// Rings around the model's axis, for what is far: any GLSL will do.
osgMultiRender::Rendering makeRings()
{
    osgMultiRender::Rendering rings;
    rings.name = "rings";
    rings.shaders.push_back({osgMultiRender::GlslStage::Vertex,
                             "varying vec3 place;\n"
                             "void main()\n{\n    place = gl_Vertex.xyz;\n"
                             "    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;\n}\n",
                             "rings.vert"});
    rings.shaders.push_back({osgMultiRender::GlslStage::Fragment,
                             "varying vec3 place;\n"
                             "void main()\n{\n    float ring = fract(0.5 * length(place.xy));\n"
                             "    gl_FragColor = vec4(mix(vec3(0.9, 0.88, 0.8), vec3(0.3, 0.35, "
                             "0.5),\n                            step(0.9, ring)), 1.0);\n}\n",
                             "rings.frag"});
    return rings;
}

/// Moves the key point along the street; nothing is compiled for it.
class Walk : public osgGA::GUIEventHandler
{
public:
    explicit Walk(MixedScene& scene) : _scene(&scene) {}

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override
    {
        osg::ref_ptr<MixedScene> scene;
        if (event.getEventType() == osgGA::GUIEventAdapter::FRAME && _scene.lock(scene))
        {
            const double x = scene->getBound().radius() * 0.8 * std::sin(0.4 * event.getTime());
            scene->setKeyPoints({scene->getBound().center() + osg::Vec3d(x, 0, 0)});
        }
        return false;
    }

private:
    osg::observer_ptr<MixedScene> _scene;
};

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    osg::ApplicationUsage& usage = *arguments.getApplicationUsage();
    usage.addCommandLineOption("-s <name=value>", "Settings of .multirender, as show=lines");
    usage.addCommandLineOption("-h or --help", "This");
    osgViewer::Viewer viewer(arguments); // Takes -e, --window and others.
    if (arguments.read("-h") || arguments.read("--help"))
        return usage.write(std::cout), 0;
    std::string settings, error;
    arguments.read("-s", settings);
    arguments.reportRemainingOptionsAsUnrecognized();
    if (arguments.errors())
        return arguments.writeErrorMessages(std::cerr), 2;
    osg::ref_ptr<osg::Node> model =
        arguments.argc() > 1 ? osgDB::readRefNodeFiles(arguments) : makeStreet();
    if (!model)
        return std::cerr << "embed_mixed: no model could be read\n", 1;
    osg::ref_ptr<MixedScene> scene = new MixedScene;
    scene->addChild(model);
    const double size = scene->getBound().radius();
    scene->addRendering(osgMultiRender::importNamed("phong"), {0.0, 0.0, 0.2 * size, 0.4 * size});
    scene->addRendering(osgMultiRender::importNamed("toon"),
                        {0.2 * size, 0.4 * size, 0.5 * size, 0.8 * size});
    scene->addRendering(makeRings(), {0.5 * size, 0.8 * size});
    osgMultiRender::Settings parsed;
    if (!osgMultiRender::parseSettings(settings, parsed, error) ||
        !osgMultiRender::setMixOptions(*scene, parsed, error))
        return std::cerr << "embed_mixed: " << error << "\n", 2;
    viewer.setSceneData(scene);
    viewer.addEventHandler(new Walk(*scene));
    viewer.addEventHandler(new osgViewer::HelpHandler(&usage));
    return viewer.run();
}
