// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <cstddef>
#include <string>

namespace osgLabels
{

/// What stands for bytes that are no UTF-8.
constexpr char32_t ReplacementCharacter = 0xFFFD;

/// Returns the character at `position`, which must lie within the text, and moves on past it.
/// Of bytes that begin no character the longest run that could have begun one is passed, at least
/// one byte, for one U+FFFD (Unicode 15, section 3.9). Overlong forms, surrogates and what is
/// above U+10FFFF are no characters.
OSGLABELS_EXPORT char32_t takeCharacter(const std::string& utf8, std::size_t& position);

OSGLABELS_EXPORT std::u32string decodeUtf8(const std::string& utf8);

} // namespace osgLabels
