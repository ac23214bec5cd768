// SPDX-License-Identifier: MIT
#include <osgLabels/MapPass.h>

#include <osgLabels/ChunkMesh.h>
#include <osgLabels/LabelResources.h>
#include <osgLabels/PrimitiveRun.h>

#include <osg/Viewport>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderStage>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

MapPass::MapPass(LabelResources& resources, const LabelSettings& settings)
    : _resources(resources), _scene(*resources.map), _settings(settings)
{
}

MapPass::~MapPass()
{
    if (_targets)
        _scene.targets.release(_contextID, _targets);
    if (_quads)
        _scene.quads.release(_contextID, _quads);
}

void MapPass::cull(osgUtil::CullVisitor& visitor, osg::Group& group,
                   const std::vector<const osgUtil::RenderLeaf*>& leaves)
{
    const osg::Matrixd groupToEye(*visitor.getModelViewMatrix());
    _groupToEye = groupToEye;
    // A camera that is nested in the view has a viewport of its own.
    const osg::Viewport* ofStage = visitor.getCurrentRenderBin()->getStage()->getViewport();
    if (visitor.getViewport() != ofStage)
        _ownViewport = visitor.getViewport();
    takeLimits(visitor.getCurrentStateGraph());
    std::vector<MapFeatures::Drawn> drawn;
    std::vector<const osgUtil::RenderLeaf*> drawnLeaves;
    const auto addGroup = [&](const osg::RefMatrix* projection, std::size_t begin)
    {
        if (_labels.size() > begin)
            _groups.push_back({projection, begin, _labels.size()});
    };
    for (const osgUtil::RenderLeaf* leaf : leaves)
    {
        const osg::Matrixd localToEye =
            leaf->_modelview ? osg::Matrixd(*leaf->_modelview) : osg::Matrixd();
        const std::size_t begin = _labels.size();
        if (auto* mark = dynamic_cast<const MapLabels::Mark*>(leaf->_drawable.get()))
        {
            _scene.prepare(mark->getLabels(), localToEye, _labels);
            addGroup(leaf->_projection.get(), begin);
            continue;
        }
        if (addMany(*leaf))
            continue;
        drawn.push_back({leaf->_drawable.get(), localToEye});
        drawnLeaves.push_back(leaf);
    }
    if (_labels.empty() && _settings.map == "off")
        return;
    const std::size_t begin = _labels.size();
    // Another view, or what this one has found, may change the numbers of all: they are taken
    // again then.
    constexpr int tries = 4;
    for (int i = 0; i < tries; ++i)
    {
        const unsigned int count = _scene.features.getModifiedCount();
        const auto found = _scene.features.find(group, groupToEye, drawn);
        for (std::size_t leaf = 0; leaf < found.size(); ++leaf)
            if (found[leaf].number)
                _occluders[drawnLeaves[leaf]] = {found[leaf].number,
                                                 found[leaf].action.value_or(_settings.mapAction),
                                                 found[leaf].sides};
        _words = _scene.activate(group);
        if (i == 0) // those that were found just now, too
            _scene.prepareValued(visitor, _labels);
        _scene.takeRanges(_labels);
        _nesting = _scene.features.getNesting();
        if (_scene.features.getModifiedCount() == count && _words->features == count)
            break;
    }
    addGroup(visitor.getProjectionMatrix(), begin);
}

/// The masks of the eyes of an anaglyph are set while it is drawn: these are the view's own.
void MapPass::takeLimits(const osgUtil::StateGraph* graph)
{
    _limits.clear();
    for (; graph; graph = graph->_parent)
    {
        const osg::StateSet* from = graph->getStateSet();
        if (!from)
            continue;
        osg::ref_ptr<osg::StateSet> limits = new osg::StateSet;
        for (const auto type : {osg::StateAttribute::COLORMASK, osg::StateAttribute::STENCIL,
                                osg::StateAttribute::SCISSOR})
            if (const auto* pair = from->getAttributePair(type))
                limits->setAttribute(pair->first, pair->second);
        for (const GLenum mode : {GL_STENCIL_TEST, GL_SCISSOR_TEST})
            if (const auto value = from->getMode(mode); value != osg::StateAttribute::INHERIT)
                limits->setMode(mode, value);
        if (!limits->getAttributeList().empty() || !limits->getModeList().empty())
            _limits.insert(_limits.begin(), limits);
    }
}

