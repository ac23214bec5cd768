// SPDX-License-Identifier: MIT
#include <osgShadowVolume/CasterCollector.h>

#include <osgShadowVolume/CastShadow.h>

#include <osg/Billboard>
#include <osg/Camera>
#include <osg/ClearNode>
#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/LightSource>
#include <osg/Multisample>
#include <osg/PolygonMode>
#include <osg/Program>
#include <osg/Projection>
#include <osgUtil/CullVisitor>

#include <algorithm>

namespace osgShadowVolume
{

namespace
{

/// Modes under which a surface may lack parts.
bool makesHoles(GLenum mode)
{
    return mode == GL_STENCIL_TEST || mode == GL_POLYGON_STIPPLE ||
           mode == GL_SAMPLE_ALPHA_TO_COVERAGE_ARB ||
           (mode >= GL_CLIP_PLANE0 && mode < GL_CLIP_PLANE0 + 8);
}

const char* nameOf(NoCaster reason)
{
    switch (reason)
    {
    case NoCaster::TEXT:
        return "texts";
    case NoCaster::POINTS_AND_LINES:
        return "points and lines";
    default:
        return "drawables without triangles";
    }
}

/// Of the diffuse colour; both sides count, as volumes have no side either.
float alphaOf(const osg::Drawable& drawable, const osg::Material* material)
{
    const bool followsColor = !material || material->getColorMode() == osg::Material::DIFFUSE ||
                              material->getColorMode() == osg::Material::AMBIENT_AND_DIFFUSE;
    const osg::Geometry* geometry = drawable.asGeometry();
    if (followsColor && geometry)
        if (const osg::Array* colors = geometry->getColorArray())
        {
            if (colors->getBinding() != osg::Array::BIND_OVERALL || !colors->getNumElements())
                return 1.0f;
            if (const auto* floats = dynamic_cast<const osg::Vec4Array*>(colors))
                return floats->front().a();
            if (const auto* bytes = dynamic_cast<const osg::Vec4ubArray*>(colors))
                return bytes->front().a() / 255.0f;
            return 1.0f;
        }
    if (!material)
        return 1.0f;
    return std::max(material->getDiffuse(osg::Material::FRONT).a(),
                    material->getDiffuse(osg::Material::BACK).a());
}

bool isDynamic(const osg::Drawable& drawable)
{
    const osg::Geometry* geometry = drawable.asGeometry();
    return drawable.getDataVariance() == osg::Object::DYNAMIC ||
           (geometry && geometry->getVertexArray() &&
            geometry->getVertexArray()->getDataVariance() == osg::Object::DYNAMIC);
}

} // namespace

CasterCollector::CasterCollector(osgUtil::CullVisitor& view, TransparentCasters transparent)
    : osg::NodeVisitor(NODE_VISITOR, TRAVERSE_ACTIVE_CHILDREN), _transparent(transparent)
{
    setTraversalMask(view.getTraversalMask());
    setNodeMaskOverride(view.getNodeMaskOverride());
    setTraversalNumber(view.getTraversalNumber());
    setFrameStamp(const_cast<osg::FrameStamp*>(view.getFrameStamp()));
    getNodePath() = view.getNodePath();

    _cullStack.setLODScale(view.getLODScale());
    _cullStack.setCullingMode(osg::CullSettings::NO_CULLING);
    osg::ref_ptr<osg::Viewport> viewport = view.getViewport();
    _cullStack.pushViewport(viewport ? viewport.get() : new osg::Viewport(0, 0, 1, 1));
    _cullStack.pushProjectionMatrix(new osg::RefMatrix(*view.getProjectionMatrix()));
    _cullStack.pushReferenceViewPoint(view.getReferenceViewPoint());
    _matrices.push_back({new osg::RefMatrix(*view.getModelViewMatrix())});

    std::vector<const osg::StateSet*> stateSets;
    for (const osgUtil::StateGraph* graph = view.getCurrentStateGraph(); graph;
         graph = graph->_parent)
        if (graph->getStateSet())
            stateSets.push_back(graph->getStateSet());
    for (auto it = stateSets.rbegin(); it != stateSets.rend(); ++it)
        addTo(_state, **it);
}

void CasterCollector::collect(osg::Node& node)
{
    if (casts(node))
        node.traverse(*this);
}

bool CasterCollector::casts(const osg::Node& node)
{
    if (!saysNoShadow(node))
        return true;
    ++_leftOut["castShadow=0"];
    return false;
}

void CasterCollector::addTo(State& state, const osg::StateSet& stateSet)
{
    using osg::StateAttribute;
    // As osg::State: what comes later wins, unless what was before overrides it unprotected.
    const auto addMode = [&](State::Value& mode, GLenum which)
    {
        const State::Value value = stateSet.getMode(which);
        if (!(value & StateAttribute::INHERIT) &&
            (!(mode & StateAttribute::OVERRIDE) || (value & StateAttribute::PROTECTED)))
            mode = value;
    };
    const auto addAttribute = [&](State::Attribute& attribute, StateAttribute::Type type)
    {
        const auto* pair = stateSet.getAttributePair(type);
        if (pair && (!(attribute.override & StateAttribute::OVERRIDE) ||
                     (pair->second & StateAttribute::PROTECTED)))
            attribute = {pair->first.get(), pair->second};
    };
    // Once on is enough here: z-fail is right for casters that hide what is behind them, too.
    for (const auto& [mode, value] : stateSet.getModeList())
        state.hasHoles = state.hasHoles || ((value & StateAttribute::ON) && makesHoles(mode));
    const auto* program =
        static_cast<const osg::Program*>(stateSet.getAttribute(StateAttribute::PROGRAM));
    const auto* mask =
        static_cast<const osg::ColorMask*>(stateSet.getAttribute(StateAttribute::COLORMASK));
    state.hasHoles = state.hasHoles || (program && program->getNumShaders() > 0) ||
                     (mask && !(mask->getRedMask() && mask->getGreenMask() && mask->getBlueMask()));
    if (!stateSet.getModeList().empty())
    {
        addMode(state.blend, GL_BLEND);
        addMode(state.alphaTest, GL_ALPHA_TEST);
        addMode(state.cullFace, GL_CULL_FACE);
        addMode(state.depthTest, GL_DEPTH_TEST);
    }
    if (!stateSet.getAttributeList().empty())
    {
        addAttribute(state.material, StateAttribute::MATERIAL);
        addAttribute(state.depth, StateAttribute::DEPTH);
        addAttribute(state.polygonMode, StateAttribute::POLYGONMODE);
    }
}

bool CasterCollector::isWireframe(const State& state)
{
    const auto* polygons = static_cast<const osg::PolygonMode*>(state.polygonMode.attribute);
    return polygons && polygons->getMode(osg::PolygonMode::FRONT) != osg::PolygonMode::FILL &&
           polygons->getMode(osg::PolygonMode::BACK) != osg::PolygonMode::FILL;
}

bool CasterCollector::isSeenThrough(const State& state)
{
    using osg::StateAttribute;
    const auto isOn = [](State::Value mode) { return (mode & StateAttribute::ON) != 0; };
    const auto* depth = static_cast<const osg::Depth*>(state.depth.attribute);
    const bool isNearest = !depth || depth->getFunction() == osg::Depth::LESS ||
                           depth->getFunction() == osg::Depth::LEQUAL;
    const auto* polygons = static_cast<const osg::PolygonMode*>(state.polygonMode.attribute);
    return state.hasHoles || !isNearest || isOn(state.blend) || isOn(state.alphaTest) ||
           isOn(state.cullFace) || !isOn(state.depthTest) || (depth && !depth->getWriteMask()) ||
           (polygons && (polygons->getMode(osg::PolygonMode::FRONT) != osg::PolygonMode::FILL ||
                         polygons->getMode(osg::PolygonMode::BACK) != osg::PolygonMode::FILL));
}

bool CasterCollector::isLeftOut(const osg::Drawable& drawable, const State& state) const
{
    if (_transparent == TransparentCasters::ALL || !(state.blend & osg::StateAttribute::ON))
        return false;
    const float alpha =
        alphaOf(drawable, static_cast<const osg::Material*>(state.material.attribute));
    return alpha < (_transparent == TransparentCasters::NONE ? 1.0f : 0.5f);
}

void CasterCollector::enter(State& state, const osg::Node& node)
{
    state.hasHoles = state.hasHoles || node.getCullCallback(); // may hide it, or what is below
    if (node.getStateSet())
        addTo(state, *node.getStateSet());
}

void CasterCollector::apply(osg::Node& node)
{
    if (!casts(node))
        return;
    const State outer = _state;
    enter(_state, node);
    traverse(node);
    _state = outer;
}

void CasterCollector::apply(osg::Transform& node)
{
    // The very operations of osgUtil::CullVisitor, so that the matrix is the same bit for bit.
    osg::ref_ptr<osg::RefMatrix> matrix = new osg::RefMatrix(*_matrices.back().modelview);
    node.computeLocalToWorldMatrix(*matrix, this);
    _matrices.push_back({matrix, node.getReferenceFrame()});
    apply(static_cast<osg::Node&>(node));
    _matrices.pop_back();
    if (_pushed > _matrices.size())
    {
        _cullStack.popModelViewMatrix();
        --_pushed;
    }
}

void CasterCollector::apply(osg::LightSource& source)
{
    if (source.getLight() && saysNoShadow(source))
        _shadowless.insert(source.getLight());
    osg::NodeVisitor::apply(static_cast<osg::Group&>(source));
}

void CasterCollector::apply(osg::Drawable& drawable)
{
    if (!casts(drawable))
        return;
    const NoCaster reason = whyNoCaster(drawable);
    if (reason != NoCaster::CASTS)
    {
        ++_leftOut[nameOf(reason)];
        return;
    }
    State state = _state;
    enter(state, drawable);
    if (isWireframe(state))
    {
        ++_leftOut["wireframes"];
        return;
    }
    if (isLeftOut(drawable, state))
    {
        ++_leftOut["transparent"];
        return;
    }
    Caster& caster = casterFor(drawable);
    caster.source.push_back(&drawable);
    caster.box.expandBy(drawable.getBoundingBox());
    caster.seenThrough = caster.seenThrough || isSeenThrough(state);
}

Caster& CasterCollector::casterFor(const osg::Drawable& drawable)
{
    Matrix& matrix = _matrices.back();
    const bool dynamic = isDynamic(drawable);
    if (!dynamic && matrix.caster >= 0)
        return _casters[std::size_t(matrix.caster)];
    if (!dynamic)
        matrix.caster = int(_casters.size());
    _casters.emplace_back();
    _casters.back().modelview = matrix.modelview;
    _casters.back().dynamic = dynamic;
    return _casters.back();
}

void CasterCollector::apply(osg::Camera&)
{
    ++_leftOut["cameras"];
}

void CasterCollector::apply(osg::Projection&)
{
    ++_leftOut["projections"];
}

void CasterCollector::apply(osg::Billboard&)
{
    ++_leftOut["billboards"];
}

void CasterCollector::apply(osg::ClearNode&)
{
    ++_leftOut["clear nodes"];
}

osg::CullStack& CasterCollector::cullStack() const
{
    for (; _pushed != _matrices.size(); ++_pushed)
        _cullStack.pushModelViewMatrix(_matrices[_pushed].modelview, _matrices[_pushed].frame);
    return _cullStack;
}

osg::Vec3 CasterCollector::getEyePoint() const
{
    return cullStack().getEyeLocal();
}

osg::Vec3 CasterCollector::getViewPoint() const
{
    return cullStack().getViewPointLocal();
}

float CasterCollector::getDistanceToEyePoint(const osg::Vec3& point, bool withLODScale) const
{
    const float distance = (point - cullStack().getEyeLocal()).length();
    return withLODScale ? distance * _cullStack.getLODScale() : distance;
}

float CasterCollector::getDistanceFromEyePoint(const osg::Vec3& point, bool withLODScale) const
{
    const osg::Matrixd& m = *_matrices.back().modelview;
    const float distance =
        float(-(point.x() * m(0, 2) + point.y() * m(1, 2) + point.z() * m(2, 2) + m(3, 2)));
    return withLODScale ? distance * _cullStack.getLODScale() : distance;
}

float CasterCollector::getDistanceToViewPoint(const osg::Vec3& point, bool withLODScale) const
{
    const float distance = (point - cullStack().getViewPointLocal()).length();
    return withLODScale ? distance * _cullStack.getLODScale() : distance;
}

} // namespace osgShadowVolume
