// SPDX-License-Identifier: MIT
#include <osgPagedTexture/NeedCollector.h>

#include <osgPagedTexture/PagedSubload.h>
#include <osgPagedTexture/SurfaceOf.h>

#include <osg/TexGen>
#include <osg/TexMat>

#include <glm/gtc/type_ptr.hpp>

#include <cmath>
#include <limits>

namespace osgPagedTexture
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

unsigned int modifiedCount(const osg::Drawable& drawable)
{
    const osg::Geometry* geometry = drawable.asGeometry();
    const osg::Array* vertices = geometry ? geometry->getVertexArray() : nullptr;
    return vertices ? vertices->getModifiedCount() : 0;
}

/// A paged texture that is on at a place of the StateGraph.
struct Bound
{
    unsigned int unit = 0;
    unsigned int texture = 0;
};

/// What the StateSets on the way to a leaf say.
struct Inherited
{
    std::vector<Bound> textures;
    std::map<unsigned int, double> scales; ///< Area that the texture matrix makes of one.
    std::map<unsigned int, bool> generated;
};

class Collection
{
public:
    Collection(const osgUtil::CullVisitor& visitor, const Pager& pager, SurfaceCache& cache,
               const osg::Vec3d& moved)
        : _visitor(visitor), _pager(pager), _cache(cache), _moved(moved.x(), moved.y(), moved.z())
    {
    }

    void collect(const osgUtil::StateGraph& graph, Inherited inherited)
    {
        if (const osg::StateSet* stateSet = graph.getStateSet())
            take(*stateSet, inherited);
        if (!inherited.textures.empty())
            for (const osg::ref_ptr<osgUtil::RenderLeaf>& leaf : graph._leaves)
                demand(*leaf, inherited);
        for (const auto& child : graph._children)
            if (!child.second->empty())
                collect(*child.second, inherited);
    }

    std::vector<PagedDemand> takeDemands()
    {
        std::vector<PagedDemand> demands;
        for (const auto& each : _demands)
            demands.push_back(each.second);
        return demands;
    }

private:
    void take(const osg::StateSet& stateSet, Inherited& inherited) const
    {
        for (unsigned int unit = 0; unit < stateSet.getNumTextureAttributeLists(); ++unit)
        {
            for (const auto& each : stateSet.getTextureAttributeList()[unit])
                if (const osg::StateAttribute* attribute = each.second.first.get())
                    takeAttribute(*attribute, unit, inherited);
        }
        for (unsigned int unit = 0; unit < stateSet.getNumTextureModeLists(); ++unit)
            for (const auto& mode : stateSet.getTextureModeList()[unit])
                if (mode.first >= GL_TEXTURE_GEN_S && mode.first <= GL_TEXTURE_GEN_T)
                    inherited.generated[unit] = mode.second & osg::StateAttribute::ON;
    }

