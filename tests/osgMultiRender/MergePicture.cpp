// SPDX-License-Identifier: MIT
#include "osgMultiRender/MergePicture.h"

#include <algorithm>
#include <cmath>

using namespace osgMultiRender;

namespace
{

constexpr int Units = 12;

unsigned int hashOf(const std::string& text)
{
    unsigned int hash = 2166136261u;
    for (char c : text)
    {
        hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
    }
    return hash;
}

/// 0.1 to 0.9 by name and component.
float valueOf(const std::string& name, int component)
{
    return 0.1f + 0.8f * static_cast<float>(hashOf(name + char('a' + component)) % 1000u) / 1000.0f;
}

void lookUpTexture(unsigned int texture, unsigned int seed)
{
    glBindTexture(GL_TEXTURE_2D, texture);
    std::vector<unsigned char> noise(16 * 16 * 4);
    unsigned int state = seed;
    for (unsigned char& byte : noise)
    {
        state = state * 1664525u + 1013904223u;
        byte = static_cast<unsigned char>(state >> 24);
    }
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 16, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, noise.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glGenerateMipmap(GL_TEXTURE_2D);
}

GLenum stageOf(GlslStage stage)
{
    return stage == GlslStage::Vertex ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER;
}

bool isSampler(GLenum type)
{
    return (type >= GL_SAMPLER_1D && type <= GL_SAMPLER_2D_SHADOW) || type == GL_SAMPLER_2D_RECT;
}

void setOne(GLint at, GLenum type, int count, const std::vector<float>& v)
{
    const std::vector<int> ints(v.begin(), v.end());
    const float* f = v.data();
    switch (type)
    {
    case GL_FLOAT:
        glUniform1fv(at, count, f);
        break;
    case GL_FLOAT_VEC2:
        glUniform2fv(at, count, f);
        break;
    case GL_FLOAT_VEC3:
        glUniform3fv(at, count, f);
        break;
    case GL_FLOAT_VEC4:
        glUniform4fv(at, count, f);
        break;
    case GL_FLOAT_MAT2:
        glUniformMatrix2fv(at, count, GL_FALSE, f);
        break;
    case GL_FLOAT_MAT3:
        glUniformMatrix3fv(at, count, GL_FALSE, f);
        break;
    case GL_FLOAT_MAT4:
        glUniformMatrix4fv(at, count, GL_FALSE, f);
        break;
    case GL_INT_VEC2:
        glUniform2iv(at, count, ints.data());
        break;
    default:
        glUniform1iv(at, count, ints.data());
        break;
    }
}

int componentsOf(GLenum type)
{
    switch (type)
    {
    case GL_FLOAT_VEC2:
    case GL_INT_VEC2:
        return 2;
    case GL_FLOAT_VEC3:
        return 3;
    case GL_FLOAT_VEC4:
    case GL_FLOAT_MAT2:
        return 4;
    case GL_FLOAT_MAT3:
        return 9;
    case GL_FLOAT_MAT4:
        return 16;
    default:
        return 1;
    }
}

/// The shape of the sheet.
void vertex(int i, int j, const std::vector<std::pair<int, unsigned int>>& attributes)
{
    const float u = static_cast<float>(i) / 16.0f, v = static_cast<float>(j) / 16.0f;
    const float x = u * 2.4f - 1.2f, y = v * 2.4f - 1.2f;
    const float z = 0.3f * std::cos(x * 2.0f) * std::cos(y * 2.0f);
    const float dx = -0.6f * std::sin(x * 2.0f) * std::cos(y * 2.0f);
    const float dy = -0.6f * std::cos(x * 2.0f) * std::sin(y * 2.0f);
    for (const auto& [at, seed] : attributes)
    {
        const float k = static_cast<float>(seed % 7u + 1u);
        if (at > 0)
        {
            glVertexAttrib4f(static_cast<GLuint>(at), std::sin(k * x), std::cos(k * y), u, 1.0f);
        }
    }
    glNormal3f(-dx, -dy, 1.0f);
    glColor4f(0.2f + 0.8f * u, 0.9f - 0.5f * v, 0.5f, 1.0f);
    glSecondaryColor3f(v, u, 0.25f);
    glMultiTexCoord2f(GL_TEXTURE0, u * 2.0f, v * 2.0f);
    glMultiTexCoord2f(GL_TEXTURE1, v, u);
    glVertex3f(x, y, z);
}

void setMaterial(GLenum face, const RenderingMaterial& material)
{
    glMaterialfv(face, GL_AMBIENT, material.ambient.data());
    glMaterialfv(face, GL_DIFFUSE, material.diffuse.data());
    glMaterialfv(face, GL_SPECULAR, material.specular.data());
    glMaterialfv(face, GL_EMISSION, material.emission.data());
    glMaterialf(face, GL_SHININESS, material.shininess);
}

/// As GL itself takes them, in eye coordinates.
void setLighting(const RenderingState& state)
{
    glMatrixMode(GL_MODELVIEW);
    glPushMatrix();
    glLoadIdentity();
    for (const RenderingLight& light : state.lights)
    {
        const GLenum name = GL_LIGHT0 + light.number;
        glLightfv(name, GL_AMBIENT, light.ambient.data());
        glLightfv(name, GL_DIFFUSE, light.diffuse.data());
        glLightfv(name, GL_SPECULAR, light.specular.data());
        glLightfv(name, GL_POSITION, light.position.data());
        glLightfv(name, GL_SPOT_DIRECTION, light.spotDirection.data());
        glLightf(name, GL_SPOT_EXPONENT, light.spotExponent);
        glLightf(name, GL_SPOT_CUTOFF, light.spotCutoff);
        glLightf(name, GL_CONSTANT_ATTENUATION, light.attenuation[0]);
        glLightf(name, GL_LINEAR_ATTENUATION, light.attenuation[1]);
        glLightf(name, GL_QUADRATIC_ATTENUATION, light.attenuation[2]);
    }
    glPopMatrix();
    if (state.hasMaterials)
    {
        glLightModelfv(GL_LIGHT_MODEL_AMBIENT, state.modelAmbient.data());
        setMaterial(GL_FRONT, state.front);
        setMaterial(GL_BACK, state.back);
    }
}

void setFixedState()
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.5, 0.5, -0.5, 0.5, 1.0, 10.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    const GLfloat light[] = {0.4f, 0.5f, 1.0f, 0.0f};
    glLightfv(GL_LIGHT0, GL_POSITION, light);
    const GLfloat fog[] = {0.3f, 0.4f, 0.5f, 1.0f};
    glFogfv(GL_FOG_COLOR, fog);
    glTranslatef(0.0f, 0.0f, -2.4f);
    glRotatef(20.0f, 1.0f, 1.0f, 0.0f);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
}

} // namespace

