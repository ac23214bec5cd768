// SPDX-License-Identifier: MIT
// `return` and `discard` in a fragment stage that is a function.
#include <osgMultiRender/MergeRename.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

class Jumps
{
public:
    Jumps(const MergeProgram& program, const GlslSource& source, const MergeRename& rename,
          GlslEdit& edit)
        : _program(program), _source(source), _rename(rename), _edit(edit)
    {
    }

    void run()
    {
        for (const GlslFunction& function : _source.functions)
        {
            const MergeEntity* entity = _rename.find(function.name);
            const bool main = function.name == "main";
            for (std::size_t i = function.body.first;
                 entity && entity->inPlace && i < function.body.last; ++i)
            {
                if (_source.tokens[i].kind != GlslToken::Kind::Keyword)
                {
                    continue;
                }
                const std::string_view word = _source.word(i);
                if (word == "return" && main)
                {
                    _edit.replace(_source.tokens[i].begin, _source.tokens[i].end,
                                  "return " + _program.color);
                }
                else if (word == "discard")
                {
                    discardAt(i, function);
                }
                else if (_program.discardsInLoops &&
                         (word == "for" || word == "while" || word == "do"))
                {
                    guardLoop(i, function);
                }
            }
        }
    }

private:
    void discardAt(std::size_t token, const GlslFunction& function)
    {
        std::size_t end = token + 1;
        while (end < function.body.last && _source.tokens[end].blank())
        {
            ++end;
        }
        if (_source.word(end) == ";")
        {
            _edit.blank({end, end + 1});
        }
        std::string leave = "return;";
        const GlslSpecifiers& type = _source.specifiers[function.specifiers];
        if (function.name == "main")
        {
            leave = "return " + _program.color + ";";
        }
        else if (type.type != "void")
        {
            // The value is never looked at.
            const std::string* other = _rename.of(type.typeToken);
            leave = (other ? *other : type.type) + _rename.textOf(type.typeArray) +
                    " nothing; return nothing;";
        }
        _edit.replace(_source.tokens[token].begin, _source.tokens[token].end,
                      "{ " + _program.discarded + " = true; " + leave + " }");
    }

    std::size_t skipBlanks(std::size_t i) const
    {
        while (i < _source.tokens.size() && _source.tokens[i].blank())
        {
            ++i;
        }
        return i;
    }

    /// The token behind the bracket that matches the one at `open`.
    std::size_t behindMatch(std::size_t open, std::size_t end) const
    {
        int depth = 0;
        for (std::size_t i = open; i < end; ++i)
        {
            const std::string_view word = _source.word(i);
            depth += word == "(" || word == "{" ? 1 : word == ")" || word == "}" ? -1 : 0;
            if (depth == 0)
            {
                return i + 1;
            }
        }
        return end;
    }

    /// A function that discarded returns to its caller, which must not go round for ever.
    void guardLoop(std::size_t token, const GlslFunction& function)
    {
        const std::size_t end = function.body.last;
        std::size_t at = skipBlanks(token + 1);
        const auto calls = [&](const GlslUse& use) { return use.kind == GlslUse::Kind::Function; };
        if (std::none_of(_source.uses.begin() + static_cast<std::ptrdiff_t>(token),
                         _source.uses.begin() + static_cast<std::ptrdiff_t>(end), calls))
        {
            return;
        }
        if (_source.word(token) == "do")
        {
            if (at >= end || _source.word(at) != "{")
            {
                return;
            }
            _tails.insert(skipBlanks(behindMatch(at, end)));
        }
        else
        {
            if (at >= end || _source.word(at) != "(" || _tails.count(token))
            {
                return;
            }
            at = behindMatch(at, end);
        }
        _edit.insertBefore(at, " if (" + _program.discarded + ") break; else ");
    }

    const MergeProgram& _program;
    const GlslSource& _source;
    const MergeRename& _rename;
    GlslEdit& _edit;
    std::set<std::size_t> _tails; ///< The `while` of do loops.
};

} // namespace

void editJumps(const MergeProgram& program, std::size_t shader, const MergeRename& rename,
               GlslEdit& edit)
{
    Jumps(program, program.fragment.shaders[shader].source, rename, edit).run();
}

} // namespace osgMultiRender
