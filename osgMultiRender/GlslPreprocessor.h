// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/GlslCondition.h>
#include <osgMultiRender/GlslSource.h>

namespace osgMultiRender
{

/// The tokens of a source that are compiled, without blanks and directives.
struct GlslActiveTokens
{
    std::vector<std::size_t> tokens;
    std::vector<bool> conditional; ///< Whether it depends on an unknown condition.
};

/// Reads the directives of `source` (which has text and tokens): version, macros, conditionals.
///
/// Of the branches of an unknown condition all are kept if each is balanced in its brackets, else
/// the first one alone. `version` is the value of `__VERSION__`.
GlslActiveTokens preprocess(GlslSource& source, int version);

/// One directive of a text, with its parts; `index` is that of its token.
GlslDirective readDirective(const std::string& text, const GlslToken& token, std::size_t index,
                            int version);

/// The "#version" of a text that is tokenized; 110 without one.
GlslVersion readVersion(const std::string& text, const std::vector<GlslToken>& tokens);

/// Replaces object-like macros of `source` in force at `token` in `words`, and gives up (an unknown
/// word "?" instead) beyond 256 words. Words that are no macro are kept.
std::vector<std::string_view> expandMacros(const GlslSource& source, std::size_t token,
                                           const std::vector<std::string_view>& words);

} // namespace osgMultiRender
