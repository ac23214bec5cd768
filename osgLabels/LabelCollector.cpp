// SPDX-License-Identifier: MIT
#include <osgLabels/LabelCollector.h>

#include <osgLabels/PrimitiveRun.h>

#include <osg/NodeVisitor>
#include <osg/Transform>

#include <algorithm>

namespace osgLabels
{

namespace
{

/// Instances of one Drawable that are told apart; subgraphs that share nodes on many levels have
/// more paths than memory.
constexpr std::size_t mostInstances = std::size_t(1) << 20;

/// Relative error of a matrix that went to eye coordinates and back, in doubles, with reserve.
constexpr double roundTrip = 1e-12;

class DrawableVisitor : public osg::NodeVisitor
{
public:
    explicit DrawableVisitor(std::function<void(osg::Drawable&)> f)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _f(std::move(f))
    {
        setNodeMaskOverride(~0u); // what is hidden now may be shown later
    }
    void apply(osg::Drawable& drawable) override { _f(drawable); }

private:
    const std::function<void(osg::Drawable&)> _f;
};

template <typename Vector, typename Index>
std::size_t placeIn(Vector& all, std::vector<Index>& free)
{
    if (free.empty())
    {
        all.emplace_back();
        return all.size() - 1;
    }
    const std::size_t place = free.back();
    free.pop_back();
    return place;
}

} // namespace

LabelCollector::LabelCollector(std::shared_ptr<LabelTable> table,
                               std::shared_ptr<const LabelSource> source, Encode encode,
                               std::shared_ptr<Shared> shared, StyleOf styleOf)
    : LabelCollector(
          std::move(table),
          [source = std::move(source)](const osg::NodePath& path) { return source->find(path); },
          std::move(encode), std::move(shared), std::move(styleOf))
{
}

LabelCollector::LabelCollector(std::shared_ptr<LabelTable> table, Find find, Encode encode,
                               std::shared_ptr<Shared> shared, StyleOf styleOf)
    : _table(std::move(table)), _find(std::move(find)), _encode(std::move(encode)),
      _styleOf(std::move(styleOf)), _shared(std::move(shared)), _instances(1), _objects(1),
      _labels(1)
{
}

LabelCollector::~LabelCollector() = default;

void LabelCollector::collect(const osg::Group& group)
{
    std::lock_guard<std::mutex> lock(_mutex);
    DrawableVisitor visitor(
        [&](osg::Drawable& drawable)
        {
            if (!dynamic_cast<const PrimitiveRun*>(&drawable)) // its objects are a batch's
                entryOf(group, drawable);
        });
    const_cast<osg::Group&>(group).accept(visitor);
}

LabelCollector::View::View(LabelCollector& collector, const osg::Group& group,
                           const osg::Matrixd& groupToEye)
    : _collector(collector), _lock(collector._mutex), _group(group), _groupToEye(groupToEye),
      _number(++collector._views)
{
}

std::uint32_t LabelCollector::View::find(const osg::Drawable& drawable,
                                         const osg::Matrixd& localToEye)
{
    const Entry& entry = _collector._entries[_collector.entryOf(_group, drawable)];
    if (!entry.instances)
        return entry.object;
    if (!_isInverted)
        _eyeToGroup.invert(_groupToEye);
    _isInverted = true;
    Instances& instances = *_collector._instances[entry.instances];
    const osg::Matrixd localToGroup = localToEye * _eyeToGroup;
    const double rounding =
        roundTrip * (localToEye.getTrans().length() + _groupToEye.getTrans().length() +
                     localToGroup.getTrans().length());
    std::size_t path = instances.finder.find(localToGroup, rounding);
    if (path == InstanceFinder::None && instances.view != _number)
    {
        const auto paths = pathsFrom(_group, drawable, mostInstances);
        if (paths.size() == instances.objects.size())
            instances.finder = InstanceFinder(drawable.getBoundingBox(), paths);
        instances.view = _number;
        path = instances.finder.find(localToGroup, rounding);
    }
    if (path == InstanceFinder::None)
        path = instances.finder.findNearest(localToGroup);
    return path == InstanceFinder::None ? 0 : instances.objects[path];
}

std::size_t LabelCollector::entryOf(const osg::Group& group, const osg::Drawable& drawable)
{
    const auto found = _byDrawable.find(&drawable);
    return found != _byDrawable.end() ? found->second : add(group, drawable);
}

std::size_t LabelCollector::add(const osg::Group& group, const osg::Drawable& drawable)
{
    const auto paths = pathsFrom(group, drawable, mostInstances);
    const std::size_t index = placeIn(_entries, _freeEntries);
    Entry entry;
    entry.drawable = &drawable;
    entry.parents = drawable.getNumParents();
    for (const osg::NodePath& path : paths)
        entry.paths += hashOf(path, path.size());
    if (paths.size() == 1)
        entry.object = addObject(drawable, paths.front());
    else if (!paths.empty())
    {
        auto instances = std::make_unique<Instances>();
        instances->finder = InstanceFinder(drawable.getBoundingBox(), paths);
        for (const osg::NodePath& path : paths)
        {
            instances->objects.push_back(addObject(drawable, path));
            instances->byPath.emplace(hashOf(path, path.size()), instances->objects.back());
        }
        entry.instances = static_cast<std::uint32_t>(placeIn(_instances, _freeInstances));
        _instances[entry.instances] = std::move(instances);
    }
    _entries[index] = entry;
    _byDrawable.emplace(&drawable, index);
    return index;
}

std::uint32_t LabelCollector::addObject(const osg::Drawable& drawable, const osg::NodePath& path)
{
    // The group's own name is not that of an object in it.
    const osg::NodePath below(path.begin() + 1, path.end());
    const auto found = _find(below);
    if (!found)
        return 0;
    const auto object = static_cast<std::uint32_t>(placeIn(_objects, _freeObjects));
    _objects[object].drawable = &drawable;
    _objects[object].identifier = addLabel(*found, path, object);
    _objects[object].scale = _scales.hold(drawable, osg::computeLocalToWorld(below));
    _new.push_back(object);
    return object;
}

std::uint32_t LabelCollector::addLabel(const LabelSource::Found& found, const osg::NodePath& path,
                                       std::uint32_t object)
{
    const std::size_t depth = found.depth + 1; // of the path with the group
    const std::uint64_t key = hashOf(path, depth + 1);
    const std::size_t original = std::hash<std::string>()(found.text);
    std::uint32_t& identifier = _byPath[key];
    // Nodes that died may have lain where others are now.
    if (!identifier || _labels[identifier].original != original)
    {
        identifier = newLabel();
        _labels[identifier] = {found.text, key, original, 0, 0, depth};
        _table->setCodes(identifierOf(identifier), _encode(found.text));
        if (_styleOf && !found.style.empty())
            _table->setStyle(identifierOf(identifier), _styleOf(found.style));
    }
    Label& label = _labels[identifier];
    ++label.objects;
    if (!label.object)
        label.object = object;
    return identifier;
}

std::uint32_t LabelCollector::newLabel()
{
    const bool isNew = _freeLabels.empty();
    const auto label = static_cast<std::uint32_t>(placeIn(_labels, _freeLabels));
    if (isNew)
        _identifiers.add(label, _shared->identifiers.takeNext());
    return label;
}

std::uint32_t LabelCollector::identifierOf(std::uint32_t label) const
{
    return _identifiers.rightOf(label).value_or(0);
}

std::uint32_t LabelCollector::labelOf(std::uint32_t identifier) const
{
    const std::uint32_t label = _identifiers.leftOf(identifier).value_or(0);
    return _labels[label].objects ? label : 0;
}

void LabelCollector::reuse()
{
    _retiredObjects.release(_shared->frames,
                            [this](std::uint32_t object) { _freeObjects.push_back(object); });
    _retiredLabels.release(_shared->frames,
                           [this](std::uint32_t label) { _freeLabels.push_back(label); });
}

void LabelCollector::removeObject(std::uint32_t object)
{
    if (!object)
        return;
    const std::uint32_t identifier = _objects[object].identifier;
    _scales.release(_objects[object].scale);
    _objects[object] = {};
    _retiredObjects.add(object, _shared->frames);
    Label& label = _labels[identifier];
    if (_lost)
        _lost(label.text);
    if (--label.objects)
    {
        if (label.object == object)
            label.object = 0;
        return;
    }
    _table->remove(identifierOf(identifier));
    if (const auto found = _byPath.find(label.key);
        found != _byPath.end() && found->second == identifier)
        _byPath.erase(found);
    label = {};
    _retiredLabels.add(identifier, _shared->frames);
}

void LabelCollector::remove(std::size_t index)
{
    Entry& entry = _entries[index];
    removeObject(entry.object);
    if (entry.instances)
    {
        for (const std::uint32_t object : _instances[entry.instances]->objects)
            removeObject(object);
        _instances[entry.instances].reset();
        _freeInstances.push_back(entry.instances);
    }
    _byDrawable.erase(entry.drawable.get());
    entry = {};
    _freeEntries.push_back(index);
}

bool LabelCollector::isCurrent(const osg::Group& group, const Entry& entry,
                               std::size_t mostPaths) const
{
    if (entry.drawable->getNumParents() != entry.parents)
        return false;
    if (entry.instances && _instances[entry.instances]->objects.size() > mostPaths)
        return true;
    std::uint64_t paths = 0;
    for (const osg::NodePath& path : pathsFrom(group, *entry.drawable, mostInstances))
        paths += hashOf(path, path.size());
    return paths == entry.paths;
}

void LabelCollector::sweep(const osg::Group& group, std::size_t count)
{
    std::lock_guard<std::mutex> lock(_mutex);
    reuse();
    std::size_t cost = 0;
    for (std::size_t seen = 0; cost < count && seen < _entries.size(); ++seen)
    {
        _next = _next + 1 < _entries.size() ? _next + 1 : 0;
        const Entry& entry = _entries[_next];
        if (!entry.drawable)
            continue;
        const std::size_t instances =
            entry.instances ? _instances[entry.instances]->objects.size() : 1;
        cost += instances > count ? 1 : instances;
        if (!isCurrent(group, entry, count))
            remove(_next);
    }
    reuse();
}

void LabelCollector::clear()
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (std::size_t i = 0; i < _entries.size(); ++i)
        if (_entries[i].drawable)
            remove(i);
    _entries.clear();
    _freeEntries.clear();
    _instances.resize(1);
    _freeInstances.clear();
    _new.clear();
    reuse();
}

