// SPDX-License-Identifier: MIT
#include <osgLabels/MapPrograms.h>

#include <osgLabels/LabelPrograms.h>
#include <osgLabels/MapTargets.h>
#include <osgLabels/Shaders.h>

#include <osgMultiRender/SurfaceSource.h>

#include <osg/BlendEquation>
#include <osg/BlendFunc>
#include <osg/ColorMask>
#include <osg/PolygonMode>
#include <osg/Program>

namespace osgLabels
{

namespace
{

constexpr auto On = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
constexpr auto Off = osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE;

osg::ref_ptr<osg::Program> makeProgram(const MapPrograms::Kind& kind, const std::string& defines)
{
    using osg::Shader;
    const std::string version = osgMultiRender::glslVersionLine(float(kind.language) / 100.0f);
    std::string head = "#define OSGLABELS_LAYERS " + std::to_string(kind.layers) + "\n";
    if (kind.next)
        head += "#define OSGLABELS_NEXT\n";
    if (kind.anchored)
        head += "#define OSGLABELS_ANCHORED\n";
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName("osgLabels map labels");
    program->addShader(new Shader(
        Shader::VERTEX,
        version + defines +
            LabelSources::file(Shader::FRAGMENT, "labelTable.glsl", shaders::labelTable_glsl) +
            LabelSources::file(Shader::VERTEX, "mapLabel.vert", shaders::mapLabel_vert)));
    program->addShader(new Shader(
        Shader::FRAGMENT,
        version + head + LabelSources::text(defines) +
            LabelSources::file(Shader::FRAGMENT, "occlusion.glsl", shaders::occlusion_glsl) +
            LabelSources::file(Shader::FRAGMENT, "mapLabel.frag", shaders::mapLabel_frag)));
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
    stateSet->setAttributeAndModes(makeProgram(kind, defines), On);
    stateSet->setAttributeAndModes(
        new osg::BlendFunc(osg::BlendFunc::ONE, osg::BlendFunc::ONE_MINUS_SRC_ALPHA), On);
    stateSet->setAttribute(new osg::BlendEquation(osg::BlendEquation::FUNC_ADD), On);
    stateSet->setAttribute(new osg::PolygonMode, On);
    stateSet->setAttribute(new osg::ColorMask, On);
    for (GLenum mode : {GL_DEPTH_TEST, GL_CULL_FACE, GL_ALPHA_TEST, GL_STENCIL_TEST,
                        GL_POLYGON_OFFSET_FILL, GL_COLOR_LOGIC_OP, GL_SAMPLE_ALPHA_TO_COVERAGE_ARB})
        stateSet->setMode(mode, Off);
    const std::pair<const char*, int> samplers[] = {{"osgLabels_near", MapTargets::NearUnit},
                                                    {"osgLabels_next", MapTargets::NextUnit},
                                                    {"osgLabels_mapLabels", LabelsUnit}};
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
