// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pager.h>

#include <osg/Drawable>
#include <osg/Viewport>
#include <osg/observer_ptr>
#include <osgUtil/CullVisitor>

#include <array>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace osgPagedTexture
{

/// How the drawables of a scene lie under their textures, found once for each. Any thread.
class SurfaceCache
{
public:
    /// Of a drawable under a texture unit.
    TexelSurface get(const osg::Drawable& drawable, unsigned int unit);

private:
    struct Known
    {
        osg::observer_ptr<const osg::Drawable> drawable; ///< Addresses are given again.
        unsigned int modified = 0;
        TexelSurface surface;
    };
    std::mutex _mutex;
    std::unordered_map<const osg::Drawable*, std::vector<Known>> _known; ///< By unit, too.
};

/// Finds the surfaces in a subgraph and takes them into the cache, so that no frame has to.
void findSurfaces(osg::Node& node, SurfaceCache& cache);

/// What a projection shows in a viewport, from the eye itself.
TexelView viewThrough(const osg::Matrixd& projection, const osg::Viewport* viewport);

/// What the leaves that were culled below a StateGraph need of a pager's textures. `moved` is where
/// the eye will be, in eye coordinates.
std::vector<PagedDemand> collectDemands(const osgUtil::StateGraph& graph,
                                        const osgUtil::CullVisitor& visitor, const Pager& pager,
                                        SurfaceCache& cache, const osg::Vec3d& moved);

} // namespace osgPagedTexture
