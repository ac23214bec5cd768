// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LightReach.h>
#include <osgShadowVolume/Photometry.h>
#include <osgShadowVolume/ShadowSettings.h>

#include <osg/Light>
#include <osg/Node>

#include <string>
#include <vector>

namespace osgShadowVolume
{

/// A light where a LightSource puts it.
struct SceneLight
{
    const osg::Light* light = nullptr; ///< The scene owns it.
    EyeLight world;                    ///< World coordinates; its luxAtUnit is not set.
    Stated intensity;
};

/// The lights of all LightSources that are not masked or switched off, once for each way to them.
/// Those that state no intensity have that of the settings, if there is one.
std::vector<SceneLight> collectLights(osg::Node& root, const ShadowSettings& settings);

/// One line about the lights whose intensity is unknown, naming the first few and the remedy;
/// empty for none.
std::string describeUnknown(const std::vector<SceneLight>& lights);

/// Lux at one unit of distance, or of a directional light at any; negative where it is unknown.
double luxAtUnit(const SceneLight& light, double metresPerUnit);

} // namespace osgShadowVolume
