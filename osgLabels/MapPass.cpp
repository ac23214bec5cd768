// SPDX-License-Identifier: MIT
#include <osgLabels/MapPass.h>

#include <osgLabels/ChunkMesh.h>
#include <osgLabels/LabelResources.h>
#include <osgLabels/LabelUnits.h>
#include <osgLabels/PrimitiveRun.h>

#include <osg/Point>
#include <osg/Viewport>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

/// How long a label stays as it is when it is hidden as a whole.
constexpr float secondsOfState = 1.0f;

constexpr auto Over = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;

/// A style whose ink and plate are chosen where it leaves them open: what is below a map label is
/// not known, so that its plate makes it legible.
LabelStyle resolved(LabelStyle style)
{
    const bool isPlateOpen = style.plate.a() < 0.0f;
    const osg::Vec4& known = style.ink.a() > 0.0f ? style.ink : style.plate;
    const float light = 0.299f * known.r() + 0.587f * known.g() + 0.114f * known.b();
    const float other = known.a() > 0.0f && light < 0.5f ? 1.0f : 0.0f;
    if (isPlateOpen)
    {
        const float tone = style.ink.a() > 0.0f ? other : 1.0f;
        style.plate.set(tone, tone, tone, 0.75f);
    }
    if (style.ink.a() == 0.0f)
    {
        const float tone = isPlateOpen || style.plate.a() == 0.0f ? 0.0f : other;
        style.ink.set(tone, tone, tone, 1.0f);
    }
    return style;
}

osg::ref_ptr<osg::Uniform> looksOf(const std::vector<LabelStyle>& styles)
{
    osg::ref_ptr<osg::Uniform> looks = new osg::Uniform(osg::Uniform::FLOAT_VEC4, "osgLabels_looks",
                                                        3 * int(LabelStyle::MaxStyles));
    for (unsigned int i = 0; i < LabelStyle::MaxStyles; ++i)
    {
        const LabelStyle style = resolved(styles[i < styles.size() ? i : 0]);
        looks->setElement(3 * i, style.ink);
        looks->setElement(3 * i + 1, style.plate);
        looks->setElement(3 * i + 2, osg::Vec4(style.outline, style.outlineWidth));
    }
    return looks;
}

} // namespace

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
    const std::size_t begin = _labels.size();
    _scene.prepareValued(groupToEye, _labels);
    addGroup(visitor.getProjectionMatrix(), begin);
    if (_labels.empty())
        return;
    const std::vector<MapFeatures::Occluder> found = _scene.features.find(group, groupToEye, drawn);
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i].number)
            _occluders[drawnLeaves[i]] = {
                found[i].number, found[i].action.value_or(_settings.mapAction), found[i].sides};
    _scene.activate(group);
}

bool MapPass::addMany(const osgUtil::RenderLeaf& leaf)
{
    Occluder occluder;
    occluder.isMany = true;
    occluder.sides = MeshSides::Outward; // each object's are in its record
    if (auto* run = dynamic_cast<const PrimitiveRun*>(leaf._drawable.get()))
    {
        const std::optional<int> base = _resources.batches.recordBaseOf(*run);
        occluder.recordBase = base.value_or(0);
        if (base)
            _occluders[&leaf] = occluder;
        return true;
    }
    if (!ChunkMesh::isChunk(*leaf._drawable))
        return false;
    occluder.recordBase = int(_resources.objects.indexOf(0));
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
    if (!_labels.empty() && (_settings.declutter || _settings.mapTest != MapTest::Pixel))
        _memory = _scene.getMemory(camera);
}

void MapPass::place(const osgMultiRender::SurfaceFrame& frame)
{
    if (_labels.empty())
        return;
    // A camera that is nested in the view has its viewport in the state of its leaves.
    const osg::Viewport* own = nullptr;
    frame.forEachItem(
        [&](const osgMultiRender::SurfaceItem& item)
        {
            using osgMultiRender::SurfaceState;
            if (item.state && !own)
                own = static_cast<const osg::Viewport*>(item.state->get(SurfaceState::Viewport));
        });
    if (own)
    {
        const double values[] = {own->x(), own->y(), own->width(), own->height()};
        std::copy(std::begin(values), std::end(values), std::begin(_viewport));
    }
    _view = {double(_viewport[0]), double(_viewport[1]), double(_viewport[0] + _viewport[2]),
             double(_viewport[1] + _viewport[3])};
    if (_view.isEmpty())
        return;
    placeAll();
    _inView = unsigned(_placed.size());
    if (_settings.declutter)
        _memory->declutter(_placed, _view, _time);
}