MergeStudio::MergeStudio() : _textures(Units)
{
    glGenFramebuffers(1, &_frame);
    glBindFramebuffer(GL_FRAMEBUFFER, _frame);
    glGenTextures(1, &_color);
    glBindTexture(GL_TEXTURE_2D, _color);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, MergePicture::Size, MergePicture::Size);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, _color, 0);
    glGenRenderbuffers(1, &_depth);
    glBindRenderbuffer(GL_RENDERBUFFER, _depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, MergePicture::Size,
                          MergePicture::Size);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, _depth);
    glViewport(0, 0, MergePicture::Size, MergePicture::Size);
    glGenTextures(Units, _textures.data());
}

MergeStudio::~MergeStudio()
{
    glDeleteTextures(Units, _textures.data());
    glDeleteFramebuffers(1, &_frame);
    glDeleteTextures(1, &_color);
    glDeleteRenderbuffers(1, &_depth);
}

std::string MergeStudio::weights(std::size_t count)
{
    // Tents over the columns: two renderings at most have weight at a pixel.
    return "float osgmr_weight(int rendering)\n{\n    float at = floor(gl_FragCoord.x) * " +
           std::to_string(count - 1) +
           ".0 / 63.0;\n"
           "    return clamp(1.0 - abs(at - float(rendering)), 0.0, 1.0);\n}\n";
}

double MergeStudio::weight(std::size_t rendering, std::size_t count, int column)
{
    const double at = column * static_cast<double>(count - 1) / 63.0;
    return std::min(std::max(1.0 - std::abs(at - static_cast<double>(rendering)), 0.0), 1.0);
}

