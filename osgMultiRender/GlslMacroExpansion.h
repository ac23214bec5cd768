// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/GlslToken.h>

#include <string>
#include <unordered_map>
#include <vector>

namespace osgMultiRender
{

/// A token on its way through macro expansion.
struct GlslWord
{
    std::string text;
    bool space = false;  ///< A blank stands before it.
    bool closed = false; ///< The name of a macro within its own expansion: never expanded again.
};

/// The macros in force, and the expansion of words by them.
class GlslMacroTable
{
public:
    struct Macro
    {
        bool functionLike = false;
        std::vector<std::string> parameters;
        std::vector<GlslWord> body;
    };

    /// Reads the parts of "#define name(a, b) body". False if they are malformed.
    bool define(std::string_view text, const std::vector<GlslToken>& parts);

    void define(const std::string& name, const std::string& body);
    void undefine(const std::string& name) { _macros.erase(name); }
    const Macro* find(const std::string& name) const;

    /// Expands words completely. `line` is the value of `__LINE__`. False beyond the bounds on size
    /// and nesting.
    bool expand(std::vector<GlslWord> words, unsigned int line, std::vector<GlslWord>& result);

private:
    struct Frame;

    bool expandNested(std::vector<GlslWord> words, std::vector<GlslWord>& result);
    bool collectArguments(std::vector<Frame>& frames,
                          std::vector<std::vector<GlslWord>>& arguments) const;
    bool substitute(const Macro& macro, std::vector<std::vector<GlslWord>>& arguments,
                    std::vector<GlslWord>& result);

    std::unordered_map<std::string, Macro> _macros;
    unsigned int _line = 0;
    std::size_t _budget = 0;
    unsigned int _depth = 0;
};

/// True for names: the words that can be macros.
bool isGlslName(std::string_view word);

} // namespace osgMultiRender