void MapPass::placeAll()
{
    for (const Group& group : _groups)
    {
        const MapFrame frame(group.projection ? osg::Matrixd(*group.projection) : osg::Matrixd(),
                             _view);
        _isParallel = frame.isParallel;
        PlacedLabel placed;
        for (std::size_t i = group.begin; i < group.end; ++i)
            if (placeLabel(_labels[i], frame, _settings, placed))
                _placed.push_back(placed);
    }
    // The nearest is drawn last.
    std::sort(_placed.begin(), _placed.end(),
              [](const PlacedLabel& a, const PlacedLabel& b)
              {
                  if (a.distance != b.distance)
                      return a.distance > b.distance;
                  if (a.label->priority != b.label->priority)
                      return a.label->priority < b.label->priority;
                  return a.label->key < b.label->key;
              });
}

void MapPass::upload(osg::State& state)
{
    std::vector<std::uint32_t> last(_placed.size());
    if (_settings.mapTest != MapTest::Pixel)
        last = _memory->begin(state, _placed, _time);
    std::vector<MapQuads::Words> words;
    words.reserve(_placed.size());
    for (std::size_t i = 0; i < _placed.size(); ++i)
    {
        const PlacedLabel& each = _placed[i];
        const EyeLabel& label = *each.label;
        words.push_back({float(each.center.x()), float(each.center.y()), float(each.em),
                         label.width, float(each.anchor.x()), float(each.anchor.y()),
                         float(each.distance), 1.0f, label.identifier, label.own.first,
                         label.own.last, label.style | last[i] << 8});
    }
    _quads = _scene.quads.acquire(_contextID, {});
    _quads->set(state, words);
}

/// Program, textures and uniforms that look at what stands before labels.
osg::ref_ptr<osg::StateSet> MapPass::makePass(osg::State& state, bool isTest)
{
    MapPrograms::Kind kind;
    kind.language = _language;
    kind.layers = _targets ? int(_actions.size()) : 0;
    kind.next = _targets && _targets->getNext();
    kind.isTest = isTest;
    kind.states = !isTest && _settings.mapTest != MapTest::Pixel;
    kind.anchored = isTest && _settings.mapTest == MapTest::Anchor;
    osg::ref_ptr<osg::StateSet> pass =
        new osg::StateSet(*_scene.programs.get(kind, _resources.getDefines(_isPaged, 0)));
    const auto texture = [&](unsigned int unit, const osg::StateAttribute* attribute)
    { pass->setTextureAttribute(unit, const_cast<osg::StateAttribute*>(attribute), Over); };
    texture(MapPrograms::LabelsUnit, _quads->getTexture());
    if (_targets)
        texture(MapTargets::NearUnit, _targets->getNear());
    if (kind.next)
        texture(MapTargets::NextUnit, _targets->getNext());
    if (kind.states)
        texture(MapPrograms::StatesUnit, _memory->getStates());
    const auto add = [&](osg::Uniform* uniform) { pass->addUniform(uniform, Over); };
    int actions[4] = {};
    for (std::size_t i = 0; i < _actions.size(); ++i)
        actions[i] = int(_actions[i]);
    add(new osg::Uniform("osgLabels_actions", actions[0], actions[1], actions[2], actions[3]));
    add(new osg::Uniform("osgLabels_isParallel", int(_isParallel)));
    add(new osg::Uniform("osgLabels_isBack", int(_settings.mapDepth == MapDepth::Back)));
    add(new osg::Uniform("osgLabels_pad",
                         osg::Vec2(float(LabelSettings::MapPadX), float(LabelSettings::MapPadY))));
    add(new osg::Uniform("osgLabels_bounds", _viewport[0], _viewport[1],
                         _viewport[0] + _viewport[2] - 1, _viewport[1] + _viewport[3] - 1));
    pass->merge(*_scene.buffers.update(state));
    return pass;
}

