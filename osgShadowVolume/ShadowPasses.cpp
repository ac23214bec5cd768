// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowPasses.h>

#include <osgShadowVolume/Shaders.h>
#include <osgShadowVolume/ShadowTargets.h>
#include <osgShadowVolume/VolumeProgram.h>

#include <osg/BlendEquation>
#include <osg/BlendFunc>
#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/LogicOp>
#include <osg/Multisample>
#include <osg/PolygonOffset>
#include <osg/Program>
#include <osg/Uniform>
#include <osgDB/ReadFile>

#ifndef GL_DEPTH_CLAMP
#define GL_DEPTH_CLAMP 0x864F
#endif

namespace osgShadowVolume
{

namespace
{

using Pass = ShadowPasses::Pass;

constexpr auto On = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
constexpr auto Off = osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE;

bool isVolume(Pass pass)
{
    return pass >= Pass::TessSides;
}

bool isCaps(Pass pass)
{
    return pass == Pass::GeometryCaps || pass == Pass::TriangleCaps;
}

VolumePart partOf(Pass pass)
{
    switch (pass)
    {
    case Pass::TessSides:
        return VolumePart::TESS_SIDES;
    case Pass::GeometrySides:
        return VolumePart::GEOMETRY_SIDES;
    case Pass::GeometryCaps:
        return VolumePart::CAPS;
    default:
        return VolumePart::SILHOUETTE;
    }
}

/// State in which leaves are drawn once more, over their own.
void setDepthState(osg::StateSet& state, bool masked)
{
    // Without a colour there is no alpha that would say what is covered.
    if (!masked)
        state.setMode(GL_SAMPLE_ALPHA_TO_COVERAGE_ARB, Off);
    state.setAttribute(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, true), On);
    state.setAttribute(new osg::ColorMask, On);
    for (GLenum mode : {GL_BLEND, GL_COLOR_LOGIC_OP, GL_STENCIL_TEST})
        state.setMode(mode, Off);
}

void setScreenState(osg::StateSet& state, bool combine)
{
    for (GLenum mode : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_STENCIL_TEST, GL_ALPHA_TEST})
        state.setMode(mode, Off);
    state.setAttribute(new osg::ColorMask, On);
    state.setAttributeAndModes(new osg::LogicOp(osg::LogicOp::OR), combine ? On : Off);
    state.addUniform(new osg::Uniform("osgsv_counter", ShadowTargets::DepthUnit));
}

void setVolumeState(osg::StateSet& state, ShadowPasses::Count count, bool caps)
{
    const bool zFail = count == ShadowPasses::Count::ZFail;
    const bool shown = count == ShadowPasses::Count::Shown;
    // What fails LESS passes GEQUAL: a blended count has no operation for failing fragments.
    state.setAttributeAndModes(
        new osg::Depth(zFail ? osg::Depth::GEQUAL : osg::Depth::LESS, 0.0, 1.0, false), On);
    // Nothing of a volume may be lost before the near or behind the far plane. Under z-pass no
    // volume comes near the near plane, and what lies before it must not count.
    state.setMode(GL_DEPTH_CLAMP, zFail ? On : Off);
    state.setAttributeAndModes(
        shown ? new osg::BlendFunc(osg::BlendFunc::SRC_ALPHA, osg::BlendFunc::ONE_MINUS_SRC_ALPHA)
              : new osg::BlendFunc(osg::BlendFunc::ONE, osg::BlendFunc::ONE),
        On);
    state.setAttribute(new osg::BlendEquation(osg::BlendEquation::FUNC_ADD), On);
    state.setAttribute(new osg::ColorMask, On);
    for (GLenum mode : {GL_CULL_FACE, GL_STENCIL_TEST, GL_ALPHA_TEST, GL_COLOR_LOGIC_OP})
        state.setMode(mode, Off);
    // A near cap lies in the surface that casts. It has to count as behind it, so that a surface
    // is in its own shadow exactly where light comes from behind. A small share of the slope makes
    // up for what two rasterizations of one triangle differ by; a whole one would push caps that
    // the near plane cuts behind other surfaces.
    if (caps)
        state.setAttributeAndModes(new osg::PolygonOffset(1.0f / 64.0f, 4.0f), On);
}

