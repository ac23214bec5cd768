// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/MirrorNames.h>

#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/NodeVisitor>

#include <string>
#include <vector>

namespace osgUtil
{
class CullVisitor;
}

namespace osgShadowVolume
{

/// A Drawable that says it is a mirror.
struct NamedMirror
{
    const osg::Drawable* drawable = nullptr;
    osg::Matrixd modelview; ///< Local to eye.
    double reflectivity = 0.0;
    std::string name; ///< For messages.
};

/// Finds the mirrors of a subgraph for a view that is being culled, whether in view or not: those
/// of its active children. What is nearest to a Drawable on its path counts; see mirrorMarkOf().
/// Looks at names alone, so that a scene without mirrors takes little time.
class MirrorCollector : public osg::NodeVisitor
{
public:
    explicit MirrorCollector(osgUtil::CullVisitor& view);

    /// Collects what is below `node`, and what the node says itself.
    void collect(osg::Node& node);
    std::vector<NamedMirror>& getMirrors() { return _mirrors; }

    float getDistanceToViewPoint(const osg::Vec3& point, bool withLODScale) const override;
    float getDistanceToEyePoint(const osg::Vec3& point, bool withLODScale) const override;

    void apply(osg::Node& node) override;
    void apply(osg::Drawable& drawable) override;
    void apply(osg::Camera&) override {} // has a picture of its own
    void apply(osg::Projection&) override {}

private:
    struct Named
    {
        MirrorMark mark;
        std::string name;
    };

    void enter(const osg::Node& node);
    osg::Matrixd getModelview() const;

    const osg::Matrixd _view;
    const std::size_t _viewPathSize;
    const float _lodScale;
    Named _current;
    std::vector<NamedMirror> _mirrors;
};

} // namespace osgShadowVolume
