// SPDX-License-Identifier: MIT
#include <osgLabels/MapFeatures.h>

#include <osg/ComputeBoundsVisitor>
#include <osg/Geometry>
#include <osg/Notify>
#include <osg/Transform>
#include <osg/ValueObject>

#include <cmath>
#include <unordered_map>

namespace osgLabels
{

namespace
{

const char* const labelValue = "label";

/// Vertices of a mesh that may be looked at in any frame.
constexpr unsigned int smallMesh = 4096;

bool hasLabel(const osg::Node& node, std::string& text)
{
    return node.getUserDataContainer() && node.getUserValue(labelValue, text) && !text.empty();
}

bool isAlive(const osg::ObserverNodePath& path)
{
    osg::RefNodePath nodes;
    return path.getRefNodePath(nodes);
}

/// In the coordinates of `node`: the middle of the upper side of its box in those of the path's
/// first node.
osg::Vec3d topOf(const osg::NodePath& path)
{
    osg::NodePath above(path.begin(), path.end() - 1);
    osg::ComputeBoundsVisitor bounds(osg::NodeVisitor::TRAVERSE_ALL_CHILDREN);
    osg::Matrix aboveToTop = osg::computeLocalToWorld(above);
    bounds.pushMatrix(aboveToTop);
    path.back()->accept(bounds);
    const osg::BoundingBox& box = bounds.getBoundingBox();
    if (!box.valid())
        return {};
    const osg::Vec3d top(0.5 * (double(box.xMin()) + box.xMax()),
                         0.5 * (double(box.yMin()) + box.yMax()), box.zMax());
    return top * osg::Matrixd::inverse(osg::computeLocalToWorld(path));
}

} // namespace

MapFeatures::MapFeatures(MapClasses classes, FoundValued found)
    : _classes(std::move(classes)), _found(std::move(found)), _objects(1),
      _collector(
          std::make_shared<LabelTable>(),
          [this](const osg::NodePath& path) { return kindOf(path); },
          [](const std::string&) { return LabelTable::Codes(); })
{
    _collector.setLost([this](const std::string& text)
                       { loseKind(std::uint32_t(std::stoul(text))); });
}

void MapFeatures::collect(const osg::Group& group)
{
    _collector.collect(group);
    takeNew();
}

/// The innermost part that a path lies in; new ones are made.
FeatureTree::Part MapFeatures::partOf(const osg::NodePath& path)
{
    FeatureTree::Part part = FeatureTree::Scene;
    std::string text;
    for (std::size_t depth = 0; depth < path.size(); ++depth)
    {
        const osg::Node& node = *path[depth];
        const bool isNamed = LabelSource::hasName(node);
        const bool isValued = _found && hasLabel(node, text);
        if (!isNamed && !isValued)
            continue;
        part = _tree.add(part, hashOf(path, depth + 1), isNamed ? node.getName() : std::string());
        if (!isValued)
            continue;
        // A part may be that of nodes that have died, where these have come to lie.
        if (const auto known = _valued.find(part);
            known == _valued.end() || !isAlive(known->second))
            addValued(path, depth, part);
    }
    return part;
}

void MapFeatures::addValued(const osg::NodePath& path, std::size_t depth, FeatureTree::Part part)
{
    const osg::NodePath upTo(path.begin(), path.begin() + std::ptrdiff_t(depth) + 1);
    Valued valued;
    const osg::Node& node = *upTo.back();
    node.getUserValue(labelValue, valued.label.text);
    double priority = 0.0;
    float single = 0.0f;
    int whole = 0;
    if (node.getUserValue("labelPriority", priority))
        valued.label.priority = priority;
    else if (node.getUserValue("labelPriority", single))
        valued.label.priority = single;
    else if (node.getUserValue("labelPriority", whole))
        valued.label.priority = whole;
    if (!std::isfinite(valued.label.priority))
    {
        OSG_WARN << "osgLabels::LabelScene: labelPriority of node '" << node.getName()
                 << "' is no finite number; it counts as 0" << std::endl;
        valued.label.priority = 0.0;
    }
    node.getUserValue("labelStyle", valued.label.style);
    valued.label.anchor = topOf(upTo);
    valued.path.setNodePath(upTo);
    valued.part = part;
    _valued[part] = valued.path;
    _tree.addLabel(part);
    _found(std::move(valued));
}

/// Each Drawable on each path has an identifier of its own, whose text is the number of its kind.
std::optional<LabelSource::Found> MapFeatures::kindOf(const osg::NodePath& path)
{
    if (path.empty())
        return std::nullopt;
    std::lock_guard<std::mutex> lock(_mutex);
    const Kind kind{partOf(path), _classes.actionOf(path)};
    const auto [found, isNew] = _kindNumbers.emplace(kind, 0u);
    if (isNew)
    {
        if (_freeKinds.empty())
        {
            _freeKinds.push_back(std::uint32_t(_kinds.size()));
            _kinds.emplace_back();
        }
        found->second = _freeKinds.back();
        _freeKinds.pop_back();
        _kinds[found->second] = {kind, 0};
        _tree.hold(kind.part);
    }
    ++_kinds[found->second].objects;
    return LabelSource::Found{std::to_string(found->second), path.size() - 1, {}};
}

/// An object of a kind is gone.
void MapFeatures::loseKind(std::uint32_t number)
{
    std::lock_guard<std::mutex> lock(_mutex);
    CountedKind& kind = _kinds[number];
    if (--kind.objects)
        return;
    _kindNumbers.erase(kind);
    _tree.release(kind.part);
    kind = {};
    _freeKinds.push_back(number);
}

void MapFeatures::takeNew()
{
    // Who finds a number in the collector waits until what it is of has been written.
    std::lock_guard<std::mutex> taking(_takeMutex);
    std::unordered_map<const osg::Drawable*, MeshSides> sides; // instances share theirs
    for (const std::uint32_t object : _collector.takeNew())
    {
        const LabelCollector::Object found = _collector.getObject(object);
        if (!found.drawable)
            continue;
        auto known = sides.find(found.drawable.get());
        if (known == sides.end())
            known = sides.emplace(found.drawable.get(), sidesOf(*found.drawable)).first;
        const std::string kind = _collector.getText(found.identifier);
        std::lock_guard<std::mutex> lock(_mutex);
        if (object >= _objects.size())
            _objects.resize(object + 1);
        const std::uint64_t stamp = stampOf(*found.drawable);
        _objects[object] = {std::uint32_t(std::stoul(kind)), known->second, stamp, stamp};
    }
}

/// Meshes that have changed: small ones at once, others when they have come to rest, so that one
/// that is bent in each frame does not cost a look at all its edges.
void MapFeatures::judgeAgain(std::uint32_t object, const osg::Drawable& drawable)
{
    if (object == 0 || object >= _objects.size())
        return;
    Object& known = _objects[object];
    const std::uint64_t stamp = stampOf(drawable);
    const bool rests = stamp == known.last;
    known.last = stamp;
    if (stamp == known.judged)
        return;
    const osg::Array* vertices = drawable.asGeometry()->getVertexArray();
    if (!rests && vertices && vertices->getNumElements() > smallMesh)
        return;
    known.sides = sidesOf(drawable);
    known.judged = stamp;
}

MapFeatures::Occluder MapFeatures::occluderOf(std::uint32_t object)
{
    if (object == 0 || object >= _objects.size())
        return {};
    const Kind& kind = _kinds[_objects[object].kind];
    return {_tree.getNumber(kind.part), kind.action, _objects[object].sides};
}

std::vector<MapFeatures::Occluder> MapFeatures::find(const osg::Group& group,
                                                     const osg::Matrixd& groupToEye,
                                                     const std::vector<Drawn>& drawn)
{
    std::vector<std::uint32_t> objects;
    objects.reserve(drawn.size());
    {
        LabelCollector::View view(_collector, group, groupToEye);
        for (const Drawn& each : drawn)
            objects.push_back(view.find(*each.drawable, each.localToEye));
    }
    takeNew();
    std::vector<Occluder> found;
    found.reserve(drawn.size());
    std::lock_guard<std::mutex> lock(_mutex);
    for (std::size_t i = 0; i < drawn.size(); ++i)
    {
        judgeAgain(objects[i], *drawn[i].drawable);
        found.push_back(occluderOf(objects[i]));
    }
    return found;
}

MapFeatures::Occluder MapFeatures::find(const osg::Group& group, const osg::NodePath& path)
{
    const std::uint32_t object = _collector.getObject(group, path);
    takeNew();
    std::lock_guard<std::mutex> lock(_mutex);
    return occluderOf(object);
}

MapFeatures::Occluder MapFeatures::findPart(const osg::NodePath& path, std::uint64_t number,
                                            const std::string& name, Held& held)
{
    std::lock_guard<std::mutex> lock(_mutex);
    FeatureTree::Part part = partOf(path);
    if (_tree.isUsed(name)) // of millions of others nothing needs to be known
        part =
            _tree.add(part, hashOf(path, path.size()) ^ (number + 1) * 0x9E3779B97F4A7C15u, name);
    if (held.empty() || held.back() != part)
    {
        _tree.hold(part);
        held.push_back(part);
    }
    const std::optional<MapAction> action = _classes.find(name);
    return {_tree.getNumber(part), action ? action : _classes.actionOf(path), MeshSides::Outward};
}

FeatureTree::Name MapFeatures::use(const std::string& feature)
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _tree.use(feature);
}

void MapFeatures::release(const Held& held)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (const FeatureTree::Part part : held)
        _tree.release(part);
}

void MapFeatures::unuse(FeatureTree::Name name)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _tree.unuse(name);
}

void MapFeatures::forget(FeatureTree::Part part)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (const auto known = _valued.find(part); known != _valued.end() && !isAlive(known->second))
        _valued.erase(known);
    _tree.removeLabel(part);
}

std::size_t MapFeatures::getPartCount()
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _tree.getPartCount();
}

FeatureTree::Range MapFeatures::getRange(FeatureTree::Name name)
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _tree.getRange(name);
}

FeatureTree::Range MapFeatures::getRangeOfPart(FeatureTree::Part part)
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _tree.getRangeOfPart(part);
}

std::shared_ptr<const FeatureTree::Nesting> MapFeatures::getNesting()
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _tree.getNesting();
}

unsigned int MapFeatures::getModifiedCount()
{
    std::lock_guard<std::mutex> lock(_mutex);
    _tree.getNumber(FeatureTree::Scene);
    return _tree.getModifiedCount();
}

} // namespace osgLabels
