// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/BoundTextures.h>
#include <osgPagedTexture/NeedCollector.h>

#include <osg/NodeVisitor>

#include <utility>
#include <vector>

namespace osgPagedTexture
{

/// What an eye elsewhere would need of a pager's textures: goes through a graph as culling would,
/// with levels of detail, without asking for files of them.
class SoonCollector : public osg::NodeVisitor
{
public:
    /// `toEye`: from the graph to that eye; `view` is what it sees with, its matrix void, through
    /// `projection`.
    SoonCollector(const Pager& pager, SurfaceCache& cache, const TexelView& view,
                  const osg::Matrixd& projection, const osg::Matrixd& toEye);

    /// One for each drawable.
    std::vector<PagedDemand> takeDemands() { return std::move(_demands); }

    void apply(osg::Node& node) override;
    void apply(osg::Drawable& drawable) override;
    void apply(osg::Transform& transform) override;
    void apply(osg::Camera& camera) override;
    float getDistanceToViewPoint(const osg::Vec3& place, bool scaled) const override;
    float getDistanceToEyePoint(const osg::Vec3& place, bool scaled) const override;
    osg::Vec3 getEyePoint() const override;

private:
    bool isInView(const osg::BoundingSphere& bound) const;

    const Pager& _pager;
    SurfaceCache& _cache;
    TexelView _view;
    osg::Vec4d _sides[4]; ///< Planes in coordinates of the eye, inside is above 0.
    std::vector<osg::Matrixd> _toEye;
    std::vector<BoundTextures> _bound;
    std::vector<PagedDemand> _demands;
};

} // namespace osgPagedTexture