MergePicture MergeStudio::drawAlone(const Rendering& rendering)
{
    MergePicture picture;
    PlainProgram program;
    bool compiled = true;
    for (const RenderingShader& shader : rendering.shaders)
    {
        compiled = program.add(stageOf(shader.stage), shader.text) && compiled;
    }
    for (const auto& [name, location] : rendering.attributeBindings)
    {
        glBindAttribLocation(program.id(), location, name.c_str());
    }
    for (const auto& [name, location] : rendering.fragmentDataBindings)
    {
        glBindFragDataLocation(program.id(), location, name.c_str());
    }
    if (!compiled || !program.link())
    {
        picture.log = program.log();
        return picture;
    }
    glUseProgram(program.id());
    setUniforms(program, rendering, 0, nullptr);
    setTextures(rendering, nullptr, {});
    std::vector<std::pair<int, unsigned int>> attributes;
    GLint count = 0;
    glGetProgramiv(program.id(), GL_ACTIVE_ATTRIBUTES, &count);
    for (GLint i = 0; i < count; ++i)
    {
        char name[256] = "";
        GLint size = 0;
        GLenum type = 0;
        glGetActiveAttrib(program.id(), GLuint(i), sizeof name, nullptr, &size, &type, name);
        attributes.emplace_back(glGetAttribLocation(program.id(), name), hashOf(name));
    }
    const RenderingState& state = rendering.state;
    (state.alphaTest ? glEnable : glDisable)(GL_ALPHA_TEST);
    glAlphaFunc(state.alphaFunction, state.alphaReference);
    picture = draw(program, attributes);
    glDisable(GL_ALPHA_TEST);
    picture.log = program.log();
    return picture;
}

MergePicture MergeStudio::drawUnderOwnLighting(const Rendering& rendering)
{
    glPushAttrib(GL_LIGHTING_BIT);
    _lighting = &rendering.state;
    MergePicture picture = drawAlone(rendering);
    _lighting = nullptr;
    glPopAttrib();
    return picture;
}

MergePicture MergeStudio::drawMerged(const Merged& merged, const std::vector<MergeEntry>& entries)
{
    MergePicture picture;
    PlainProgram program;
    const bool vertex = program.add(GL_VERTEX_SHADER, merged.vertex);
    const bool fragment = program.add(GL_FRAGMENT_SHADER, merged.fragment);
    if (!vertex || !fragment || !program.link())
    {
        picture.log = merged.explain(program.log());
        return picture;
    }
    glUseProgram(program.id());
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
        setUniforms(program, *entries[i].rendering, i, &merged);
    }
    setTextures(Rendering(), &merged, entries);
    std::vector<std::pair<int, unsigned int>> attributes;
    for (const MergedAttribute& one : merged.attributes)
    {
        const int at = glGetAttribLocation(program.id(), one.merged.c_str());
        attributes.emplace_back(at, hashOf(one.name));
    }
    picture = draw(program, attributes);
    picture.log = merged.explain(program.log());
    return picture;
}

void MergeStudio::setUniforms(const PlainProgram& program, const Rendering& rendering,
                              std::size_t index, const Merged* merged)
{
    // What the rendering alone declares tells names, types and sizes.
    PlainProgram own;
    const PlainProgram* asked = &program;
    if (merged)
    {
        for (const RenderingShader& shader : rendering.shaders)
        {
            own.add(stageOf(shader.stage), shader.text);
        }
        asked = &own;
        own.link();
        glUseProgram(program.id());
    }
    GLint uniforms = 0;
    glGetProgramiv(asked->id(), GL_ACTIVE_UNIFORMS, &uniforms);
    for (GLint i = 0; i < uniforms; ++i)
    {
        char buffer[256] = "";
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(asked->id(), GLuint(i), sizeof buffer, nullptr, &size, &type, buffer);
        const std::string full = buffer;
        const bool array = full.size() > 3 && full.compare(full.size() - 3, 3, "[0]") == 0;
        const std::string name = array ? full.substr(0, full.size() - 3) : full;
        const std::string there = merged ? merged->nameOf(index, name) : name;
        const GLint at = glGetUniformLocation(program.id(), there.c_str());
        const RenderingUniform* known = rendering.findUniform(name);
        if (at < 0 || name.compare(0, 3, "gl_") == 0)
        {
            continue;
        }
        const int components = componentsOf(type) * size;
        std::vector<float> values;
        for (int c = 0; c < components; ++c)
        {
            const auto component = static_cast<std::size_t>(c);
            const bool given = known && component < known->values.size();
            values.push_back(given ? float(known->values[component]) : valueOf(name, c));
        }
        if (isSampler(type) && merged)
        {
            const MergedUniform* uniform = merged->findUniform(index, name);
            values.assign(uniform->units.begin(), uniform->units.end());
        }
        else if (isSampler(type) && !(known && !known->values.empty()))
        {
            continue;
        }
        setOne(at, type, size, values);
    }
}

