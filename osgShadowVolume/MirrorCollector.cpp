// SPDX-License-Identifier: MIT
#include <osgShadowVolume/MirrorCollector.h>

#include <osg/Transform>
#include <osgUtil/CullVisitor>

namespace osgShadowVolume
{

MirrorCollector::MirrorCollector(osgUtil::CullVisitor& view)
    : osg::NodeVisitor(NODE_VISITOR, TRAVERSE_ACTIVE_CHILDREN), _view(*view.getModelViewMatrix()),
      _viewPathSize(view.getNodePath().size()), _lodScale(view.getLODScale())
{
    setTraversalMask(view.getTraversalMask());
    setNodeMaskOverride(view.getNodeMaskOverride());
    setTraversalNumber(view.getTraversalNumber());
    setFrameStamp(const_cast<osg::FrameStamp*>(view.getFrameStamp()));
    getNodePath() = view.getNodePath();
}

void MirrorCollector::collect(osg::Node& node)
{
    enter(node);
    node.traverse(*this);
}

void MirrorCollector::enter(const osg::Node& node)
{
    if (const auto mark = mirrorMarkOf(node))
        _current = {*mark, node.getName()};
    else if (_current.mark.byMaterial && hasMaterial(node))
        _current = {};
}

void MirrorCollector::apply(osg::Node& node)
{
    const Named outer = _current;
    enter(node);
    traverse(node);
    _current = outer;
}

void MirrorCollector::apply(osg::Drawable& drawable)
{
    const Named outer = _current;
    enter(drawable);
    if (_current.mark.reflectivity > 0.0)
        _mirrors.push_back({&drawable, getModelview(), _current.mark.reflectivity, _current.name});
    _current = outer;
}

osg::Matrixd MirrorCollector::getModelview() const
{
    osg::Matrixd matrix = _view;
    for (std::size_t i = _viewPathSize; i < getNodePath().size(); ++i)
        if (const osg::Transform* transform = getNodePath()[i]->asTransform())
            transform->computeLocalToWorldMatrix(matrix, const_cast<MirrorCollector*>(this));
    return matrix;
}

float MirrorCollector::getDistanceToViewPoint(const osg::Vec3& point, bool withLODScale) const
{
    const float distance = float((osg::Vec3d(point) * getModelview()).length());
    return withLODScale ? distance * _lodScale : distance;
}

float MirrorCollector::getDistanceToEyePoint(const osg::Vec3& point, bool withLODScale) const
{
    return getDistanceToViewPoint(point, withLODScale);
}

} // namespace osgShadowVolume
