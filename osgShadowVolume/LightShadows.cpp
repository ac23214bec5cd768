// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LightShadows.h>

#include <osgShadowVolume/MirrorCamera.h>

#include <osgUtil/CullVisitor>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgShadowVolume
{

namespace
{

/// How far the light shines until it is past all corners; infinity for an unknown extent.
double reachPast(const Hexahedron& corners, const EyeLight& light)
{
    double farthest = 0.0, deepest = 0.0;
    for (const glm::dvec3& corner : corners)
    {
        const glm::dvec3 way = corner - light.position;
        if (!std::isfinite(glm::length(way)))
            return std::numeric_limits<double>::infinity();
        farthest = std::max(farthest, glm::length(way));
        deepest = std::max(deepest, glm::dot(way, light.spotDirection));
    }
    // The plane that cuts a cone behind all corners is as far away at its rim.
    if (light.type == EyeLight::Spot && light.spotCutoffDegrees < 89.0f)
        farthest = std::min(farthest, deepest / std::cos(glm::radians(light.spotCutoffDegrees)));
    return farthest * (1.0 + 1e-6);
}

EyeSphere sphereAround(const Hexahedron& corners)
{
    EyeSphere sphere;
    for (const glm::dvec3& corner : corners)
        sphere.center += corner / 8.0;
    for (const glm::dvec3& corner : corners)
    {
        const double distance = glm::length(corner - sphere.center) * (1.0 + 1e-6);
        if (!std::isfinite(distance))
            return {glm::dvec3(0.0), std::numeric_limits<double>::infinity()};
        sphere.radius = std::max(sphere.radius, distance);
    }
    return sphere;
}

} // namespace

LightShadows::~LightShadows() = default;

void LightShadows::cull(osgUtil::CullVisitor& visitor, osgMultiRender::SurfaceGroup& group)
{
    _projection = visitor.getProjectionMatrix();
    _isClipped = MirrorCamera::isInside(visitor);
    CasterCollector collector(visitor, _settings.transparentCasters);
    collector.collect(group);
    _casters = std::move(collector.getCasters());
    _shadowless = std::move(collector.getShadowless());
    _notCasting = collector.getLeftOut();
    for (const Caster& caster : _casters)
        _isDynamic = _isDynamic || caster.dynamic;
}

const char* LightShadows::whyNoShadow(const EyeLight& light) const
{
    if (!light.castsShadow)
        return "it says castShadow=0";
    if (light.isHeadlight && !_settings.headlightShadow)
        return "the headlight casts no shadow (headlight=noshadow)";
    return nullptr;
}

void LightShadows::plan(const glm::dvec4& viewport, const Hexahedron& receivers,
                        const std::vector<EyeLight>& lights, const std::vector<double>& limits)
{
    _lights = &lights;
    const glm::dmat4 projection = glm::make_mat4(_projection->ptr());
    const Hexahedron frustum = frustumOf(projection), nearRectangle = nearRectangleOf(projection);
    // Casters may be many, and a headlight alone asks for none.
    const bool anyCasts =
        std::any_of(lights.begin(), lights.end(),
                    [this](const EyeLight& light) { return whyNoShadow(light) == nullptr; });
    std::vector<Hexahedron> boxes;
    std::vector<EyeSphere> spheres;
    for (std::size_t i = 0; anyCasts && i < _casters.size(); ++i)
    {
        const osg::BoundingBox& box = _casters[i].box;
        boxes.push_back(boxOf(glm::make_vec3(box._min.ptr()), glm::make_vec3(box._max.ptr()),
                              glm::make_mat4(_casters[i].modelview->ptr())));
        spheres.push_back(sphereAround(boxes.back()));
    }
    // A mask shows whether a light is taken away even where there is none of it.
    const bool everywhere = _settings.show == Show::MASK;
    int index = 0;
    for (std::size_t number = 0; number < lights.size(); ++number)
    {
        const EyeLight& light = lights[number];
        LightDecision decision;
        const double reach = everywhere ? std::numeric_limits<double>::infinity()
                                        : std::min({limits[number], reachPast(receivers, light),
                                                    reachPast(frustum, light)});
        const std::optional<ScreenBounds> bounds =
            screenBounds(sphereOf(light, reach), projection, viewport);
        if (const char* reason = whyNoShadow(light))
            decision.reason = reason;
        else if (!bounds)
            decision.reason = "it lights nothing on the screen";
        else
        {
            decision.bounds = *bounds;
            const glm::dvec4 l(light.position, light.isDirectional() ? 0.0 : 1.0);
            const ShadowHull toReceivers(receivers, l), toFrustum(frustum, l),
                toNear(nearRectangle, l);
            for (std::uint32_t i = 0; i < boxes.size(); ++i)
                // Where light does not come, none is taken away.
                if ((everywhere || reaches(light, reach, spheres[i].center, spheres[i].radius)) &&
                    toReceivers.mayTouch(boxes[i]) && toFrustum.mayTouch(boxes[i]))
                {
                    decision.casters.push_back(i);
                    // z-pass leaves out the near cap, which lies in a surface that hides what is
                    // behind.
                    decision.needsZFail.push_back(_isClipped || _casters[i].seenThrough ||
                                                  toNear.mayTouch(boxes[i]));
                }
            const bool castsPastNear =
                std::find(decision.needsZFail.begin(), decision.needsZFail.end(), true) !=
                decision.needsZFail.end();
            if (decision.casters.empty())
                decision.reason = "no caster between it and what is in view";
            else if (!castsPastNear && hidesItsShadows(light, projection, viewport))
                decision.reason = "its shadows hide behind what casts them";
            else
                decision.index = index++;
        }
        _decisions.push_back(std::move(decision));
    }
}

bool LightShadows::receives(const osgUtil::RenderLeaf& leaf,
                            const osgMultiRender::SurfaceState& state) const
{
    return leaf._projection == _projection && state.isOn(osgMultiRender::SurfaceState::DepthTest) &&
           (state.isOpaque() || receivesOnTransparent());
}

void LightShadows::fillPlan(osgMultiRender::Plan& plan) const
{
    std::size_t shadowed = 0;
    for (const LightDecision& decision : _decisions)
        shadowed += decision.index >= 0;
    plan.counts["shadows.lights"] = static_cast<double>(shadowed);
    plan.counts["shadows.casters"] = static_cast<double>(_casters.size());
    for (const auto& [reason, number] : _notCasting)
        plan.entries.push_back({std::to_string(number) + " " + reason,
                                osgMultiRender::PlanEntry::Decision::Dropped,
                                "these cast no shadow"});
}

} // namespace osgShadowVolume
