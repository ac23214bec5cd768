// SPDX-License-Identifier: MIT
#include <osgShadowVolume/CasterDraw.h>

#include <osg/GLExtensions>
#include <osg/Program>

#include <algorithm>
#include <cmath>

namespace osgShadowVolume
{

using Pass = ShadowPasses::Pass;

namespace
{

double determinantOf(const osg::Matrixd& m)
{
    return m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) -
           m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
           m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
}

/// The power of two of its distance from the light by which what lies in the box is moved away from
/// the light, to behind all that is in view; the box and the light in the frame that the matrix
/// takes clip coordinates to.
///
/// Not by more than that: clipping, in single precision, misplaces what is left of a far cap by
/// some 2^-24 of the cap's distance, and so the cap fails to cover the picture up to its rim. The
/// limit, for a light that may touch its caster, leaves that at a thousandth of the caster's
/// distance.
int stretchOf(const osg::Vec3d& light, const osg::BoundingBoxd& box, const osg::Matrixd& fromClip)
{
    constexpr int Least = -20, Most = 14;
    osg::Vec3d nearest = light;
    for (int k = 0; k < 3; ++k)
        nearest[k] = std::max(box._min[k], std::min(box._max[k], light[k]));
    double farthest = 0.0;
    for (unsigned int i = 0; i < 8; ++i)
    {
        const osg::Vec3d corner((i & 1u) ? 1.0 : -1.0, (i & 2u) ? 1.0 : -1.0,
                                (i & 4u) ? 1.0 : -1.0);
        farthest = std::max(farthest, (corner * fromClip - light).length());
    }
    const double distance = (nearest - light).length();
    const double missing = farthest / distance - 1.0;
    if (!(missing < std::ldexp(1.0, Most - 2)))
        return Most;
    return missing > std::ldexp(1.0, Least) ? std::ilogb(missing) + 2 : Least;
}

void setUniform(const osg::State& state, const char* name, float value)
{
    const auto& program = *state.getLastAppliedProgramObject();
    state.get<osg::GLExtensions>()->glUniform1f(
        program.getUniformLocation(osg::Uniform::getNameID(name)), value);
}

} // namespace

void CasterDraw::add(const osg::ref_ptr<CasterMesh>& mesh,
                     const osg::ref_ptr<const osg::RefMatrix>& modelview)
{
    osg::Matrixd toLocal;
    const double determinant = determinantOf(*modelview);
    // What a matrix flattens has no inside that a volume could be made of.
    if (!std::isfinite(determinant) || determinant == 0.0 || !toLocal.invert(*modelview))
        return;
    const osg::Vec4d local = osg::Vec4d(_light.position.x, _light.position.y, _light.position.z,
                                        _light.isDirectional() ? 0.0 : 1.0) *
                             toLocal;
    _placed.push_back({mesh, modelview,
                       toMeshLight(mesh->getEdges(), {local.x(), local.y(), local.z(), local.w()}),
                       determinant < 0.0 ? -1.0f : 1.0f});
    _placed.back().light.end = endOf(_placed.back());
}

float CasterDraw::endOf(const Placed& placed) const
{
    // All rays of an orthographic view meet at one point at infinity, so that a cap there covers
    // all of the picture or nothing and is not drawn. So there volumes end behind what is in view.
    const osg::Matrixd& p = *_view.projection;
    const bool isPerspective = p(0, 3) != 0.0 || p(1, 3) != 0.0 || p(2, 3) != 0.0;
    if (isPerspective)
        return 0.0f;
    const glm::vec4& light = placed.light.light;
    const osg::Matrixd toClip = osg::Matrixd(*placed.modelview) * p;
    const osg::BoundingBoxd box(placed.mesh->getBoundingBox());
    if (light.w != 0.0f)
        return std::ldexp(light.w, -stretchOf(osg::Vec3d(light.x, light.y, light.z) / light.w, box,
                                              osg::Matrixd::inverse(toClip)));
    // Sides that run along the view are not drawn either, and can't close the volume of a
    // directional light. There it ends beyond what is in view.
    const osg::Vec3d way =
        osg::Matrixd::transform3x3(osg::Vec3d(light.x, light.y, light.z), toClip);
    if (std::hypot(way.x(), way.y()) > std::ldexp(std::abs(way.z()), -16))
        return 0.0f;
    double depth = 1.0;
    for (unsigned int corner = 0; corner < 8; ++corner)
        depth = std::max(depth, std::abs((box.corner(corner) * toClip).z()));
    const double end = std::abs(way.z()) / (4.0 * depth);
    return std::isfinite(end) ? float(end) : 0.0f;
}

