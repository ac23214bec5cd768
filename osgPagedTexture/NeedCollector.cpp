// SPDX-License-Identifier: MIT
#include <osgPagedTexture/NeedCollector.h>

#include <osgPagedTexture/BoundTextures.h>
#include <osgPagedTexture/SurfaceOf.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

namespace
{

unsigned int modifiedCount(const osg::Drawable& drawable)
{
    const osg::Geometry* geometry = drawable.asGeometry();
    const osg::Array* vertices = geometry ? geometry->getVertexArray() : nullptr;
    return vertices ? vertices->getModifiedCount() : 0;
}

class Collection
{
public:
    Collection(const osgUtil::CullVisitor& visitor, const Pager& pager, SurfaceCache& cache,
               const osg::Vec3d& moved)
        : _viewport(const_cast<osgUtil::CullVisitor&>(visitor).getViewport()), _pager(pager),
          _cache(cache), _moved(moved.x(), moved.y(), moved.z())
    {
    }

    void collect(const osgUtil::StateGraph& graph, const BoundTextures& above)
    {
        const osg::StateSet* stateSet = graph.getStateSet();
        const bool isBinding = stateSet && BoundTextures::areIn(*stateSet);
        BoundTextures own;
        if (isBinding)
        {
            own = above;
            own.take(*stateSet, _pager);
        }
        const BoundTextures& bound = isBinding ? own : above;
        if (!bound.get().empty())
            for (const osg::ref_ptr<osgUtil::RenderLeaf>& leaf : graph._leaves)
                demand(*leaf, bound);
        for (const auto& child : graph._children)
            if (!child.second->empty())
                collect(*child.second, bound);
    }

    std::vector<PagedDemand> takeDemands() { return std::move(_demands); }

private:
    void demand(const osgUtil::RenderLeaf& leaf, const BoundTextures& bound)
    {
        const osg::Drawable* drawable = leaf.getDrawable();
        if (!drawable || !leaf._modelview || !leaf._projection)
            return;
        TexelView now = viewThrough(osg::Matrixd(*leaf._projection), _viewport);
        now.toEye = glm::make_mat4(osg::Matrixd(*leaf._modelview).ptr());
        TexelView soon = now;
        soon.moved = _moved;
        const bool moves = _moved != glm::dvec3(0.0);
        for (const BoundTexture& each : bound.get())
        {
            // What is in view has at least a share of a pixel.
            const double pixels = std::max(bound.pixels(each, *drawable, now, _cache), 1e-12);
            _demands.push_back(
                {each.texture, pixels, moves ? bound.pixels(each, *drawable, soon, _cache) : 0.0});
        }
    }

    const osg::Viewport* const _viewport;
    const Pager& _pager;
    SurfaceCache& _cache;
    const glm::dvec3 _moved;
    std::vector<PagedDemand> _demands; ///< One for each leaf: the pager takes the most.
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

TexelView viewThrough(const osg::Matrixd& projection, const osg::Viewport* viewport)
{
    TexelView view;
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

TexelSurface SurfaceCache::get(const osg::Drawable& drawable, unsigned int unit)
{
    const unsigned int modified = modifiedCount(drawable);
    {
        std::lock_guard<std::mutex> lock(_mutex);
        const auto found = _known.find(&drawable);
        if (found != _known.end() && unit < found->second.size() &&
            found->second[unit].drawable.valid() && found->second[unit].modified == modified)
            return found->second[unit].surface;
    }
    const TexelSurface surface = surfaceOf(drawable, unit);
    std::lock_guard<std::mutex> lock(_mutex);
    std::vector<Known>& units = _known[&drawable];
    units.resize(std::max(units.size(), std::size_t(unit) + 1));
    units[unit] = {&drawable, modified, surface};
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
