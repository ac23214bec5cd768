// SPDX-License-Identifier: MIT
// A rendering's own text as it stands in the merged source.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslEdit.h>
#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

using Kind = MergeEntity::Kind;

class Writer
{
public:
    Writer(const MergeProgram& program, const MergeStage& stage, std::size_t shader)
        : _program(program), _stage(stage), _index(shader), _source(stage.shaders[shader].source),
          _edit(_source), _fragment(&stage == &program.fragment)
    {
    }

    std::string run(const GlslVersion& version)
    {
        directives();
        statements();
        blocks();
        functions();
        jumps();
        rename();
        return _edit.getText(version.number);
    }

private:
    const MergeEntity* find(std::string_view name) const
    {
        const auto found = _stage.entities.find(std::string(name));
        return found == _stage.entities.end() ? nullptr : &found->second;
    }

    void directives()
    {
        for (const GlslDirective& directive : _source.directives)
        {
            const GlslToken& token = _source.tokens[directive.token];
            std::string line;
            if (directive.name == "line" && !directive.parts.empty())
            {
                // Below 330 the directive numbers its own line, from there on the next one.
                const unsigned long number =
                    std::stoul(std::string(textOf(_source.text, directive.parts[0])));
                line = "#line " + std::to_string(number + (_source.version.number < 330 ? 1 : 0)) +
                       " " + std::to_string(_stage.shaders[_index].file);
            }
            _edit.replace(token.begin, token.end, line);
        }
    }

    /// Whether a declaration of a variable is the one that stays.
    bool stays(const GlslDeclaration& one) const
    {
        const MergeEntity* entity = find(one.name);
        if (!entity || !entity->inPlace)
        {
            return false;
        }
        const auto* first = &entity->places.front();
        for (const MergeEntity::Place& place : entity->places)
        {
            const GlslSource& source = _stage.shaders[place.shader].source;
            if (!source.declarations[place.index].initializer.empty())
            {
                first = &place;
                break;
            }
        }
        return first->shader == _index && &_source.declarations[first->index] == &one;
    }

    void statements()
    {
        std::map<std::size_t, std::vector<const GlslDeclaration*>> groups;
        std::vector<bool> known(_source.specifiers.size(), false);
        for (const GlslDeclaration& one : _source.declarations)
        {
            known[one.specifiers] = true;
            if (one.kind == GlslDeclaration::Kind::Global)
            {
                groups[one.specifiers].push_back(&one);
            }
            else if (one.kind == GlslDeclaration::Kind::Redeclaration && one.scope == 0)
            {
                _edit.blank(_source.specifiersOf(one).statement);
            }
        }
        for (const GlslFunction& function : _source.functions)
        {
            known[function.specifiers] = true;
        }
        for (const GlslBlock& block : _source.blocks)
        {
            known[block.specifiers] = true;
            groups.erase(block.specifiers);
        }
        for (const auto& [index, declarations] : groups)
        {
            group(_source.specifiers[index], declarations);
        }
        for (const GlslStruct& one : _source.structs)
        {
            structure(one);
        }
        for (std::size_t i = 0; i < known.size(); ++i)
        {
            const GlslSpecifiers& specifiers = _source.specifiers[i];
            if (!known[i] && specifiers.type.empty() && !specifiers.qualifiers.empty())
            {
                // "layout(early_fragment_tests) in;"
                _edit.blank(specifiers.statement);
            }
        }
    }

    bool definesStruct(const GlslSpecifiers& specifiers) const
    {
        return std::any_of(_source.structs.begin(), _source.structs.end(),
                           [&](const GlslStruct& one) {
                               return !one.name.empty() && one.nameToken == specifiers.typeToken;
                           });
    }

    void structure(const GlslStruct& one)
    {
        const MergeEntity* entity = find(one.name);
        if (!entity || entity->inPlace)
        {
            return;
        }
        for (const GlslSpecifiers& specifiers : _source.specifiers)
        {
            if (specifiers.typeToken == one.nameToken && !one.name.empty())
            {
                _edit.blank(specifiers.statement);
            }
        }
    }

