// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/FramesInFlight.h>
#include <osgLabels/InstanceFinder.h>
#include <osgLabels/LabelSource.h>
#include <osgLabels/LabelTable.h>
#include <osgLabels/NumberSpace.h>
#include <osgLabels/Stretches.h>
#include <osgLabels/UnevenScale.h>

#include <osg/Drawable>
#include <osg/Group>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace osgLabels
{

/// Which objects a group's subgraph has, and which label each carries.
///
/// An object is a Drawable on one path from the group: one that hangs under several parents is
/// several objects. Objects are numbered from 1, labels have identifiers from 1; both without gaps
/// as long as nothing goes away, and free numbers are given again when no frame in flight can show
/// what they were. All Drawables whose text comes
/// from the same node share its label. Nothing is written into the subgraph.
///
/// Objects are found by collect() or when they are first in view, so what PagedLODs load later
/// needs no attention. What dies, moves to other parents or gets more of them is noticed by
/// sweep(). Not noticed is what changes the text: names, descriptions, user values; call clear()
/// then.
///
/// Functions may be called from any thread; those that take the group only while nobody changes its
/// subgraph, such as in cull.
class OSGLABELS_EXPORT LabelCollector
{
public:
    using Encode = std::function<LabelTable::Codes(const std::string& utf8)>;
    using StyleOf = std::function<std::uint32_t(const std::string& name)>;
    /// The text of the last node of a path below the group; none where it has no label.
    using Find = std::function<std::optional<LabelSource::Found>(const osg::NodePath& path)>;

    /// What several share that number things for the same table.
    struct Shared
    {
        NumberSpace identifiers;
        FramesInFlight frames;
    };

    /// Texts become codes by `encode` and names of styles numbers by `styleOf`, which are called
    /// under the collector's lock; without the latter no label has a style of its own.
    LabelCollector(std::shared_ptr<LabelTable> table, std::shared_ptr<const LabelSource> source,
                   Encode encode, std::shared_ptr<Shared> shared = std::make_shared<Shared>(),
                   StyleOf styleOf = {});
    /// `find` is called under the collector's lock.
    LabelCollector(std::shared_ptr<LabelTable> table, Find find, Encode encode,
                   std::shared_ptr<Shared> shared = std::make_shared<Shared>(),
                   StyleOf styleOf = {});
    ~LabelCollector();
    /// Before anything is collected: for each object that goes, the text that its path had, under
    /// the collector's lock.
    void setLost(std::function<void(const std::string& text)> lost) { _lost = std::move(lost); }
    LabelCollector(const LabelCollector&) = delete;
    LabelCollector& operator=(const LabelCollector&) = delete;

    struct Object
    {
        osg::ref_ptr<const osg::Drawable> drawable; ///< Null for a number that is free.
        std::uint32_t identifier = 0;               ///< Of its label.
        std::uint32_t scale = 0;                    ///< Of UnevenScales, as it was found.
    };

    /// Finds all objects of the subgraph, in the order of a traversal of all children.
    void collect(const osg::Group& group);

    /// The objects of one view of a frame, locked while it lives.
    class OSGLABELS_EXPORT View
    {
    public:
        View(LabelCollector& collector, const osg::Group& group, const osg::Matrixd& groupToEye);
        /// The number of the object that is this Drawable under this matrix; 0 for no label. Takes
        /// constant time, but for Drawables with several parents whose Transforms move: their
        /// instances are counted through once a view. Below an AutoTransform or an absolute one
        /// the nearest instance is taken.
        std::uint32_t find(const osg::Drawable& drawable, const osg::Matrixd& localToEye);
        /// What scales an object unevenly; null for none.
        std::shared_ptr<const osg::Matrixd> scaleOf(std::uint32_t object) const
        {
            return _collector._scales.get(_collector._objects[object].scale);
        }

    private:
        LabelCollector& _collector;
        std::unique_lock<std::mutex> _lock;
        const osg::Group& _group;
        const osg::Matrixd _groupToEye;
        osg::Matrixd _eyeToGroup;
        bool _isInverted = false;
        std::size_t _number; ///< Of the view.
    };

    /// Looks at the next `count` Drawables whether they are as they were; to be called each frame.
    /// Of those with more instances than `count` only the number of parents is looked at.
    void sweep(const osg::Group& group, std::size_t count);
    /// Forgets all.
    void clear();

    /// The objects that are new since the last call; their numbers may have been others' before.
    std::vector<std::uint32_t> takeNew();
    Object getObject(std::uint32_t object) const;
    /// What scales it unevenly; null for none, and for an object that is gone.
    std::shared_ptr<const osg::Matrixd> getScale(const Object& object) const;
    /// The object that a path from the group to a Drawable is; 0 for no label.
    std::uint32_t getObject(const osg::Group& group, const osg::NodePath& path);
    std::uint32_t getObjectCount() const; ///< All numbers are under it, the free ones too.

    /// Gives a label another text, until the last of its objects is gone. False for an identifier
    /// without objects.
    bool setText(std::uint32_t identifier, const std::string& utf8);
    /// Likewise; a number for LabelTable::setStyle().
    bool setStyle(std::uint32_t identifier, std::uint32_t style);
    /// Empty for an identifier without objects.
    std::string getText(std::uint32_t identifier) const;
    /// The way from the group to the node that gives an identifier its label; empty if it is gone.
    osg::NodePath getNodePath(const osg::Group& group, std::uint32_t identifier) const;
    std::vector<std::uint32_t> getIdentifiers() const;

private:
    /// What is known of a Drawable.
    struct Entry
    {
        osg::ref_ptr<const osg::Drawable> drawable;
        std::uint64_t paths = 0;     ///< Sum of the hashes of its paths.
        std::uint32_t object = 0;    ///< Of its only path.
        std::uint32_t instances = 0; ///< Index in _instances, 0 for none.
        std::uint32_t parents = 0;   ///< Of the Drawable.
    };
    struct Instances
    {
        InstanceFinder finder;
        std::vector<std::uint32_t> objects; ///< One a path.
        /// Hash of a path → its object.
        std::unordered_map<std::uint64_t, std::uint32_t> byPath;
        std::size_t view = 0; ///< In which the finder was made.
    };
    struct Label
    {
        std::string text;
        std::uint64_t key = 0;    ///< Hash of the path to the node that gives it.
        std::size_t original = 0; ///< Hash of the text that the node gives.
        std::uint32_t objects = 0;
        std::uint32_t object = 0; ///< One of them.
        std::size_t depth = 0;    ///< Of the node on that object's path.
    };

    std::size_t entryOf(const osg::Group& group, const osg::Drawable& drawable);
    std::size_t add(const osg::Group& group, const osg::Drawable& drawable);
    std::uint32_t addObject(const osg::Drawable& drawable, const osg::NodePath& path);
    std::uint32_t addLabel(const LabelSource::Found& found, const osg::NodePath& path,
                           std::uint32_t object);
    void remove(std::size_t entry);
    void removeObject(std::uint32_t object);
    void reuse();
    std::uint32_t newLabel();
    /// Of a label; 0 for none.
    std::uint32_t identifierOf(std::uint32_t label) const;
    /// Of an identifier; 0 for one without objects.
    std::uint32_t labelOf(std::uint32_t identifier) const;
    bool isCurrent(const osg::Group& group, const Entry& entry, std::size_t mostPaths) const;

    const std::shared_ptr<LabelTable> _table;
    const Find _find;
    const Encode _encode;
    const StyleOf _styleOf;
    const std::shared_ptr<Shared> _shared;
    std::function<void(const std::string& text)> _lost;

    mutable std::mutex _mutex;
    std::unordered_map<const osg::Drawable*, std::size_t> _byDrawable;
    std::vector<Entry> _entries;
    std::vector<std::size_t> _freeEntries;
    std::vector<std::unique_ptr<Instances>> _instances; ///< 0 is none.
    std::vector<std::uint32_t> _freeInstances;
    UnevenScales _scales;
    std::vector<Object> _objects; ///< 0 is none. Their identifiers are indices in _labels.
    std::vector<std::uint32_t> _freeObjects, _new;
    Retired<std::uint32_t> _retiredObjects, _retiredLabels;
    std::vector<Label> _labels; ///< 0 is none.
    std::vector<std::uint32_t> _freeLabels;
    Stretches _identifiers; ///< Of labels.
    std::unordered_map<std::uint64_t, std::uint32_t> _byPath;
    std::size_t _next = 0; ///< Entry that the next sweep() begins with.
    std::size_t _views = 0;
};

} // namespace osgLabels
