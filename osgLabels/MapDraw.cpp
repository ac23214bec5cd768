// SPDX-License-Identifier: MIT
// The part of MapPass that draws labels, and finds what becomes of them as a whole.
#include <osgLabels/MapPass.h>

#include <osgLabels/LabelResources.h>

#include <osgMultiRender/PassState.h>

#include <osg/Point>
#include <osg/Viewport>

#include <algorithm>

namespace osgLabels
{

using osgMultiRender::ForcedOn;

namespace
{

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

void MapPass::upload(osg::State& state)
{
    std::vector<MapQuads::Words> words;
    words.reserve(_placed.size());
    for (const PlacedLabel& each : _placed)
    {
        const EyeLabel& label = *each.label;
        words.push_back({float(each.center.x()), float(each.center.y()), float(each.em),
                         label.width, float(each.anchor.x()), float(each.anchor.y()),
                         float(each.distance), -1.0f, label.identifier, label.own.first,
                         label.own.last | nextOf(label.own) << MapQuads::NextShift, label.style});
    }
    if (_settings.declutter)
        for (const std::uint32_t index : _order)
            words[index].age = _memory->getAge(index);
    if (needsStates())
    {
        const std::vector<MapMemory::Past>& pasts = _memory->getPasts();
        words.resize(pasts.size()); // those that are gone too
        for (std::size_t i = 0; i < pasts.size(); ++i)
            words[i].style |= (pasts[i].isGone ? MapQuads::Gone : 0u) | pasts[i].last << 8;
    }
    if (!_quads)
        _quads = _scene.quads.acquire(_contextID, {});
    _quads->set(state, words, _order);
}

bool MapPass::needsStates() const
{
    // Where nothing stands before anything all are seen.
    return _settings.mapTest != MapTest::Pixel || (_settings.declutter && _targets);
}

void MapPass::takeShown(const std::vector<std::uint8_t>* shown)
{
    _order.clear();
    for (std::uint32_t i = 0; i < _placed.size(); ++i)
        if (!shown || (*shown)[i])
            _order.push_back(i);
    std::sort(_order.begin(), _order.end(),
              [this](std::uint32_t a, std::uint32_t b) { return isBefore(a, b); });
}

/// Which labels are shown, and what becomes of them as a whole.
void MapPass::findShown(osg::RenderInfo& renderInfo)
{
    osg::State& state = *renderInfo.getState();
    const bool isTested = needsStates();
    if (_memory)
    {
        MapCamera camera{_groupToEye, {}, _view};
        for (const Group& group : _groups)
            camera.projections.push_back(group.projection ? osg::Matrixd(*group.projection)
                                                          : osg::Matrixd());
        _memory->begin(state, _placed, camera, _time);
    }
    if (!_settings.declutter)
    {
        takeShown(nullptr);
        upload(state);
        if (isTested)
            findStates(renderInfo);
        return;
    }
    // A picture that stands for itself has no time to wait for what is hidden in it; others take
    // what was so a few frames ago.
    const bool isAtOnce = isTested && _memory->isCut();
    if (isAtOnce)
    {
        upload(state);
        findStates(renderInfo);
    }
    {
        osgMultiRender::FramebufferVisit visit(state);
        takeShown(&_memory->declutter(state, _placed, _view, isTested));
    }
    upload(state);
    if (isTested && !isAtOnce)
        findStates(renderInfo);
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
    kind.wholly = isTest && _settings.mapTest == MapTest::Pixel;
    osg::ref_ptr<osg::StateSet> pass =
        new osg::StateSet(*_scene.programs.get(kind, _resources.getDefines(_isPaged, 0)));
    const auto texture = [&](unsigned int unit, const osg::StateAttribute* attribute)
    { pass->setTextureAttribute(unit, const_cast<osg::StateAttribute*>(attribute), ForcedOn); };
    texture(MapPrograms::LabelsUnit, _quads->getTexture());
    if (_targets)
        texture(MapTargets::NearUnit, _targets->getNear());
    if (kind.next)
        texture(MapTargets::NextUnit, _targets->getNext());
    if (kind.states)
        texture(MapPrograms::StatesUnit, _memory->getStates());
    const auto add = [&](osg::Uniform* uniform) { pass->addUniform(uniform, ForcedOn); };
    int actions[4] = {};
    for (std::size_t i = 0; i < _actions.size(); ++i)
        actions[i] = int(_actions[i]);
    add(new osg::Uniform("osgLabels_actions", actions[0], actions[1], actions[2], actions[3]));
    add(new osg::Uniform("osgLabels_isByDepth", int(_isByDepth)));
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
    pass->setAttribute(new osg::Viewport(0, 0, size.x(), size.y()), ForcedOn);
    pass->setAttribute(new osg::Point(1.0f), ForcedOn);
    pass->addUniform(new osg::Uniform("osgLabels_stateSize", size), ForcedOn);
    pass->addUniform(new osg::Uniform("osgLabels_isMoving", int(_memory->isMoving())), ForcedOn);
    pass->addUniform(
        new osg::Uniform("osgLabels_time", osg::Vec2(_memory->getTime(), MapMemory::Hold)),
        ForcedOn);
    const osgMultiRender::PassState pushed(state, *pass);
    state.apply();
    _quads->drawPoints(renderInfo);
    if (_settings.declutter && !_memory->isCut())
        _memory->startFeedback(state, _placed);
}

void MapPass::draw(osg::RenderInfo& renderInfo)
{
    if (_placed.empty())
        return;
    osg::State& state = *renderInfo.getState();
    const osg::ref_ptr<osg::StateSet> pass = makePass(state, false);
    _resources.updateGlyphs(*pass);
    const auto add = [&](osg::Uniform* uniform) { pass->addUniform(uniform, ForcedOn); };
    add(new osg::Uniform("osgLabels_viewport",
                         osg::Vec4(float(_viewport[0]), float(_viewport[1]),
                                   2.0f / float(_viewport[2]), 2.0f / float(_viewport[3]))));
    add(new osg::Uniform("osgLabels_orderAt", int(_quads->getOrderAt())));
    add(new osg::Uniform("osgLabels_color", _settings.mapColor));
    add(new osg::Uniform("osgLabels_fade", _settings.mapFade));
    add(looksOf(_settings.styles));
    pass->setAttribute(new osg::Viewport(_viewport[0], _viewport[1], _viewport[2], _viewport[3]),
                       ForcedOn);
    std::vector<std::unique_ptr<osgMultiRender::PassState>> limits;
    for (const osg::ref_ptr<osg::StateSet>& each : _limits)
        limits.push_back(std::make_unique<osgMultiRender::PassState>(state, *each));
    {
        const osgMultiRender::PassState pushed(state, *pass);
        state.apply();
        _quads->draw(renderInfo);
    }
    while (!limits.empty()) // the innermost first
        limits.pop_back();
}

} // namespace osgLabels