bool MapPass::addMany(const osgUtil::RenderLeaf& leaf)
{
    Occluder occluder;
    occluder.isMany = true;
    occluder.sides = MeshSides::Outward; // each object's are in its record
    if (auto* run = dynamic_cast<const PrimitiveRun*>(leaf._drawable.get()))
    {
        occluder.recordBase = int(_resources.batches.recordBaseOf(*run));
        if (occluder.recordBase)
            _occluders[&leaf] = occluder;
        return true;
    }
    if (!ChunkMesh::isOne(*leaf._drawable))
        return false;
    occluder.recordBase = -int(_resources.objects.indexOf(1));
    _occluders[&leaf] = occluder;
    return true;
}

void MapPass::begin(osg::RenderInfo& renderInfo, const osg::Camera* camera,
                    const GLint (&viewport)[4], bool isPaged)
{
    const osg::State& state = *renderInfo.getState();
    _contextID = state.getContextID();
    _language = int(std::lround(state.get<osg::GLExtensions>()->glslLanguageVersion * 100.0f));
    _isPaged = isPaged;
    std::copy(std::begin(viewport), std::end(viewport), std::begin(_viewport));
    if (state.getFrameStamp())
        _time = state.getFrameStamp()->getSimulationTime();
    const unsigned int frame = state.getFrameStamp() ? state.getFrameStamp()->getFrameNumber() : 0;
    if (!_labels.empty() && (_settings.declutter || _settings.mapTest != MapTest::Pixel))
        _memory = _scene.getMemory(camera, frame);
}

void MapPass::place()
{
    if (_labels.empty())
        return;
    if (const osg::Viewport* own = _ownViewport.get())
    {
        const double values[] = {own->x(), own->y(), own->width(), own->height()};
        std::copy(std::begin(values), std::end(values), std::begin(_viewport));
    }
    _view = {double(_viewport[0]), double(_viewport[1]), double(_viewport[0] + _viewport[2]),
             double(_viewport[1] + _viewport[3])};
    if (_view.isEmpty())
        return;
    placeAll();
}

void MapPass::placeAll()
{
    for (const Group& group : _groups)
    {
        const MapFrame frame(group.projection ? osg::Matrixd(*group.projection) : osg::Matrixd(),
                             _view, _isByDepth);
        PlacedLabel placed;
        for (std::size_t i = group.begin; i < group.end; ++i)
            if (placeLabel(_labels[i], frame, _settings, placed))
                _placed.push_back(placed);
    }
}

/// Labels of features that others lie in need a layer for each depth of these. Deeper ones than
/// there are layers for share the last: what is around them does not hide them.
void MapPass::findDepths()
{
    // Layers are counted from 1 in what a label has of its own feature's numbers.
    constexpr std::size_t most = (1u << (32 - MapQuads::NextShift)) - 2;
    for (const PlacedLabel& placed : _placed)
        if (const FeatureTree::Range& own = placed.label->own; own.first < own.last)
            _depths.push_back(_nesting->depthOf(own.first));
    std::sort(_depths.begin(), _depths.end());
    _depths.erase(std::unique(_depths.begin(), _depths.end()), _depths.end());
    _sharing = _depths.size() - std::min(_depths.size(), most);
    _depths.resize(_depths.size() - _sharing);
}

std::uint32_t MapPass::nextOf(const FeatureTree::Range& own) const
{
    if (own.first >= own.last || _depths.empty())
        return 1;
    const auto deeper =
        std::upper_bound(_depths.begin(), _depths.end(), _nesting->depthOf(own.first));
    return 1 + std::uint32_t(deeper - _depths.begin());
}

/// The nearest is drawn last.
bool MapPass::isBefore(std::uint32_t first, std::uint32_t second) const
{
    const PlacedLabel &a = _placed[first], &b = _placed[second];
    if (a.distance != b.distance)
        return a.distance > b.distance;
    if (a.label->priority != b.label->priority)
        return a.label->priority < b.label->priority;
    return a.label->key < b.label->key;
}

