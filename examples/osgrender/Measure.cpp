// SPDX-License-Identifier: MIT
// What needs osgShadowVolume of Probe.h.
#include "Probe.h"

#include <osgShadowVolume/IlluminanceProbe.h>
#include <osgShadowVolume/ShadowedScene.h>

#include <osg/NodeVisitor>

namespace osgrender
{

namespace
{

/// Finds the first ShadowedScene, whose settings say what casts.
class SettingsFinder : public osg::NodeVisitor
{
public:
    SettingsFinder() : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN) {}

    void apply(osg::Group& group) override
    {
        const auto* scene = dynamic_cast<const osgShadowVolume::ShadowedScene*>(&group);
        if (scene && !_found)
            settings = scene->getSettings();
        _found = _found || scene;
        traverse(group);
    }

    osgShadowVolume::ShadowSettings settings;

private:
    bool _found = false;
};

std::string nameOf(const osgShadowVolume::EyeLight& light)
{
    const std::string number = "light " + std::to_string(light.number);
    return light.name.empty() ? number : number + " '" + light.name + "'";
}

GridResult measureGrid(const osgShadowVolume::IlluminanceProbe& probe, const ProbeGrid& grid)
{
    osgShadowVolume::WorkPlane plane;
    plane.corner = grid.corner;
    plane.u = grid.u;
    plane.v = grid.v;
    plane.normal = grid.normal;
    plane.columns = grid.columns;
    plane.rows = grid.rows;
    osgShadowVolume::IlluminanceProbe::PlaneReading reading = probe.measure(plane);
    GridResult result;
    result.grid = grid;
    result.grid.columns = reading.columns;
    result.grid.rows = reading.rows;
    result.minimum = reading.minimum;
    result.mean = reading.mean;
    result.maximum = reading.maximum;
    result.uniformity = reading.uniformity;
    result.points = std::move(reading.points);
    result.lux = std::move(reading.lux);
    return result;
}

} // namespace

bool measure(osg::Node& model, const ProbeSetting& setting, ProbeResult& result, std::string& error)
{
    SettingsFinder finder;
    model.accept(finder);
    if (setting.metresPerUnit > 0.0)
        finder.settings.metresPerUnit = setting.metresPerUnit;
    if (setting.candela > 0.0)
        finder.settings.candela = setting.candela;
    if (setting.lux > 0.0)
        finder.settings.lux = setting.lux;
    const osgShadowVolume::IlluminanceProbe probe(model, finder.settings);
    error = probe.getError();
    if (!error.empty())
        return false;
    for (const ProbePoint& point : setting.points)
    {
        const auto reading = probe.measure(point.point, point.normal);
        PointResult& entry = result.points.emplace_back();
        entry.probe = point;
        entry.lux = reading.lux;
        for (std::size_t i = 0; i < reading.luxOfLight.size(); ++i)
            entry.lights.emplace_back(nameOf(probe.getLights()[i]), reading.luxOfLight[i]);
    }
    for (const ProbeGrid& grid : setting.grids)
        result.grids.push_back(measureGrid(probe, grid));
    return true;
}

} // namespace osgrender
