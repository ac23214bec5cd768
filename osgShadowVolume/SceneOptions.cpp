// SPDX-License-Identifier: MIT
#include <osgShadowVolume/SceneOptions.h>

#include <osgShadowVolume/EnumNames.h>

#include <limits>
#include <utility>

namespace osgShadowVolume
{

using osgMultiRender::formatNumber;
using osgMultiRender::parseNumber;

namespace
{

/// The number of a light, or all of them, which the scene knows as -1.
SceneOption lightOption()
{
    const auto parse = [](ShadowedScene& scene, const std::string& text) -> std::string
    {
        int number = -1;
        if (text != "all" && (!parseNumber(text, number) || number < 0))
            return "'" + text + "' is neither all nor the number of a light, 0 or more";
        scene.setLightShown(number);
        return {};
    };
    const auto format = [](const ShadowedScene& scene)
    { return scene.getLightShown() < 0 ? "all" : formatNumber(scene.getLightShown()); };
    return {"light", "all|<number>", "The one light that shines, or of which the mask is shown",
            parse, format};
}

std::vector<SceneOption> makeOptions()
{
    using S = ShadowedScene;
    const double infinity = std::numeric_limits<double>::infinity();
    const auto choice = [](const char* name, const char* help, const auto& names, auto get,
                           auto set, std::pair<std::string, std::string> alias = {})
    { return osgMultiRender::wordOption<S>(name, help, names, get, set, alias); };
    const auto whole = [](const char* name, const char* help, unsigned int low, unsigned int high,
                          auto get, auto set)
    { return osgMultiRender::numberOption<S>(name, help, low, high, get, set); };
    const auto real = [](const char* name, const char* help, double high, auto get, auto set)
    { return osgMultiRender::numberOption<S>(name, help, 0.0, high, get, set); };
    return {
        choice("shadows",
               "How lights cast shadows: silhouette volumes, right to the pixel; shadow maps, as "
               "coarse as their texels; or not",
               ShadowsNames, &S::getShadows, &S::setShadows),
        choice("technique",
               "Who finds the silhouettes: the fastest that there is, tessellation shaders, "
               "geometry shaders or the CPU",
               TechniqueNames, &S::getTechnique, &S::setTechnique),
        choice(
            "transparent",
            "Which blended surfaces cast shadows: those with an alpha of at least 0.5, all, none",
            TransparentCastersNames, &S::getTransparentCasters, &S::setTransparentCasters,
            {"opaque", "all"}),
        choice("headlight",
               "Whether the viewer's headlight casts shadows, which in perspective show beside the "
               "objects",
               HeadlightNames, &S::getHeadlightShadow, &S::setHeadlightShadow),
        whole("layers", "Surfaces behind each other up to which transparent ones receive shadows",
              0, 64, &S::getTransparentLayers, &S::setTransparentLayers),
        whole("mapsize", "Texels on a side of a shadow map", 16, 65536, &S::getMapSize,
              &S::setMapSize),
        whole("pcf", "Texels on a side of the square that a shadow map is filtered over; 1 is none",
              1, 16, &S::getMapSamples, &S::setMapSamples),
        whole("mapbudget", "MiB that the shadow maps of a view may take", 1, 1048576,
              &S::getMapMegabytes, &S::setMapMegabytes),
        choice("show",
               "The picture; white where light reaches; the picture with its shadow volumes; "
               "illuminance in false colours, or in lux for float pictures",
               ShowNames, &S::getShow, &S::setShow),
        lightOption(),
        choice("mirrors", "Whether flat surfaces that are named as mirrors reflect", SwitchNames,
               &S::getMirrors, &S::setMirrors),
        whole("maxmirrors", "Planes of mirrors that a view draws, the largest first", 0, 64,
              &S::getMaxMirrors, &S::setMaxMirrors),
        choice("keys", "Whether the group answers to keys of the viewer", SwitchNames, &S::getKeys,
               &S::setKeys),
        real("metres", "Metres that a unit of world coordinates stands for; 0 is unknown", infinity,
             &S::getMetresPerUnit, &S::setMetresPerUnit),
        real("maxlux", "Lux at the top of the false colours; 0 chooses", infinity,
             &S::getIlluminanceMaximum, &S::setIlluminanceMaximum),
        real("candela", "Of point and spot lights that state no intensity; 0 is unknown", infinity,
             &S::getCandela, &S::setCandela),
        real("lux", "Of directional lights that state none; 0 is unknown", infinity, &S::getLux,
             &S::setLux),
        choice("lighting",
               "Where light is evaluated: per pixel by any number of lights, per vertex by GL's "
               "eight as the fixed function does, or nowhere; shadows need pixel",
               LightingNames, &S::getLighting, &S::setLighting),
        choice("lights",
               "Which LightSources light a drawable: those whose GL_LIGHTn mode is on there, as in "
               "OSG, or all of the view",
               LightScopeNames, &S::getLightScope, &S::setLightScope),
        real("tolerance",
             "The most that all lights left out because of their distance may add to a pixel", 1.0,
             &S::getLightTolerance, &S::setLightTolerance),
    };
}

} // namespace

const std::vector<SceneOption>& sceneOptions()
{
    static const std::vector<SceneOption> options = makeOptions();
    return options;
}

const SceneOption* findSceneOption(const std::string& name)
{
    for (const SceneOption& option : sceneOptions())
        if (option.name == name)
            return &option;
    return nullptr;
}

bool setSceneOption(ShadowedScene& scene, const std::string& name, const std::string& text,
                    std::string& error)
{
    return osgMultiRender::setOption(sceneOptions(), scene, name, text, error);
}

} // namespace osgShadowVolume