std::vector<std::uint32_t> LabelCollector::takeNew()
{
    std::lock_guard<std::mutex> lock(_mutex);
    std::vector<std::uint32_t> taken;
    taken.swap(_new);
    return taken;
}

LabelCollector::Object LabelCollector::getObject(std::uint32_t object) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    Object found = object < _objects.size() ? _objects[object] : Object();
    found.identifier = identifierOf(found.identifier);
    return found;
}

std::shared_ptr<const osg::Matrixd> LabelCollector::getScale(const Object& object) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _scales.get(object.scale);
}

std::uint32_t LabelCollector::getObject(const osg::Group& group, const osg::NodePath& path)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const osg::Drawable* drawable = path.empty() ? nullptr : path.back()->asDrawable();
    if (!drawable)
        return 0;
    const Entry& entry = _entries[entryOf(group, *drawable)];
    if (!entry.instances)
        return entry.object;
    const auto& byPath = _instances[entry.instances]->byPath;
    const auto found = byPath.find(hashOf(path, path.size()));
    return found == byPath.end() ? 0 : found->second;
}

std::uint32_t LabelCollector::getObjectCount() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return static_cast<std::uint32_t>(_objects.size());
}

bool LabelCollector::setText(std::uint32_t identifier, const std::string& utf8)
{
    const LabelTable::Codes codes = _encode(utf8);
    std::lock_guard<std::mutex> lock(_mutex);
    const std::uint32_t label = labelOf(identifier);
    if (!label)
        return false;
    _labels[label].text = utf8;
    return _table->setCodes(identifier, codes);
}

