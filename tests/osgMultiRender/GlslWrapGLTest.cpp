// SPDX-License-Identifier: MIT
// Wrapped programs compile, link and draw what the unwrapped ones draw.
#include "osgMultiRender/GlslSamples.h"
#include "osgMultiRender/PlainGL.h"

#include <osgMultiRender/GlslWrap.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace osgMultiRender;

namespace
{

// Normals and texture coordinates vary, so that what reads them shows.
constexpr char VertexText[] = R"(#version 120
varying vec2 uv;
void main()
{
    uv = gl_Vertex.xy * 0.5 + 0.5;
    gl_FrontColor = gl_Color;
    gl_TexCoord[0] = gl_MultiTexCoord0;
    gl_Position = gl_Vertex;
}
)";

const GlslVersion Target330{330, GlslVersion::Profile::Compatibility};

class GlslWrapGLTest : public PlainGLTest
{
protected:
    void SetUp() override
    {
        PlainGLTest::SetUp();
        if (hasContext())
        {
            makeTexture();
        }
    }

    /// What every sampler sees.
    void makeTexture()
    {
        glGenTextures(1, &_texture);
        glBindTexture(GL_TEXTURE_2D, _texture);
        std::vector<unsigned char> noise(16 * 16 * 4);
        unsigned int state = 1;
        for (unsigned char& byte : noise)
        {
            state = state * 1664525u + 1013904223u;
            byte = static_cast<unsigned char>(state >> 24);
        }
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 16, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     noise.data());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    }

    /// Values that depend on the name alone.
    static void setUniforms(const PlainProgram& program)
    {
        glUseProgram(program.id());
        GLint count = 0;
        glGetProgramiv(program.id(), GL_ACTIVE_UNIFORMS, &count);
        for (GLint i = 0; i < count; ++i)
        {
            char name[256] = "";
            GLint size = 0;
            GLenum type = 0;
            glGetActiveUniform(program.id(), static_cast<GLuint>(i), sizeof(name), nullptr, &size,
                               &type, name);
            float value = 0.3f;
            for (const char* c = name; *c; ++c)
            {
                value = value * 0.9f + static_cast<float>(*c % 8) * 0.02f;
            }
            const GLint at = glGetUniformLocation(program.id(), name);
            switch (type)
            {
            case GL_FLOAT:
                glUniform1f(at, value);
                break;
            case GL_FLOAT_VEC2:
                glUniform2f(at, value, 1.0f - value);
                break;
            case GL_FLOAT_VEC3:
                glUniform3f(at, value, 1.0f - value, 0.5f);
                break;
            case GL_FLOAT_VEC4:
                glUniform4f(at, value, 1.0f - value, 0.5f, 1.0f);
                break;
            default:
                break;
            }
        }
    }

    GLuint _texture = 0;
};

struct Pair
{
    std::string vertex;
    std::vector<std::string> fragments;
    std::vector<std::pair<const char*, unsigned int>> bindings;
};

bool buildPlain(const Pair& pair, PlainProgram& program)
{
    bool ok = program.add(GL_VERTEX_SHADER, pair.vertex);
    for (const std::string& text : pair.fragments)
    {
        ok = program.add(GL_FRAGMENT_SHADER, text) && ok;
    }
    for (const auto& binding : pair.bindings)
    {
        glBindFragDataLocation(program.id(), binding.second, binding.first);
    }
    return ok && program.link();
}

::testing::AssertionResult buildWrapped(const Pair& pair, int targets, const GlslVersion& target,
                                        PlainProgram& program,
                                        const std::vector<GlslSnippet>& snippets = {})
{
    std::vector<GlslShader> shaders = {{GlslStage::Vertex, pair.vertex}};
    for (const std::string& text : pair.fragments)
    {
        shaders.push_back({GlslStage::Fragment, text});
    }
    GlslWrapped wrapped = wrapProgram(shaders, target);
    if (!wrapped.ok)
    {
        return ::testing::AssertionFailure() << wrapped.errors[0].where.message;
    }
    std::string error;
    std::map<std::string, unsigned int> bindings(pair.bindings.begin(), pair.bindings.end());
    if (!bindOutputs(wrapped.outputs, bindings, error))
    {
        return ::testing::AssertionFailure() << error;
    }
    GlslMainOptions options;
    options.drawBuffers = targets;
    options.snippets = snippets;
    std::string all;
    bool ok = true;
    for (std::size_t i = 0; i < wrapped.texts.size(); ++i)
    {
        ok = program.add(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER, wrapped.texts[i]) && ok;
        all += wrapped.texts[i] + "\n----\n";
    }
    const std::string main = wrapperMain(wrapped.version, wrapped.outputs, options);
    ok = program.add(GL_FRAGMENT_SHADER, main) && ok && program.link();
    return ok ? ::testing::AssertionSuccess()
              : ::testing::AssertionFailure() << program.log() << "\n"
                                              << all << main;
}

/// Pixels of the first picture that are not as in the second.
std::size_t differences(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        // One step: the compiler may order the same arithmetic in another way.
        count += std::abs(int(a[i]) - int(b[i])) > 1 ? 1 : 0;
    }
    return count;
}

