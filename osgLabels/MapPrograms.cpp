// SPDX-License-Identifier: MIT
#include <osgLabels/MapPrograms.h>

#include <osgLabels/LabelPrograms.h>
#include <osgLabels/MapTargets.h>
#include <osgLabels/Shaders.h>

#include <osgMultiRender/PassState.h>
#include <osgMultiRender/SurfaceSource.h>

#include <osg/BlendEquation>
#include <osg/BlendFunc>
#include <osg/ColorMask>
#include <osg/PolygonMode>
#include <osg/Program>

namespace osgLabels
{

using osgMultiRender::ForcedOff;
using osgMultiRender::ForcedOn;

namespace
{

osg::ref_ptr<osg::Program> makeProgram(const MapPrograms::Kind& kind, const std::string& defines)
{
    using osg::Shader;
    const std::string version = osgMultiRender::glslVersionLine(float(kind.language) / 100.0f);
    std::string head = "#define OSGLABELS_LAYERS " + std::to_string(kind.layers) + "\n";
    if (kind.next)
        head += "#define OSGLABELS_NEXT\n";
    if (kind.states)
        head += "#define OSGLABELS_STATES\n";
    if (kind.anchored)
        head += "#define OSGLABELS_ANCHORED\n";
    if (kind.wholly)
        head += "#define OSGLABELS_WHOLLY\n";
    const auto common = [](const char* name, const char* text)
    { return LabelSources::file(Shader::FRAGMENT, name, text); };
    const std::string table = common("labelTable.glsl", shaders::labelTable_glsl);
    const std::string occlusion = common("occlusion.glsl", shaders::occlusion_glsl);
    osg::ref_ptr<osg::Program> program = new osg::Program;
    const auto add = [&](Shader::Type type, const std::string& text)
    { program->addShader(new Shader(type, version + head + text)); };
    if (kind.isTest)
    {
        program->setName("osgLabels states of map labels");
        add(Shader::VERTEX,
            defines + table +
                LabelSources::file(Shader::VERTEX, "mapTest.vert", shaders::mapTest_vert));
        add(Shader::FRAGMENT, occlusion + common("mapTest.frag", shaders::mapTest_frag));
    }
    else
    {
        program->setName("osgLabels map labels");
        add(Shader::VERTEX,
            defines + table +
                LabelSources::file(Shader::VERTEX, "mapLabel.vert", shaders::mapLabel_vert));
        add(Shader::FRAGMENT, LabelSources::text(defines) + occlusion +
                                  common("mapLabel.frag", shaders::mapLabel_frag));
    }
    program->setThreadSafeRefUnref(true);
    return program;
}

} // namespace

const osg::StateSet* MapPrograms::get(const Kind& kind, const std::string& defines)
{
    std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<osg::StateSet>& stateSet = _stateSets[{kind, defines}];
    if (stateSet)
        return stateSet.get();
    stateSet = new osg::StateSet;
    stateSet->setThreadSafeRefUnref(true);
    stateSet->setAttributeAndModes(makeProgram(kind, defines), ForcedOn);
    if (kind.isTest)
    {
        stateSet->setMode(GL_BLEND, ForcedOff);
        stateSet->setMode(GL_STENCIL_TEST, ForcedOff);
        stateSet->setAttribute(new osg::ColorMask, ForcedOn);
    }
    else // masked as the view is
        stateSet->setAttributeAndModes(
            new osg::BlendFunc(osg::BlendFunc::ONE, osg::BlendFunc::ONE_MINUS_SRC_ALPHA), ForcedOn);
    stateSet->setAttribute(new osg::BlendEquation(osg::BlendEquation::FUNC_ADD), ForcedOn);
    stateSet->setAttribute(new osg::PolygonMode, ForcedOn);
    for (GLenum mode : {GL_DEPTH_TEST, GL_CULL_FACE, GL_ALPHA_TEST, GL_POLYGON_OFFSET_FILL,
                        GL_COLOR_LOGIC_OP, GL_SAMPLE_ALPHA_TO_COVERAGE_ARB})
        stateSet->setMode(mode, ForcedOff);
    const std::pair<const char*, int> samplers[] = {{"osgLabels_nearFace", MapTargets::NearUnit},
                                                    {"osgLabels_next", MapTargets::NextUnit},
                                                    {"osgLabels_mapLabels", LabelsUnit},
                                                    {"osgLabels_states", StatesUnit}};
    for (const auto& [name, unit] : samplers)
        stateSet->addUniform(new osg::Uniform(name, unit));
    return stateSet.get();
}

void MapPrograms::releaseGLObjects(osg::State* state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& [key, stateSet] : _stateSets)
        stateSet->releaseGLObjects(state);
}

} // namespace osgLabels
