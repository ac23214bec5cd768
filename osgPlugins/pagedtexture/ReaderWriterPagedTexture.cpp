// SPDX-License-Identifier: MIT
#include <osgMultiRender/PseudoLoader.h>
#include <osgPagedTexture/PagedOptions.h>
#include <osgPagedTexture/PagedScene.h>

#include <osgDB/FileNameUtils>
#include <osgDB/Registry>

/// "model.iv.pagedtexture": loads the model's textures in the background, as fine as they are seen.
class ReaderWriterPagedTexture : public osgMultiRender::PseudoLoader
{
public:
    ReaderWriterPagedTexture()
        : PseudoLoader("pagedtexture", "Textures loaded as they are seen, within budgets of "
                                       "memory: model.ext.[(settings).]pagedtexture")
    {
        const osgPagedTexture::PagedSettings defaults;
        for (const osgPagedTexture::PagedOption& option : osgPagedTexture::pagedOptions())
            supportsOption("pagedtexture." + option.name + "=" + option.values,
                           option.help + " (default " + option.format(defaults) + ")");
    }

    const char* className() const override { return "osgPagedTexture pseudo-loader"; }

protected:
    /// The model comes below a PagedScene, since its images must not be read with it.
    ReadResult readModel(const std::string& file, const Options* options) const override
    {
        osg::ref_ptr<osgPagedTexture::PagedScene> scene = new osgPagedTexture::PagedScene;
        ReadResult result = scene->readModel(file, options);
        return result.validNode() ? ReadResult(scene.get()) : result;
    }

    osg::ref_ptr<osg::Node> wrap(osg::Node& model, const osgMultiRender::Settings& settings,
                                 std::string& error) const override
    {
        osgPagedTexture::PagedSettings parsed;
        for (const auto& [name, value] : settings)
            if (!setPagedOption(parsed, name, value, error))
                return nullptr;
        auto& scene = static_cast<osgPagedTexture::PagedScene&>(model);
        // The viewer's optimizer must not remove or merge the group.
        scene.setDataVariance(osg::Object::DYNAMIC);
        scene.setSettings(parsed);
        return &scene;
    }
};

REGISTER_OSGPLUGIN(pagedtexture, ReaderWriterPagedTexture)
