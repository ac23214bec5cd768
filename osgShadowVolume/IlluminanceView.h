// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LuxLegend.h>
#include <osgShadowVolume/ShadowSettings.h>

#include <osg/Group>
#include <osg/Light>

#include <map>
#include <mutex>
#include <string>

namespace osgShadowVolume
{

/// What the lights of a view give off, for Show::LUX and Show::ILLUMINANCE.
struct LightMeasures
{
    /// Lux at one unit of world coordinates; negative where unknown. Lights that are not in it are
    /// none of the scene: the viewer's headlight.
    std::map<const osg::Light*, double> luxAtUnit;
    double maximum = 1.0; ///< Lux at the top of the false colours.
    std::string error;    ///< What is unknown; empty: nothing.
};

/// What a ShadowedScene has for measuring light. Thread safe.
class IlluminanceView
{
public:
    /// Looks at the lights of the whole scene that `group` is part of. Warns when something is
    /// unknown, once for the same.
    LightMeasures measure(osg::Group& group, const ShadowSettings& settings);

    LuxLegend legend;

private:
    std::mutex _mutex;
    std::string _said;
};

} // namespace osgShadowVolume
