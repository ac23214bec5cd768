// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/CasterMesh.h>
#include <osgShadowVolume/ShadowSettings.h>

#include <osg/CullStack>
#include <osg/Material>
#include <osg/NodeVisitor>
#include <osg/Transform>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace osgUtil
{
class CullVisitor;
}

namespace osgShadowVolume
{

/// Drawables that cast shadows under one matrix, for one frame of one view.
struct Caster
{
    Caster() = default;
    Caster(const Caster&) = default;
    Caster(Caster&&) noexcept = default; // osg::ref_ptr's own says nothing: lists would copy.
    Caster& operator=(const Caster&) = default;
    Caster& operator=(Caster&&) noexcept = default;

    CasterSource source;                          ///< For CasterCache::get().
    osg::ref_ptr<const osg::RefMatrix> modelview; ///< Local to eye.
    osg::BoundingBox box;                         ///< Local, as the Drawables state it.
    bool dynamic = false;                         ///< Changes its vertices.
    /// Surfaces behind it may show: it is blended, has holes by alpha test or lacks faces. Then its
    /// lit side is not always in front of what is in its volume.
    bool seenThrough = false;
};

/// Finds what casts shadows in a subgraph, for a view that is being culled.
///
/// Nothing is culled: what lies outside the view casts into it. Otherwise it sees the subgraph as
/// the view's cull traversal does: node masks, Switch, Sequence, LOD and PagedLOD by the view's
/// eye, and modelview matrices equal to those of its leaves bit for bit. Cull callbacks are not
/// run, so what they hide casts. Left out and counted are nested Cameras, Projections, Billboards
/// and ClearNodes with all that is below, and:
///
/// - Text, particles, points and lines, and polygons that are drawn as such (PolygonMode).
/// - Nodes and Drawables with a user value `castShadow` of false, 0, "false" or "0", or a
/// description
///   "castShadow=0", with all that is below.
/// - Transparent Drawables, by the settings. One is transparent where GL_BLEND is on, with OVERRIDE
///   and PROTECTED as they are in GL's state, and its alpha is below 1. That is the alpha of the
///   overall colour of its Geometry where the material follows it (color material on diffuse) or
///   there is none, otherwise the material's diffuse alpha, of both sides the larger one. Textures
///   and colours of single vertices are not looked at.
///
/// Static Geometries under one matrix are one caster; one whose data variance, or that of its
/// vertex array, is DYNAMIC is its own. Use in the cull thread, once.
class OSGSHADOWVOLUME_EXPORT CasterCollector : public osg::NodeVisitor
{
public:
    /// Starts with the matrices, state, eye, and traversal mask that the view has at this point.
    CasterCollector(osgUtil::CullVisitor& view, TransparentCasters transparent);

    /// Collects what is below the node. The node's own StateSet and matrix are the view's already.
    void collect(osg::Node& node);

    std::vector<Caster>& getCasters() { return _casters; }
    /// What casts nothing: "billboards" and so on, with how many there are.
    const std::map<std::string, unsigned int>& getLeftOut() const { return _leftOut; }

    /// Lights whose LightSource says castShadow=0. A Light can say so itself, wherever it is.
    std::set<const osg::Light*>& getShadowless() { return _shadowless; }

    osg::CullStack* asCullStack() override { return &cullStack(); }
    const osg::CullStack* asCullStack() const override { return &cullStack(); }
    osg::Vec3 getEyePoint() const override;
    osg::Vec3 getViewPoint() const override;
    float getDistanceToEyePoint(const osg::Vec3& point, bool withLODScale) const override;
    float getDistanceFromEyePoint(const osg::Vec3& point, bool withLODScale) const override;
    float getDistanceToViewPoint(const osg::Vec3& point, bool withLODScale) const override;

    void apply(osg::Node& node) override;
    void apply(osg::LightSource& source) override;
    void apply(osg::Drawable& drawable) override;
    void apply(osg::Transform& node) override;
    void apply(osg::Camera& node) override;
    void apply(osg::Projection& node) override;
    void apply(osg::Billboard& node) override;
    void apply(osg::ClearNode& node) override;

private:
    struct Matrix
    {
        osg::ref_ptr<osg::RefMatrix> modelview;
        osg::Transform::ReferenceFrame frame = osg::Transform::RELATIVE_RF;
        int caster = -1; ///< Index of the one of its static Geometries; -1 for none yet.
    };
    /// What decides on whether it hides what is behind, of the state on the path.
    struct State
    {
        using Value = osg::StateAttribute::GLModeValue;
        Value blend = osg::StateAttribute::OFF;
        Value alphaTest = osg::StateAttribute::OFF;
        Value cullFace = osg::StateAttribute::OFF;
        Value depthTest = osg::StateAttribute::OFF;
        struct Attribute
        {
            const osg::StateAttribute* attribute = nullptr;
            osg::StateAttribute::OverrideValue override = osg::StateAttribute::OFF;
        };
        Attribute material, depth, polygonMode;
        bool hasHoles = false; ///< For any other reason.
    };

    bool casts(const osg::Node& node);
    static void addTo(State& state, const osg::StateSet& stateSet);
    static void enter(State& state, const osg::Node& node);
    bool isLeftOut(const osg::Drawable& drawable, const State& state) const;
    /// Triangles drawn as lines or points cast no more than those.
    static bool isWireframe(const State& state);
    static bool isSeenThrough(const State& state);
    Caster& casterFor(const osg::Drawable& drawable);
    /// Matrices that OSG's nodes ask for seldom are made only then: it takes longer than the rest.
    osg::CullStack& cullStack() const;

    const TransparentCasters _transparent;
    mutable osg::CullStack _cullStack;
    mutable std::size_t _pushed = 0; ///< Of _matrices, on _cullStack.
    std::vector<Matrix> _matrices;
    State _state;
    std::vector<Caster> _casters;
    std::map<std::string, unsigned int> _leftOut;
    std::set<const osg::Light*> _shadowless;
};

} // namespace osgShadowVolume
