// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/GlslEdit.h>
#include <osgMultiRender/GlslWrap.h>

namespace osgMultiRender
{

/// What raising the version of a program's shader objects takes.
struct GlslRaise
{
    GlslEdit::Names words;                  ///< New keywords, in each role.
    std::vector<GlslEdit::Names> functions; ///< New built-in functions, one map a shader object.
    std::vector<GlslWrapMessage> errors;
};

/// True if the text's version is below the target.
bool mustRaise(const GlslSource& source, const GlslVersion& target);

/// The version of a text once it is raised.
GlslVersion raisedVersion(const GlslSource& source, const GlslVersion& target);

/// Finds the names of `sources` that mean something else in `target`, and what forbids to raise.
GlslRaise planRaise(const std::vector<GlslShader>& shaders, const std::vector<GlslSource>& sources,
                    const GlslVersion& target);

/// Changes "#version" and "#line" of a source that is raised.
void raiseDirectives(const GlslSource& source, const GlslVersion& target, GlslEdit& edit);

} // namespace osgMultiRender
