// SPDX-License-Identifier: MIT
#include <osgMultiRender/PseudoLoader.h>
#include <osgPagedTexture/VirtualOptions.h>
#include <osgPagedTexture/VirtualScene.h>

#include <osgDB/Registry>

/// "model.osgb.virtualtexture": shows textures that lie in tile stores, of any size.
class ReaderWriterVirtualTexture : public osgMultiRender::PseudoLoader
{
public:
    ReaderWriterVirtualTexture()
        : PseudoLoader("virtualtexture", "Textures of any size from tile stores: "
                                         "model.ext.[(store=atlas.tiles,settings).]virtualtexture")
    {
        const osgPagedTexture::VirtualSettings defaults;
        for (const osgPagedTexture::VirtualOption& option : osgPagedTexture::virtualOptions())
            supportsOption("virtualtexture." + option.name + "=" + option.values,
                           option.help + " (default " + option.format(defaults) + ")");
    }

    const char* className() const override { return "osgPagedTexture virtual pseudo-loader"; }

protected:
    osg::ref_ptr<osg::Node> wrap(osg::Node& model, const osgMultiRender::Settings& settings,
                                 std::string& error) const override
    {
        return wrapIn({}, model, settings, error);
    }

    osg::ref_ptr<osg::Node> wrapIn(const std::string& folder, osg::Node& model,
                                   const osgMultiRender::Settings& settings,
                                   std::string& error) const override
    {
        // A model that brings its scene along gets the settings alone.
        osg::ref_ptr<osgPagedTexture::VirtualScene> scene =
            dynamic_cast<osgPagedTexture::VirtualScene*>(&model);
        osgPagedTexture::VirtualSettings parsed;
        if (scene)
            parsed = scene->getSettings();
        for (const auto& [name, value] : settings)
            if (!setVirtualOption(parsed, name, value, error))
                return nullptr;
        if (!scene)
        {
            scene = new osgPagedTexture::VirtualScene;
            scene->addChild(&model);
        }
        // The viewer's optimizer must not remove or merge the group.
        scene->setDataVariance(osg::Object::DYNAMIC);
        scene->setSettings(parsed);
        const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
        if (!folder.empty())
            options->getDatabasePathList().push_back(folder);
        scene->install(options);
        return scene;
    }
};

REGISTER_OSGPLUGIN(virtualtexture, ReaderWriterVirtualTexture)
