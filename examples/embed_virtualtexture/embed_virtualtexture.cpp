// SPDX-License-Identifier: MIT
// Virtual textures in a viewer of one's own: a tile store of any size on a wall, or models whose
// textures name their stores; how far the picture is, is printed each second.
#include <osgPagedTexture/TileStore.h>
#include <osgPagedTexture/VirtualOptions.h>
#include <osgPagedTexture/VirtualScene.h>
#include <osgPagedTexture/VirtualTexture.h>

#include <osg/Geometry>
#include <osgDB/ReadFile>
#include <osgGA/GUIEventHandler>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <cstdio>
#include <iostream>

namespace
{

using osgPagedTexture::VirtualScene;
using osgPagedTexture::VirtualTexture;

/// An upright wall of the store's shape, z up. Throws TileStoreError.
osg::ref_ptr<osg::Node> makeWall(const std::string& store)
{
    const auto& grid = osgPagedTexture::openTileStore(store)->getSettings().grid;
    const float height = float(double(grid.getHeight()) / double(grid.getWidth()));
    osg::ref_ptr<osg::Geometry> wall =
        osg::createTexturedQuadGeometry({}, osg::X_AXIS, osg::Z_AXIS * height);
    osg::StateSet& state = *wall->getOrCreateStateSet();
    state.setTextureAttributeAndModes(0, new VirtualTexture(store));
    state.setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    return wall;
}

class Report : public osgGA::GUIEventHandler
{
public:
    explicit Report(VirtualScene& scene) : _scene(&scene) {}

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override
    {
        if (event.getEventType() != osgGA::GUIEventAdapter::FRAME || event.getTime() < _next)
            return false;
        _next = event.getTime() + 1.0;
        std::printf("%s\n", _scene->isAtRest() ? "all pages that are in view are there"
                                               : "more pages to come");
        return false;
    }

private:
    const osg::ref_ptr<VirtualScene> _scene;
    double _next = 0.0;
};

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    osg::ApplicationUsage& usage = *arguments.getApplicationUsage();
    usage.setCommandLineUsage("embed_virtualtexture [switches] --wall store | model...");
    usage.addCommandLineOption("--wall <store>", "Shows a tile store on a wall");
    usage.addCommandLineOption("-s <name=value>", "A setting of .virtualtexture, as gpu=64");
    usage.addCommandLineOption("-h or --help", "This");
    osgViewer::Viewer viewer(arguments); // Takes -e, --window and others.
    if (arguments.read("-h") || arguments.read("--help"))
        return usage.write(std::cout), 0;

    osgPagedTexture::VirtualSettings settings;
    std::string setting, error, store;
    while (arguments.read("-s", setting))
    {
        const std::size_t equals = setting.find('=');
        const std::string value = equals < setting.size() ? setting.substr(equals + 1) : "";
        if (!setVirtualOption(settings, setting.substr(0, equals), value, error))
            return std::fprintf(stderr, "embed_virtualtexture: %s\n", error.c_str()), 2;
    }
    arguments.read("--wall", store);
    arguments.reportRemainingOptionsAsUnrecognized();
    if (arguments.errors())
        return arguments.writeErrorMessages(std::cerr), 2;

    osg::ref_ptr<VirtualScene> scene = new VirtualScene;
    scene->setSettings(settings);
    try
    {
        if (!store.empty())
            scene->addChild(makeWall(store));
    }
    catch (const osgPagedTexture::TileStoreError& fault)
    {
        return std::fprintf(stderr, "embed_virtualtexture: %s\n", fault.what()), 1;
    }
    for (int i = 1; i < arguments.argc(); ++i)
    {
        const osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile(arguments[i]);
        if (!model)
            return std::fprintf(stderr, "embed_virtualtexture: '%s' could not be read\n",
                                arguments[i]),
                   1;
        scene->addChild(model);
    }
    scene->install(); // Opens the stores that textures below name.
    viewer.setSceneData(scene);
    viewer.addEventHandler(new Report(*scene));
    viewer.addEventHandler(new osgViewer::HelpHandler(&usage)); // h shows the keys, too.
    return viewer.run();
}
