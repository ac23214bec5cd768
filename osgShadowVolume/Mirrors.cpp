// SPDX-License-Identifier: MIT
#include <osgShadowVolume/Mirrors.h>

#include <osgShadowVolume/Shaders.h>
#include <osgShadowVolume/TriangleReader.h>

#include <osg/CullFace>
#include <osg/FrontFace>
#include <osg/Geometry>
#include <osg/Notify>
#include <osgDB/ReadFile>
#include <osgUtil/CullVisitor>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_set>

namespace osgShadowVolume
{

using osgMultiRender::PlanEntry;

namespace
{

std::vector<glm::dvec3> trianglesOf(const osg::Drawable& drawable)
{
    std::vector<glm::dvec3> points;
    readTriangles(drawable,
                  [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
                      points.insert(points.end(), {a, b, c});
                  });
    return points;
}

/// What counts of an attribute or a mode on a leaf's path.
class PathState
{
public:
    explicit PathState(const osgUtil::RenderLeaf& leaf)
    {
        for (const osgUtil::StateGraph* graph = leaf._parent; graph; graph = graph->_parent)
            if (graph->getStateSet())
                _path.push_back(graph->getStateSet());
    }

    bool isOn(GLenum mode) const
    {
        osg::StateAttribute::GLModeValue value = osg::StateAttribute::OFF;
        for (auto it = _path.rbegin(); it != _path.rend(); ++it)
        {
            const auto next = (*it)->getMode(mode);
            if (!(next & osg::StateAttribute::INHERIT) && wins(next, value))
                value = next;
        }
        return (value & osg::StateAttribute::ON) != 0;
    }

    template <class Attribute> const Attribute* get(osg::StateAttribute::Type type) const
    {
        const osg::StateSet::RefAttributePair* result = nullptr;
        for (auto it = _path.rbegin(); it != _path.rend(); ++it)
        {
            const auto* next = (*it)->getAttributePair(type);
            if (next && (!result || wins(next->second, result->second)))
                result = next;
        }
        return result ? static_cast<const Attribute*>(result->first.get()) : nullptr;
    }

private:
    static bool wins(unsigned int next, unsigned int before)
    {
        return !(before & osg::StateAttribute::OVERRIDE) || (next & osg::StateAttribute::PROTECTED);
    }