bool LabelCollector::setStyle(std::uint32_t identifier, std::uint32_t style)
{
    std::lock_guard<std::mutex> lock(_mutex);
    return labelOf(identifier) != 0 && _table->setStyle(identifier, style);
}

std::string LabelCollector::getText(std::uint32_t identifier) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _labels[labelOf(identifier)].text;
}

osg::NodePath LabelCollector::getNodePath(const osg::Group& group, std::uint32_t identifier) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    const std::uint32_t index = labelOf(identifier);
    if (!index)
        return {};
    const Label& label = _labels[index];
    std::size_t object = label.object;
    if (!object)
        object = static_cast<std::size_t>(std::find_if(_objects.begin(), _objects.end(),
                                                       [&](const Object& o)
                                                       { return o.identifier == index; }) -
                                          _objects.begin());
    for (osg::NodePath& path : pathsFrom(group, *_objects[object].drawable, mostInstances))
        if (path.size() > label.depth && hashOf(path, label.depth + 1) == label.key)
        {
            path.resize(label.depth + 1);
            return path;
        }
    return {};
}

std::vector<std::uint32_t> LabelCollector::getIdentifiers() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    std::vector<std::uint32_t> identifiers;
    for (std::size_t i = 1; i < _labels.size(); ++i)
        if (_labels[i].objects)
            identifiers.push_back(identifierOf(static_cast<std::uint32_t>(i)));
    return identifiers;
}

} // namespace osgLabels
