// SPDX-License-Identifier: MIT
#include <osgMultiRender/PseudoLoader.h>
#include <osgShadowVolume/LitScene.h>

#include <osgDB/Registry>

#include <cstdlib>

/// "model.iv.shadowvolume": lights the model per pixel.
class ReaderWriterShadowVolume : public osgMultiRender::PseudoLoader
{
public:
    ReaderWriterShadowVolume()
        : PseudoLoader("shadowvolume", "Per-pixel lighting: model.ext.[(settings).]shadowvolume")
    {
        supportsOption("shadowvolume.shadows=off", "Light without shadows (the default)");
        supportsOption("shadowvolume.lighting=pixel|vertex|off",
                       "Where light is evaluated: per pixel by any number of lights (the default), "
                       "per vertex by GL's eight as the fixed function does, or nowhere");
        supportsOption(
            "shadowvolume.lights=modes|all",
            "Which LightSources light a drawable: those whose GL_LIGHTn mode is on there "
            "(the default, as in OSG), or all of the view");
        supportsOption("shadowvolume.tolerance=<0..1>",
                       "The most that all lights left out because of their distance may add to a "
                       "pixel (0.00196, half a step of 8 bits)");
    }

    const char* className() const override { return "osgShadowVolume pseudo-loader"; }

protected:
    osg::ref_ptr<osg::Node> wrap(osg::Node& model, const osgMultiRender::Settings& settings,
                                 std::string& error) const override
    {
        osg::ref_ptr<osgShadowVolume::LitScene> scene = new osgShadowVolume::LitScene;
        // The viewer's optimizer must not remove or merge the group.
        scene->setDataVariance(osg::Object::DYNAMIC);
        for (const auto& [key, value] : settings)
            if (!set(*scene, key, value, error))
                return nullptr;
        scene->addChild(&model);
        return scene;
    }

private:
    static bool parse(const std::string& text, double& value)
    {
        char* end = nullptr;
        value = std::strtod(text.c_str(), &end);
        return !text.empty() && !*end && value >= 0.0 && value <= 1.0;
    }

    static bool set(osgShadowVolume::LitScene& scene, const std::string& key,
                    const std::string& value, std::string& error)
    {
        using osgShadowVolume::LitScene;
        if (key == "shadows" && value == "off")
            return true;
        if (key == "lighting" && value == "pixel")
            scene.setLighting(LitScene::Lighting::PIXEL);
        else if (key == "lighting" && value == "vertex")
            scene.setLighting(LitScene::Lighting::VERTEX);
        else if (key == "lighting" && value == "off")
            scene.setLighting(LitScene::Lighting::OFF);
        else if (key == "lights" && value == "modes")
            scene.setLightScope(LitScene::LightScope::MODES);
        else if (key == "lights" && value == "all")
            scene.setLightScope(LitScene::LightScope::ALL);
        else if (double tolerance = 0.0; key == "tolerance" && parse(value, tolerance))
            scene.setLightTolerance(tolerance);
        else
        {
            error = "setting '" + key + "=" + value +
                    "' is not known; there are shadows=off, lighting=pixel|vertex|off, "
                    "lights=modes|all and tolerance=<0..1>";
            return false;
        }
        return true;
    }
};

REGISTER_OSGPLUGIN(shadowvolume, ReaderWriterShadowVolume)
