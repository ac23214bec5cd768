// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace osgMultiRender
{

/// A piece of GLSL text: every byte of a source is in exactly one token.
struct GlslToken
{
    enum class Kind
    {
        Identifier,
        Keyword,    ///< A keyword or reserved word of the version that was asked for.
        Number,     ///< As the preprocessor sees it: "1.5e-3", "0x1Fu", ".5".
        Operator,   ///< Longest match: "<<=", "&&", "[", ";".
        Whitespace, ///< Blanks, line ends, line continuations outside of directives.
        Comment,    ///< Line comments without their line end; block comments may be unterminated.
        Directive,  ///< From "#" to the end of the line, with continued lines and comments in it.
        Other       ///< Bytes that GLSL has no use for: NUL, quotes, UTF-8 outside of comments.
    };

    Kind kind = Kind::Other;
    std::size_t begin = 0;   ///< Byte offset of the first byte.
    std::size_t end = 0;     ///< Byte offset behind the last byte.
    unsigned int line = 1;   ///< Counted from 1; CR, LF, CRLF and LFCR end a line.
    unsigned int column = 1; ///< In bytes, counted from 1.

    /// True for white space and comments.
    bool blank() const { return kind == Kind::Whitespace || kind == Kind::Comment; }
};

/// A finding about a place of a source.
struct GlslMessage
{
    unsigned int line = 0; ///< 0: about the whole source.
    unsigned int column = 0;
    std::string message; ///< One clause: "the comment is not closed".
};

/// Splits GLSL text into tokens, in linear time, for any bytes; never fails.
///
/// `version` decides which words are keywords ("sample" is one from 400 on). The tokens joined are
/// the text, byte for byte.
OSGMULTIRENDER_EXPORT std::vector<GlslToken> tokenize(std::string_view text, int version = 460);

/// Splits one directive of `text` into its parts: "#", words, operators, comments, blanks. Lines
/// and columns go on from the directive's own.
OSGMULTIRENDER_EXPORT std::vector<GlslToken>
tokenizeDirective(std::string_view text, const GlslToken& directive, int version = 460);

/// The bytes of a token of `text`.
inline std::string_view textOf(std::string_view text, const GlslToken& token)
{
    return text.substr(token.begin, token.end - token.begin);
}

} // namespace osgMultiRender
