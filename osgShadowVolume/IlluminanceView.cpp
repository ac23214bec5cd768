// SPDX-License-Identifier: MIT
#include <osgShadowVolume/IlluminanceView.h>

#include <osgShadowVolume/FalseColors.h>
#include <osgShadowVolume/RadicalInverse.h>
#include <osgShadowVolume/SceneLights.h>
#include <osgShadowVolume/Shaders.h>

#include <osg/ComputeBoundsVisitor>
#include <osg/Notify>
#include <osgDB/ReadFile>

#include <algorithm>
#include <cmath>
#include <set>

namespace osgShadowVolume
{

namespace
{

/// The nodes without parents above a node; itself, where it has none.
class RootFinder : public osg::NodeVisitor
{
public:
    RootFinder() : osg::NodeVisitor(TRAVERSE_PARENTS) {}

    void apply(osg::Node& node) override
    {
        if (node.getNumParents() == 0)
            roots.insert(&node);
        traverse(node);
    }

    std::set<osg::Node*> roots;
};

/// A round value above what nine tenths of the group's box get, facing each light and without
/// shadows: close to a lamp there is no largest value. It depends on the scene, not on the view.
double chooseMaximum(osg::Group& group, const std::vector<SceneLight>& lights, double metresPerUnit)
{
    osg::ComputeBoundsVisitor visitor;
    group.accept(visitor);
    const osg::BoundingBox& box = visitor.getBoundingBox();
    if (!box.valid() || !std::isfinite(box.radius()))
        return 1.0;
    constexpr unsigned int samples = 128;
    std::vector<double> lux(samples, 0.0);
    for (unsigned int i = 0; i < samples; ++i)
    {
        const glm::dvec3 at(box.xMin() + (box.xMax() - box.xMin()) * radicalInverse(i + 1, 2),
                            box.yMin() + (box.yMax() - box.yMin()) * radicalInverse(i + 1, 3),
                            box.zMin() + (box.zMax() - box.zMin()) * radicalInverse(i + 1, 5));
        for (const SceneLight& light : lights)
        {
            EyeLight world = light.world;
            world.luxAtUnit = std::max(0.0, luxAtUnit(light, metresPerUnit));
            const glm::dvec3 way = world.isDirectional() ? world.position : world.position - at;
            const double length = glm::length(way);
            lux[i] += length > 0.0 ? illuminanceAt(world, at, way / length) : 0.0;
        }
    }
    std::sort(lux.begin(), lux.end());
    return roundUp(lux[samples * 9 / 10]);
}

} // namespace

LightMeasures IlluminanceView::measure(osgUtil::CullVisitor& visitor, osg::Group& group,
                                       const ShadowSettings& settings)
{
    RootFinder finder;
    group.accept(finder);
    std::vector<SceneLight> lights;
    for (osg::Node* root : finder.roots)
        for (SceneLight& light : collectLights(*root, settings))
            lights.push_back(std::move(light));
    const Stated scale =
        settings.metresPerUnit > 0.0 ? Stated{settings.metresPerUnit, {}} : metresPerUnitOf(group);
    LightMeasures measures;
    for (const SceneLight& light : lights)
    {
        const bool isKnown = scale.isKnown() || light.world.isDirectional();
        measures.luxAtUnit[light.light] = isKnown ? luxAtUnit(light, scale.value) : -1.0;
    }
    if (lights.empty())
        measures.error = "no illuminance without lights: the scene has no LightSource";
    else if (!scale.isKnown())
        measures.error = "no illuminance without a scale: " + scale.error +
                         " (user value, description or name of the model's root, or the setting)";
    else
        measures.error = describeUnknown(lights);
    measures.maximum = settings.illuminanceMaximum > 0.0
                           ? settings.illuminanceMaximum
                           : chooseMaximum(group, lights, std::max(scale.value, 0.0));
    std::lock_guard<std::mutex> lock(_mutex);
    if (_said != measures.error && !measures.error.empty())
    {
        OSG_WARN << "osgShadowVolume::ShadowedScene: " << measures.error
                 << "; what they light is magenta" << std::endl;
    }
    _said = measures.error;
    if (settings.show == Show::ILLUMINANCE)
        _maxima[&visitor] = measures.maximum;
    return measures;
}

void IlluminanceView::cullLegend(osgUtil::CullVisitor& visitor)
{
    double maximum = 0.0;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        const auto found = _maxima.find(&visitor);
        if (found == _maxima.end())
            return;
        maximum = found->second;
        _maxima.erase(found);
    }
    _legend.cull(visitor, maximum);
}

const osg::StateSet* IlluminanceView::getStateSet()
{
    static const osg::ref_ptr<const osg::StateSet> stateSet = []
    {
        osg::ref_ptr<osg::StateSet> made = new osg::StateSet;
        made->setThreadSafeRefUnref(true);
        made->setMode(GL_BLEND, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
        return made;
    }();
    return stateSet.get();
}

std::string illuminanceSource(bool falseColors)
{
    const osg::ref_ptr<osg::Shader> shader = osgDB::readRefShaderFileWithFallback(
        osg::Shader::FRAGMENT, "osgShadowVolume/illuminance.frag", shaders::illuminance_frag);
    const std::string colors =
        falseColors ? "#define OSGSV_FALSE_COLORS\n" + falseColorSource() : std::string();
    return colors + shader->getShaderSource();
}

} // namespace osgShadowVolume