    /// One statement that declares variables.
    void group(const GlslSpecifiers& specifiers, const std::vector<const GlslDeclaration*>& all)
    {
        std::vector<bool> kept;
        for (const GlslDeclaration* one : all)
        {
            kept.push_back(stays(*one));
        }
        if (std::none_of(kept.begin(), kept.end(), [](bool k) { return k; }) &&
            !definesStruct(specifiers))
        {
            _edit.blank(specifiers.statement);
            return;
        }
        bool any = false;
        for (std::size_t i = 0; i < all.size(); ++i)
        {
            if (i > 0 && !(kept[i] && any))
            {
                blankComma(endOf(*all[i - 1]), all[i]->nameToken);
            }
            if (!kept[i])
            {
                _edit.blank({all[i]->nameToken, endOf(*all[i])});
            }
            any = any || kept[i];
        }
        const MergeEntity* entity = find(all.front()->name);
        if (entity && (entity->kind == Kind::Varying || entity->kind == Kind::Output))
        {
            _edit.setQualifiers(specifiers, "");
        }
        else if (entity && entity->kind == Kind::Uniform)
        {
            stripLayout(specifiers);
        }
        for (std::size_t i = 0; i < all.size(); ++i)
        {
            const MergeEntity* one = find(all[i]->name);
            if (kept[i] && one && one->tainted && !all[i]->initializer.empty())
            {
                moveInitializer(*all[i]);
            }
        }
    }

    std::size_t endOf(const GlslDeclaration& one) const
    {
        return std::max({one.nameToken + 1, one.array.empty() ? 0 : one.array.last,
                         one.initializer.empty() ? 0 : one.initializer.last});
    }

    void blankComma(std::size_t first, std::size_t last)
    {
        for (std::size_t i = first; i < last; ++i)
        {
            if (_source.word(i) == ",")
            {
                _edit.blank({i, i + 1});
            }
        }
    }

    /// Takes locations and bindings out, which are the merger's to give.
    void stripLayout(const GlslSpecifiers& specifiers)
    {
        for (const GlslQualifier& qualifier : specifiers.qualifiers)
        {
            if (qualifier.word != "layout")
            {
                continue;
            }
            std::string rest;
            std::size_t from = qualifier.range.first;
            for (std::size_t i = from; i < qualifier.range.last; ++i)
            {
                if (_source.uses[i].kind != GlslUse::Kind::LayoutName)
                {
                    continue;
                }
                std::size_t end = i;
                while (end < qualifier.range.last && _source.word(end) != "," &&
                       _source.word(end) != ")")
                {
                    ++end;
                }
                const std::string_view key = _source.word(i);
                if (key != "location" && key != "binding" && key != "set" && key != "index")
                {
                    rest += (rest.empty() ? "" : ", ") + _source.spell({i, end});
                }
            }
            _edit.blank(qualifier.range);
            if (!rest.empty())
            {
                _edit.insertBefore(qualifier.range.first, "layout(" + rest + ") ");
            }
        }
    }

    /// What an initializer says is done in main(), when the varyings are there.
    void moveInitializer(const GlslDeclaration& one)
    {
        _edit.removeQualifiers(_source.specifiersOf(one), {"const"});
        _moved += find(one.name)->merged + " = " + renamedText(one.initializer) + "; ";
        std::size_t equals = one.nameToken;
        while (equals < one.initializer.first && _source.word(equals) != "=")
        {
            ++equals;
        }
        _edit.blank({equals, one.initializer.last});
    }

    std::string renamedText(const GlslRange& range) const
    {
        std::string text;
        for (std::size_t i = range.first; i < range.last; ++i)
        {
            const std::string* other = renamed(i);
            text += _source.tokens[i].blank() ? " "
                    : other                   ? *other
                                              : std::string(_source.word(i));
        }
        return text;
    }

    void blocks()
    {
        for (const GlslBlock& block : _source.blocks)
        {
            const GlslSpecifiers& specifiers = _source.specifiers[block.specifiers];
            const MergeEntity* entity = find(block.name);
            const bool first = entity && entity->places.front().shader == _index &&
                               &_source.blocks[entity->places.front().index] == &block;
            if (!entity || !entity->inPlace || !first)
            {
                _edit.blank(specifiers.statement);
            }
            else if (specifiers.has("uniform") || specifiers.has("buffer"))
            {
                stripLayout(specifiers);
            }
            else
            {
                interfaceBlock(block, specifiers);
            }
        }
    }

