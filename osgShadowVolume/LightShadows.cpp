// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LightShadows.h>

#include <osgShadowVolume/MirrorCamera.h>

#include <osgUtil/CullVisitor>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
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
    // The group may stand in several places.
    _casters.insert(_casters.end(), std::make_move_iterator(collector.getCasters().begin()),
                    std::make_move_iterator(collector.getCasters().end()));
    _shadowless.merge(collector.getShadowless());
    for (const auto& [what, count] : collector.getLeftOut())
        _notCasting[what] += count;
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

/// What decides on the shadows of all lights, in eye coordinates.
struct LightShadows::Seen
{
    glm::dmat4 projection;
    glm::dvec4 viewport;
    Hexahedron receivers, frustum, nearRectangle;
    std::vector<Hexahedron> boxes{}; ///< Of the casters; none where no light casts shadows.
    std::vector<EyeSphere> spheres{};
};

void LightShadows::plan(const glm::dvec4& viewport, const Hexahedron& receivers,
                        const std::vector<EyeLight>& lights, const std::vector<double>& limits)
{
    _lights = &lights;
    const glm::dmat4 projection = glm::make_mat4(_projection->ptr());
    Seen seen{projection, viewport, receivers, frustumOf(projection), nearRectangleOf(projection)};
    // Casters may be many, and a headlight alone asks for none.
    const bool anyCasts =
        std::any_of(lights.begin(), lights.end(),
                    [this](const EyeLight& light) { return whyNoShadow(light) == nullptr; });
    for (std::size_t i = 0; anyCasts && i < _casters.size(); ++i)
    {
        const osg::BoundingBox& box = _casters[i].box;
        seen.boxes.push_back(boxOf(glm::make_vec3(box._min.ptr()), glm::make_vec3(box._max.ptr()),
                                   glm::make_mat4(_casters[i].modelview->ptr())));
        seen.spheres.push_back(sphereAround(seen.boxes.back()));
    }
    int index = 0;
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
        _decisions.push_back(decide(lights[i], limits[i], seen));
        if (_decisions.back().reason.empty())
            _decisions.back().index = index++;
    }
}

LightDecision LightShadows::decide(const EyeLight& light, double limit, const Seen& seen) const
{
    LightDecision decision;
    // A mask shows whether a light is taken away even where there is none of it.
    const bool everywhere = _settings.show == Show::MASK;
    const double reach =
        everywhere
            ? std::numeric_limits<double>::infinity()
            : std::min({limit, reachPast(seen.receivers, light), reachPast(seen.frustum, light)});
    const std::optional<ScreenBounds> bounds =
        screenBounds(sphereOf(light, reach), seen.projection, seen.viewport);
    if (const char* reason = whyNoShadow(light))
    {
        decision.reason = reason;
        return decision;
    }
    if (!bounds)
    {
        decision.reason = "it lights nothing on the screen";
        return decision;
    }
    decision.bounds = *bounds;
    const glm::dvec4 l(light.position, light.isDirectional() ? 0.0 : 1.0);
    const ShadowHull toReceivers(seen.receivers, l), toFrustum(seen.frustum, l),
        toNear(seen.nearRectangle, l);
    for (std::uint32_t i = 0; i < seen.boxes.size(); ++i)
        // Where light does not come, none is taken away.
        if ((everywhere || reaches(light, reach, seen.spheres[i].center, seen.spheres[i].radius)) &&
            toReceivers.mayTouch(seen.boxes[i]) && toFrustum.mayTouch(seen.boxes[i]))
        {
            decision.casters.push_back(i);
            // z-pass leaves out the near cap, which lies in a surface that hides what is behind.
            decision.needsZFail.push_back(_isClipped || _casters[i].seenThrough ||
                                          toNear.mayTouch(seen.boxes[i]));
        }
    const bool castsPastNear = std::find(decision.needsZFail.begin(), decision.needsZFail.end(),
                                         true) != decision.needsZFail.end();
    if (decision.casters.empty())
        decision.reason = "no caster between it and what is in view";
    else if (!castsPastNear && hidesItsShadows(light, seen.projection, seen.viewport))
        decision.reason = "its shadows hide behind what casts them";
    return decision;
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
