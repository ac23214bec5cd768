// SPDX-License-Identifier: MIT
#include <osgMultiRender/PseudoLoader.h>
#include <osgShadowVolume/SceneOptions.h>

#include <osgDB/Registry>

using osgShadowVolume::ShadowedScene;

/// "model.iv.shadowvolume": gives the model shadows and lights it per pixel.
class ReaderWriterShadowVolume : public osgMultiRender::PseudoLoader
{
public:
    ReaderWriterShadowVolume()
        : PseudoLoader("shadowvolume",
                       "Shadows and per-pixel lighting: model.ext.[(settings).]shadowvolume")
    {
        const osg::ref_ptr<ShadowedScene> defaults = new ShadowedScene;
        for (const osgShadowVolume::SceneOption& option : osgShadowVolume::sceneOptions())
            supportsOption("shadowvolume." + option.name + "=" + option.values,
                           option.help + " (default " + option.format(*defaults) + ")");
    }

    const char* className() const override { return "osgShadowVolume pseudo-loader"; }

protected:
    osg::ref_ptr<osg::Node> wrap(osg::Node& model, const osgMultiRender::Settings& settings,
                                 std::string& error) const override
    {
        osg::ref_ptr<ShadowedScene> scene = new ShadowedScene;
        // The viewer's optimizer must not remove or merge the group.
        scene->setDataVariance(osg::Object::DYNAMIC);
        for (const auto& [name, value] : settings)
            if (!setSceneOption(*scene, name, value, error))
                return nullptr;
        if (scene->getLighting() != ShadowedScene::Lighting::PIXEL)
        {
            if (settings.count("shadows") && scene->getShadows() != osgShadowVolume::Shadows::OFF)
            {
                error = "setting 'shadows=" + settings.at("shadows") + "' needs lighting=pixel";
                return nullptr;
            }
            scene->setShadows(osgShadowVolume::Shadows::OFF);
        }
        scene->addChild(&model);
        return scene;
    }
};

REGISTER_OSGPLUGIN(shadowvolume, ReaderWriterShadowVolume)
