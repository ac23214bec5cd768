// SPDX-License-Identifier: MIT
#include <osgLabels/LabelPrograms.h>

#include <osgLabels/LabelTargets.h>
#include <osgLabels/LabelUnits.h>
#include <osgLabels/Placement.h>
#include <osgLabels/Shaders.h>

#include <osgMultiRender/PassState.h>
#include <osgMultiRender/SurfaceSource.h>

#include <osg/Depth>
#include <osgDB/ReadFile>

namespace osgLabels
{

using osgMultiRender::ForcedOff;
using osgMultiRender::ForcedOn;

namespace
{

std::string fragmentText(const std::string& file, const char* builtIn)
{
    return LabelSources::file(osg::Shader::FRAGMENT, file, builtIn);
}

} // namespace

std::string LabelSources::file(osg::Shader::Type type, const std::string& name, const char* builtIn)
{
    osg::ref_ptr<osg::Shader> shader =
        osgDB::readRefShaderFileWithFallback(type, "osgLabels/" + name, builtIn);
    return shader ? shader->getShaderSource() : std::string(builtIn);
}

std::string LabelSources::text(const std::string& defines)
{
    return defines + fragmentText("labelTable.glsl", shaders::labelTable_glsl) +
           fragmentText("coverage.glsl", shaders::coverage_glsl);
}

std::string LabelSources::locate(const std::string& defines)
{
    return text(defines) + placementSource() + fragmentText("locate.glsl", shaders::locate_glsl);
}

std::string LabelSources::surface()
{
    return fragmentText("target.frag", shaders::target_frag);
}

std::string LabelSources::direct()
{
    return fragmentText("direct.frag", shaders::direct_frag);
}

std::string LabelSources::ink()
{
    return fragmentText("ink.glsl", shaders::ink_glsl);
}

const osg::StateSet* LabelPrograms::getComposite(float languageVersion, int samples,
                                                 const std::string& defines)
{
    std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<osg::StateSet>& stateSet =
        _composites[{int(languageVersion * 100.0f), samples, defines}];
    if (stateSet)
        return stateSet.get();
    const std::string version = osgMultiRender::glslVersionLine(languageVersion);
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName("osgLabels second pass");
    program->addShader(new osg::Shader(
        osg::Shader::VERTEX,
        version + LabelSources::file(osg::Shader::VERTEX, "screen.vert", shaders::screen_vert)));
    program->addShader(new osg::Shader(
        osg::Shader::FRAGMENT, version + "#define OSGLABELS_SAMPLES " + std::to_string(samples) +
                                   "\n" + LabelSources::locate(defines) + LabelSources::ink() +
                                   fragmentText("composite.frag", shaders::composite_frag)));
    program->setThreadSafeRefUnref(true);
    stateSet = new osg::StateSet;
    stateSet->setThreadSafeRefUnref(true);
    stateSet->setAttributeAndModes(program, ForcedOn);
    // The result lies at the surfaces' own depths, among those of siblings.
    stateSet->setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, true), ForcedOn);
    for (GLenum mode : {GL_BLEND, GL_CULL_FACE, GL_ALPHA_TEST, GL_POLYGON_OFFSET_FILL,
                        GL_SAMPLE_ALPHA_TO_COVERAGE_ARB})
        stateSet->setMode(mode, ForcedOff);
    const std::pair<const char*, int> samplers[] = {
        {"osgLabels_color", LabelTargets::ColorUnit},
        {"osgLabels_depths", LabelTargets::DepthUnit},
        {"osgLabels_surfaces", LabelTargets::SurfaceUnit},
        {"osgLabels_texCoords", LabelTargets::TexCoordUnit},
        {"osgLabels_changes", LabelTargets::ChangeUnit},
        {"osgLabels_frames", FramesUnit}};
    for (const auto& [name, unit] : samplers)
        stateSet->addUniform(new osg::Uniform(name, unit));
    return stateSet.get();
}

void LabelPrograms::releaseGLObjects(osg::State* state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& [key, stateSet] : _composites)
        stateSet->releaseGLObjects(state);
}

} // namespace osgLabels