    /// "out Data { … } data;" becomes a struct, or plain variables.
    void interfaceBlock(const GlslBlock& block, const GlslSpecifiers& specifiers)
    {
        for (std::size_t member : block.members)
        {
            _edit.setQualifiers(_source.specifiersOf(_source.declarations[member]), "");
        }
        if (!block.instance.empty())
        {
            _edit.setQualifiers(specifiers, "struct");
            return;
        }
        _edit.setQualifiers(specifiers, "");
        _edit.blank({block.nameToken, block.nameToken + 1});
        std::size_t last = specifiers.statement.last;
        for (std::size_t i = block.nameToken; i < specifiers.statement.last; ++i)
        {
            const std::string_view word = _source.word(i);
            if (word == "{")
            {
                _edit.blank({i, i + 1});
            }
            last = word == "}" ? i : last;
        }
        _edit.blank({last, specifiers.statement.last});
    }

    void functions()
    {
        for (const GlslFunction& function : _source.functions)
        {
            const MergeEntity* entity = find(function.name);
            const GlslSpecifiers& specifiers = _source.specifiers[function.specifiers];
            if (entity && !entity->inPlace)
            {
                const std::size_t last =
                    std::max(specifiers.statement.last, function.body.empty() ? 0 : function.body.last);
                _edit.blank({specifiers.statement.first, last});
                continue;
            }
            if (function.name == "main" && _fragment)
            {
                const GlslToken& type = _source.tokens[specifiers.typeToken];
                _edit.replace(type.begin, type.end, "vec4");
            }
            if (function.name == "main" && !function.body.empty())
            {
                mainBody(function);
            }
        }
    }

    void mainBody(const GlslFunction& function)
    {
        const std::string start = (_fragment ? startOfFragment() : "") + _moved;
        if (!start.empty())
        {
            _edit.insertBefore(function.body.first + 1, " " + start);
        }
        if (!_fragment)
        {
            return;
        }
        _edit.insertBefore(function.body.last - 1, "return " + _program.color + "; ");
    }

    /// What GL leaves undefined where a fragment shader does not write it.
    std::string startOfFragment() const
    {
        std::string text;
        for (const std::string& output : _program.outputs)
        {
            text += output + "; ";
        }
        if (!_program.depth.empty())
        {
            text += _program.depth + " = gl_FragCoord.z; ";
        }
        return text;
    }

