// SPDX-License-Identifier: MIT
#include <osgLabels/MapScene.h>

#include <osgLabels/MapLabelFile.h>

#include <osg/LOD>
#include <osg/NodeVisitor>
#include <osg/Notify>
#include <osg/Sequence>
#include <osg/Switch>
#include <osg/Transform>
#include <osgDB/FileUtils>
#include <osgDB/fstream>
#include <osgUtil/CullVisitor>

#include <algorithm>

namespace osgLabels
{

namespace
{

/// Drawables that are looked at in each frame, whether they are still where they were.
constexpr std::size_t sweptPerFrame = 256;

MapClasses classesOf(const LabelSettings& settings)
{
    MapClasses classes;
    std::string error;
    if (!classes.parse(settings.mapClass, error))
        OSG_WARN << "osgLabels::LabelScene: mapclass: " << error << "; it does not count"
                 << std::endl;
    return classes;
}

/// Whether a node that traverses some of its children only, by what is chosen or by distance,
/// traverses this one. `above` leads to the parent, from the group that the visitor is at.
bool isChosen(const osg::NodePath& above, const osg::Node& child, osgUtil::CullVisitor& visitor)
{
    osg::Group& parent = *above.back()->asGroup();
    if (const osg::Switch* choice = parent.asSwitch())
        return choice->getChildValue(&child);
    if (const auto* sequence = dynamic_cast<const osg::Sequence*>(&parent))
        return sequence->getValue() == int(parent.getChildIndex(&child));
    const auto* levels = dynamic_cast<const osg::LOD*>(&parent);
    if (!levels)
        return true;
    visitor.pushModelViewMatrix(
        new osg::RefMatrix(osg::computeLocalToWorld(above) * *visitor.getModelViewMatrix()),
        osg::Transform::RELATIVE_RF);
    const float range = levels->getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT
                            ? visitor.getDistanceToViewPoint(levels->getCenter(), true)
                            : visitor.clampedPixelSize(levels->getBound()) / visitor.getLODScale();
    visitor.popModelViewMatrix();
    const unsigned int place = levels->getChildIndex(&child);
    return place < levels->getNumRanges() && levels->getMinRange(place) <= range &&
           range < levels->getMaxRange(place);
}

/// Whether nodes are still one below the other, and the visitor traverses them.
bool isShown(const osg::NodePath& path, osgUtil::CullVisitor& visitor)
{
    for (std::size_t i = 0; i < path.size(); ++i)
    {
        if (!(path[i]->getNodeMask() & visitor.getTraversalMask()))
            return false;
        if (i == 0)
            continue;
        const osg::Group* parent = path[i - 1]->asGroup();
        const osg::NodePath above(path.begin(), path.begin() + std::ptrdiff_t(i));
        if (!parent || !parent->containsNode(path[i]) || !isChosen(above, *path[i], visitor))
            return false;
    }
    return true;
}

/// Hands over all nodes of labels.
class MapLabelsVisitor : public osg::NodeVisitor
{
public:
    explicit MapLabelsVisitor(std::function<void(MapLabels&)> f)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _f(std::move(f))
    {
        setNodeMaskOverride(~0u); // what is hidden now may be shown later
    }
    void apply(osg::Node& node) override
    {
        if (auto* labels = dynamic_cast<MapLabels*>(&node))
            _f(*labels);
        traverse(node);
    }

private:
    const std::function<void(MapLabels&)> _f;
};

} // namespace

MapScene::MapScene(const LabelSettings& settings, std::shared_ptr<GlyphSet> glyphs,
                   MapTexts::StyleOf styleOf, const LabelBatches& batches,
                   const LabelObjects& objects, const FramesInFlight& frames, osg::Group& group)
    : features(
          classesOf(settings), settings.map == "off" ? MapFeatures::FoundValued()
                                                     : [this](MapFeatures::Valued valued)
                                   { addValued(std::move(valued)); }),
      texts(std::move(glyphs), std::move(styleOf), features, frames),
      records(batches, objects, features), buffers(texts.getTable())
{
    if (settings.map != "off" && settings.map != "values")
        readFile(settings.map);
    bool any = settings.map != "off";
    MapLabelsVisitor visitor(
        [&](MapLabels& labels)
        {
            texts.of(labels);
            any = true;
        });
    group.accept(visitor);
    if (_fileLabels)
        _fileLabels->accept(visitor);
    if (any)
        activate(group);
}

void MapScene::readFile(const std::string& file)
{
    const std::string found = osgDB::findDataFile(file);
    osgDB::ifstream in(found.c_str(), std::ios::binary);
    if (found.empty() || !in)
    {
        OSG_WARN << "osgLabels::LabelScene: map=" << file
                 << ": there is no such file, so its labels are missing; name one beside the "
                    "model, or on OSG_FILE_PATH"
                 << std::endl;
        return;
    }
    std::vector<std::string> warnings;
    std::vector<MapLabel> labels = readMapLabels(in, found, warnings);
    for (const std::string& warning : warnings)
        OSG_WARN << "osgLabels::LabelScene: " << warning << std::endl;
    _fileLabels = new MapLabels(std::move(labels));
    _fileLabels->setName(found);
}

void MapScene::cull(osg::NodeVisitor& visitor)
{
    if (_fileLabels)
        _fileLabels->accept(visitor);
    osgUtil::CullVisitor* cullVisitor = visitor.asCullVisitor();
    if (!cullVisitor || !_hasValues)
        return;
    _values->leaveMark(*cullVisitor);
}

osg::ref_ptr<MapMemory> MapScene::getMemory(const osg::Camera* camera, unsigned int frame)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto each = _memories.begin(); each != _memories.end();)
        if (each->first && !each->second.camera.valid())
            each = _memories.erase(each);
        else
            ++each;
    Memories& own = _memories[camera];
    own.camera = camera;
    if (own.frame != frame)
    {
        own.memories.resize(own.used); // fewer pictures than before
        own.used = 0;
        own.frame = frame;
    }
    if (own.used == own.memories.size())
        own.memories.push_back(new MapMemory);
    return own.memories[own.used++];
}

