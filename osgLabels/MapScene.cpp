// SPDX-License-Identifier: MIT
#include <osgLabels/MapScene.h>

#include <osg/NodeVisitor>
#include <osg/Notify>
#include <osg/Transform>

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

MapScene::MapScene(const LabelSettings& s, std::shared_ptr<GlyphSet> glyphs, osg::Group& group)
    : settings(s), features(
                       classesOf(s), s.map == "off" ? MapFeatures::FoundValued()
                                                    : [this](MapFeatures::Valued valued)
                                         { addValued(std::move(valued)); }),
      texts(std::move(glyphs), features), buffers(texts.getTable())
{
    bool any = false;
    MapLabelsVisitor visitor(
        [&](MapLabels& labels)
        {
            texts.of(labels);
            any = true;
        });
    group.accept(visitor);
    if (any || s.map != "off")
        activate(group);
}

/// Called under the lock of features.
void MapScene::addValued(MapFeatures::Valued valued)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _found.push_back(std::move(valued));
}

void MapScene::activate(osg::Group& group)
{
    if (!_isActive)
        features.collect(group);
    else
        features.sweep(group, sweptPerFrame);
    _isActive = true;
}

bool MapScene::prepare(const MapLabels& node, const osg::Matrixd& localToEye,
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
    return !prepared->empty();
}

void MapScene::prepareValued(const osg::Matrixd& groupToEye, std::vector<EyeLabel>& labels)
{
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
    for (const Valued& each : _valued)
    {
        osg::RefNodePath path;
        if (!each.path.getRefNodePath(path))
            continue;
        osg::NodePath nodes;
        bool isShown = true;
        for (const osg::ref_ptr<osg::Node>& node : path)
        {
            nodes.push_back(node.get());
            isShown = isShown && node->getNodeMask() != 0;
        }
        if (!isShown)
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
