// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/GlslSource.h>

#include <map>
#include <string>
#include <vector>

namespace osgMultiRender
{

/// An active "#extension" line.
struct GlslExtension
{
    std::string name;
    std::string behavior; ///< "enable", "require", "warn", "disable".
    unsigned int line = 0;
};

/// What the preprocessor makes of a text.
struct GlslExpanded
{
    /// The text that is compiled, without macros and directives but "#version" and "#line". Comments
    /// of compiled parts stay; each line is on the line it was on.
    std::string text;
    GlslVersion version; ///< Of the "#version" line; GLSL ES as the desktop version that holds it.
    std::vector<GlslExtension> extensions;
    bool invariantAll = false; ///< "#pragma STDGL invariant(all)"
    std::vector<GlslMessage> errors;
};

/// Runs the preprocessor over a text: conditions, macros (also with arguments and pasting).
///
/// `defines` are the macros that are defined before the text: those of `#pragma import_defines`
/// and those of the extensions of a context; all other names are undefined. `__VERSION__` is the
/// text's own version. Macros that explode are an error. Any bytes; never throws but std::bad_alloc.
OSGMULTIRENDER_EXPORT GlslExpanded
expandGlsl(const std::string& text, const std::map<std::string, std::string>& defines = {});

} // namespace osgMultiRender
