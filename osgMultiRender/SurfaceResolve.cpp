// SPDX-License-Identifier: MIT
// Which variant each leaf of a SurfaceFrame gets.
#include <osgMultiRender/SurfaceFrame.h>

#include <osgMultiRender/ProgramWrap.h>
#include <osgMultiRender/SurfaceSource.h>
#include <osgMultiRender/VertexSnippet.h>

#include <osg/Notify>
#include <osg/Timer>

#include <utility>

namespace osgMultiRender
{

SurfacePasses SurfaceFrame::passesOf(const osgUtil::StateGraph* graph) const
{
    SurfacePasses passes = NoPasses;
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
    if (passes[TextureRole] != NoPass && key.texture)
        snippet += _passes[passes[TextureRole]].pass->makeSnippet(key);
    if (passes[OutputRole] != NoPass && key.output)
        snippet += _passes[passes[OutputRole]].pass->makeSnippet(key);
    return snippet;
}

SurfaceVariant* SurfaceFrame::variantOf(const SurfaceKey& key, const Surface& surface)
{
    osg::ref_ptr<SurfaceVariant>& variant = _variants[surface.passes][key];
    if (!variant)
    {
        std::string kit = glslVersionLine(_languageVersion);
        for (const std::uint16_t place : surface.passes)
            kit += place == NoPass ? "-" : _passes[place].group->className();
        bool made = false;
        const auto make = [&]
        {
            const SurfaceSnippet snippet = makeSnippet(key, surface.passes, surface.program);
            if (surface.look)
                return new SurfaceVariant(key, snippet, *surface.look);
            return surface.program
                       ? new SurfaceVariant(key, snippet, *surface.program)
                       : new SurfaceVariant(key, snippet, surface.instance ? *surface.instance : "",
                                            _languageVersion);
        };
        variant = surface.look ? surface.look->get(kit, key, make, made)
                               : SurfaceVariantCache::instance().get(kit, key, make, made);
        // The program of a look is linked by its pass, which counts it.
        _compiled += made && (!surface.look || key.output);
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
        Surface alone;
        alone.program = &program;
        found->second = variantOf(key, alone);
    }
    return found->second;
}

SurfaceFrame::Surface& SurfaceFrame::surfaceOf(osg::RenderInfo& renderInfo,
                                               const osgUtil::StateGraph* graph, SurfaceLook* look)
{
    const auto [found, isNew] = _surfaces.try_emplace({graph, look});
    Surface& surface = found->second;
    if (!isNew)
        return surface;
    surface.state = &stateOf(graph);
    surface.passes = passesOf(graph);
    if (look)
    {
        surface.look = look;
        surface.program = look->getProgram();
        surface.key.program = look->getContent();
        return surface;
    }
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

/// Null where the leaf keeps its own look.
SurfaceLook* SurfaceFrame::lookOf(const osgUtil::RenderLeaf& leaf, const SurfacePasses& passes)
{
    if (passes[LookRole] == NoPass)
        return nullptr;
    const SurfaceState& state = stateOf(leaf._parent);
    if (state.isProgramProtected() ||
        dynamic_cast<const VertexSnippet*>(state.get(SurfaceState::Program)))
        return nullptr;
    return _passes[passes[LookRole]].pass->look(state, leaf);
}

void SurfaceFrame::resolve(osg::State& state, Surface& surface, osgUtil::RenderLeaf& leaf,
                           bool ordered, SurfaceItem& item)
{
    item.leaf = &leaf;
    item.state = surface.state;
    item.passes = surface.passes;
    item.instance = surface.instance;
    item.look = surface.look;
    if (surface.beyond)
    {
        ++surface.beyond->second;
        return;
    }
    SurfaceKey& key = surface.key;
    const std::uint32_t kit = std::exchange(key.kit, 0), output = std::exchange(key.output, 0),
                        texture = std::exchange(key.texture, 0);
    for (TextureKey& unit : key.textures)
        unit.sampled = 0;
    classify(surface, leaf, ordered, key, item);
    if (key.kit != kit || key.output != output || key.texture != texture)
        surface.variant = nullptr;
    if (!surface.variant)
        surface.variant = variantOf(key, surface);
    item.variant = surface.variant;
    if (!key.output || links(state, *item.variant, surface.passes))
        return;
    // Better the look alone than neither.
    _failedOutputs.insert(item.variant);
    key.output = 0;
    surface.variant = variantOf(key, surface);
    item.variant = surface.variant;
}

void SurfaceFrame::classify(const Surface& surface, const osgUtil::RenderLeaf& leaf, bool ordered,
                            SurfaceKey& key, SurfaceItem& item)
{
    for (const std::uint16_t place : surface.passes)
    {
        if (place == NoPass || _passes[place].role() == LookRole)
            continue;
        const Pass& pass = _passes[place];
        if (pass.role() == TextureRole && key.program)
            continue;
        const bool isLit = key.lighting == LightingMode::Pixel || pass.pass->classifiesUnlit();
        if (pass.role() != LightRole || (isLit && !key.program))
            pass.pass->classify(*surface.state, leaf, ordered, key, item.numbers[pass.role()]);
    }
}

/// False for a program that is known not to link, and for a model's own that turns out not to.
bool SurfaceFrame::links(osg::State& state, SurfaceVariant& variant, const SurfacePasses& passes)
{
    if (!variant.failed && !variant.getProgram())
    {
        variant.failed = true;
        const SurfaceGroup& group = *_passes[passes[OutputRole]].group;
        OSG_WARN << group.getCompoundClassName()
                 << ": a program can't be wrapped, its surfaces are drawn without what "
                 << group.className() << " adds: " << variant.getError() << std::endl;
    }
    if (variant.failed)
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
        OSG_WARN << group.getCompoundClassName() << ": program '" << program.getName()
                 << "' does not compile or link together with what " << group.className()
                 << " adds, its surfaces are drawn without that:\n"
                 << errorsOf(program, state) << std::flush;
    }
    return false;
}

} // namespace osgMultiRender
