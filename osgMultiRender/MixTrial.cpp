// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixTrial.h>

#include <osg/GLExtensions>

#include <algorithm>
#include <cmath>

namespace osgMultiRender
{

namespace
{

/// Shader and program objects answer alike.
template <class Get, class GetLog>
std::string logOf(GLuint object, GLenum status, Get get, GetLog getLog)
{
    GLint ok = 0, length = 0;
    get(object, status, &ok);
    get(object, GL_INFO_LOG_LENGTH, &length);
    if (ok)
        return "";
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    getLog(object, length, nullptr, &log[0]);
    log.resize(log.find_last_not_of(std::string("\0\n", 2)) + 1);
    return log.empty() ? "the driver gives no reason" : log;
}

int get(GLenum what, int otherwise)
{
    GLint value = 0;
    glGetIntegerv(what, &value);
    return value > 0 ? value : otherwise;
}

} // namespace

std::string tryProgram(const Merged& merged, osg::State& state)
{
    const auto* gl = state.get<osg::GLExtensions>();
    const GLuint program = gl->glCreateProgram();
    std::string log;
    for (const GLenum type : {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER})
    {
        const std::string& text = type == GL_VERTEX_SHADER ? merged.vertex : merged.fragment;
        const GLchar* lines = text.c_str();
        const GLuint shader = gl->glCreateShader(type);
        gl->glShaderSource(shader, 1, &lines, nullptr);
        gl->glCompileShader(shader);
        if (log.empty())
            log = logOf(shader, GL_COMPILE_STATUS, gl->glGetShaderiv, gl->glGetShaderInfoLog);
        gl->glAttachShader(program, shader);
        gl->glDeleteShader(shader); // when the program goes
    }
    if (log.empty())
    {
        gl->glLinkProgram(program);
        log = logOf(program, GL_LINK_STATUS, gl->glGetProgramiv, gl->glGetProgramInfoLog);
    }
    gl->glDeleteProgram(program);
    return log.empty() ? log : merged.explain(log);
}

MergeLimits limitsOf(osg::State& state, const std::optional<MergeLimits>& most)
{
    const MergeLimits least;
    MergeLimits limits;
    limits.version = int(std::lround(state.get<osg::GLExtensions>()->glslLanguageVersion * 100.0f));
    limits.varyingVectors = get(GL_MAX_VARYING_FLOATS, 4 * least.varyingVectors) / 4;
    // One is the texture of key points.
    limits.fragmentSamplers = get(GL_MAX_TEXTURE_IMAGE_UNITS, least.fragmentSamplers) - 1;
    limits.vertexSamplers = get(GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS, least.vertexSamplers);
    limits.textureUnits = get(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, least.textureUnits) - 1;
    limits.vertexUniformComponents =
        get(GL_MAX_VERTEX_UNIFORM_COMPONENTS, least.vertexUniformComponents);
    // The uniforms of mix.glsl and the matrix of the projection.
    limits.fragmentUniformComponents =
        get(GL_MAX_FRAGMENT_UNIFORM_COMPONENTS, least.fragmentUniformComponents) - 64;
    limits.vertexAttributes = get(GL_MAX_VERTEX_ATTRIBS, least.vertexAttributes);
    if (most)
        for (int MergeLimits::*each :
             {&MergeLimits::version, &MergeLimits::varyingVectors, &MergeLimits::fragmentSamplers,
              &MergeLimits::vertexSamplers, &MergeLimits::textureUnits,
              &MergeLimits::vertexUniformComponents, &MergeLimits::fragmentUniformComponents,
              &MergeLimits::vertexAttributes})
            limits.*each = std::min(limits.*each, (*most).*each);
    return limits;
}

} // namespace osgMultiRender