    /// `return` of main and `discard`.
    void jumps()
    {
        if (!_fragment)
        {
            return;
        }
        for (const GlslFunction& function : _source.functions)
        {
            const MergeEntity* entity = find(function.name);
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
                else if (_program.discardsInLoops && (word == "for" || word == "while" || word == "do"))
                {
                    guardLoop(i, function);
                }
            }
        }
    }

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
            const std::string* other = renamed(type.typeToken);
            leave = (other ? *other : type.type) + renamedText(type.typeArray) +
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

    /// The other name of a token; null if it keeps its own.
    const std::string* renamed(std::size_t token) const
    {
        using Use = GlslUse::Kind;
        const Use kind = _source.uses[token].kind;
        const auto inMap = [&](const std::map<std::string, std::string>& map) -> const std::string*
        {
            const auto found = map.find(std::string(_source.word(token)));
            return found == map.end() ? nullptr : &found->second;
        };
        switch (kind)
        {
        case Use::Global:
        case Use::BlockMember:
        case Use::Type:
        case Use::BlockName:
        case Use::Function:
        {
            const MergeEntity* entity = find(_source.word(token));
            if (!entity)
            {
                return inMap(_stage.builtins);
            }
            return kind == Use::Function && !callsOwn(token) ? nullptr : &entity->merged;
        }
        case Use::Builtin:
            return inMap(_stage.builtins);
        case Use::Local:
        case Use::Parameter:
        case Use::Member:
            return inMap(_stage.reserved);
        default:
            return nullptr;
        }
    }

    /// Whether a use of a function's name means the rendering's own overloads, and not those of
    /// a built-in function of the same name.
    bool callsOwn(std::size_t token) const
    {
        const std::string_view word = _source.word(token);
        if (!builtinFunctionSince(word) || builtinFunctionSince(word) > _source.version.number)
        {
            return true;
        }
        const std::size_t open = skipBlanks(token + 1);
        if (open >= _source.tokens.size() || _source.word(open) != "(")
        {
            return true;
        }
        std::size_t count = 0;
        int depth = 0;
        for (std::size_t i = open; i < _source.tokens.size(); ++i)
        {
            const std::string_view text = _source.word(i);
            depth += text == "(" || text == "[" || text == "{"   ? 1
                     : text == ")" || text == "]" || text == "}" ? -1
                                                                 : 0;
            if (depth == 0)
            {
                break;
            }
            const bool starts = i > open && count == 0 && !_source.tokens[i].blank();
            count += starts || (text == "," && depth == 1) ? 1 : 0;
        }
        return std::any_of(_source.functions.begin(), _source.functions.end(),
                           [&](const GlslFunction& function) {
                               return function.name == word &&
                                      (function.nameToken == token ||
                                       function.parameters.size() == count);
                           });
    }

    /// Whether a word of a comment is meant as a name: "lightDir", "wave_2", "fade()", "'n'".
    static bool looksLikeName(std::string_view text, std::size_t begin, std::size_t end)
    {
        const char before = begin > 0 ? text[begin - 1] : ' ';
        const char behind = end < text.size() ? text[end] : ' ';
        const std::string_view quotes = "'`\"";
        if (behind == '(' || (before == behind && quotes.find(before) != std::string_view::npos))
        {
            return true;
        }
        return std::any_of(text.begin() + static_cast<std::ptrdiff_t>(begin) + 1,
                           text.begin() + static_cast<std::ptrdiff_t>(end),
                           [](char c) { return c == '_' || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
    }

    /// Comments follow the new names.
    void renameComment(const GlslToken& token)
    {
        const std::string_view text = textOf(_source.text, token);
        const auto letter = [](char c)
        {
            return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                   (c >= '0' && c <= '9');
        };
        for (std::size_t at = 2; at < text.size();)
        {
            std::size_t end = at;
            while (end < text.size() && letter(text[end]))
            {
                ++end;
            }
            const MergeEntity* entity = end > at ? find(text.substr(at, end - at)) : nullptr;
            if (entity && looksLikeName(text, at, end))
            {
                _edit.replace(token.begin + at, token.begin + end, entity->merged);
            }
            at = std::max(end, at + 1);
        }
    }

    void rename()
    {
        for (std::size_t i = 0; i < _source.tokens.size(); ++i)
        {
            if (_source.tokens[i].kind == GlslToken::Kind::Comment)
            {
                renameComment(_source.tokens[i]);
                continue;
            }
            const std::string* other = renamed(i);
            if (other)
            {
                _edit.replace(_source.tokens[i].begin, _source.tokens[i].end, *other);
            }
        }
    }

    const MergeProgram& _program;
    const MergeStage& _stage;
    std::size_t _index;
    const GlslSource& _source;
    GlslEdit _edit;
    bool _fragment;
    std::string _moved;
    std::set<std::size_t> _tails; ///< The `while` of do loops.
};

} // namespace

std::string mergedText(const MergeProgram& program, const MergeStage& stage,
                       const GlslVersion& version)
{
    std::string text;
    for (std::size_t i = 0; i < stage.shaders.size(); ++i)
    {
        text += "#line 1 " + std::to_string(stage.shaders[i].file) + "\n";
        text += Writer(program, stage, i).run(version);
        text += text.back() == '\n' ? "" : "\n";
    }
    return text;
}

std::string builtinGlobals(const MergeProgram& program, bool fragment)
{
    const MergeStage& stage = fragment ? program.fragment : program.vertex;
    std::string text;
    for (const auto& [builtin, name] : stage.builtins)
    {
        const bool scalar = builtin == "gl_FragDepth" || builtin == "gl_PointSize" ||
                            builtin == "gl_FogFragCoord" || builtin == "gl_ClipDistance";
        const int coordinates = stage.texCoords.empty() ? 1 : *stage.texCoords.rbegin() + 1;
        const int size = builtin == "gl_TexCoord"       ? coordinates
                         : builtin == "gl_FragData"     ? stage.fragData
                         : builtin == "gl_ClipDistance" ? stage.clipDistances
                                                        : 0;
        const std::string type = scalar ? "float " : "vec4 ";
        text += type + name;
        text += size ? "[" + std::to_string(size) + "];\n"
                     : " = " + std::string(scalar ? "0.0" : "vec4(0.0)") + ";\n";
    }
    if (fragment && program.discards)
    {
        text += "bool " + program.discarded + " = false;\n";
    }
    return text;
}

} // namespace osgMultiRender
