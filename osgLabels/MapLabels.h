// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/MapLabel.h>

#include <osg/Drawable>
#include <osg/Node>

#include <vector>

namespace osgUtil
{
class CullVisitor;
}

namespace osgLabels
{

/// Labels at points of a scene, which the LabelScene above them draws facing the viewer.
///
/// One node for all labels of a map, or one for each label below what moves; what switches, masks,
/// LODs and Transforms do to it counts. Without a LabelScene above it nothing is drawn. A view
/// shows labels of nodes whose bound it sees: the bound of all anchors, which are points.
class OSGLABELS_EXPORT MapLabels : public osg::Node
{
public:
    MapLabels();
    explicit MapLabels(std::vector<MapLabel> labels);
    MapLabels(const MapLabels& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_Node(osgLabels, MapLabels)

    /// Exchanges all labels; in the update traversal. The next frame shows them.
    void setLabels(std::vector<MapLabel> labels);
    const std::vector<MapLabel>& getLabels() const { return _labels; }

    /// Grows with each change.
    unsigned int getModifiedCount() const { return _modifiedCount; }

    /// In a cull traversal, as if the node were met: draws its labels, and any others of the scene.
    void leaveMark(osgUtil::CullVisitor& visitor) const;

    void traverse(osg::NodeVisitor& visitor) override;
    osg::BoundingSphere computeBound() const override;

    /// What a cull traversal leaves in the render bins for a node of labels; draws nothing itself.
    class Mark;

protected:
    ~MapLabels() override;

private:
    std::vector<MapLabel> _labels;
    unsigned int _modifiedCount = 0;
    osg::ref_ptr<Mark> _mark;
};

class MapLabels::Mark : public osg::Drawable
{
public:
    explicit Mark(const MapLabels& labels) : _labels(&labels) {}
    /// While the node lives, such as in cull.
    const MapLabels& getLabels() const { return *_labels; }
    osg::BoundingBox computeBoundingBox() const override { return {}; }
    void drawImplementation(osg::RenderInfo&) const override {}

protected:
    ~Mark() override = default;

private:
    const MapLabels* _labels;
};

} // namespace osgLabels