std::size_t distinctBytes(const std::vector<unsigned char>& picture)
{
    std::vector<unsigned char> sorted = picture;
    std::sort(sorted.begin(), sorted.end());
    return static_cast<std::size_t>(std::unique(sorted.begin(), sorted.end()) - sorted.begin());
}

std::string readFile(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

TEST_F(GlslWrapGLTest, wrappedSamplesDrawWhatUnwrappedOnesDraw)
{
    ASSERT_GE(glslSamples::fragmentSamples().size(), 25u);
    for (const glslSamples::Sample& sample : glslSamples::fragmentSamples())
    {
        for (const int number : {330, 400, 450})
        {
            SCOPED_TRACE(std::string(sample.name) + " raised to " + std::to_string(number));
            const Pair pair{VertexText, sample.fragments, sample.bindings};
            PlainProgram plain, wrapped;
            ASSERT_TRUE(buildPlain(pair, plain)) << plain.log();
            ASSERT_TRUE(buildWrapped(pair, sample.targets,
                                     {number, GlslVersion::Profile::Compatibility}, wrapped));
            PlainTarget target(sample.targets, sample.integers);
            glBindTexture(GL_TEXTURE_2D, _texture);
            const auto expected = target.draw(plain);
            const auto actual = target.draw(wrapped);
            EXPECT_GE(distinctBytes(expected), 8u) << "the picture shows nothing";
            EXPECT_EQ(differences(expected, actual), 0u);
            EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
        }
    }
}

TEST_F(GlslWrapGLTest, installedShaderDesignerProgramsDrawTheSame)
{
    const char* own = std::getenv("OSGKITS_SHADERDESIGNER");
    const std::filesystem::path folder = own ? own : "/usr/share/meshlab/shaders";
    if (!std::filesystem::is_directory(folder))
    {
        GTEST_SKIP() << folder << " is not there (package meshlab): nothing was compared";
    }
    std::size_t compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
    {
        auto fragment = entry.path();
        if (fragment.extension() != ".frag")
        {
            continue;
        }
        auto vertex = fragment;
        vertex.replace_extension(".vert");
        SCOPED_TRACE(fragment.string());
        const std::string vertexText =
            std::filesystem::exists(vertex) ? readFile(vertex) : std::string(VertexText);
        const Pair pair{vertexText, {readFile(fragment)}, {}};
        PlainProgram plain, wrapped;
        if (!buildPlain(pair, plain))
        {
            continue; // Broken as it is.
        }
        EXPECT_TRUE(buildWrapped(pair, 1, Target330, wrapped));
        PlainTarget target(1, false);
        glBindTexture(GL_TEXTURE_2D, _texture);
        setUniforms(plain);
        const auto expected = target.draw(plain);
        setUniforms(wrapped);
        EXPECT_EQ(differences(expected, target.draw(wrapped)), 0u);
        ++compared;
    }
    EXPECT_GE(compared, 15u);
}

TEST_F(GlslWrapGLTest, snippetsSeeTheUsersColour)
{
    GlslSnippet mark;
    mark.declarations = "layout(location = 1) out vec4 kit_label;";
    mark.statements = "    kit_label = osgmr_out0.bgra;";
    const Pair pair{VertexText, glslSamples::fragmentSamples()[0].fragments, {}};
    PlainProgram program;
    ASSERT_TRUE(buildWrapped(pair, 1, Target330, program, {mark}));
    PlainTarget target(2, false);
    const auto picture = target.draw(program);
    const std::size_t second = picture.size() / 2;
    for (std::size_t i = 0; i < second; i += 4)
    {
        ASSERT_EQ(picture[i], picture[second + i + 2]);
        ASSERT_EQ(picture[i + 2], picture[second + i]);
    }
}

TEST_F(GlslWrapGLTest, compilerMessagesKeepTheUsersLines)
{
    // Without "#version", with it, with a comment before it, and with the user's own "#line".
    const std::vector<std::pair<std::string, int>> cases = {
        {"varying vec2 uv;\n\nvoid main() { gl_FragColor = nowhere; }\n", 3},
        {"#version 120\nvarying vec2 uv;\nvoid main()\n{\n    gl_FragColor = nowhere;\n}\n", 5},
        {"// head\n\n#version 120 /* two\nlines */\n#ifdef GL_unknown\nint i;\n#endif\nvoid "
         "main()\n"
         "{ gl_FragColor = nowhere; }\n",
         9},
        {"#version 120\n#line 99\nvoid main() { gl_FragColor = nowhere; }\n", 100},
        {"#version 330\n#line 99\nout\nvec4 c; void main() { c = nowhere; }\n", 100}};
    for (const auto& [text, line] : cases)
    {
        PlainProgram plain, raised;
        EXPECT_FALSE(plain.add(GL_FRAGMENT_SHADER, text));
        const GlslWrapped wrapped = wrapProgram({{GlslStage::Fragment, text}}, Target330);
        ASSERT_TRUE(wrapped.ok);
        EXPECT_FALSE(raised.add(GL_FRAGMENT_SHADER, wrapped.texts[0]));
        const std::string where = "0:" + std::to_string(line) + "(";
        EXPECT_NE(plain.log().find(where), std::string::npos) << plain.log() << text;
        EXPECT_NE(raised.log().find(where), std::string::npos) << raised.log() << wrapped.texts[0];
    }
}
