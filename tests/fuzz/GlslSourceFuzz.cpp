// SPDX-License-Identifier: MIT
// Any bytes as GLSL: the tokens give them back, the model and the edits hold, nothing crashes.
// The first byte picks the version that is raised to and the stage; a byte 0xFF splits the rest
// into shader objects.
#include "fuzz/Require.h"

#include <osgMultiRender/GlslEdit.h>
#include <osgMultiRender/GlslWrap.h>

#include <cstdint>

using namespace osgMultiRender;

namespace
{

void checkTokens(const std::string& text)
{
    std::size_t at = 0;
    unsigned int line = 1;
    for (const GlslToken& token : tokenize(text))
    {
        require(token.begin == at && token.end > token.begin, "tokens follow each other");
        require(token.line >= line, "lines ascend");
        at = token.end;
        line = token.line;
        if (token.kind == GlslToken::Kind::Directive)
        {
            std::size_t inner = token.begin;
            for (const GlslToken& part : tokenizeDirective(text, token))
            {
                require(part.begin == inner && part.end > inner, "parts follow each other");
                inner = part.end;
            }
            require(inner == token.end, "parts fill the directive");
        }
    }
    require(at == text.size(), "tokens fill the text");
}

void checkRange(const GlslSource& source, const GlslRange& range)
{
    require(range.first <= source.tokens.size() && range.last <= source.tokens.size(),
            "ranges lie in the source");
}

void checkModel(const GlslSource& source)
{
    require(source.uses.size() == source.tokens.size(), "a use a token");
    for (const GlslDeclaration& one : source.declarations)
    {
        require(source.word(one.nameToken) == one.name, "a declaration's token is its name");
        require(one.scope < source.scopes.size(), "a declaration's scope exists");
        checkRange(source, one.array);
        checkRange(source, one.initializer);
        checkRange(source, source.specifiersOf(one).statement);
    }
    for (const GlslFunction& function : source.functions)
    {
        require(source.word(function.nameToken) == function.name, "a function's token is its name");
        checkRange(source, function.body);
    }
    for (const GlslScope& scope : source.scopes)
    {
        checkRange(source, scope.range);
    }
}

void checkEdits(const GlslSource& source)
{
    require(GlslEdit(source).getText() == source.text, "no edit, the same text");
    GlslEdit there(source);
    const std::size_t count = there.rename({{"main", "zq7_main"}});
    const GlslSource renamed = parseGlsl(there.getText());
    if (source.text.find("zq7_main") != std::string::npos)
    {
        return;
    }
    require(!renamed.findFunction("main"), "main is renamed");
    GlslEdit back(renamed);
    require(back.rename({{"zq7_main", "main"}}) == count && back.getText() == source.text,
            "renamed back, the same text");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0)
    {
        return 0;
    }
    static constexpr int versions[] = {330, 400, 430, 450};
    GlslVersion target;
    target.number = versions[data[0] & 3];
    target.profile = data[0] & 4 ? GlslVersion::Profile::Core : GlslVersion::Profile::Compatibility;
    std::vector<GlslShader> shaders(1);
    for (std::size_t i = 1; i < size; ++i)
    {
        if (data[i] == 0xFF && shaders.size() < 4)
        {
            shaders.emplace_back();
            continue;
        }
        shaders.back().text += static_cast<char>(data[i]);
    }
    if (data[0] & 8)
    {
        shaders.front().stage = GlslStage::Vertex;
    }
    for (const GlslShader& shader : shaders)
    {
        checkTokens(shader.text);
        const GlslSource source = parseGlsl(shader.text);
        checkModel(source);
        checkEdits(source);
    }
    GlslWrapped wrapped = wrapProgram(shaders, target);
    require(wrapped.ok == wrapped.errors.empty(), "not ok has a reason");
    require(wrapped.texts.size() == (wrapped.ok ? shaders.size() : 0), "a text a shader object");
    std::string error;
    if (wrapped.ok && bindOutputs(wrapped.outputs, {}, error))
    {
        checkTokens(wrapperMain(wrapped.version, wrapped.outputs));
    }
    return 0;
}