    std::vector<const osg::StateSet*> _path; ///< From the leaf to the root.
};

bool isCulled(const PathState& state, bool front)
{
    if (!state.isOn(GL_CULL_FACE))
        return false;
    const auto* face = state.get<osg::FrontFace>(osg::StateAttribute::FRONTFACE);
    if (face && face->getMode() == osg::FrontFace::CLOCKWISE)
        front = !front;
    const auto* cull = state.get<osg::CullFace>(osg::StateAttribute::CULLFACE);
    const auto mode = cull ? cull->getMode() : osg::CullFace::BACK;
    return mode == osg::CullFace::FRONT_AND_BACK || (mode == osg::CullFace::FRONT) == front;
}

void forEachLeaf(osgUtil::RenderBin& bin,
                 const std::function<void(osgUtil::StateGraph::LeafList&)>& f)
{
    for (osgUtil::StateGraph* graph : bin.getStateGraphList())
        f(graph->_leaves);
    for (auto& [number, inner] : bin.getRenderBinList())
        forEachLeaf(*inner, f);
}

/// Of the picture that the camera draws into; 0 for none.
int samplesOf(const osg::Camera* camera)
{
    unsigned int samples = 0;
    if (!camera)
        return 0;
    for (const auto& [buffer, attachment] : camera->getBufferAttachmentMap())
        samples = std::max(samples, attachment._multisampleSamples);
    const osg::GraphicsContext* context = camera->getGraphicsContext();
    if (camera->getBufferAttachmentMap().empty() && context && context->getTraits())
        samples = context->getTraits()->samples;
    return int(samples);
}

bool isAllBehind(const osgUtil::RenderLeaf& leaf, const glm::dvec4& plane)
{
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    if (!box.valid() || !leaf._modelview)
        return false;
    for (unsigned int i = 0; i < 8; ++i)
    {
        const osg::Vec3d p = osg::Vec3d(box.corner(i)) * *leaf._modelview;
        // The picture shows what is reflected: what was before the mirror is behind it.
        if (!(plane.x * p.x() + plane.y * p.y() + plane.z * p.z() + plane.w > 0.0))
            return false;
    }
    return true;
}

std::string inQuotes(const std::string& name)
{
    return name.empty() ? "mirror" : "mirror '" + name + "'";
}

std::string inPercent(double share)
{
    return std::to_string(int(std::lround(100.0 * share))) + " %";
}

} // namespace

/// A mirror that shows.
struct Mirrors::Found
{
    NamedMirror mirror;
    const osgUtil::RenderLeaf* leaf = nullptr;
    MirrorShape shape; ///< In eye coordinates.
    glm::dvec4 plane{0.0};
    double share = 0.0; ///< Of the view.
};

std::optional<MirrorShape> MirrorShapes::get(const NamedMirror& mirror, std::string& error)
{
    const osg::Drawable* drawable = mirror.drawable;
    const osg::Geometry* geometry = drawable->asGeometry();
    const unsigned int modified =
        geometry && geometry->getVertexArray() ? geometry->getVertexArray()->getModifiedCount() : 0;
    std::lock_guard<std::mutex> lock(_mutex);
    Known& known = _known[drawable];
    const bool isNew = known.drawable.get() != drawable;
    if (isNew || known.modified != modified || drawable->getDataVariance() == osg::Object::DYNAMIC)
    {
        known.drawable = drawable;
        known.modified = modified;
        known.error.clear();
        known.shape = fitMirror(trianglesOf(*drawable), known.error);
        if (!known.shape && isNew)
        {
            OSG_WARN << "osgShadowVolume::ShadowedScene: " << inQuotes(mirror.name) << " is "
                     << known.error
                     << ", so it reflects nothing; a mirror has to be one flat Drawable"
                     << std::endl;
        }
    }
    error = known.error;
    return known.shape;
}

Mirrors::Mirrors(const ShadowSettings& settings, MirrorResources& resources)
    : _settings(settings), _resources(resources)
{
}

Mirrors::~Mirrors()
{
    drawn();
}

void Mirrors::drop(const std::string& name, const std::string& reason)
{
    _entries.push_back({inQuotes(name), PlanEntry::Decision::Dropped, reason});
}

void Mirrors::cull(osgUtil::CullVisitor& visitor, osg::Group& group)
{
    if (MirrorCamera::isInside(visitor))
    {
        if (auto* camera = dynamic_cast<MirrorCamera*>(visitor.getCurrentCamera()))
            trim(visitor, group, *camera);
        return;
    }
    _frameNumber = visitor.getFrameStamp() ? visitor.getFrameStamp()->getFrameNumber() : 0;
    _resources.pool.evict(_frameNumber);
    if (!visitor.getViewport() || measuresLight(_settings) || _settings.show == Show::MASK)
        return;
    MirrorCollector collector(visitor);
    collector.collect(group);
    if (collector.getMirrors().empty())
        return;
    const std::vector<Found> found = find(visitor, collector.getMirrors());
    std::vector<Plane> planes = join(found);
    const osg::Viewport& viewport = *visitor.getViewport();
    _offset.set(std::floor(viewport.x()) + std::floor(viewport.width()), std::floor(viewport.y()));
    for (std::size_t i = 0; i < planes.size(); ++i)
        if (i < _settings.maxMirrors)
            draw(visitor, group, planes[i], found);
        else
            for (std::size_t member : planes[i].members)
                drop(found[member].mirror.name, "the view has " + std::to_string(planes.size()) +
                                                    " planes of mirrors, the largest " +
                                                    std::to_string(_settings.maxMirrors) +
                                                    " are drawn (maxmirrors)");
}

std::vector<Mirrors::Found> Mirrors::find(osgUtil::CullVisitor& visitor,
                                          std::vector<NamedMirror>& named)
{
    std::unordered_set<const osg::Drawable*> drawables;
    for (const NamedMirror& mirror : named)
        drawables.insert(mirror.drawable);
    std::unordered_multimap<const osg::Drawable*, const osgUtil::RenderLeaf*> seen;
    forEachLeaf(*visitor.getCurrentRenderBin()->getStage(),
                [&](const osgUtil::StateGraph::LeafList& list)
                {
                    for (const auto& leaf : list)
                        if (leaf->_projection == visitor.getProjectionMatrix() &&
                            drawables.count(leaf->_drawable.get()))
                            seen.emplace(leaf->_drawable.get(), leaf.get());
                });
    const glm::dmat4 projection = glm::make_mat4(visitor.getProjectionMatrix()->ptr());
    const glm::dvec4 eye = eyeOf(projection);
    std::vector<Found> result;
    for (NamedMirror& mirror : named)
    {
        std::string error;
        const auto local = _resources.shapes.get(mirror, error);
        if (!local)
        {
            drop(mirror.name, "it is " + error);
            continue;
        }
        Found found;
        found.shape = local->transformed(glm::make_mat4(mirror.modelview.ptr()));
        found.share = shareOfView(found.shape, projection);
        const auto plane = planeTowards(found.shape, eye);
        // A Drawable that is used in several places has a leaf for each.
        const auto [first, last] = seen.equal_range(mirror.drawable);
        const auto leaf = std::find_if(first, last,
                                       [&](const auto& each) {
                                           return each.second->_modelview &&
                                                  *each.second->_modelview == mirror.modelview;
                                       });
        if (isBehind(found.shape, projection))
            drop(mirror.name, "it is behind the viewer");
        else if (!plane)
            drop(mirror.name, "it is seen edge-on");
        else if (!(found.share > 0.0))
            drop(mirror.name, "it is out of view");
        else if (leaf == last)
            drop(mirror.name, "it was culled");
        else
        {
            found.leaf = leaf->second;
            const PathState state(*found.leaf);
            const auto* program = state.get<osg::Program>(osg::StateAttribute::PROGRAM);
            if (isCulled(state, showsFront(found.shape, *plane)))
                drop(mirror.name, "the side that faces the viewer is not drawn (GL_CULL_FACE)");
            else if (program && program->getNumShaders())
                drop(mirror.name, "it has a program of its own");
            else
            {
                found.plane = *plane;
                found.mirror = std::move(mirror);
                result.push_back(std::move(found));
            }
        }
    }
    return result;
}

std::vector<Mirrors::Plane> Mirrors::join(const std::vector<Found>& found) const
{
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        const Found& each = found[i];
        auto plane = std::find_if(planes.begin(), planes.end(),
                                  [&](const Plane& other)
                                  { return liesIn(each.shape, other.equation, other.tolerance); });
        if (plane == planes.end())
            plane = planes.insert(plane, Plane{each.plane, each.shape.tolerance, 0.0, {}, {}});
        plane->share += each.share;
        plane->members.push_back(i);
    }
    std::stable_sort(planes.begin(), planes.end(),
                     [](const Plane& a, const Plane& b) { return a.share > b.share; });
    return planes;
}

