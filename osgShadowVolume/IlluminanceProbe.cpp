// SPDX-License-Identifier: MIT
#include <osgShadowVolume/IlluminanceProbe.h>

#include <osgShadowVolume/CasterCollector.h>
#include <osgShadowVolume/SceneLights.h>
#include <osgShadowVolume/TriangleReader.h>

#include <osgUtil/CullVisitor>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace osgShadowVolume
{

namespace
{

/// Share of the scene's size within which a point lies on a surface.
constexpr double OnSurface = 1e-6;

/// What casts in the picture, of each LOD what is shown close up.
class NearCasters : public CasterCollector
{
public:
    using CasterCollector::CasterCollector;

    osg::CullStack* asCullStack() override { return nullptr; }
    float getDistanceToEyePoint(const osg::Vec3&, bool) const override { return 0.0f; }
    float getDistanceFromEyePoint(const osg::Vec3&, bool) const override { return 0.0f; }
    float getDistanceToViewPoint(const osg::Vec3&, bool) const override { return 0.0f; }
};

std::vector<TriangleTree::Triangle> collectTriangles(osg::Node& scene, TransparentCasters which)
{
    // A view from the origin: its eye coordinates are those of the world.
    const osg::ref_ptr<osgUtil::CullVisitor> view = new osgUtil::CullVisitor;
    view->pushViewport(new osg::Viewport(0, 0, 1, 1));
    view->pushProjectionMatrix(new osg::RefMatrix);
    view->pushModelViewMatrix(new osg::RefMatrix, osg::Transform::RELATIVE_RF);
    NearCasters casters(*view, which);
    scene.accept(casters);
    std::vector<TriangleTree::Triangle> triangles;
    for (const Caster& caster : casters.getCasters())
    {
        const glm::dmat4 matrix = glm::make_mat4(caster.modelview->ptr());
        const auto toWorld = [&](const glm::vec3& p)
        { return glm::dvec3(matrix * glm::dvec4(p, 1.0)); };
        const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
            triangles.push_back({toWorld(a), toWorld(b), toWorld(c)});
        };
        std::size_t badIndices = 0;
        for (const auto& drawable : caster.source)
            badIndices += readTriangles(*drawable, add);
        warnLeftOut(caster.source, badIndices, "an index is beyond the vertices");
    }
    return triangles;
}

} // namespace

void fillStandardCells(double uMetres, double vMetres, unsigned int& columns, unsigned int& rows)
{
    const double longer = std::max(uMetres, vMetres), shorter = std::min(uMetres, vMetres);
    const double d = longer >= 2.0 * shorter ? shorter : longer;
    const double p = std::min(0.2 * std::pow(5.0, std::log10(d)), 10.0);
    const auto cells = [p](double side)
    { return static_cast<unsigned int>(std::clamp(std::round(side / p), 1.0, 1000.0)); };
    columns = cells(uMetres);
    rows = cells(vMetres);
}

IlluminanceProbe::IlluminanceProbe(osg::Node& scene, const ShadowSettings& settings)
{
    const Stated scale =
        settings.metresPerUnit > 0.0 ? Stated{settings.metresPerUnit, {}} : metresPerUnitOf(scene);
    if (!scale.isKnown())
    {
        _error = "no illuminance without a scale: " + scale.error;
        return;
    }
    _metresPerUnit = scale.value;
    const std::vector<SceneLight> lights = collectLights(scene, settings);
    _error = lights.empty() ? "no illuminance without lights: the scene has no LightSource"
                            : describeUnknown(lights);
    if (!_error.empty())
        return;
    for (const SceneLight& light : lights)
    {
        _lights.push_back(light.world);
        _lights.back().luxAtUnit = luxAtUnit(light, _metresPerUnit);
    }
    if (settings.shadows != Shadows::OFF)
        _tree = TriangleTree(collectTriangles(scene, settings.transparentCasters));
    _tolerance = OnSurface * _tree.getDiagonal();
}

IlluminanceProbe::Reading IlluminanceProbe::measure(const osg::Vec3d& point,
                                                    const osg::Vec3d& normal) const
{
    Reading reading;
    const double length = normal.length();
    const glm::dvec3 at = glm::make_vec3(point.ptr());
    const glm::dvec3 n = length > 0.0 ? glm::make_vec3(normal.ptr()) / length : glm::dvec3(0.0);
    for (const EyeLight& light : _lights)
    {
        double lux = illuminanceAt(light, at, n);
        if (lux > 0.0 && light.castsShadow &&
            (light.isDirectional() ? _tree.blocks(at, light.position, _tolerance,
                                                  std::numeric_limits<double>::infinity())
                                   : _tree.blocks(at, light.position - at, _tolerance)))
            lux = 0.0;
        reading.luxOfLight.push_back(lux);
        reading.lux += lux;
    }
    return reading;
}

IlluminanceProbe::PlaneReading IlluminanceProbe::measure(const WorkPlane& plane) const
{
    PlaneReading reading;
    osg::Vec3d normal = plane.normal;
    const osg::Vec3d across = plane.u ^ plane.v;
    if (normal.length2() == 0.0)
        normal = across.z() < 0.0 ? -across : across;
    if (!(across.length2() > 0.0))
        return reading;
    reading.columns = plane.columns;
    reading.rows = plane.rows;
    unsigned int columns = 0, rows = 0;
    fillStandardCells(plane.u.length() * _metresPerUnit, plane.v.length() * _metresPerUnit, columns,
                      rows);
    if (reading.columns == 0)
        reading.columns = columns;
    if (reading.rows == 0)
        reading.rows = rows;
    double sum = 0.0;
    for (unsigned int row = 0; row < reading.rows; ++row)
        for (unsigned int column = 0; column < reading.columns; ++column)
        {
            reading.points.push_back(plane.corner + plane.u * ((column + 0.5) / reading.columns) +
                                     plane.v * ((row + 0.5) / reading.rows));
            reading.lux.push_back(measure(reading.points.back(), normal).lux);
            sum += reading.lux.back();
        }
    const auto [least, most] = std::minmax_element(reading.lux.begin(), reading.lux.end());
    reading.minimum = *least;
    reading.maximum = *most;
    reading.mean = sum / double(reading.lux.size());
    reading.uniformity = reading.mean > 0.0 ? reading.minimum / reading.mean : 0.0;
    return reading;
}

} // namespace osgShadowVolume
