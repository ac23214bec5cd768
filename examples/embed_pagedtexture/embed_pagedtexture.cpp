// SPDX-License-Identifier: MIT
// Paged textures in a viewer of one's own: models are read without their images, or a scene that is
// there already gives its textures up; what is where is printed each second.
#include <osgPagedTexture/PagedOptions.h>
#include <osgPagedTexture/PagedScene.h>

#include <osg/Geometry>
#include <osg/Texture2D>
#include <osgGA/GUIEventHandler>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <cmath>
#include <cstdio>
#include <iostream>

namespace
{

using osgPagedTexture::PagedScene;

osg::ref_ptr<osg::Image> makePicture(int number)
{
    constexpr int side = 512;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(side, side, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
        {
            const double ring = 0.5 + 0.5 * std::sin(0.002 * (x * x + y * y) / (1.0 + number));
            image->setColor(osg::Vec4(float(ring), float(x) / side, float(number % 4) / 3.0f, 1.0f),
                            unsigned(x), unsigned(y));
        }
    return image;
}

/// Walls behind each other, z up, each with a picture of its own in memory.
osg::ref_ptr<osg::Node> makeGallery()
{
    osg::ref_ptr<osg::Group> gallery = new osg::Group;
    for (int i = 0; i < 12; ++i)
    {
        osg::ref_ptr<osg::Geometry> wall = osg::createTexturedQuadGeometry(
            osg::Vec3(2.5f * float(i % 4), 5.0f * float(i / 4), 1.5f * float(i / 4)),
            osg::Vec3(2, 0, 0), osg::Vec3(0, 0, 2));
        wall->getOrCreateStateSet()->setTextureAttributeAndModes(
            0, new osg::Texture2D(makePicture(i)));
        gallery->addChild(wall);
    }
    return gallery;
}

class Report : public osgGA::GUIEventHandler
{
public:
    explicit Report(PagedScene& scene) : _scene(&scene) {}

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override
    {
        if (event.getEventType() != osgGA::GUIEventAdapter::FRAME || event.getTime() < _next)
            return false;
        _next = event.getTime() + 1.0;
        const osgPagedTexture::PagerStatistics now = _scene->getStatistics();
        std::printf("%zu of %zu textures in view, %zu there, %.1f MiB on the GPU%s\n", now.inView,
                    now.textures, now.resident, double(now.upload.bytes) / 1048576.0,
                    _scene->isAtRest() ? "" : ", more to come");
        return false;
    }

private:
    const osg::ref_ptr<PagedScene> _scene;
    double _next = 0.0;
};

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    osg::ApplicationUsage& usage = *arguments.getApplicationUsage();
    usage.setCommandLineUsage("embed_pagedtexture [switches] [model]...");
    usage.addCommandLineOption("-s <name=value>", "A setting of .pagedtexture, as gpu=64");
    usage.addCommandLineOption("-h or --help", "This");
    osgViewer::Viewer viewer(arguments); // Takes -e, --window and others.
    if (arguments.read("-h") || arguments.read("--help"))
        return usage.write(std::cout), 0;

    osgPagedTexture::PagedSettings settings;
    std::string setting, error;
    while (arguments.read("-s", setting))
    {
        const std::size_t equals = setting.find('=');
        const std::string value = equals < setting.size() ? setting.substr(equals + 1) : "";
        if (!setPagedOption(settings, setting.substr(0, equals), value, error))
            return std::fprintf(stderr, "embed_pagedtexture: %s\n", error.c_str()), 2;
    }
    arguments.reportRemainingOptionsAsUnrecognized();
    if (arguments.errors())
        return arguments.writeErrorMessages(std::cerr), 2;

    osg::ref_ptr<PagedScene> scene = new PagedScene;
    scene->setSettings(settings);
    for (int i = 1; i < arguments.argc(); ++i)
        if (!scene->readModel(arguments[i]).validNode())
            return std::fprintf(stderr, "embed_pagedtexture: '%s' could not be read\n",
                                arguments[i]),
                   1;
    if (arguments.argc() < 2)
        scene = osgPagedTexture::install(*makeGallery(), settings);
    viewer.setSceneData(scene);
    viewer.addEventHandler(new Report(*scene));
    viewer.addEventHandler(new osgViewer::HelpHandler(&usage)); // h shows the keys, too.
    return viewer.run();
}
