// SPDX-License-Identifier: MIT
// Globals that are set up in main(), as what their initializers read is.
#include <osgMultiRender/MergeProgram.h>

#include <algorithm>
#include <set>

namespace osgMultiRender
{

namespace
{

bool readsMain(const MergeStage& stage, bool isFragment, const GlslSource& source,
               const GlslRange& range)
{
    static const std::set<std::string_view> written = {"gl_Color", "gl_SecondaryColor",
                                                       "gl_TexCoord", "gl_FogFragCoord"};
    for (std::size_t i = range.first; i < range.last; ++i)
    {
        const GlslUse::Kind use = source.uses[i].kind;
        const auto found = stage.entities.find(std::string(source.word(i)));
        const bool entity = (use == GlslUse::Kind::Global || use == GlslUse::Kind::BlockMember) &&
                            found != stage.entities.end();
        if (use == GlslUse::Kind::Function ||
            (use == GlslUse::Kind::Builtin && isFragment && written.count(source.word(i))) ||
            (entity && (found->second.tainted || found->second.kind == MergeEntity::Kind::Varying)))
        {
            return true;
        }
    }
    return false;
}

} // namespace

void findTaints(MergeProgram& program, MergeStage& stage, const std::vector<MergedFile>& files)
{
    const bool isFragment = &stage == &program.fragment;
    for (const MergeShader& shader : stage.shaders)
    {
        const GlslSource& source = shader.source;
        const bool hasMain =
            std::any_of(source.functions.begin(), source.functions.end(),
                        [](const GlslFunction& f) { return f.name == "main" && !f.body.empty(); });
        for (const GlslDeclaration& one : source.declarations)
        {
            const auto found = stage.entities.find(one.name);
            if (one.kind != GlslDeclaration::Kind::Global || one.initializer.empty() ||
                found == stage.entities.end() ||
                !readsMain(stage, isFragment, source, one.initializer))
            {
                continue;
            }
            found->second.tainted = true;
            if (!hasMain || source.word(one.initializer.first) == "{")
            {
                program.fail(files, shader, one.nameToken,
                             "the initializer of '" + one.name + "' can't be merged");
            }
        }
    }
}

} // namespace osgMultiRender