struct Stage
{
    osg::Shader::Type type;
    const char* file;
    const char* text;
};

std::vector<Stage> stagesOf(Pass pass)
{
    using osg::Shader;
    const Stage depth{Shader::VERTEX, "depth.vert", shaders::depth_vert};
    const Stage peel{Shader::FRAGMENT, "peel.frag", shaders::peel_frag};
    const Stage screen{Shader::VERTEX, "resolve.vert", shaders::resolve_vert};
    const Stage resolve{Shader::FRAGMENT, "resolve.frag", shaders::resolve_frag};
    switch (pass)
    {
    case Pass::Depth:
    case Pass::Peel:
        return {depth, peel};
    case Pass::Clear:
    case Pass::Resolve:
        return {screen, resolve};
    default:
        return {};
    }
}

std::string headOf(Pass pass, const ShadowPasses::Tier& tier)
{
    std::string head = "#version " + std::to_string(tier.language) + " compatibility\n";
    if (tier.language < 400)
        head += "#extension GL_ARB_gpu_shader5 : enable\n"
                "#extension GL_ARB_sample_shading : enable\n";
    head += "#define OSGSV_SAMPLES " + std::to_string(tier.samples) + "\n";
    if (pass == Pass::Peel)
        head += "#define OSGSV_PEEL\n";
    return head;
}

} // namespace

const osg::StateSet& ShadowPasses::get(Pass pass, const Tier& tier, Count count)
{
    return get(Key{pass, tier, count, {}});
}

const osg::StateSet& ShadowPasses::getFor(Pass pass, const Tier& tier, const std::string* instance)
{
    const bool placesVertices = !stagesOf(pass).empty();
    return get(
        Key{pass, tier, Count::ZPass, instance && placesVertices ? *instance : std::string()});
}

const osg::StateSet& ShadowPasses::get(const Key& key)
{
    std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<osg::StateSet>& state = _states[key];
    if (!state)
        state = make(key);
    return *state;
}

osg::ref_ptr<osg::StateSet> ShadowPasses::make(const Key& key)
{
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    state->setThreadSafeRefUnref(true);
    if (osg::ref_ptr<osg::Program> program = makeProgram(key))
        state->setAttribute(program, On);
    if (isVolume(key.pass))
        setVolumeState(*state, key.count, isCaps(key.pass));
    else if (key.pass == Pass::Clear || key.pass == Pass::Resolve)
        setScreenState(*state, key.pass == Pass::Resolve);
    else
        setDepthState(*state, key.pass == Pass::Masked);
    if (key.pass == Pass::Peel)
    {
        state->addUniform(new osg::Uniform("osgsv_depth", ShadowTargets::DepthUnit));
        state->addUniform(new osg::Uniform("osgsv_opaqueDepth", ShadowTargets::OpaqueDepthUnit));
    }
    return state;
}

osg::ref_ptr<osg::Program> ShadowPasses::makeProgram(const Key& key)
{
    if (isVolume(key.pass))
        return makeVolumeProgram(partOf(key.pass), key.tier.language, key.count == Count::Shown);
    const std::vector<Stage> stages = stagesOf(key.pass);
    if (stages.empty())
        return nullptr;
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setThreadSafeRefUnref(true);
    for (const Stage& stage : stages)
    {
        std::string head = headOf(key.pass, key.tier);
        if (stage.type == osg::Shader::VERTEX && !key.instance.empty())
            head += "#define OSGSV_INSTANCE\n" + key.instance;
        osg::ref_ptr<osg::Shader> text = osgDB::readRefShaderFileWithFallback(
            stage.type, std::string("osgShadowVolume/") + stage.file, stage.text);
        osg::ref_ptr<osg::Shader> shader =
            new osg::Shader(stage.type, head + text->getShaderSource());
        shader->setName(std::string("osgShadowVolume/") + stage.file);
        program->addShader(shader);
    }
    program->setName(std::string("osgShadowVolume ") + stages.back().file);
    return program;
}

void ShadowPasses::releaseGLObjects(osg::State* state) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& [key, stateSet] : _states)
        stateSet->releaseGLObjects(state);
}

} // namespace osgShadowVolume
