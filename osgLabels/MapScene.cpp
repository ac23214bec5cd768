// SPDX-License-Identifier: MIT
#include <osgLabels/MapScene.h>

#include <osgLabels/MapLabelFile.h>

#include <osg/NodeVisitor>
#include <osg/Notify>
#include <osg/Switch>
#include <osg/Transform>
#include <osgDB/FileUtils>
#include <osgDB/fstream>

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

/// Whether nodes are still one below the other, and neither masked nor switched off.
bool isShown(const osg::NodePath& path, osg::Node::NodeMask mask)
{
    for (std::size_t i = 0; i < path.size(); ++i)
    {
        if (!(path[i]->getNodeMask() & mask))
            return false;
        if (i == 0)
            continue;
        const osg::Group* parent = path[i - 1]->asGroup();
        if (!parent || !parent->containsNode(path[i]))
            return false;
        if (const osg::Switch* choice = path[i - 1]->asSwitch();
            choice && !choice->getChildValue(path[i]))
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
                   const LabelObjects& objects, osg::Group& group)
    : features(
          classesOf(settings), settings.map == "off" ? MapFeatures::FoundValued()
                                                     : [this](MapFeatures::Valued valued)
                                   { addValued(std::move(valued)); }),
      texts(std::move(glyphs), std::move(styleOf), features), records(batches, objects, features),
      buffers(texts.getTable())
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

osg::ref_ptr<MapMemory> MapScene::getMemory(const osg::Camera* camera)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto each = _memories.begin(); each != _memories.end();)
        if (each->first && !each->second.camera.valid())
            each = _memories.erase(each);
        else
            ++each;
    Memory& memory = _memories[camera];
    if (!memory.memory)
        memory = {camera, new MapMemory};
    return memory.memory;
}

void MapScene::releaseGLObjects(osg::State* state)
{
    buffers.releaseGLObjects(state);
    targets.releaseGLObjects(state);
    quads.releaseGLObjects(state);
    programs.releaseGLObjects(state);
    records.releaseGLObjects(state);
    std::lock_guard<std::mutex> lock(_mutex);
    _memories.clear();
}

/// Called under the lock of features.
void MapScene::addValued(MapFeatures::Valued valued)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _found.push_back(std::move(valued));
}

void MapScene::activate(osg::Group& group)
{
    std::lock_guard<std::mutex> lock(_cullMutex);
    if (!_isActive)
        features.collect(group);
    else
        features.sweep(group, sweptPerFrame);
    _isActive = true;
    records.update(group);
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
        label.own = features.getRange(from.feature);
        labels.push_back(label);
    }
}

void MapScene::prepareValued(const osg::Matrixd& groupToEye, osg::Node::NodeMask mask,
                             std::vector<EyeLabel>& labels)
{
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
        _valued.push_back({each.path, label});
    }
    for (Valued& each : _valued)
    {
        texts.update(each.label);
        osg::RefNodePath path;
        if (!each.path.getRefNodePath(path))
            continue;
        osg::NodePath nodes;
        for (const osg::ref_ptr<osg::Node>& node : path)
            nodes.push_back(node.get());
        if (!isShown(nodes, mask))
            continue;
        EyeLabel label;
        label.anchor = each.label.anchor * osg::computeLocalToWorld(nodes) * groupToEye;
        label.priority = each.label.priority;
        label.key = label.identifier = each.label.identifier;
        label.style = each.label.style;
        label.width = each.label.width;
        label.own = features.getRangeOfPart(each.label.part);
        labels.push_back(label);
    }
}

} // namespace osgLabels
