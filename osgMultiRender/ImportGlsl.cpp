// SPDX-License-Identifier: MIT
// Pairs of GLSL files, and what comments and side files say of their uniforms.
#include <osgMultiRender/Import.h>

#include <osgMultiRender/GlslExpand.h>
#include <osgMultiRender/GlslSource.h>
#include <osgMultiRender/ImportFile.h>

#include <algorithm>
#include <filesystem>

namespace osgMultiRender
{

namespace
{

/// "wood.png" in quotes from `at` on; empty if none stands there.
std::string quoted(const std::string& text, std::size_t at)
{
    at = text.find_first_not_of(" \t", at);
    if (at == std::string::npos || text[at] != '"')
    {
        return "";
    }
    const std::size_t end = text.find('"', at + 1);
    return end == std::string::npos ? "" : text.substr(at + 1, end - at - 1);
}

/// A unit that no texture of the rendering has yet.
unsigned int freeUnit(const Rendering& rendering)
{
    unsigned int unit = 0;
    while (rendering.findTexture(unit))
    {
        ++unit;
    }
    return unit;
}

/// Reads "1, 0.5, 0 min 0 max 1", "1, 0.5, 0 [0, 1]" or a file's name.
void readValues(Rendering& rendering, RenderingUniform& uniform, const std::string& text,
                std::size_t at)
{
    const std::string file = quoted(text, at);
    if (!file.empty())
    {
        RenderingTexture texture;
        texture.fileName = pathBeside(rendering, file);
        texture.unit = freeUnit(rendering);
        uniform.values = {static_cast<double>(texture.unit)};
        rendering.textures.push_back(texture);
        return;
    }
    std::vector<double> values = readNumbers(text, at);
    if (!values.empty())
    {
        uniform.values = std::move(values);
    }
    const std::size_t bracket = text.find_first_not_of(" \t", at);
    if (bracket != std::string::npos && text[bracket] == '[') // = 40 [1, 200]
    {
        at = bracket + 1;
        const std::vector<double> both = readNumbers(text, at);
        if (both.size() == 2)
        {
            uniform.minimum = both[0];
            uniform.maximum = both[1];
        }
        return;
    }
    const std::pair<const char*, double*> bounds[] = {{"min", &uniform.minimum},
                                                      {"max", &uniform.maximum}};
    for (const auto& [word, target] : bounds)
    {
        std::size_t found = text.find(word, at);
        if (found != std::string::npos)
        {
            found += 3;
            const std::vector<double> bound = readNumbers(text, found);
            *target = bound.empty() ? *target : bound[0];
        }
    }
}

/// The values of "= vec3(1.0, 0.5, 0.0)".
void readInitializer(const GlslSource& source, const GlslRange& range, RenderingUniform& uniform)
{
    const std::string text = source.spell(range);
    std::size_t at = text.find('(');
    at = at == std::string::npos ? 0 : at + 1;
    std::vector<double> values = readNumbers(text, at);
    // "a * 2.0" is no value that we can give.
    const bool whole = text.find_first_not_of(" )", at) == std::string::npos;
    if (whole && uniform.values.empty())
    {
        uniform.values = std::move(values);
    }
}

void readShaderUniforms(Rendering& rendering, const std::string& text)
{
    const GlslSource source = parseGlsl(expandGlsl(text, rendering.defines).text);
    for (const GlslDeclaration& one : source.declarations)
    {
        const GlslSpecifiers& specifiers = source.specifiersOf(one);
        if (one.kind != GlslDeclaration::Kind::Global || !specifiers.has("uniform") ||
            specifiers.type.empty())
        {
            continue;
        }
        RenderingUniform& uniform = uniformOf(rendering, one.name);
        uniform.type = specifiers.type;
        readInitializer(source, one.initializer, uniform);
        const unsigned int line = source.tokens[one.nameToken].line;
        for (std::size_t i = one.nameToken;
             i < source.tokens.size() && source.tokens[i].line == line; ++i)
        {
            const std::string comment(source.word(i));
            const std::size_t equals = comment.find_first_not_of("/*! \t");
            if (source.tokens[i].kind == GlslToken::Kind::Comment && equals != std::string::npos &&
                comment[equals] == '=')
            {
                readValues(rendering, uniform, comment, equals + 1);
            }
        }
    }
}

void addShader(Rendering& rendering, GlslStage stage, const std::string& fileName)
{
    RenderingShader shader;
    std::string error;
    shader.stage = stage;
    shader.fileName = fileName;
    if (readTextFile(fileName, shader.text, error))
    {
        rendering.shaders.push_back(std::move(shader));
    }
    else
    {
        rendering.messages.push_back({true, fileName + ": " + error});
    }
}

bool definesMainImage(const std::string& text)
{
    const GlslSource source = parseGlsl(text);
    return source.findFunction("mainImage") && !source.findFunction("main");
}

} // namespace

void readUniformComments(Rendering& rendering)
{
    for (const RenderingShader& shader : rendering.shaders)
    {
        readShaderUniforms(rendering, shader.text);
    }
}

void readUniformFile(Rendering& rendering, const std::string& text, const std::string& fileName)
{
    std::size_t line = 0;
    for (std::size_t at = 0; at < text.size(); ++line)
    {
        const std::size_t end = std::min(text.find_first_of("\n", at), text.size());
        const std::string one = text.substr(at, end - at);
        at = end + 1;
        const std::size_t first = one.find_first_not_of(" \t\r");
        if (first == std::string::npos || one[first] == '#' || one.compare(first, 2, "//") == 0)
        {
            continue;
        }
        const std::size_t equals = one.find('=');
        const std::size_t last =
            equals == std::string::npos ? equals : one.find_last_not_of(" \t", equals - 1);
        if (equals == std::string::npos || equals == first || last == std::string::npos)
        {
            rendering.messages.push_back(
                {false, fileName + ":" + std::to_string(line + 1) + ": not 'name = values'"});
            continue;
        }
        readValues(rendering, uniformOf(rendering, one.substr(first, last - first + 1)), one,
                   equals + 1);
    }
}

Rendering importGlsl(const std::string& vertexFile, const std::string& fragmentFile)
{
    Rendering rendering;
    rendering.fileName = fragmentFile.empty() ? vertexFile : fragmentFile;
    rendering.name = baseName(rendering.fileName);
    if (!vertexFile.empty())
    {
        addShader(rendering, GlslStage::Vertex, vertexFile);
    }
    if (!fragmentFile.empty())
    {
        addShader(rendering, GlslStage::Fragment, fragmentFile);
    }
    readUniformComments(rendering);
    const std::string side =
        std::filesystem::path(rendering.fileName).replace_extension(".uniforms").string();
    std::string text, error;
    std::error_code code;
    if (std::filesystem::exists(side, code) && readTextFile(side, text, error))
    {
        readUniformFile(rendering, text, side);
    }
    return rendering;
}

Rendering importRendering(const std::string& fileName)
{
    namespace fs = std::filesystem;
    const fs::path path(fileName);
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
    std::string text, error;
    if (!readTextFile(fileName, text, error))
    {
        Rendering missing;
        missing.name = baseName(fileName);
        missing.fileName = fileName;
        say(missing, true, error);
        return missing;
    }
    if (extension == ".gdp")
    {
        return importShaderDesigner(text, fileName);
    }
    const bool vertex = extension == ".vert" || extension == ".vs";
    if (!vertex && definesMainImage(text))
    {
        return importShadertoy(text, fileName);
    }
    if (extension != ".frag" && extension != ".fs" && extension != ".glsl" && !vertex)
    {
        Rendering unknown;
        unknown.name = baseName(fileName);
        unknown.fileName = fileName;
        say(unknown, true,
            "not a file that can be imported: .gdp, .vert, .frag, .vs, .fs or .glsl");
        return unknown;
    }
    const bool shortNames = extension == ".vs" || extension == ".fs";
    const std::string other = fs::path(path)
                                  .replace_extension(vertex ? (shortNames ? ".fs" : ".frag")
                                                            : (shortNames ? ".vs" : ".vert"))
                                  .string();
    std::error_code code;
    const std::string beside = fs::exists(other, code) ? other : "";
    return vertex ? importGlsl(fileName, beside) : importGlsl(beside, fileName);
}

} // namespace osgMultiRender
