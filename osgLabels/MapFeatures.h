// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/FeatureTree.h>
#include <osgLabels/LabelCollector.h>
#include <osgLabels/MapClasses.h>
#include <osgLabels/MapLabel.h>
#include <osgLabels/MeshSides.h>

#include <osg/ObserverNodePath>

#include <map>
#include <mutex>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace osgLabels
{

/// What stands before map labels: of each Drawable on each path below a group the feature that it
/// is of, what it does to labels, and which of its sides count. Keeps what lives: a part goes with
/// the last Drawable in it, label of it and batch that has it. Thread safe.
class OSGLABELS_EXPORT MapFeatures
{
public:
    /// A label by user values: "label", "labelPriority", "labelStyle" of a node.
    struct Valued
    {
        osg::ObserverNodePath path; ///< To the node that has them, from the group on.
        MapLabel label;             ///< The anchor in the node's own coordinates.
        FeatureTree::Part part = FeatureTree::Scene;
    };
    using FoundValued = std::function<void(Valued)>;

    /// `found` is called once for each node with a label of its own, and again when it has another
    /// way from the group; forget() each. None: user values are not looked at.
    MapFeatures(MapClasses classes, FoundValued found);

    /// All of the subgraph; what comes later is found when it is in view.
    void collect(const osg::Group& group);
    void sweep(const osg::Group& group, std::size_t count) { _collector.sweep(group, count); }

    struct Occluder
    {
        std::uint32_t number = 0;        ///< Of FeatureTree; 0: not below the group.
        std::optional<MapAction> action; ///< Of its class, if it has one.
        MeshSides sides = MeshSides::Open;
    };
    struct Drawn
    {
        const osg::Drawable* drawable = nullptr;
        osg::Matrixd localToEye;
    };
    /// Of what a view draws.
    std::vector<Occluder> find(const osg::Group& group, const osg::Matrixd& groupToEye,
                               const std::vector<Drawn>& drawn);
    /// Of a path from the group to a Drawable.
    Occluder find(const osg::Group& group, const osg::NodePath& path);
    /// Of a part, with a number, of what is at the end of a path, which has a name and no node. The
    /// part is held by `held` until release().
    using Held = std::vector<FeatureTree::Part>;
    Occluder findPart(const osg::NodePath& path, std::uint64_t number, const std::string& name,
                      Held& held);
    void release(const Held& held);

    /// A label has the name of a feature, until unuse().
    FeatureTree::Name use(const std::string& feature);
    void unuse(FeatureTree::Name name);
    /// A label by user values is gone.
    void forget(FeatureTree::Part part);
    FeatureTree::Range getRange(FeatureTree::Name name);
    FeatureTree::Range getRangeOfPart(FeatureTree::Part part);
    std::shared_ptr<const FeatureTree::Nesting> getNesting();
    /// Grows when numbers that were given have changed.
    unsigned int getModifiedCount();
    /// Named parts of the scene that are kept.
    std::size_t getPartCount();

private:
    /// What Drawables on the same path of named nodes have in common.
    struct Kind
    {
        FeatureTree::Part part;
        std::optional<MapAction> action;
        bool operator<(const Kind& other) const
        {
            return std::tie(part, action) < std::tie(other.part, other.action);
        }
    };
    struct CountedKind : Kind
    {
        std::uint32_t objects = 0;
    };
    std::optional<LabelSource::Found> kindOf(const osg::NodePath& path);
    void loseKind(std::uint32_t number);
    FeatureTree::Part partOf(const osg::NodePath& path);
    void addValued(const osg::NodePath& path, std::size_t depth, FeatureTree::Part part);
    void takeNew();
    Occluder occluderOf(std::uint32_t object);
    void judgeAgain(std::uint32_t object, const osg::Drawable& drawable);

    const MapClasses _classes;
    const FoundValued _found;
    std::mutex _takeMutex; ///< Of takeNew(); locked before the collector's.
    std::mutex _mutex;     ///< Of all below, under the collector's.
    FeatureTree _tree;
    std::map<Kind, std::uint32_t> _kindNumbers;
    std::vector<CountedKind> _kinds;
    std::vector<std::uint32_t> _freeKinds;
    struct Object
    {
        std::uint32_t kind = 0;
        MeshSides sides = MeshSides::Open;
        std::uint64_t judged = 0; ///< Stamp of the mesh whose sides these are,
        std::uint64_t last = 0;   ///< and of the mesh in the last frame.
    };
    std::vector<Object> _objects; ///< By the collector's number.
    /// Parts with labels by user values, and the ways to the nodes that gave them.
    std::unordered_map<FeatureTree::Part, osg::ObserverNodePath> _valued;
    LabelCollector _collector;
};

} // namespace osgLabels