void CasterDraw::run(ShadowPasses::Count count)
{
    if (_placed.empty())
        return;
    // What lies before a surface and what lies behind it add up to 0: both ways count into one
    // counter, so z-pass counts the other way round.
    if (count == ShadowPasses::Count::ZPass)
        for (Placed& placed : _placed)
            placed.handedness = -placed.handedness;
    const bool onCpu = _view.technique == Technique::CPU;
    drawPass(onCpu                                ? Pass::TriangleSides
             : _view.technique == Technique::TESS ? Pass::TessSides
                                                  : Pass::GeometrySides,
             count);
    if (count == ShadowPasses::Count::ZFail)
        drawPass(onCpu ? Pass::TriangleCaps : Pass::GeometryCaps, count);
    _placed.clear();
}

void CasterDraw::drawPass(Pass pass, ShadowPasses::Count count)
{
    osg::State& state = *_view.renderInfo.getState();
    state.pushStateSet(&_view.resources.passes.get(pass, _view.tier, count));
    state.apply();
    state.applyProjectionMatrix(_view.projection.get());
    if (state.getLastAppliedProgramObject())
        for (const Placed& placed : _placed)
        {
            place(placed);
            drawParts(pass, placed);
        }
    state.popStateSet();
}

void CasterDraw::place(const Placed& placed)
{
    static const unsigned int light = osg::Uniform::getNameID("osgsv_localLight");
    static const unsigned int color = osg::Uniform::getNameID("osgsv_color");
    static const unsigned int rest = osg::Uniform::getNameID("osgsv_lightRest");
    osg::State& state = *_view.renderInfo.getState();
    const auto& program = *state.getLastAppliedProgramObject();
    const auto* gl = state.get<osg::GLExtensions>();
    gl->glUniform4fv(program.getUniformLocation(light), 1, &placed.light.light[0]);
    gl->glUniform3fv(program.getUniformLocation(rest), 1, &placed.light.rest[0]);
    setUniform(state, "osgsv_meshScale", placed.mesh->getEdges().scale);
    setUniform(state, "osgsv_handedness", placed.handedness);
    setUniform(state, "osgsv_end", placed.light.end);
    gl->glUniform4fv(program.getUniformLocation(color), 1, _color.ptr());
    state.applyModelViewMatrix(placed.modelview.get());
    if (state.getUseModelViewAndProjectionUniforms())
        state.applyModelViewAndProjectionUniformsIfRequired();
}

void CasterDraw::drawParts(Pass pass, const Placed& placed)
{
    osg::State& state = *_view.renderInfo.getState();
    switch (pass)
    {
    case Pass::TessSides:
        for (const auto& patches : placed.mesh->getPatches())
            drawGeometry(*patches);
        return;
    case Pass::GeometrySides:
        drawGeometry(*placed.mesh->getLines());
        return;
    case Pass::GeometryCaps:
        drawGeometry(*placed.mesh->getTriangles());
        return;
    default:
        break;
    }
    const auto volume = _view.resources.silhouettes.get(
        placed.mesh, placed.light, _view.renderInfo.getContextID(), _view.frameNumber);
    for (const auto& [weight, geometry] :
         pass == Pass::TriangleSides ? volume->sides : volume->caps)
    {
        setUniform(state, "osgsv_weight", weight);
        drawGeometry(*geometry);
    }
}

void CasterDraw::drawGeometry(const osg::Geometry& geometry)
{
    geometry.draw(_view.renderInfo);
    ++_drawCalls;
}

} // namespace osgShadowVolume
