// SPDX-License-Identifier: MIT
// Names within a rendering's own text. Not installed.
#pragma once

#include <osgMultiRender/GlslEdit.h>
#include <osgMultiRender/MergeProgram.h>

namespace osgMultiRender
{

/// Gives the tokens of one shader object their names in the merged text.
class MergeRename
{
public:
    MergeRename(const MergeStage& stage, const GlslSource& source) : _stage(stage), _source(source)
    {
    }

    const MergeEntity* find(std::string_view name) const;

    /// The other name of a token; null if it keeps its own.
    const std::string* of(std::size_t token) const;

    /// A range with its tokens renamed, without comments.
    std::string textOf(const GlslRange& range) const;

    /// Renames all tokens, and names in comments.
    void apply(GlslEdit& edit) const;

private:
    bool callsOwn(std::size_t token) const;
    std::size_t skipBlanks(std::size_t token) const;
    void renameComment(const GlslToken& token, GlslEdit& edit) const;

    const MergeStage& _stage;
    const GlslSource& _source;
};

/// Makes `return` of main and `discard` of a fragment shader object what they are in a function
/// that returns the colour.
void editJumps(const MergeProgram& program, std::size_t shader, const MergeRename& rename,
               GlslEdit& edit);

} // namespace osgMultiRender