MapAction MapPass::actionAt(osg::State& state, const PlacedLabel& label, int x, int y)
{
    if (!_targets)
        return MapAction::Ignore;
    const FeatureTree::Range& own = label.label->own;
    const auto isOwn = [&](std::uint32_t n) { return n >= own.first && n <= own.last; };
    const auto limitOf = [&](double distance)
    { return _isByDepth ? distance - 1e-6 : distance * (1.0 - 2e-6); };
    std::vector<MapTargets::Texel> foreign;
    double distance = label.distance, back = -1.0;
    for (std::size_t i = 0; i < _actions.size(); ++i)
    {
        const MapTargets::Texel near = _targets->read(state, int(i), 0, x, y);
        const MapTargets::Texel next = _targets->getNext()
                                           ? _targets->read(state, int(i), int(nextOf(own)), x, y)
                                           : MapTargets::Texel();
        foreign.push_back(!isOwn(near.number)  ? near
                          : isOwn(next.number) ? MapTargets::Texel()
                                               : next);
        for (const MapTargets::Texel& each : {near, next})
            if (isOwn(each.number) && (back < 0.0 || each.distance < back))
                back = each.distance;
    }
    if (_settings.mapDepth == MapDepth::Back && back >= 0.0)
        distance = back;
    for (std::size_t i = 0; i < _actions.size(); ++i)
        if (foreign[i].number && foreign[i].distance < limitOf(distance))
            return _actions[i];
    return MapAction::Ignore;
}

std::uint32_t MapPass::pick(osg::State& state, double x, double y)
{
    const double px = _view.left + (0.5 + 0.5 * x) * (_view.right - _view.left);
    const double py = _view.bottom + (0.5 + 0.5 * y) * (_view.top - _view.bottom);
    if (!_view.contains(px, py))
        return 0;
    osgMultiRender::FramebufferVisit visit(state);
    for (auto index = _order.rbegin(); index != _order.rend(); ++index)
    {
        const PlacedLabel& label = _placed[*index];
        if (!label.plate.contains(px, py))
            continue;
        MapAction action;
        if (_settings.mapTest == MapTest::Pixel)
            action = actionAt(state, label, int(std::floor(px)), int(std::floor(py)));
        else
            action = MapAction(_memory->read(state, *index));
        if (action != MapAction::Hide)
            return MapScene::FirstIdentifier + label.label->identifier;
    }
    return 0;
}

void MapPass::fillPlan(osgMultiRender::Plan& plan) const
{
    using Decision = osgMultiRender::PlanEntry::Decision;
    if (_labels.empty())
        return;
    if (_placed.empty())
    {
        plan.entries.push_back({"map labels", Decision::Dropped, "none is in view"});
        return;
    }
    std::string text = std::to_string(_placed.size()) + " in view";
    if (_order.size() < _placed.size())
        text += ", " + std::to_string(_placed.size() - _order.size()) +
                " make way for others or are hidden by surfaces";
    if (_drawn)
        text += ", " + std::to_string(_drawn) + " drawables may stand before them";
    if (_drawnNext)
        text += ", " + std::to_string(_drawnNext) + " of them drawn for a second layer";
    if (_sharing)
        text += ", " + std::to_string(_sharing) +
                " depths of nested features share the last of their layers";
    if (_leftOut)
        text += ", " + std::to_string(_leftOut) + " can't";
    if (_refused)
        text += ", " + std::to_string(_refused) + " don't because of their own programs";
    plan.entries.push_back({"map labels", Decision::Drawn, text});
    plan.counts["map.labels"] = double(_order.size());
    plan.counts["map.labels.inView"] = double(_placed.size());
    plan.counts["map.occluders"] = _drawn;
    plan.counts["map.occluders.second"] = _drawnNext;
    plan.counts["map.occluders.leftOut"] = _leftOut;
    plan.counts["map.depths"] = double(_depths.size());
    plan.counts["map.depths.sharing"] = double(_sharing);
    plan.counts["map.actions"] = double(_actions.size());
    plan.counts["map.bytes.targets"] = double(_targets ? _targets->getBytes() : 0);
}

} // namespace osgLabels
