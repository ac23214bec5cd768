// SPDX-License-Identifier: MIT
// Questions that several parts of the merger ask of a source, and messages.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslCondition.h>

namespace osgMultiRender
{

std::string lineDirective(std::size_t file, unsigned long line)
{
    return "#line " + std::to_string((file + 1) * LinesPerFile + line) + " " + std::to_string(file);
}

void MergeProgram::fail(const std::string& text)
{
    failed = true;
    if (messages.size() < 16)
    {
        messages.push_back({MergeSeverity::Error, id, text});
    }
}

void MergeProgram::fail(const std::vector<MergedFile>& files, const MergeShader& shader,
                        std::size_t token, const std::string& text)
{
    fail(files[shader.file].name + ":" + std::to_string(shader.lineOf(token)) + ": " + text);
}

unsigned int MergeShader::lineOf(std::size_t token) const
{
    return authorLine(source.tokens[token].line);
}

unsigned int MergeShader::authorLine(unsigned int line) const
{
    unsigned int result = line;
    for (const GlslDirective& directive : source.directives)
    {
        const unsigned int next = source.tokens[directive.token].line + 1;
        if (directive.name == "line" && next <= line && !directive.parts.empty())
        {
            // Below 330 the directive numbers its own line, from there on the next one.
            const auto number = static_cast<unsigned int>(
                std::stoul(std::string(textOf(source.text, directive.parts[0]))));
            result = number + (source.version.number < 330 ? 1 : 0) + (line - next);
        }
    }
    return result;
}

void MergeProgram::note(const std::string& text)
{
    messages.push_back({MergeSeverity::Note, id, text});
}

long long constantOf(const GlslSource& source, std::size_t first, std::size_t last, bool& known)
{
    // Constants in brackets, so that "2 * N" with N = 1 + 2 is 6; a bound, as they may nest.
    std::vector<std::pair<std::size_t, std::size_t>> pending = {{first, last}};
    std::vector<std::string_view> words;
    while (!pending.empty() && words.size() < 256 && pending.size() < 32)
    {
        auto& [at, end] = pending.back();
        if (at >= end)
        {
            pending.pop_back();
            if (!pending.empty())
            {
                words.push_back(")");
            }
            continue;
        }
        const std::size_t token = at++;
        const std::string_view word = source.word(token);
        if (source.tokens[token].blank())
        {
            continue;
        }
        const GlslDeclaration* global = source.tokens[token].kind == GlslToken::Kind::Identifier
                                            ? source.findGlobal(word)
                                            : nullptr;
        if (global && source.specifiersOf(*global).has("const") && !global->initializer.empty())
        {
            words.push_back("(");
            pending.emplace_back(global->initializer.first, global->initializer.last);
            continue;
        }
        words.push_back(word);
    }
    const GlslValue value = pending.empty() ? evaluate(words) : GlslValue{};
    known = value.known;
    return value.value;
}

bool arraySizes(const GlslSource& source, const GlslRange& range, std::vector<int>& sizes)
{
    std::size_t open = range.first;
    int depth = 0;
    for (std::size_t i = range.first; i < range.last; ++i)
    {
        const std::string_view word = source.word(i);
        if (word == "[" && depth++ == 0)
        {
            open = i;
        }
        else if (word == "]" && --depth == 0)
        {
            bool known = false;
            const long long size = constantOf(source, open + 1, i, known);
            if (!known || size < 1 || size > 4096)
            {
                return false;
            }
            sizes.push_back(static_cast<int>(size));
        }
    }
    return true;
}

int layoutValue(const GlslSource& source, const GlslSpecifiers& specifiers, std::string_view key)
{
    for (const GlslQualifier& qualifier : specifiers.qualifiers)
    {
        for (std::size_t i = qualifier.range.first; i < qualifier.range.last; ++i)
        {
            if (source.uses[i].kind != GlslUse::Kind::LayoutName || source.word(i) != key)
            {
                continue;
            }
            std::size_t first = i + 1;
            while (first < qualifier.range.last && source.word(first) != "=")
            {
                ++first;
            }
            std::size_t last = ++first;
            while (last < qualifier.range.last && source.word(last) != "," &&
                   source.word(last) != ")")
            {
                ++last;
            }
            bool known = false;
            const long long value = constantOf(source, first, last, known);
            return known && value >= 0 && value < 256 ? static_cast<int>(value) : -1;
        }
    }
    return -1;
}

} // namespace osgMultiRender