void MapScene::releaseGLObjects(osg::State* state)
{
    buffers.releaseGLObjects(state);
    targets.releaseGLObjects(state);
    quads.releaseGLObjects(state);
    programs.releaseGLObjects(state);
    records.releaseGLObjects(state);
    nests.releaseGLObjects(state);
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto each = _memories.begin(); each != _memories.end();)
    {
        const auto isGone = [&](const osg::ref_ptr<MapMemory>& memory)
        { return !state || memory->isOf(state->getContextID()); };
        std::vector<osg::ref_ptr<MapMemory>>& own = each->second.memories;
        const bool any = std::any_of(own.begin(), own.end(), isGone);
        each = any ? _memories.erase(each) : std::next(each);
    }
}

/// Called under the lock of features.
void MapScene::addValued(MapFeatures::Valued valued)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _found.push_back(std::move(valued));
    _hasValues = true;
}

std::shared_ptr<const MapWords> MapScene::activate(osg::Group& group)
{
    std::lock_guard<std::mutex> lock(_cullMutex);
    if (!_isActive)
        features.collect(group);
    else
        features.sweep(group, sweptPerFrame);
    _isActive = true;
    return records.update(group);
}

void MapScene::prepare(const MapLabels& node, const osg::Matrixd& localToEye,
                       std::vector<EyeLabel>& labels)
{
    const auto prepared = texts.of(node);
    for (const PreparedLabel& from : *prepared)
    {
        EyeLabel label;
        label.anchor = from.anchor * localToEye;
        label.priority = from.priority;
        label.key = label.identifier = from.identifier;
        label.style = from.style;
        label.width = from.width;
        label.feature = from.feature;
        labels.push_back(label);
    }
}

void MapScene::takeRanges(std::vector<EyeLabel>& labels)
{
    for (EyeLabel& label : labels)
        label.own = label.part == FeatureTree::Scene ? features.getRange(label.feature)
                                                     : features.getRangeOfPart(label.part);
}

void MapScene::prepareValued(osgUtil::CullVisitor& visitor, std::vector<EyeLabel>& labels)
{
    const osg::Matrixd groupToEye(*visitor.getModelViewMatrix());
    std::lock_guard<std::mutex> cullLock(_cullMutex);
    std::vector<MapFeatures::Valued> found;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        found.swap(_found);
    }
    for (const MapFeatures::Valued& each : found)
    {
        PreparedLabel label = texts.add(each.label);
        label.part = each.part;
        _valued.push_back({each.path, label, false});
    }
    for (Valued& each : _valued)
    {
        texts.update(each.label);
        osg::RefNodePath path;
        if (!each.path.getRefNodePath(path))
        {
            texts.remove(each.label);
            features.forget(each.label.part);
            each.isGone = true;
            continue;
        }
        osg::NodePath nodes;
        for (const osg::ref_ptr<osg::Node>& node : path)
            nodes.push_back(node.get());
        if (!isShown(nodes, visitor))
            continue;
        EyeLabel label;
        label.anchor = each.label.anchor * osg::computeLocalToWorld(nodes) * groupToEye;
        label.priority = each.label.priority;
        label.key = label.identifier = each.label.identifier;
        label.style = each.label.style;
        label.width = each.label.width;
        label.part = each.label.part;
        labels.push_back(label);
    }
    _valued.erase(std::remove_if(_valued.begin(), _valued.end(),
                                 [](const Valued& each) { return each.isGone; }),
                  _valued.end());
}

} // namespace osgLabels
