// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LitPass.h>

#include <osgShadowVolume/EyeLights.h>
#include <osgShadowVolume/LitBits.h>
#include <osgShadowVolume/RadicalInverse.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace osgShadowVolume
{

using osgMultiRender::LightingMode;
using osgMultiRender::SurfaceState;

LitPass::LitPass(const LitScene& scene) : LitPass(scene, ShadowSettings(), nullptr) {}

LitPass::LitPass(const LitScene& scene, const ShadowSettings& settings,
                 std::unique_ptr<LightShadows> shadows)
    : _scene(scene),
      _lighting(measuresLight(settings) ? LitScene::Lighting::PIXEL : scene.getLighting()),
      _lightScope(measuresLight(settings) ? LitScene::LightScope::ALL : scene.getLightScope()),
      _tolerance(scene.getLightTolerance()), _settings(settings)
{
    if (_lighting == LitScene::Lighting::PIXEL)
        _shadows = std::move(shadows);
}

void LitPass::cull(osgUtil::CullVisitor& visitor, osgMultiRender::SurfaceGroup& group,
                   const osg::StateSet*)
{
    if (_shadows)
        _shadows->cull(visitor, group);
    if (_mirrors)
        _mirrors->cull(visitor, group);
    if (measuresLight(_settings))
        _measures = _illuminance->measure(visitor, group, _settings);
}

bool LitPass::isDynamic() const
{
    return _shadows && _shadows->isDynamic();
}

LightingMode LitPass::getLighting() const
{
    switch (_lighting)
    {
    case LitScene::Lighting::OFF:
        return LightingMode::Off;
    case LitScene::Lighting::VERTEX:
        return LightingMode::Vertex;
    case LitScene::Lighting::PIXEL:
        break;
    }
    return LightingMode::Pixel;
}

void LitPass::begin(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceFrame& frame)
{
    const std::vector<EyeLight> all = collectLights(frame);
    if (_lighting != LitScene::Lighting::PIXEL)
    {
        leaveToGL(all);
        return;
    }
    chooseGridAxes(frame);
    const bool everythingBounded = measureBox(frame);
    const std::vector<double> limits = keepReaching(all, everythingBounded);
    _used.assign(_lights.size(), false);
    if (_shadows)
        planShadows(renderInfo, everythingBounded, limits);
    if (_lights.size() > maxListed && _hasBox)
        choosePoints();
}

std::vector<EyeLight> LitPass::collectLights(const osgMultiRender::SurfaceFrame& frame)
{
    std::map<int, std::size_t> lastOf;
    std::vector<EyeLight> all;
    frame.forEachLight(
        [&](const osg::Light& light, const osg::Matrix* matrix, bool isHeadlight)
        {
            EyeLight eye = toEye(light, matrix);
            eye.isHeadlight = isHeadlight;
            if (_shadows && _shadows->isShadowless(light))
                eye.castsShadow = false;
            if (measuresLight(_settings) && !measure(eye, light, frame))
                return;
            if (_lightScope == LitScene::LightScope::MODES)
            {
                const auto [found, isNew] = lastOf.emplace(light.getLightNum(), all.size());
                if (!isNew) // GL keeps the last one of a number.
                {
                    all[found->second] = eye;
                    return;
                }
            }
            all.push_back(eye);
        });
    return all;
}

void LitPass::leaveToGL(const std::vector<EyeLight>& all)
{
    for (const EyeLight& light : all)
    {
        if (_lighting == LitScene::Lighting::OFF)
            _dropped.push_back({light, "lighting is off"});
        else if (light.number >= int(SurfaceState::MaxGLLights))
            _dropped.push_back({light, "GL has lights 0 to 7 only; lighting=pixel has all"});
        else
        {
            _lights.push_back(light);
            _used.push_back(true);
        }
    }
}

bool LitPass::measureBox(const osgMultiRender::SurfaceFrame& frame)
{
    bool unbounded = false;
    const osg::BoundingBoxd box = frame.getBounds(_toGrid, unbounded);
    _boxMin = glm::dvec3(box.xMin(), box.yMin(), box.zMin());
    _boxMax = glm::dvec3(box.xMax(), box.yMax(), box.zMax());
    _hasBox = box.valid() && std::isfinite(glm::length(_boxMax - _boxMin));
    return _hasBox && !unbounded;
}

std::vector<double> LitPass::keepReaching(const std::vector<EyeLight>& all, bool everythingBounded)
{
    const glm::dvec3 center = fromGrid(0.5 * (_boxMin + _boxMax));
    const double radius = 0.5 * glm::length(_boxMax - _boxMin);
    // Half of the tolerance is for what the whole view leaves out, half for what a leaf does.
    const double threshold = 0.5 * _tolerance / std::max<std::size_t>(1, all.size());
    std::vector<double> limits;
    for (const EyeLight& light : all)
    {
        if (!isUsable(light))
            continue;
        if (_settings.lightShown >= 0 && light.number != _settings.lightShown)
        {
            _dropped.push_back({light, "another light is shown alone"});
            continue;
        }
        const double reach = reachOf(light, threshold);
        if (brightness(light) == 0.0 && !lightsUnlit())
            _dropped.push_back({light, "it is black"});
        else if (everythingBounded && !reaches(light, reach, center, radius))
            _dropped.push_back({light, "it reaches nothing in view"});
        else
        {
            _lights.push_back(light);
            limits.push_back(reach);
        }
    }
    return limits;
}

void LitPass::planShadows(osg::RenderInfo& renderInfo, bool everythingBounded,
                          const std::vector<double>& limits)
{
    _shadows->begin(renderInfo);
    GLint viewport[4];
    glGetIntegerv(GL_VIEWPORT, viewport);
    const glm::dmat4 toEye(glm::make_mat4(osg::Matrixd::inverse(_toGrid).ptr()));
    const Hexahedron receivers = everythingBounded
                                     ? boxOf(_boxMin, _boxMax, toEye)
                                     : boxOf(glm::dvec3(1.0), glm::dvec3(-1.0), toEye);
    _shadows->plan({viewport[0], viewport[1], viewport[2], viewport[3]}, receivers, _lights,
                   limits);
}

void LitPass::choosePoints()
{
    for (unsigned int i = 0; i < 64; ++i)
        _points.push_back(
            fromGrid(_boxMin + (_boxMax - _boxMin) * glm::dvec3(radicalInverse(i + 1, 2),
                                                                radicalInverse(i + 1, 3),
                                                                radicalInverse(i + 1, 5))));
}

void LitPass::chooseGridAxes(const osgMultiRender::SurfaceFrame& frame)
{
    auto& stage = const_cast<osgUtil::RenderStage&>(frame.getStage());
    if (!stage.getInitialViewMatrix())
        return;
    // A view matrix may scale; only its rotation counts.
    const osg::Quat rotation = stage.getInitialViewMatrix()->getRotate();
    if (std::isfinite(rotation.length2()) && rotation.length2() > 0.0)
        _toGrid.makeRotate(rotation.inverse());
}

glm::dvec3 LitPass::toGrid(const glm::dvec3& eye) const
{
    const osg::Vec3d p = osg::Vec3d(eye.x, eye.y, eye.z) * _toGrid;
    return {p.x(), p.y(), p.z()};
}

glm::dvec3 LitPass::fromGrid(const glm::dvec3& grid) const
{
    const osg::Vec3d p = osg::Matrixd::inverse(_toGrid).preMult(osg::Vec3d(grid.x, grid.y, grid.z));
    return {p.x(), p.y(), p.z()};
}

bool LitPass::isUsable(const EyeLight& light)
{
    const double values[] = {brightness(light),
                             glm::dot(light.position, light.position),
                             glm::dot(light.spotDirection, light.spotDirection),
                             double(light.constantAttenuation),
                             double(light.linearAttenuation),
                             double(light.quadraticAttenuation),
                             double(light.spotCutoffDegrees),
                             double(light.spotExponent)};
    if (std::all_of(std::begin(values), std::end(values),
                    [](double x) { return std::isfinite(x); }))
        return true;
    _dropped.push_back({light, "a parameter of it is infinite or not a number"});
    return false;
}

} // namespace osgShadowVolume
