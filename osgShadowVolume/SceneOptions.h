// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Option.h>
#include <osgShadowVolume/ShadowedScene.h>

#include <string>
#include <vector>

namespace osgShadowVolume
{

/// One setting of a ShadowedScene as text.
using SceneOption = osgMultiRender::Option<ShadowedScene>;

/// All of them, those of LitScene too.
OSGSHADOWVOLUME_EXPORT const std::vector<SceneOption>& sceneOptions();

/// Null where there is none of that name.
OSGSHADOWVOLUME_EXPORT const SceneOption* findSceneOption(const std::string& name);

/// Sets one by its name. Returns false and fills `error` with one line that says what may be said.
OSGSHADOWVOLUME_EXPORT bool setSceneOption(ShadowedScene& scene, const std::string& name,
                                           const std::string& text, std::string& error);

} // namespace osgShadowVolume
