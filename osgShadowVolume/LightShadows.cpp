// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LightShadows.h>

#include <osgShadowVolume/LightScreen.h>
#include <osgShadowVolume/MirrorCamera.h>
#include <osgShadowVolume/ShadowHull.h>

#include <osgUtil/CullVisitor>

#include <algorithm>

namespace osgShadowVolume
{

namespace
{

glm::dmat4 toGlm(const osg::Matrixd& m)
{
    glm::dmat4 result;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            result[row][column] = m(row, column); // osg's rows are GLM's columns
    return result;
}

glm::dvec3 toGlm(const osg::Vec3d& v)
{
    return {v.x(), v.y(), v.z()};
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
    _notCasting = collector.getLeftOut();
    for (const Caster& caster : _casters)
        _isDynamic = _isDynamic || caster.dynamic;
}

void LightShadows::plan(const glm::dvec4& viewport, const osgMultiRender::SurfaceFrame& frame,
                        const std::vector<EyeLight>& lights)
{
    _lights = &lights;
    bool unbounded = false;
    const osg::BoundingBoxd box = frame.getBounds(osg::Matrixd(), unbounded);
    Hexahedron receivers = boxOf(toGlm(osg::Vec3d(box._min)), toGlm(osg::Vec3d(box._max)),
                                 glm::dmat4(1.0));
    if (unbounded || !box.valid())
        receivers = boxOf(glm::dvec3(1.0), glm::dvec3(-1.0), glm::dmat4(1.0)); // unknown
    const glm::dmat4 projection = toGlm(*_projection);
    const Hexahedron frustum = frustumOf(projection), nearRectangle = nearRectangleOf(projection);
    std::vector<Hexahedron> boxes;
    for (const Caster& caster : _casters)
        boxes.push_back(boxOf(toGlm(osg::Vec3d(caster.box._min)),
                              toGlm(osg::Vec3d(caster.box._max)), toGlm(*caster.modelview)));
    int index = 0;
    for (const EyeLight& light : lights)
    {
        LightDecision decision;
        if (!light.castsShadow)
            decision.reason = "it says castShadow=0";
        else if (light.isHeadlight && !_settings.headlightShadow)
            decision.reason = "the headlight casts no shadow (headlight=noshadow)";
        else
        {
            const glm::dvec4 l(light.position, light.isDirectional() ? 0.0 : 1.0);
            const ShadowHull toReceivers(receivers, l), toFrustum(frustum, l),
                toNear(nearRectangle, l);
            for (std::uint32_t i = 0; i < boxes.size(); ++i)
                if (toReceivers.mayTouch(boxes[i]) && toFrustum.mayTouch(boxes[i]))
                {
                    decision.casters.push_back(i);
                    decision.needsZFail.push_back(_isClipped || toNear.mayTouch(boxes[i]));
                }
            const bool castsPastNear = std::find(decision.needsZFail.begin(),
                                                 decision.needsZFail.end(), true) !=
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
    return leaf._projection == _projection &&
           state.isOn(osgMultiRender::SurfaceState::DepthTest) &&
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
