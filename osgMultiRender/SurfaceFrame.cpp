// SPDX-License-Identifier: MIT
// The resolving half of SurfaceFrame; SurfaceCollect.cpp culls, SurfaceDraw.cpp draws.
#include <osgMultiRender/SurfaceFrame.h>

#include <osgMultiRender/ProgramWrap.h>
#include <osgMultiRender/SurfaceSource.h>
#include <osgMultiRender/VertexSnippet.h>
#include <osgMultiRender/WithheldLights.h>

#include <osg/GLExtensions>
#include <osg/Notify>

#include <algorithm>
#include <set>
#include <utility>

namespace osgMultiRender
{

namespace
{

bool byOrder(const SurfaceItem& a, const SurfaceItem& b)
{
    return a.diverted != b.diverted ? a.diverted : a.order < b.order;
}

} // namespace

unsigned int SurfaceFrame::passesOf(const osgUtil::StateGraph* graph) const
{
    unsigned int passes = 0;
    for (std::size_t i = 0; i < _passes.size(); ++i)
    {
        bool inside = !_passes[i].scope;
        for (const osgUtil::StateGraph* g = graph; g && !inside; g = g->_parent)
            inside = g->getStateSet() == _passes[i].scope;
        passes |= inside ? 1u << i : 0u;
    }
    return passes;
}

LightingMode SurfaceFrame::lightingOf(unsigned int passes) const
{
    for (std::size_t i = 0; i < _passes.size(); ++i)
        if (_passes[i].isLight() && (passes & (1u << i)))
            return _passes[i].pass->getLighting();
    return LightingMode::Vertex;
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

SurfaceVariant* SurfaceFrame::variantOf(const SurfaceKey& key, const osg::Program* program,
                                        const std::string* instance)
{
    osg::ref_ptr<SurfaceVariant>& variant = _variants[key];
    if (!variant)
    {
        std::string kit = glslVersionLine(_languageVersion);
        for (const Pass& pass : _passes)
            kit += pass.group->className();
        bool made = false;
        variant = SurfaceVariantCache::instance().get(
            kit, key,
            [&]
            {
                SurfaceSnippet snippet;
                for (const Pass& pass : _passes)
                    if (pass.isLight() ? !program : key.output != 0)
                        snippet += pass.pass->makeSnippet(key);
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
        found->second = variantOf(key, &program, nullptr);
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

void SurfaceFrame::resolve(Surface& surface, osgUtil::RenderLeaf& leaf, bool ordered,
                           SurfaceItem& item)
{
    item.leaf = &leaf;
    item.state = surface.state;
    item.instance = surface.instance;
    if (surface.beyond)
    {
        ++surface.beyond->second;
        return;
    }
    SurfaceKey& key = surface.key;
    const std::uint32_t kit = std::exchange(key.kit, 0), output = std::exchange(key.output, 0);
    for (std::size_t i = 0; i < _passes.size(); ++i)
    {
        if (!(surface.passes & (1u << i)))
            continue;
        const Pass& pass = _passes[i];
        const bool isLit = key.lighting == LightingMode::Pixel || pass.pass->classifiesUnlit();
        if (!pass.isLight() || (isLit && !key.program))
            pass.pass->classify(*surface.state, leaf, ordered, key,
                                item.numbers[std::size_t(pass.pass->getRole())]);
    }
    if (key.kit != kit || key.output != output)
        surface.variant = nullptr;
    if (!surface.variant)
        surface.variant = variantOf(key, surface.program, surface.instance);
    item.variant = surface.variant;
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
    {
        pass.pass->begin(renderInfo, *this);
        if (pass.pass->getRole() == SurfaceRole::Output)
            _outputPass = pass.pass.get();
    }
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
            resolve(*surface, leaf, _isOrdered[bin], _items[bin][i]);
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
            item.diverted =
                _outputPass && item.variant && !item.variant->failed && _outputPass->diverts(item);
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

void SurfaceFrame::forEachLeaf(
    const SurfacePass& pass,
    const std::function<void(const osgUtil::RenderLeaf&, bool ordered)>& f) const
{
    const auto found = std::find_if(_passes.begin(), _passes.end(),
                                    [&](const Pass& p) { return p.pass.get() == &pass; });
    const unsigned int bit = 1u << (found - _passes.begin());
    for (std::size_t bin = 0; bin < _bins.size(); ++bin)
        for (const osgUtil::RenderLeaf* leaf : _bins[bin])
            if (passesOf(leaf->_parent) & bit)
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
    const std::size_t diverted = _diverted[bin];
    if (diverted)
        _outputPass->divert(renderInfo, [&] { draw(renderInfo, _items[bin].data(), diverted); });
    draw(renderInfo, _items[bin].data() + diverted, _items[bin].size() - diverted);
}

void SurfaceFrame::drawLeaf(osg::RenderInfo& renderInfo, std::size_t bin, std::size_t leaf)
{
    prepare(renderInfo);
    draw(renderInfo, &_items[bin][leaf], 1);
}

} // namespace osgMultiRender
