// SPDX-License-Identifier: MIT
#include <osgLabels/MapLabels.h>

#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

MapLabels::MapLabels() : _mark(new Mark(*this)) {}

MapLabels::MapLabels(std::vector<MapLabel> labels)
    : _labels(std::move(labels)), _mark(new Mark(*this))
{
}

MapLabels::MapLabels(const MapLabels& other, const osg::CopyOp& copyop)
    : osg::Node(other, copyop), _labels(other._labels), _mark(new Mark(*this))
{
}

MapLabels::~MapLabels() = default;

void MapLabels::setLabels(std::vector<MapLabel> labels)
{
    _labels = std::move(labels);
    ++_modifiedCount;
    dirtyBound();
}

void MapLabels::traverse(osg::NodeVisitor& visitor)
{
    auto* cullVisitor = visitor.asCullVisitor();
    if (visitor.getVisitorType() == osg::NodeVisitor::CULL_VISITOR && cullVisitor &&
        !_labels.empty())
        leaveMark(*cullVisitor);
}

void MapLabels::leaveMark(osgUtil::CullVisitor& visitor) const
{
    visitor.addDrawable(_mark, visitor.getModelViewMatrix());
}

osg::BoundingSphere MapLabels::computeBound() const
{
    osg::BoundingBoxd box;
    for (const MapLabel& label : _labels)
        if (std::isfinite(label.anchor.length2()) && !label.text.empty())
            box.expandBy(label.anchor);
    if (!box.valid())
        return {};
    // A point has a bound of radius 0, which counts as none in OSG's culling.
    const double least = 1e-6 * (1.0 + box.center().length());
    return osg::BoundingSphere(box.center(), std::max(box.radius(), least));
}

} // namespace osgLabels