void MapPass::findStates(osg::RenderInfo& renderInfo)
{
    osg::State& state = *renderInfo.getState();
    osgMultiRender::FramebufferVisit visit(state);
    const osg::ref_ptr<osg::StateSet> pass = makePass(state, true);
    _memory->bind(state, *pass, MapPrograms::StatesUnit);
    const osg::Vec2 size = _memory->getSize();
    pass->setAttribute(new osg::Viewport(0, 0, size.x(), size.y()), Over);
    pass->setAttribute(new osg::Point(1.0f), Over);
    pass->addUniform(new osg::Uniform("osgLabels_stateSize", size), Over);
    pass->addUniform(
        new osg::Uniform("osgLabels_time", osg::Vec2(_memory->getTime(), secondsOfState)), Over);
    state.pushStateSet(pass);
    state.apply();
    _quads->drawPoints(renderInfo);
    state.popStateSet();
}

void MapPass::draw(osg::RenderInfo& renderInfo)
{
    if (_placed.empty())
        return;
    osg::State& state = *renderInfo.getState();
    upload(state);
    if (_settings.mapTest != MapTest::Pixel)
        findStates(renderInfo);
    const osg::ref_ptr<osg::StateSet> pass = makePass(state, false);
    _resources.updateGlyphs(*pass);
    const auto add = [&](osg::Uniform* uniform) { pass->addUniform(uniform, Over); };
    add(new osg::Uniform("osgLabels_viewport",
                         osg::Vec4(float(_viewport[0]), float(_viewport[1]),
                                   2.0f / float(_viewport[2]), 2.0f / float(_viewport[3]))));
    add(new osg::Uniform("osgLabels_color", _settings.mapColor));
    add(new osg::Uniform("osgLabels_fade", _settings.mapFade));
    add(looksOf(_settings.styles));
    pass->setAttribute(new osg::Viewport(_viewport[0], _viewport[1], _viewport[2], _viewport[3]),
                       Over);
    state.pushStateSet(pass);
    state.apply();
    _quads->draw(renderInfo);
    state.popStateSet();
}

MapAction MapPass::actionAt(osg::State& state, const PlacedLabel& label, int x, int y)
{
    if (!_targets)
        return MapAction::Ignore;
    const FeatureTree::Range& own = label.label->own;
    const auto isOwn = [&](std::uint32_t n) { return n >= own.first && n <= own.last; };
    const auto limitOf = [&](double distance)
    { return _isParallel ? distance - 1e-6 : distance * (1.0 - 2e-6); };
    std::vector<MapTargets::Texel> foreign;
    double distance = label.distance, back = -1.0;
    for (std::size_t i = 0; i < _actions.size(); ++i)
    {
        const MapTargets::Texel near = _targets->read(state, int(i), false, x, y);
        const MapTargets::Texel next =
            _targets->getNext() ? _targets->read(state, int(i), true, x, y) : MapTargets::Texel();
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
    for (auto label = _placed.rbegin(); label != _placed.rend(); ++label)
    {
        if (!label->plate.contains(px, py))
            continue;
        MapAction action;
        if (_settings.mapTest == MapTest::Pixel)
            action = actionAt(state, *label, int(std::floor(px)), int(std::floor(py)));
        else
            action = MapAction(_memory->read(state, std::size_t(_placed.rend() - label) - 1));
        if (action != MapAction::Hide)
            return MapScene::FirstIdentifier + label->label->identifier;
    }
    return 0;
}

void MapPass::fillPlan(osgMultiRender::Plan& plan) const
{
    using Decision = osgMultiRender::PlanEntry::Decision;
    if (_labels.empty())
        return;
    if (!_inView)
    {
        plan.entries.push_back({"map labels", Decision::Dropped, "none is in view"});
        return;
    }
    std::string text = std::to_string(_inView) + " in view";
    if (_placed.size() < _inView)
        text += ", " + std::to_string(_inView - _placed.size()) + " make way for others";
    if (_drawn)
        text += ", " + std::to_string(_drawn) + " drawables may stand before them";
    if (_drawnNext)
        text += ", " + std::to_string(_drawnNext) + " of them drawn for a second layer";
    if (_leftOut)
        text += ", " + std::to_string(_leftOut) + " can't";
    if (_refused)
        text += ", " + std::to_string(_refused) + " don't because of their own programs";
    plan.entries.push_back({"map labels", Decision::Drawn, text});
    plan.counts["map.labels"] = double(_placed.size());
    plan.counts["map.labels.inView"] = _inView;
    plan.counts["map.occluders"] = _drawn;
    plan.counts["map.occluders.second"] = _drawnNext;
    plan.counts["map.occluders.leftOut"] = _leftOut;
    plan.counts["map.actions"] = double(_actions.size());
    plan.counts["map.bytes.targets"] = double(_targets ? _targets->getBytes() : 0);
}

} // namespace osgLabels
