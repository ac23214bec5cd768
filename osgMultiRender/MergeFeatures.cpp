// SPDX-License-Identifier: MIT
// What the code of a rendering uses: built-ins, their sizes, derivatives, discard.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

bool startsWith(std::string_view word, std::string_view prefix)
{
    return word.substr(0, prefix.size()) == prefix;
}

/// Texture lookups that choose the level by derivatives, and what takes derivatives itself.
bool takesDerivatives(std::string_view word)
{
    const auto starts = [&](std::string_view prefix) { return startsWith(word, prefix); };
    const auto holds = [&](std::string_view part)
    { return word.find(part) != std::string_view::npos; };
    if (starts("dFd") || starts("fwidth") || starts("textureQueryL"))
    {
        return true;
    }
    const bool lookup = starts("texture") || starts("shadow1D") || starts("shadow2D");
    return lookup && builtinFunctionSince(word) && !holds("Lod") && !holds("Grad") &&
           !holds("Size") && !holds("Gather") && !holds("Samples") && !holds("Levels");
}

/// The size that "gl_TexCoord[2]" asks for.
void takeIndex(MergeStage& stage, const GlslSource& source, std::size_t token)
{
    const std::string_view word = source.word(token);
    if (word != "gl_TexCoord" && word != "gl_FragData" && word != "gl_ClipDistance")
    {
        return;
    }
    std::size_t open = token + 1;
    while (open < source.tokens.size() && source.tokens[open].blank())
    {
        ++open;
    }
    std::size_t close = open;
    while (close < source.tokens.size() && source.word(close) != "]" && close < open + 16)
    {
        ++close;
    }
    bool known = false;
    const long long index =
        open < close && source.word(open) == "[" ? constantOf(source, open + 1, close, known) : 0;
    // An index that varies, or the whole array: all that contexts have.
    const int last = known && index >= 0 && index < 32 ? static_cast<int>(index) : 7;
    if (word == "gl_TexCoord")
    {
        for (int i = known ? last : 0; i <= last; ++i)
        {
            stage.texCoords.insert(i);
        }
        return;
    }
    int& size = word == "gl_FragData" ? stage.fragData : stage.clipDistances;
    size = std::max(size, last + 1);
}

/// What can't be merged whatever it is used for.
void refuse(MergeProgram& program, const MergeShader& shader, std::size_t token,
            const std::vector<MergedFile>& files)
{
    const std::string_view word = shader.source.word(token);
    if (startsWith(word, "interpolateAt"))
    {
        program.fail(files, shader, token,
                     std::string(word) + " can't be merged: varyings are packed");
    }
    if (startsWith(word, "gl_SecondaryFragData") || startsWith(word, "gl_SecondaryFragColor"))
    {
        program.fail(files, shader, token, "dual-source blending can't be merged");
    }
}

} // namespace

void findFeatures(MergeProgram& program, MergeStage& stage, const MergeShader& shader,
                  const std::vector<MergedFile>& files)
{
    const bool isFragment = &stage == &program.fragment;
    const GlslSource& source = shader.source;
    for (std::size_t i = 0; i < source.tokens.size(); ++i)
    {
        const std::string_view word = source.word(i);
        if (source.tokens[i].kind == GlslToken::Kind::Keyword)
        {
            program.discards = program.discards || (isFragment && word == "discard");
            continue;
        }
        const GlslUse& use = source.uses[i];
        const bool isVariable =
            use.kind == GlslUse::Kind::Global || use.kind == GlslUse::Kind::BlockMember;
        const bool isUsed = isVariable && source.declarations[use.target].nameToken != i;
        if (isUsed)
        {
            stage.usedGlobals.emplace(word);
        }
        // Redeclared ones are globals: "varying vec4 gl_TexCoord[2];".
        const bool isRedeclared =
            isUsed && use.kind == GlslUse::Kind::Global && startsWith(word, "gl_");
        if (use.kind != GlslUse::Kind::Builtin && !isRedeclared)
        {
            continue;
        }
        program.derivatives = program.derivatives || (isFragment && takesDerivatives(word));
        if (startsWith(word, "gl_") || word == "ftransform")
        {
            stage.usedBuiltins.emplace(word);
            takeIndex(stage, source, i);
        }
        refuse(program, shader, i, files);
    }
}

void findDiscards(MergeProgram& program)
{
    for (const MergeShader& shader : program.fragment.shaders)
    {
        const GlslSource& source = shader.source;
        for (const GlslFunction& function : source.functions)
        {
            for (std::size_t i = function.body.first;
                 function.name != "main" && i < function.body.last; ++i)
            {
                program.discardsInLoops =
                    program.discardsInLoops || (source.tokens[i].kind == GlslToken::Kind::Keyword &&
                                                source.word(i) == "discard");
            }
        }
    }
}

} // namespace osgMultiRender