void Mirrors::draw(osgUtil::CullVisitor& visitor, osg::Group& group, Plane& plane,
                   const std::vector<Found>& found)
{
    const osg::Camera* view = visitor.getCurrentCamera();
    MirrorLayout layout;
    layout.width = int(visitor.getViewport()->width());
    layout.height = int(visitor.getViewport()->height());
    layout.samples = samplesOf(view);
    osg::ref_ptr<MirrorCamera> camera = _resources.pool.acquire(layout);
    _cameras.push_back(camera);
    const Found& first = found[plane.members.front()];
    camera->setName(inQuotes(first.mirror.name) +
                    (view && !view->getName().empty() ? " in " + view->getName() : ""));
    double tolerance = plane.tolerance;
    for (std::size_t member : plane.members)
    {
        const Found& each = found[member];
        tolerance = std::max(tolerance, each.shape.tolerance);
        _indices.emplace(each.leaf, int(_reflecting.size()));
        _reflecting.push_back({camera->getTexture(), each.mirror.reflectivity});
        if (&each == &first)
            _entries.push_back({inQuotes(each.mirror.name), PlanEntry::Decision::Drawn,
                                "reflects " + inPercent(each.mirror.reflectivity) +
                                    ", its plane has " + inPercent(plane.share) + " of the view"});
        else
            _entries.push_back({inQuotes(each.mirror.name), PlanEntry::Decision::Folded,
                                "reflects " + inPercent(each.mirror.reflectivity) +
                                    ", in the plane of " + inQuotes(first.mirror.name)});
    }
    camera->cull(visitor, group, plane.equation, tolerance);
}

