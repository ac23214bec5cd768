// SPDX-License-Identifier: MIT
// The resolving half of SurfaceFrame; SurfaceCollect.cpp culls, SurfaceDraw.cpp draws.
#include <osgMultiRender/SurfaceFrame.h>

#include <osgMultiRender/ProgramWrap.h>
#include <osgMultiRender/SurfaceSource.h>
#include <osgMultiRender/VertexSnippet.h>
#include <osgMultiRender/WithheldLights.h>

#include <osg/GLExtensions>
#include <osg/Notify>
#include <osg/Timer>

#include <algorithm>
#include <set>
#include <utility>

namespace osgMultiRender
{

namespace
{

bool byOrder(const SurfaceItem& a, const SurfaceItem& b)
{
    if (a.diverted != b.diverted)
        return a.diverted;
    // Those of an output pass follow each other.
    if (a.passes != b.passes)
        return std::make_pair(a.passes[1], a.passes[0]) < std::make_pair(b.passes[1], b.passes[0]);
    return a.order < b.order;
}

} // namespace

SurfacePasses SurfaceFrame::passesOf(const osgUtil::StateGraph* graph) const
{
    SurfacePasses passes{NoPass, NoPass};
    passes[_passes.front().role()] = 0;
    for (const osgUtil::StateGraph* g = graph; g && !_scopes.empty(); g = g->_parent)
        if (const auto found = _scopes.find(g->getStateSet()); found != _scopes.end())
            passes[_passes[found->second].role()] = found->second;
    return passes;
}

LightingMode SurfaceFrame::lightingOf(const SurfacePasses& passes) const
{
    const std::uint16_t light = passes[LightRole];
    return light == NoPass ? LightingMode::Vertex : _passes[light].pass->getLighting();
}

bool SurfaceFrame::isOf(const SurfacePass& pass, const SurfaceItem& item) const
{
    const std::uint16_t place = item.passes[static_cast<std::size_t>(pass.getRole())];
    return place != NoPass && _passes[place].pass.get() == &pass;
}

const SurfaceState& SurfaceFrame::stateOf(const osgUtil::StateGraph* graph)
{
    const auto found = _states.find(graph);
    if (found != _states.end())
        return found->second;
    SurfaceState state;
    if (graph->_parent)
        state = stateOf(graph->_parent);
    if (graph->getStateSet())
        state.apply(*graph->getStateSet());
    return _states.emplace(graph, std::move(state)).first->second;
}

SurfaceSnippet SurfaceFrame::makeSnippet(const SurfaceKey& key, const SurfacePasses& passes,
                                         bool hasProgram) const
{
    SurfaceSnippet snippet;
    if (passes[LightRole] != NoPass && !hasProgram)
        snippet += _passes[passes[LightRole]].pass->makeSnippet(key);
    if (passes[OutputRole] != NoPass && key.output)
        snippet += _passes[passes[OutputRole]].pass->makeSnippet(key);
    return snippet;
}

SurfaceVariant* SurfaceFrame::variantOf(const SurfaceKey& key, const SurfacePasses& passes,
                                        const osg::Program* program, const std::string* instance)
{
    osg::ref_ptr<SurfaceVariant>& variant = _variants[passes][key];
    if (!variant)
    {
        std::string kit = glslVersionLine(_languageVersion);
        for (const std::uint16_t place : passes)
            kit += place == NoPass ? "-" : _passes[place].group->className();
        bool made = false;
        variant = SurfaceVariantCache::instance().get(
            kit, key,
            [&]
            {
                const SurfaceSnippet snippet = makeSnippet(key, passes, program);
                return program ? new SurfaceVariant(key, snippet, *program)
                               : new SurfaceVariant(key, snippet, instance ? *instance : "",
                                                    _languageVersion);
            },
            made);
        _compiled += made;
    }
    return variant.get();
}

/// The variant of a model's own Program; its texts are looked at once a frame, so that a change
/// shows.
SurfaceVariant* SurfaceFrame::wrapperOf(const osg::Program& program)
{
    const auto [found, isNew] = _wrappers.emplace(&program, nullptr);
    if (isNew)
    {
        SurfaceKey key;
        key.program = contentOf(program);
        found->second = variantOf(key, {NoPass, NoPass}, &program, nullptr);
    }
    return found->second;
}

SurfaceFrame::Surface& SurfaceFrame::surfaceOf(osg::RenderInfo& renderInfo,
                                               const osgUtil::StateGraph* graph)
{
    const auto [found, isNew] = _surfaces.try_emplace(graph);
    Surface& surface = found->second;
    if (!isNew)
        return surface;
    surface.state = &stateOf(graph);
    surface.passes = passesOf(graph);
    std::string beyond = makeSurfaceKey(*surface.state, lightingOf(surface.passes), _lights,
                                        renderInfo.getContextID(), surface.key);
    auto* program = static_cast<const osg::Program*>(surface.state->get(SurfaceState::Program));
    if (auto* snippet = dynamic_cast<const VertexSnippet*>(program))
    {
        surface.key.instance = snippet->getContent();
        surface.instance = &snippet->getText();
    }
    else if (program && program->getNumShaders() > 0 && !surface.state->isProgramProtected())
    {
        SurfaceVariant* wrapper = wrapperOf(*program);
        if (wrapper->getProgram() && !wrapper->failed)
        {
            surface.key = wrapper->getKey();
            surface.variant = wrapper;
            surface.program = program;
            return surface;
        }
        // What GL refuses shows the fixed-function look; what only we can't wrap, its own program.
        if (wrapper->failed)
            _failedWrappers.insert(wrapper);
        if (!wrapper->getProgram())
            beyond = "its own program, which can't be wrapped: " + wrapper->getError();
    }
    // Only PROTECTED is stronger than our OVERRIDE: such a leaf draws with its own program anyway.
    if (surface.state->isProgramProtected())
        beyond = "its own protected program";
    if (!beyond.empty())
        surface.beyond = &*_beyond.emplace(beyond, 0).first;
    return surface;
}

void SurfaceFrame::resolve(osg::State& state, Surface& surface, osgUtil::RenderLeaf& leaf,
                           bool ordered, SurfaceItem& item)
{
    item.leaf = &leaf;
    item.state = surface.state;
    item.passes = surface.passes;
    if (surface.beyond)
    {
        ++surface.beyond->second;
        return;
    }
    SurfaceKey& key = surface.key;
    const std::uint32_t kit = std::exchange(key.kit, 0), output = std::exchange(key.output, 0);
    classify(surface, leaf, ordered, key, item);
    if (key.kit != kit || key.output != output)
        surface.variant = nullptr;
    if (!surface.variant)
        surface.variant = variantOf(key, surface.passes, surface.program, surface.instance);
    item.variant = surface.variant;
    if (!key.output || links(state, *item.variant, surface.passes))
        return;
    // Better the look alone than neither.
    _failedOutputs.insert(item.variant);
    key.output = 0;
    surface.variant = variantOf(key, surface.passes, surface.program, surface.instance);
    item.variant = surface.variant;
}

void SurfaceFrame::classify(const Surface& surface, const osgUtil::RenderLeaf& leaf, bool ordered,
                            SurfaceKey& key, SurfaceItem& item)
{
    for (const std::uint16_t place : surface.passes)
    {
        if (place == NoPass)
            continue;
        const Pass& pass = _passes[place];
        const bool isLit = key.lighting == LightingMode::Pixel || pass.pass->classifiesUnlit();
        if (pass.role() != LightRole || (isLit && !key.program))
            pass.pass->classify(*surface.state, leaf, ordered, key, item.numbers[pass.role()]);
    }
}

/// False for a program that is known not to link, and for a model's own that turns out not to.
bool SurfaceFrame::links(osg::State& state, SurfaceVariant& variant, const SurfacePasses& passes)
{
    if (variant.failed || !variant.getProgram())
        return false;
    auto& program = const_cast<osg::Program&>(*variant.getProgram());
    // Which one of those with defines it will be only its draw knows.
    if (!variant.getKey().program || !program.getShaderDefines().empty())
        return true;
    const osg::Program::PerContextProgram* linked = program.getPCP(state);
    if (linked && linked->needsLink())
    {
        const osg::Timer_t start = osg::Timer::instance()->tick();
        program.compileGLObjects(state);
        variant.compileMilliseconds =
            osg::Timer::instance()->delta_m(start, osg::Timer::instance()->tick());
    }
    if (linked && linked->isLinked())
        return true;
    if (!variant.failed.exchange(true))
    {
        const SurfaceGroup& group = *_passes[passes[OutputRole]].group;
        OSG_WARN << group.libraryName() << "::" << group.className() << ": program '"
                 << program.getName() << "' does not compile or link together with what "
                 << group.className() << " adds, its surfaces are drawn without that:\n"
                 << errorsOf(program, state) << std::flush;
    }
    return false;
}

void SurfaceFrame::prepare(osg::RenderInfo& renderInfo)
{
    if (_prepared)
        return;
    _prepared = true;
    osg::State& state = *renderInfo.getState();
    SurfaceVariantCache::instance().attach(state.getContextID());
    // After the stage of a camera drawn before, osg::State may have gone back to its default.
    if (const osg::Viewport* viewport = _stage->getViewport())
    {
        viewport->apply(state);
        state.haveAppliedAttribute(viewport);
    }
    const auto* gl = state.get<osg::GLExtensions>();
    _languageVersion = gl->glslLanguageVersion;
    _items.resize(_bins.size());
    for (std::size_t bin = 0; bin < _bins.size(); ++bin)
        _items[bin].resize(_bins[bin].size());
    _diverted.assign(_bins.size(), 0);
    // Some drivers tell of a newer language than their version of GL goes with.
    const bool isSupported = std::min(gl->glVersion, _languageVersion) >= 3.295f;
    if (isSupported)
        classifyAll(renderInfo);
    else
        sayTooOld(gl->glVersion);
    withholdLights();
    sortItems();
    if (isSupported)
        for (const Pass& pass : _passes)
            pass.pass->drawBefore(renderInfo, *this);
    writePlan(renderInfo);
}

void SurfaceFrame::sayTooOld(float glVersion)
{
    static std::once_flag said;
    std::call_once(said,
                   [&]
                   {
                       OSG_WARN << _group->libraryName() << "::" << _group->className()
                                << ": OpenGL " << glVersion << " with GLSL " << _languageVersion
                                << " is older than 3.3, so models keep their fixed-function look; "
                                   "a driver with the OpenGL 3.3 compatibility profile is needed"
                                << std::endl;
                   });
    for (std::size_t bin = 0; bin < _bins.size(); ++bin)
        for (std::size_t i = 0; i < _bins[bin].size(); ++i)
        {
            _items[bin][i].leaf = _bins[bin][i];
            ++_beyond["OpenGL older than 3.3"];
        }
}

void SurfaceFrame::classifyAll(osg::RenderInfo& renderInfo)
{
    forEachLight(
        [this](const osg::Light& light, const osg::Matrix*, bool)
        {
            if (light.getLightNum() >= 0 && light.getLightNum() < int(_lights.size()))
                _lights[light.getLightNum()] = &light;
        });
    for (const Pass& pass : _passes)
        pass.pass->begin(renderInfo, *this);
    for (std::size_t bin = 0; bin < _bins.size(); ++bin)
    {
        Surface* surface = nullptr;
        const osgUtil::StateGraph* graph = nullptr;
        for (std::size_t i = 0; i < _bins[bin].size(); ++i)
        {
            osgUtil::RenderLeaf& leaf = *_bins[bin][i];
            if (leaf._parent != graph) // leaves of one StateGraph follow each other
            {
                graph = leaf._parent;
                surface = &surfaceOf(renderInfo, graph);
            }
            resolve(*renderInfo.getState(), *surface, leaf, _isOrdered[bin], _items[bin][i]);
        }
    }
    for (const Pass& pass : _passes)
        pass.pass->end(renderInfo);
}

void SurfaceFrame::withholdLights()
{
    std::set<unsigned int> mentioned;
    const void* last = nullptr;
    for (const auto& [graph, surfaceState] : _states)
        if (surfaceState.getExtraLightsIdentity() && surfaceState.getExtraLightsIdentity() != last)
        {
            last = surfaceState.getExtraLightsIdentity();
            for (unsigned int number : surfaceState.getExtraLights(false))
                mentioned.insert(number);
        }
    if (mentioned.empty())
        return;
    osg::ref_ptr<osg::StateSet> withheld = new osg::StateSet;
    for (unsigned int number : mentioned)
    {
        withheld->setMode(GL_LIGHT0 + number,
                          osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
        withheld->setAttribute(new WithheldLights(number), osg::StateAttribute::OVERRIDE);
    }
    _withheld = withheld;
}

void SurfaceFrame::sortItems()
{
    std::unordered_map<const SurfaceVariant*, std::uint32_t> orderOf;
    for (std::size_t bin = 0; bin < _bins.size(); ++bin)
    {
        if (_isOrdered[bin])
            continue;
        for (SurfaceItem& item : _items[bin])
        {
            item.order = orderOf.emplace(item.variant, std::uint32_t(orderOf.size())).first->second;
            const std::uint16_t output = item.passes[OutputRole];
            item.diverted = output != NoPass && item.variant && !item.variant->failed &&
                            _passes[output].pass->diverts(item);
            _diverted[bin] += item.diverted;
        }
        if (!std::is_sorted(_items[bin].begin(), _items[bin].end(), byOrder))
            std::stable_sort(_items[bin].begin(), _items[bin].end(), byOrder);
    }
}

void SurfaceFrame::proxyDrawn(osg::RenderInfo& renderInfo)
{
    if (--_proxies == 0)
        for (const Pass& pass : _passes)
            pass.pass->drawn(renderInfo);
}

void SurfaceFrame::drawNothing(osg::RenderInfo& renderInfo)
{
    writePlan(renderInfo);
    for (const Pass& pass : _passes)
        pass.pass->drawn(renderInfo);
}

void SurfaceFrame::forEachLeaf(
    const SurfacePass& pass,
    const std::function<void(const osgUtil::RenderLeaf&, bool ordered)>& f) const
{
    const auto role = static_cast<std::size_t>(pass.getRole());
    const auto isIn = [&](const osgUtil::RenderLeaf& leaf)
    {
        const std::uint16_t place = passesOf(leaf._parent)[role];
        return place != NoPass && _passes[place].pass.get() == &pass;
    };
    for (std::size_t bin = 0; bin < _bins.size(); ++bin)
        for (const osgUtil::RenderLeaf* leaf : _bins[bin])
            if (isIn(*leaf))
                f(*leaf, _isOrdered[bin]);
}

void SurfaceFrame::forEachItem(const std::function<void(const SurfaceItem&)>& f) const
{
    for (const auto& items : _items)
        for (const SurfaceItem& item : items)
            f(item);
}

void SurfaceFrame::drawBin(osg::RenderInfo& renderInfo, std::size_t bin)
{
    prepare(renderInfo);
    const SurfaceItem* items = _items[bin].data();
    const std::size_t diverted = _diverted[bin];
    for (std::size_t i = 0, end = 0; i < diverted; i = end)
    {
        const std::uint16_t output = items[i].passes[OutputRole];
        for (end = i + 1; end < diverted && items[end].passes[OutputRole] == output;)
            ++end;
        _passes[output].pass->divert(renderInfo, [&] { draw(renderInfo, items + i, end - i); });
    }
    draw(renderInfo, items + diverted, _items[bin].size() - diverted);
}

void SurfaceFrame::drawLeaf(osg::RenderInfo& renderInfo, std::size_t bin, std::size_t leaf)
{
    prepare(renderInfo);
    draw(renderInfo, &_items[bin][leaf], 1);
}

} // namespace osgMultiRender