    void takeAttribute(const osg::StateAttribute& attribute, unsigned int unit,
                       Inherited& inherited) const
    {
        if (attribute.getType() == osg::StateAttribute::TEXMAT)
        {
            const osg::Matrix& m = static_cast<const osg::TexMat&>(attribute).getMatrix();
            inherited.scales[unit] = std::abs(m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0));
        }
        if (attribute.getType() != osg::StateAttribute::TEXTURE)
            return;
        auto& textures = inherited.textures;
        textures.erase(std::remove_if(textures.begin(), textures.end(),
                                      [unit](const Bound& bound) { return bound.unit == unit; }),
                       textures.end());
        const auto* flat = dynamic_cast<const osg::Texture2D*>(&attribute);
        const auto* paged =
            flat ? dynamic_cast<const PagedSubload*>(flat->getSubloadCallback()) : nullptr;
        if (paged && paged->getPager() == &_pager)
            textures.push_back({unit, paged->getTexture()});
    }

    void demand(const osgUtil::RenderLeaf& leaf, const Inherited& inherited)
    {
        const osg::Drawable* drawable = leaf.getDrawable();
        if (!drawable || !leaf._modelview || !leaf._projection)
            return;
        const TexelView now = viewOf(leaf);
        TexelView soon = now;
        soon.moved = _moved;
        const bool moves = _moved != glm::dvec3(0.0);
        for (const Bound& bound : inherited.textures)
        {
            const double now_ = pixels(*drawable, bound, inherited, now);
            PagedDemand& sum = _demands[bound.texture];
            sum.texture = bound.texture;
            // What is in view has at least a share of a pixel.
            sum.pixels = std::max({sum.pixels, now_, 1e-12});
            if (moves)
                sum.soonPixels =
                    std::max(sum.soonPixels, pixels(*drawable, bound, inherited, soon));
        }
    }

    double pixels(const osg::Drawable& drawable, const Bound& bound, const Inherited& inherited,
                  const TexelView& view) const
    {
        const auto generated = inherited.generated.find(bound.unit);
        if (generated != inherited.generated.end() && generated->second)
            return Infinity;
        TexelSurface surface = _cache.get(drawable, bound.unit);
        const auto scale = inherited.scales.find(bound.unit);
        if (scale != inherited.scales.end())
            surface.uvDensity *= scale->second;
        return pixelsOfTexture(surface, view);
    }

    TexelView viewOf(const osgUtil::RenderLeaf& leaf) const
    {
        TexelView view;
        view.toEye = glm::make_mat4(osg::Matrixd(*leaf._modelview).ptr());
        const osg::Matrixd projection(*leaf._projection);
        const osg::Viewport* viewport = const_cast<osgUtil::CullVisitor&>(_visitor).getViewport();
        const double width = viewport ? viewport->width() : 1024.0;
        const double height = viewport ? viewport->height() : 1024.0;
        view.pixelsX = 0.5 * width * std::abs(projection(0, 0));
        view.pixelsY = 0.5 * height * std::abs(projection(1, 1));
        view.isParallel = projection(2, 3) == 0.0;
        if (!view.isParallel)
        {
            const double x = (1.0 + std::abs(projection(2, 0))) / std::abs(projection(0, 0));
            const double y = (1.0 + std::abs(projection(2, 1))) / std::abs(projection(1, 1));
            view.corner = std::sqrt(1.0 + x * x + y * y);
        }
        return view;
    }

    const osgUtil::CullVisitor& _visitor;
    const Pager& _pager;
    SurfaceCache& _cache;
    const glm::dvec3 _moved;
    std::unordered_map<unsigned int, PagedDemand> _demands;
};

class SurfaceFinder : public osg::NodeVisitor
{
public:
    explicit SurfaceFinder(SurfaceCache& cache)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _cache(cache)
    {
    }
    void apply(osg::Drawable& drawable) override { _cache.get(drawable, 0); }

private:
    SurfaceCache& _cache;
};

} // namespace

TexelSurface SurfaceCache::get(const osg::Drawable& drawable, unsigned int unit)
{
    const unsigned int modified = modifiedCount(drawable);
    {
        std::lock_guard<std::mutex> lock(_mutex);
        const auto found = _known.find({&drawable, unit});
        if (found != _known.end() && found->second.drawable.valid() &&
            found->second.modified == modified)
            return found->second.surface;
    }
    const TexelSurface surface = surfaceOf(drawable, unit);
    std::lock_guard<std::mutex> lock(_mutex);
    _known[{&drawable, unit}] = {&drawable, modified, surface};
    return surface;
}

void findSurfaces(osg::Node& node, SurfaceCache& cache)
{
    SurfaceFinder finder(cache);
    node.accept(finder);
}

std::vector<PagedDemand> collectDemands(const osgUtil::StateGraph& graph,
                                        const osgUtil::CullVisitor& visitor, const Pager& pager,
                                        SurfaceCache& cache, const osg::Vec3d& moved)
{
    Collection collection(visitor, pager, cache, moved);
    collection.collect(graph, {});
    return collection.takeDemands();
}

} // namespace osgPagedTexture