void Mirrors::trim(osgUtil::CullVisitor& visitor, osg::Group& group, const MirrorCamera& camera)
{
    osgUtil::RenderStage& stage = *visitor.getCurrentRenderBin()->getStage();
    // Lights of the subgraph are inherited from the view, like all others.
    auto& positioned = stage.getPositionalStateContainer()->getAttrMatrixList();
    positioned.erase(
        std::remove_if(positioned.begin(), positioned.end(),
                       [](const auto& entry)
                       { return dynamic_cast<const osg::Light*>(entry.first.get()) != nullptr; }),
        positioned.end());
    // The mirror itself, and others in its plane, would cover its picture.
    MirrorCollector collector(visitor);
    collector.collect(group);
    std::unordered_map<const osg::Drawable*, std::vector<osg::Matrixd>> inPlane;
    for (const NamedMirror& mirror : collector.getMirrors())
    {
        std::string error;
        const auto shape = _resources.shapes.get(mirror, error);
        if (shape && liesIn(shape->transformed(glm::make_mat4(mirror.modelview.ptr())),
                            camera.getPlane(), camera.getTolerance()))
            inPlane[mirror.drawable].push_back(mirror.modelview);
    }
    const auto isLeftOut = [&](const osg::ref_ptr<osgUtil::RenderLeaf>& leaf)
    {
        const auto mirror = inPlane.find(leaf->_drawable.get());
        return isAllBehind(*leaf, camera.getPlane()) ||
               (mirror != inPlane.end() && leaf->_modelview &&
                std::find(mirror->second.begin(), mirror->second.end(), *leaf->_modelview) !=
                    mirror->second.end());
    };
    forEachLeaf(stage, [&](osgUtil::StateGraph::LeafList& list)
                { list.erase(std::remove_if(list.begin(), list.end(), isLeftOut), list.end()); });
}

int Mirrors::reflect(const osgUtil::RenderLeaf& leaf, bool blended)
{
    const auto found = _indices.find(&leaf);
    if (found == _indices.end())
        return -1;
    _reflecting[std::size_t(found->second)].blended = blended;
    return found->second;
}

std::string Mirrors::makeSource()
{
    osg::ref_ptr<osg::Shader> shader = osgDB::readRefShaderFileWithFallback(
        osg::Shader::FRAGMENT, "osgShadowVolume/mirror.frag", shaders::mirror_frag);
    return shader->getShaderSource();
}

void Mirrors::apply(osg::State& state, const osg::Program::PerContextProgram& program,
                    int index) const
{
    static const unsigned int mirror = osg::Uniform::getNameID("osgsv_mirror");
    const Reflecting& leaf = _reflecting[std::size_t(index)];
    state.applyTextureAttribute(ReflectionUnit, leaf.texture.get());
    state.get<osg::GLExtensions>()->glUniform4f(
        program.getUniformLocation(mirror), float(_offset.x()), float(_offset.y()),
        float(leaf.reflectivity), leaf.blended ? 1.0f : 0.0f);
}

void Mirrors::drawn()
{
    for (osg::ref_ptr<MirrorCamera>& camera : _cameras)
        _resources.pool.release(std::move(camera), _frameNumber);
    _cameras.clear();
}

void Mirrors::fillPlan(osgMultiRender::Plan& plan) const
{
    if (_entries.empty())
        return;
    plan.entries.insert(plan.entries.end(), _entries.begin(), _entries.end());
    plan.counts["mirrors.passes"] = static_cast<double>(_cameras.size());
    double bytes = 0.0;
    for (const osg::ref_ptr<MirrorCamera>& camera : _cameras)
    {
        const MirrorLayout& layout = camera->getLayout();
        // Colour, and of each sample colour and depth.
        bytes += double(layout.width) * layout.height * (4.0 + 8.0 * std::max(1, layout.samples));
    }
    plan.counts["mirrors.bytes"] = bytes;
}

} // namespace osgShadowVolume
