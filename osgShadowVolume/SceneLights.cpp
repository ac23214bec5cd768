// SPDX-License-Identifier: MIT
#include <osgShadowVolume/SceneLights.h>

#include <osgShadowVolume/EyeLights.h>

#include <osg/LightSource>
#include <osg/NodeVisitor>
#include <osg/Transform>

#include <algorithm>

namespace osgShadowVolume
{

namespace
{

class LightCollector : public osg::NodeVisitor
{
public:
    LightCollector() : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN) {}

    void apply(osg::LightSource& source) override
    {
        if (const osg::Light* light = source.getLight())
        {
            osg::Matrixd matrix;
            if (source.getReferenceFrame() == osg::LightSource::RELATIVE_RF)
                matrix = osg::computeLocalToWorld(getNodePath());
            lights.push_back({light, toEye(*light, &matrix), intensityOf(source)});
        }
        traverse(source);
    }

    std::vector<SceneLight> lights;
};

} // namespace

std::vector<SceneLight> collectLights(osg::Node& root, const ShadowSettings& settings)
{
    LightCollector collector;
    root.accept(collector);
    for (SceneLight& light : collector.lights)
    {
        const double given = light.world.isDirectional() ? settings.lux : settings.candela;
        if (light.intensity.isMissing && given > 0.0)
            light.intensity = {given, {}};
    }
    return std::move(collector.lights);
}

std::string describeUnknown(const std::vector<SceneLight>& lights)
{
    constexpr int most = 3;
    std::string text;
    int unknown = 0;
    for (const SceneLight& light : lights)
        if (!light.intensity.isKnown() && ++unknown <= most)
            text += (unknown > 1 ? "; " : "") + describeLight(*light.light) + ": " +
                    light.intensity.error;
    if (unknown > most)
        text += "; and " + std::to_string(unknown - most) + " more";
    return unknown ? "no illuminance without intensities: " + text : std::string();
}

double luxAtUnit(const SceneLight& light, double metresPerUnit)
{
    if (!light.intensity.isKnown() || light.world.isDirectional())
        return light.intensity.value;
    return light.intensity.value / (metresPerUnit * metresPerUnit);
}

} // namespace osgShadowVolume