void MergeStudio::setTextures(const Rendering& rendering, const Merged* merged,
                              const std::vector<MergeEntry>& entries)
{
    for (unsigned int unit = 0; unit < Units; ++unit)
    {
        const RenderingTexture* texture = rendering.findTexture(unit);
        unsigned int seed = texture ? hashOf(texture->fileName) : unit + 1;
        for (std::size_t i = 0; merged && i < merged->textures.size(); ++i)
        {
            const MergedTexture& one = merged->textures[i];
            if (one.unit == unit)
            {
                texture = entries[one.rendering].rendering->findTexture(one.ownUnit);
                seed = one.own ? hashOf(texture->fileName) : one.ownUnit + 1;
            }
        }
        glActiveTexture(GL_TEXTURE0 + unit);
        lookUpTexture(_textures[unit], seed);
    }
    glActiveTexture(GL_TEXTURE0);
}

MergePicture MergeStudio::draw(const PlainProgram& program,
                               const std::vector<std::pair<int, unsigned int>>& attributes)
{
    glBindFramebuffer(GL_FRAMEBUFFER, _frame);
    const GLfloat empty[] = {0.0f, 0.0f, 0.0f, MergePicture::Empty};
    const GLfloat far = 1.0f;
    glClearBufferfv(GL_COLOR, 0, empty);
    glClearBufferfv(GL_DEPTH, 0, &far);
    setFixedState();
    if (_lighting)
    {
        setLighting(*_lighting);
    }
    glUseProgram(program.id());
    for (int i = 0; i < 16; ++i)
    {
        glBegin(GL_TRIANGLE_STRIP);
        for (int j = 0; j <= 16; ++j)
        {
            vertex(i, j, attributes);
            vertex(i + 1, j, attributes);
        }
        glEnd();
    }
    glUseProgram(0);
    MergePicture picture;
    const std::size_t pixels = std::size_t(MergePicture::Size) * MergePicture::Size;
    picture.colors.resize(pixels * 4);
    picture.depths.resize(pixels);
    glReadPixels(0, 0, MergePicture::Size, MergePicture::Size, GL_RGBA, GL_FLOAT,
                 picture.colors.data());
    glReadPixels(0, 0, MergePicture::Size, MergePicture::Size, GL_DEPTH_COMPONENT, GL_FLOAT,
                 picture.depths.data());
    picture.ok = glGetError() == GL_NO_ERROR;
    return picture;
}

MergeDifference MergeStudio::compare(const MergePicture& merged,
                                     const std::vector<MergePicture>& alone)
{
    MergeDifference result;
    for (std::size_t pixel = 0; pixel < merged.depths.size(); ++pixel)
    {
        const int column = static_cast<int>(pixel % MergePicture::Size);
        double sum[4] = {0, 0, 0, 0}, depth = 0.0;
        for (std::size_t i = 0; i < alone.size(); ++i)
        {
            const double w = weight(i, alone.size(), column);
            if (w > 0.0 && alone[i].covered(pixel))
            {
                for (std::size_t c = 0; c < 3; ++c)
                {
                    sum[c] += w * static_cast<double>(alone[i].colors[pixel * 4 + c]);
                }
                sum[3] += w;
                depth += w * static_cast<double>(alone[i].depths[pixel]);
            }
        }
        if ((sum[3] > 0.0) != merged.covered(pixel))
        {
            ++result.beside;
            continue;
        }
        result.covered += sum[3] > 0.0 ? 1 : 0;
        for (std::size_t c = 0; c < 4 && sum[3] > 0.0; ++c)
        {
            const double expected = std::min(std::max(sum[c], 0.0), 1.0);
            const double off = std::abs(expected - double(merged.colors[pixel * 4 + c]));
            result.worst = std::isnan(off) ? 1e9 : std::max(result.worst, off);
        }
        const double mean = sum[3] > 0.0 ? depth / sum[3] : 1.0;
        result.worstDepth =
            std::max(result.worstDepth, std::abs(mean - double(merged.depths[pixel])));
    }
    return result;
}
