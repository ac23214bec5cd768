// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LuxLegend.h>
#include <osgShadowVolume/ShadowSettings.h>

#include <osg/Group>
#include <osg/Light>
#include <osg/StateSet>

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
    /// Looks at the lights of the whole scene that `group` is part of, in the cull thread. Warns
    /// when something is unknown, once for the same.
    LightMeasures measure(osgUtil::CullVisitor& visitor, osg::Group& group,
                          const ShadowSettings& settings);

    /// Adds the legend to the view, where measure() was called for it since the last time.
    void cullLegend(osgUtil::CullVisitor& visitor);

    /// What measured surfaces are drawn under: blending would mix numbers.
    static const osg::StateSet* getStateSet();

    void resizeGLObjectBuffers(unsigned int maxSize) { _legend.resizeGLObjectBuffers(maxSize); }
    void releaseGLObjects(osg::State* state) const { _legend.releaseGLObjects(state); }

private:
    LuxLegend _legend;
    std::mutex _mutex;
    std::string _said;
    std::map<const osgUtil::CullVisitor*, double> _maxima; ///< Of views that want a legend.
};

/// GLSL that defines osgmr_output() and follows lights.frag; see shaders/illuminance.frag.
std::string illuminanceSource(bool falseColors);

} // namespace osgShadowVolume
