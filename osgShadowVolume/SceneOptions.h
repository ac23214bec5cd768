// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/ShadowedScene.h>

#include <functional>
#include <string>
#include <vector>

namespace osgShadowVolume
{

/// One setting of a ShadowedScene as text, as pseudo-loaders, .osg files and keys say it.
struct SceneOption
{
    std::string name;   ///< "shadows".
    std::string values; ///< What may be said: "volumes|map|off", "<0..1>".
    std::string help;   ///< One sentence.
    /// Sets it; returns "", or why the text is wrong, and then sets nothing.
    std::function<std::string(ShadowedScene&, const std::string& text)> parse;
    /// The text that parse() would take for the value that the scene has.
    std::function<std::string(const ShadowedScene&)> format;
};

/// All of them, those of LitScene too.
OSGSHADOWVOLUME_EXPORT const std::vector<SceneOption>& sceneOptions();

/// Null where there is none of that name.
OSGSHADOWVOLUME_EXPORT const SceneOption* findSceneOption(const std::string& name);

/// Sets one by its name. Returns false and fills `error` with one line that says what may be said.
OSGSHADOWVOLUME_EXPORT bool setSceneOption(ShadowedScene& scene, const std::string& name,
                                           const std::string& text, std::string& error);

} // namespace osgShadowVolume
