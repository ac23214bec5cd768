// SPDX-License-Identifier: MIT
#include <osgShadowVolume/VolumeShadows.h>

#include <osgMultiRender/DrawTarget.h>
#include <osgMultiRender/PassState.h>
#include <osgShadowVolume/CasterDraw.h>
#include <osgShadowVolume/DepthBounds.h>
#include <osgShadowVolume/EnumNames.h>
#include <osgShadowVolume/Shaders.h>

#include <osg/GLExtensions>
#include <osg/Scissor>
#include <osg/Viewport>
#include <osgDB/ReadFile>

#include <algorithm>
#include <cmath>
#include <limits>

#ifndef GL_MAX_COLOR_TEXTURE_SAMPLES
#define GL_MAX_COLOR_TEXTURE_SAMPLES 0x910E
#define GL_MAX_DEPTH_TEXTURE_SAMPLES 0x910F
#define GL_MAX_INTEGER_SAMPLES 0x9110
#endif

namespace osgShadowVolume
{

using osgMultiRender::SurfaceItem;
using Pass = ShadowPasses::Pass;

namespace
{

/// Hues that are far apart for neighbours.
osg::Vec4 colorOf(int index)
{
    const float hue = 6.0f * std::fmod(0.13f + 0.618034f * float(index), 1.0f);
    const auto channel = [hue](float offset)
    {
        const float k = std::fmod(offset + hue, 6.0f);
        return 1.0f - std::max(0.0f, std::min({k, 4.0f - k, 1.0f}));
    };
    return {channel(5.0f), channel(3.0f), channel(1.0f), 0.12f};
}

std::string nameOf(Technique technique)
{
    for (const auto& [name, value] : TechniqueNames)
        if (value == technique)
            return name;
    return {};
}

/// That textures may have of all the kinds that ShadowTargets has.
int mostSamples()
{
    GLint most = std::numeric_limits<GLint>::max();
    for (const GLenum limit :
         {GL_MAX_COLOR_TEXTURE_SAMPLES, GL_MAX_DEPTH_TEXTURE_SAMPLES, GL_MAX_INTEGER_SAMPLES})
    {
        GLint samples = 1;
        glGetIntegerv(limit, &samples);
        most = std::min(most, samples);
    }
    return std::max(1, most);
}

bool isOpaque(const SurfaceItem& item)
{
    return item.state->isOpaque();
}

} // namespace

VolumeShadows::VolumeShadows(const ShadowSettings& settings, ShadowResources& resources)
    : LightShadows(settings), _resources(resources)
{
}

VolumeShadows::~VolumeShadows()
{
    if (_targets)
        _resources.targets.release(_contextID, _targets);
}

void VolumeShadows::begin(osg::RenderInfo& renderInfo)
{
    const auto* gl = renderInfo.getState()->get<osg::GLExtensions>();
    const auto target = osgMultiRender::DrawTarget::current(*renderInfo.getState());
    _viewSamples = target.samples;
    _tier.samples = std::min(_viewSamples, mostSamples());
    _isFlipped = target.flipped && _tier.samples > 1;
    const float version = std::min(gl->glVersion, gl->glslLanguageVersion);
    _tier.language = std::clamp(int(std::lround(version * 100.0f)), 330, 450);
    const bool hasPrecise =
        _tier.language >= 400 || osg::isGLExtensionSupported(gl->contextID, "GL_ARB_gpu_shader5");
    _technique = getSettings().technique;
    if (_technique == Technique::AUTO)
        _technique = Technique::GEOMETRY;
    if (_technique == Technique::TESS && _tier.language < 400)
        _technique = Technique::GEOMETRY;
    if (_technique == Technique::GEOMETRY && !hasPrecise)
        _technique = Technique::CPU;
}

void VolumeShadows::draw(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
                         const std::vector<bool>& used, const Items& isReceiver)
{
    osg::State& state = *renderInfo.getState();
    _contextID = state.getContextID();
    _frameNumber = state.getFrameStamp() ? state.getFrameStamp()->getFrameNumber() : 0;
    _resources.casters->evict(_frameNumber);
    _meshes.assign(getCasters().size(), nullptr);
    _descriptions.assign(getLights().size(), std::string());
    int lights = 0;
    bool any = false;
    for (std::size_t i = 0; i < getLights().size(); ++i)
        if (getDecision(i).index >= 0)
        {
            lights = std::max(lights, getDecision(i).index + 1);
            any = any || used[i];
        }
    if (!any)
        return;
    bool hasTransparent = false;
    frame.forEachItem(
        [&](const SurfaceItem& item)
        {
            if (!isReceiver(item))
                return;
            hasTransparent = hasTransparent || !isOpaque(item);
            _hasPolygonOffset =
                _hasPolygonOffset || item.state->isOn(osgMultiRender::SurfaceState::PolygonOffset);
        });
    GLint viewport[4];
    glGetIntegerv(GL_VIEWPORT, viewport);
    TargetLayout layout;
    layout.width = viewport[0] + viewport[2];
    layout.height = viewport[1] + viewport[3];
    layout.samples = _tier.samples;
    layout.flipped = _isFlipped;
    layout.words = (lights + 31) / 32;
    layout.layers = hasTransparent ? int(getSettings().transparentLayers) : 0;
    FramebufferVisit visit(state);
    if (!acquireTargets(state, layout))
        return;
    // Without it osg::State would go back to its default viewport at our own draws.
    osg::ref_ptr<osg::StateSet> base = new osg::StateSet;
    base->setAttribute(new osg::Viewport(viewport[0], viewport[1], viewport[2], viewport[3]),
                       osg::StateAttribute::OVERRIDE);
    const osgMultiRender::PassState pushed(state, *base);
    drawDepths(renderInfo, frame, isReceiver);
    makeMask(renderInfo, used, -1);
    for (_layers = 0; _layers < layout.layers; ++_layers)
    {
        if (!peel(renderInfo, frame, isReceiver, _layers))
            break;
        makeMask(renderInfo, used, _layers);
    }
    _lookUp = new osg::StateSet;
    _lookUp->setTextureAttribute(ShadowTargets::MaskUnit, _targets->getMask(),
                                 osg::StateAttribute::OVERRIDE);
    if (_targets->getLayers())
        _lookUp->setTextureAttribute(ShadowTargets::LayersUnit, _targets->getLayers(),
                                     osg::StateAttribute::OVERRIDE);
}

bool VolumeShadows::acquireTargets(osg::State& state, const TargetLayout& layout)
{
    _targets = _resources.targets.acquire(_contextID, layout);
    const std::string& status = _targets->whyIncomplete(state);
    if (status.empty())
        return true;
    const std::string reason =
        _resources.warnIncomplete(status, layout.width, layout.height, layout.samples);
    std::fill(_descriptions.begin(), _descriptions.end(), reason);
    _resources.targets.release(_contextID, _targets);
    _targets = nullptr;
    return false;
}

osgMultiRender::SurfaceFrame::StateFor VolumeShadows::statesOf(Pass pass)
{
    return [this, pass](const std::string* instance) -> const osg::StateSet&
    { return _resources.passes.getFor(pass, _tier, instance); };
}

void VolumeShadows::drawDepths(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
                               const Items& isReceiver)
{
    _targets->bindDepth(*renderInfo.getState());
    glDepthMask(GL_TRUE);
    renderInfo.getState()->haveAppliedAttribute(osg::StateAttribute::DEPTH);
    glClear(GL_DEPTH_BUFFER_BIT);
    const auto hasHoles = [](const SurfaceItem& item)
    {
        return item.state->isOn(osgMultiRender::SurfaceState::AlphaTest) ||
               item.state->isOn(osgMultiRender::SurfaceState::AlphaToCoverage);
    };
    const auto draw = [&](Pass pass, bool holes)
    {
        frame.drawSelected(renderInfo, statesOf(pass),
                           [&](const SurfaceItem& item) {
                               return isReceiver(item) && isOpaque(item) && hasHoles(item) == holes;
                           });
    };
    draw(Pass::Depth, false);
    draw(Pass::Masked, true);
}

bool VolumeShadows::peel(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
                         const Items& isReceiver, int layer)
{
    osg::State& state = *renderInfo.getState();
    const auto* gl = state.get<osg::GLExtensions>();
    _targets->bindLayer(state, layer);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    state.haveAppliedAttribute(osg::StateAttribute::DEPTH);
    state.haveAppliedAttribute(osg::StateAttribute::COLORMASK);
    glClearColor(1.0f, 1.0f, 1.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    osg::ref_ptr<osg::StateSet> inputs = new osg::StateSet;
    inputs->setTextureAttribute(ShadowTargets::OpaqueDepthUnit, _targets->getDepth(-1),
                                osg::StateAttribute::OVERRIDE);
    inputs->setTextureAttribute(ShadowTargets::DepthUnit, _targets->getDepth(layer - 1),
                                osg::StateAttribute::OVERRIDE);
    inputs->addUniform(new osg::Uniform("osgsv_layer", layer));
    inputs->addUniform(new osg::Uniform("osgsv_flippedHeight", _targets->getFlippedHeight()));
    GLuint query = 0;
    gl->glGenQueries(1, &query);
    gl->glBeginQuery(GL_SAMPLES_PASSED_ARB, query);
    state.pushStateSet(inputs);
    frame.drawSelected(renderInfo, statesOf(Pass::Peel),
                       [&](const SurfaceItem& item)
                       { return isReceiver(item) && !isOpaque(item); });
    state.popStateSet();
    gl->glEndQuery(GL_SAMPLES_PASSED_ARB);
    GLuint passed = 0;
    gl->glGetQueryObjectuiv(query, GL_QUERY_RESULT_ARB, &passed);
    gl->glDeleteQueries(1, &query);
    return passed != 0;
}

void VolumeShadows::resolve(osg::RenderInfo& renderInfo, int bit)
{
    osg::State& state = *renderInfo.getState();
    osg::ref_ptr<osg::StateSet> inputs = new osg::StateSet;
    inputs->setTextureAttribute(ShadowTargets::DepthUnit, _targets->getCounter());
    inputs->addUniform(new osg::Uniform("osgsv_bit", bit));
    inputs->addUniform(new osg::Uniform("osgsv_flippedHeight", _targets->getFlippedHeight()));
    state.pushStateSet(&_resources.passes.get(bit < 0 ? Pass::Clear : Pass::Resolve, _tier));
    state.pushStateSet(inputs);
    state.apply();
    _resources.screen->draw(renderInfo);
    state.popStateSet();
    state.popStateSet();
}

void VolumeShadows::makeMask(osg::RenderInfo& renderInfo, const std::vector<bool>& used, int layer)
{
    osg::State& state = *renderInfo.getState();
    int word = -1;
    for (std::size_t light = 0; light < getLights().size(); ++light)
    {
        const int index = getDecision(light).index;
        if (index < 0 || !used[light])
            continue;
        if (index / 32 != word)
        {
            word = index / 32;
            _targets->bindMask(state, layer, word);
            resolve(renderInfo, -1);
        }
        const ScreenBounds& bounds = getDecision(light).bounds;
        osg::ref_ptr<osg::StateSet> area = new osg::StateSet;
        area->setAttributeAndModes(
            new osg::Scissor(bounds.x, bounds.y, bounds.width, bounds.height),
            osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
        _targets->bindCounter(state, layer);
        state.pushStateSet(area);
        state.apply();
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        state.haveAppliedAttribute(osg::StateAttribute::COLORMASK);
        glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
        glClear(GL_COLOR_BUFFER_BIT);
        {
            // The bounds know nothing of surfaces that are pushed.
            const DepthBounds depths(state, _hasPolygonOffset ? 0.0 : bounds.nearDepth,
                                     _hasPolygonOffset ? 1.0 : bounds.farDepth);
            drawVolumes(renderInfo, light);
        }
        _targets->bindMask(state, layer, word);
        resolve(renderInfo, index % 32);
        state.popStateSet();
        // What clears next, clears all; the next area may come to lie where this one was.
        state.applyMode(GL_SCISSOR_TEST, false);
        state.haveAppliedAttribute(osg::StateAttribute::SCISSOR);
    }
}

const osg::ref_ptr<CasterMesh>& VolumeShadows::getMesh(std::size_t caster)
{
    osg::ref_ptr<CasterMesh>& mesh = _meshes[caster];
    if (!mesh)
        mesh = _resources.casters->get(getCasters()[caster].source);
    return mesh;
}

void VolumeShadows::drawVolumes(osg::RenderInfo& renderInfo, std::size_t light)
{
    const LightDecision& decision = getDecision(light);
    const CasterDraw::View view{renderInfo, _resources,      _technique,
                                _tier,      getProjection(), _frameNumber};
    CasterDraw draw(view, getLights()[light]);
    std::size_t zFail = 0;
    for (bool failing : {false, true})
    {
        for (std::size_t i = 0; i < decision.casters.size(); ++i)
            if (decision.needsZFail[i] == failing)
            {
                draw.add(getMesh(decision.casters[i]), getCasters()[decision.casters[i]].modelview);
                zFail += failing;
            }
        draw.run(failing ? ShadowPasses::Count::ZFail : ShadowPasses::Count::ZPass);
    }
    _drawCalls += draw.getDrawCalls();
    const std::size_t casters = decision.casters.size();
    const TargetLayout& layout = _targets->getLayout();
    const double share = double(decision.bounds.width) * decision.bounds.height /
                         (double(layout.width) * layout.height);
    _descriptions[light] = std::to_string(casters) + (casters == 1 ? " caster" : " casters") +
                           ", z-fail for " + std::to_string(zFail) +
                           ", technique=" + nameOf(_technique) + ", on " +
                           std::to_string(std::lround(100.0 * share)) + " % of the screen";
    if (_tier.samples < _viewSamples)
        _descriptions[light] += ", with " + std::to_string(_tier.samples) + " of " +
                                std::to_string(_viewSamples) + " samples";
}

std::string VolumeShadows::makeSource(bool transparent) const
{
    std::string source = "#define OSGSV_SAMPLES " + std::to_string(_tier.samples) + "\n";
    // Samples of another number lie elsewhere in the pixel.
    if (_tier.language >= 400 && _tier.samples == _viewSamples)
        source += "#define OSGSV_SAMPLE_MASK\n";
    if (transparent)
        source += "#define OSGSV_TRANSPARENT\n";
    osg::ref_ptr<osg::Shader> shader = osgDB::readRefShaderFileWithFallback(
        osg::Shader::FRAGMENT, "osgShadowVolume/visible.frag", shaders::visible_frag);
    return source + shader->getShaderSource();
}

std::vector<std::pair<std::string, int>> VolumeShadows::getSamplers() const
{
    return {{"osgsv_mask", ShadowTargets::MaskUnit}, {"osgsv_layers", ShadowTargets::LayersUnit}};
}

void VolumeShadows::apply(const osg::Program::PerContextProgram& program,
                          const osg::GLExtensions& gl) const
{
    static const unsigned int size = osg::Uniform::getNameID("osgsv_maskSize");
    gl.glUniform3i(program.getUniformLocation(size), _targets ? _targets->getLayout().words : 0,
                   _layers, _targets ? _targets->getFlippedHeight() : 0);
}

std::uint32_t VolumeShadows::getVariantBits() const
{
    if (_tier.samples < _viewSamples && _tier.samples > 1)
        return 7; // as many as the context has, without their coverage
    // Samples are a power of two up to 64.
    std::uint32_t bits = 0;
    for (int samples = _tier.samples; samples > 1; samples /= 2)
        ++bits;
    return bits;
}

void VolumeShadows::showVolumes(osg::RenderInfo& renderInfo)
{
    osg::State& state = *renderInfo.getState();
    GLint viewport[4];
    glGetIntegerv(GL_VIEWPORT, viewport);
    osg::ref_ptr<osg::StateSet> base = new osg::StateSet;
    base->setAttribute(new osg::Viewport(viewport[0], viewport[1], viewport[2], viewport[3]),
                       osg::StateAttribute::OVERRIDE);
    const osgMultiRender::PassState pushed(state, *base);
    const CasterDraw::View view{renderInfo, _resources,      _technique,
                                _tier,      getProjection(), _frameNumber};
    for (std::size_t light = 0; light < getLights().size(); ++light)
    {
        const LightDecision& decision = getDecision(light);
        if (decision.index < 0 || _descriptions[light].empty())
            continue;
        CasterDraw draw(view, getLights()[light]);
        draw.setColor(colorOf(decision.index));
        for (std::uint32_t caster : decision.casters)
            draw.add(getMesh(caster), getCasters()[caster].modelview);
        draw.run(ShadowPasses::Count::Shown);
    }
}

void VolumeShadows::drawn(osg::RenderInfo& renderInfo)
{
    if (_targets && getSettings().show == Show::VOLUMES)
        showVolumes(renderInfo);
    if (_targets)
        _resources.targets.release(_contextID, _targets);
    _targets = nullptr;
    _lookUp = nullptr;
}

std::string VolumeShadows::describe(std::size_t light) const
{
    return _descriptions.empty() ? std::string() : _descriptions[light];
}

void VolumeShadows::fillPlan(osgMultiRender::Plan& plan) const
{
    LightShadows::fillPlan(plan);
    plan.counts["shadows.drawCalls"] = _drawCalls;
    plan.counts["shadows.transparentLayers"] = _layers;
    plan.counts["shadows.bytes"] = _targets ? double(_targets->getBytes()) : 0.0;
}

} // namespace osgShadowVolume
