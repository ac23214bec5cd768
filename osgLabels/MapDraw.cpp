// SPDX-License-Identifier: MIT
// The part of MapPass that draws labels, and finds what becomes of them as a whole.
#include <osgLabels/MapPass.h>

#include <osgLabels/LabelResources.h>

#include <osg/Point>
#include <osg/Viewport>

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

} // namespace osgLabels
