// SPDX-License-Identifier: MIT
#include <osgShadowVolume/VolumeProgram.h>

#include <osgShadowVolume/Shaders.h>

#include <osgDB/ReadFile>

#include <vector>

namespace osgShadowVolume
{

namespace
{

struct Stage
{
    VolumePart part;
    osg::Shader::Type type;
    const char* file;
    const char* text;
    bool judges;
};

const std::vector<Stage>& stages()
{
    using osg::Shader;
    static const std::vector<Stage> list = {
        {VolumePart::TESS_SIDES, Shader::VERTEX, "volume.vert", shaders::volume_vert, false},
        {VolumePart::TESS_SIDES, Shader::TESSCONTROL, "volume.tesc", shaders::volume_tesc, true},
        {VolumePart::TESS_SIDES, Shader::TESSEVALUATION, "volume.tese", shaders::volume_tese,
         false},
        {VolumePart::TESS_SIDES, Shader::FRAGMENT, "volume.frag", shaders::volume_frag, false},
        {VolumePart::GEOMETRY_SIDES, Shader::VERTEX, "volume.vert", shaders::volume_vert, false},
        {VolumePart::GEOMETRY_SIDES, Shader::GEOMETRY, "volume.geom", shaders::volume_geom, true},
        {VolumePart::GEOMETRY_SIDES, Shader::FRAGMENT, "volume.frag", shaders::volume_frag, false},
        {VolumePart::CAPS, Shader::VERTEX, "volume.vert", shaders::volume_vert, false},
        {VolumePart::CAPS, Shader::GEOMETRY, "caps.geom", shaders::caps_geom, true},
        {VolumePart::CAPS, Shader::FRAGMENT, "volume.frag", shaders::volume_frag, false},
        {VolumePart::SILHOUETTE, Shader::VERTEX, "silhouette.vert", shaders::silhouette_vert,
         false},
        {VolumePart::SILHOUETTE, Shader::FRAGMENT, "volume.frag", shaders::volume_frag, false},
    };
    return list;
}

/// Found on OSG_FILE_PATH, else the built-in text.
std::string textOf(osg::Shader::Type type, const char* file, const char* builtIn)
{
    osg::ref_ptr<osg::Shader> shader =
        osgDB::readRefShaderFileWithFallback(type, std::string("osgShadowVolume/") + file, builtIn);
    return shader ? shader->getShaderSource() : std::string(builtIn);
}

std::string textOf(const Stage& stage, int glslVersion)
{
    std::string text = "#version " + std::to_string(glslVersion) + " compatibility\n";
    if (glslVersion < 400 && stage.part != VolumePart::SILHOUETTE)
        text += "#extension GL_ARB_gpu_shader5 : require\n"; // for `precise`
    if (stage.judges)
        text += textOf(stage.type, "judge.glsl", shaders::judge_glsl);
    return text + textOf(stage.type, stage.file, stage.text);
}

} // namespace

std::string volumeShaderText(VolumePart part, osg::Shader::Type stage, int glslVersion)
{
    for (const Stage& candidate : stages())
        if (candidate.part == part && candidate.type == stage)
            return textOf(candidate, glslVersion);
    return std::string();
}

osg::ref_ptr<osg::Program> makeVolumeProgram(VolumePart part, int glslVersion, bool shown)
{
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName("osgShadowVolume");
    for (const Stage& stage : stages())
        if (stage.part == part)
        {
            Stage drawn = stage;
            if (shown && stage.type == osg::Shader::FRAGMENT)
            {
                drawn.file = "shown.frag";
                drawn.text = shaders::shown_frag;
            }
            program->addShader(new osg::Shader(stage.type, textOf(drawn, glslVersion)));
        }
    return program;
}

} // namespace osgShadowVolume
