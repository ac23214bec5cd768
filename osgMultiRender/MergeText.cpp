// SPDX-License-Identifier: MIT
// A rendering's own text as it stands in the merged source.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslVocabulary.h>
#include <osgMultiRender/MergeRename.h>

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
          _rename(stage, _source), _edit(_source), _fragment(&stage == &program.fragment)
    {
    }

    std::string run(const GlslVersion& version)
    {
        directives();
        statements();
        blocks();
        functions();
        if (_fragment)
        {
            editJumps(_program, _index, _rename, _edit);
        }
        _rename.apply(_edit);
        return _edit.getText(version.number);
    }

private:
    const MergeEntity* find(std::string_view name) const { return _rename.find(name); }

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
                const std::size_t file = _stage.shaders[_index].file;
                line = lineDirective(file, number + (_source.version.number < 330 ? 1 : 0));
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
                           [&](const GlslStruct& one)
                           { return !one.name.empty() && one.nameToken == specifiers.typeToken; });
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
            dropQualifiers(specifiers);
        }
        else if (entity && entity->kind == Kind::Uniform)
        {
            stripLayout(specifiers);
        }
        const bool plain = specifiers.typeArray.empty() && isBuiltinType(specifiers.type);
        for (std::size_t i = 0; i < all.size(); ++i)
        {
            const MergeEntity* one = find(all[i]->name);
            if (_fragment && kept[i] && plain && one->kind == Kind::Varying &&
                all[i]->array.empty())
            {
                // main() gives it its value; compilers that do not see that would warn.
                _edit.insertBefore(all[i]->nameToken + 1, " = " + specifiers.type + "(0)");
            }
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

    /// Takes the qualifiers out, with the blanks behind them.
    void dropQualifiers(const GlslSpecifiers& specifiers)
    {
        _edit.setQualifiers(specifiers, "");
        for (const GlslQualifier& qualifier : specifiers.qualifiers)
        {
            const GlslToken& behind = _source.tokens[qualifier.range.last];
            if (behind.kind == GlslToken::Kind::Whitespace &&
                textOf(_source.text, behind).find('\n') == std::string_view::npos)
            {
                _edit.replace(behind.begin, behind.end, "");
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
        _moved += find(one.name)->merged + " = " + _rename.textOf(one.initializer) + "; ";
        std::size_t equals = one.nameToken;
        while (equals < one.initializer.first && _source.word(equals) != "=")
        {
            ++equals;
        }
        _edit.blank({equals, one.initializer.last});
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
                const std::size_t last = std::max(specifiers.statement.last,
                                                  function.body.empty() ? 0 : function.body.last);
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

    const MergeProgram& _program;
    const MergeStage& _stage;
    std::size_t _index;
    const GlslSource& _source;
    MergeRename _rename;
    GlslEdit _edit;
    bool _fragment;
    std::string _moved; ///< Assignments for the start of main().
};

} // namespace

std::string mergedText(const MergeProgram& program, const MergeStage& stage,
                       const GlslVersion& version)
{
    std::string text;
    for (std::size_t i = 0; i < stage.shaders.size(); ++i)
    {
        text += lineDirective(stage.shaders[i].file, 1) + "\n";
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
        const std::string constant = lightingConstant(program.rendering->state, builtin, name);
        if (!constant.empty())
        {
            text += constant;
            continue;
        }
        const bool scalar = builtin == "gl_FragDepth" || builtin == "gl_PointSize" ||
                            builtin == "gl_FogFragCoord" || builtin == "gl_ClipDistance";
        const int coordinates = stage.texCoords.empty() ? 1 : *stage.texCoords.rbegin() + 1;
        const int size = builtin == "gl_TexCoord"       ? coordinates
                         : builtin == "gl_FragData"     ? stage.fragData
                         : builtin == "gl_ClipDistance" ? stage.clipDistances
                                                        : 0;
        const std::string type = scalar ? "float" : "vec4";
        const std::string zero = scalar ? "0.0" : "vec4(0.0)";
        const std::string count = size ? "[" + std::to_string(size) + "]" : "";
        std::string value = zero;
        for (int i = 1; i < size; ++i)
        {
            value += ", " + zero;
        }
        value = size ? type + count + "(" + value + ")" : value;
        text += type + " " + name + count + " = " + value + ";\n";
    }
    if (fragment && program.discards)
    {
        text += "bool " + program.discarded + " = false;\n";
    }
    return text;
}

} // namespace osgMultiRender
