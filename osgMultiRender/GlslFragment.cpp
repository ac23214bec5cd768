// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslFragment.h>

#include <osgMultiRender/GlslPreprocessor.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

constexpr std::size_t MaximumOutputs = 64;

/// Words that a plain global can't have.
const std::vector<std::string> OutputQualifiers = {"layout", "out",    "invariant",     "centroid",
                                                   "flat",   "smooth", "noperspective", "sample"};

} // namespace

GlslFragment::GlslFragment(const GlslSource& source, std::size_t shader)
    : _source(&source), _shader(shader)
{
}

void GlslFragment::say(std::vector<GlslWrapMessage>& list, std::size_t token,
                       const std::string& message) const
{
    const GlslToken& at = _source->tokens[token];
    list.push_back({_shader, {at.line, at.column, message}});
}

void GlslFragment::read(GlslWrapped& result)
{
    findMain();
    findBuiltins(result);
    std::size_t count = 0;
    for (const GlslDeclaration& one : _source->declarations)
    {
        if (!isOutput(one))
        {
            continue;
        }
        if (++count > MaximumOutputs)
        {
            say(result.errors, one.nameToken, "more outputs than any context has");
            return;
        }
        addOutput(one, result);
    }
}

void GlslFragment::findMain()
{
    for (const GlslFunction& function : _source->functions)
    {
        _definesMain = _definesMain || (function.name == "main" && !function.body.empty());
    }
    if (_source->findFunction("main"))
    {
        return;
    }
    // "#define ENTRY void main()"
    for (const GlslMacro& macro : _source->macros)
    {
        for (const GlslToken& part : macro.body)
        {
            _definesMain = _definesMain || textOf(_source->text, part) == "main";
        }
    }
}

void GlslFragment::findBuiltins(GlslWrapped& result)
{
    using Kind = GlslUse::Kind;
    for (std::size_t i = 0; i < _source->tokens.size(); ++i)
    {
        if (_source->uses[i].kind != Kind::Builtin)
        {
            continue;
        }
        const std::string_view word = _source->word(i);
        _usesColor = _usesColor || word == "gl_FragColor";
        if (word == "gl_FragData")
        {
            std::vector<std::string_view> next;
            for (std::size_t k = i + 1; k < _source->tokens.size() && next.size() < 3; ++k)
            {
                if (!_source->tokens[k].blank())
                {
                    next.push_back(_source->word(k));
                }
            }
            useOfData(next);
        }
        else if (word.substr(0, 21) == "gl_SecondaryFragColor" ||
                 word.substr(0, 20) == "gl_SecondaryFragData")
        {
            say(result.errors, i, "dual-source blending is not supported");
        }
    }
    for (const GlslMacro& macro : _source->macros)
    {
        for (std::size_t i = 0; i < macro.body.size(); ++i)
        {
            const std::string_view word = textOf(_source->text, macro.body[i]);
            _usesColor = _usesColor || word == "gl_FragColor";
            if (word == "gl_FragData")
            {
                std::vector<std::string_view> next;
                for (std::size_t k = i + 1; k < std::min(i + 4, macro.body.size()); ++k)
                {
                    next.push_back(textOf(_source->text, macro.body[k]));
                }
                useOfData(next);
            }
            const bool pasted = word.substr(0, 7) == "gl_Frag" && i + 1 < macro.body.size() &&
                                textOf(_source->text, macro.body[i + 1]) == "##";
            if (pasted)
            {
                result.errors.push_back({_shader,
                                         {macro.body[i].line, macro.body[i].column,
                                          "a pasted 'gl_Frag' name can't be followed"}});
            }
        }
    }
}

/// Notes which element of gl_FragData is meant; `next` are the words behind the name.
void GlslFragment::useOfData(const std::vector<std::string_view>& next)
{
    _usesData = true;
    const GlslValue index =
        next.size() == 3 && next[0] == "[" && next[2] == "]" ? evaluate({next[1]}) : GlslValue{};
    if (index.known && index.value >= 0 && index.value < 64)
    {
        _dataElements.insert(static_cast<int>(index.value));
    }
    else
    {
        _dataIndexedFreely = true;
    }
}

bool GlslFragment::isOutput(const GlslDeclaration& one) const
{
    return one.kind == GlslDeclaration::Kind::Global && one.name.substr(0, 3) != "gl_" &&
           _source->specifiersOf(one).has("out") && !_source->specifiersOf(one).type.empty();
}

/// The value of tokens [first, last): numbers, macros and constant ints of this text.
long long GlslFragment::constant(std::size_t first, std::size_t last, bool& known) const
{
    std::vector<std::string_view> words;
    for (std::size_t i = first; i < last; ++i)
    {
        if (!_source->tokens[i].blank())
        {
            words.push_back(_source->word(i));
        }
    }
    words = expandMacros(*_source, first, words);
    for (std::string_view& word : words)
    {
        const GlslDeclaration* global = _source->findGlobal(word);
        if (global && _source->specifiersOf(*global).has("const") &&
            global->initializer.last == global->initializer.first + 1)
        {
            word = _source->word(global->initializer.first);
        }
    }
    const GlslValue value = evaluate(words);
    known = value.known;
    return value.value;
}

/// The type's name, behind a macro that stands for it.
std::string GlslFragment::typeOf(const GlslSpecifiers& specifiers) const
{
    const auto words = expandMacros(*_source, specifiers.typeToken, {specifiers.type});
    return words.size() == 1 ? std::string(words[0]) : specifiers.type;
}

void GlslFragment::addOutput(const GlslDeclaration& one, GlslWrapped& result)
{
    const GlslSpecifiers& specifiers = _source->specifiersOf(one);
    GlslOutput output;
    output.name = output.variable = one.name;
    output.type = typeOf(specifiers);
    output.conditional = one.conditional;
    _outputs.insert(one.name);
    const GlslRange& array = one.array.empty() ? specifiers.typeArray : one.array;
    if (!array.empty())
    {
        bool known = false;
        const long long size = constant(array.first + 1, array.last - 1, known);
        if (!known || size < 1 || size > 64 ||
            (!one.array.empty() && !specifiers.typeArray.empty()))
        {
            say(result.errors, one.nameToken,
                "the array size of output '" + one.name + "' is not known");
            return;
        }
        output.arraySize = static_cast<int>(size);
    }
    readLayout(one, output, result);
    if (one.conditional)
    {
        say(result.warnings, one.nameToken,
            "output '" + one.name + "' depends on a condition that is not known here");
    }
    const auto same = std::find_if(result.outputs.begin(), result.outputs.end(),
                                   [&](const GlslOutput& other) { return other.name == one.name; });
    if (same == result.outputs.end())
    {
        result.outputs.push_back(output);
    }
    else if (same->type != output.type || same->arraySize != output.arraySize ||
             (same->location >= 0 && output.location >= 0 && same->location != output.location))
    {
        say(result.errors, one.nameToken,
            "output '" + one.name + "' is declared differently before");
    }
    else
    {
        same->location = std::max(same->location, output.location);
    }
}

void GlslFragment::readLayout(const GlslDeclaration& one, GlslOutput& output, GlslWrapped& result)
{
    for (const GlslQualifier& qualifier : _source->specifiersOf(one).qualifiers)
    {
        if (qualifier.word != "layout")
        {
            continue;
        }
        for (std::size_t i = qualifier.range.first; i < qualifier.range.last; ++i)
        {
            const std::string_view word = _source->word(i);
            if (_source->uses[i].kind != GlslUse::Kind::LayoutName ||
                (word != "location" && word != "index"))
            {
                continue;
            }
            std::size_t first = i + 1;
            while (first < qualifier.range.last && _source->word(first) != "=")
            {
                ++first;
            }
            std::size_t last = ++first;
            while (last + 1 < qualifier.range.last && _source->word(last) != ",")
            {
                ++last;
            }
            bool known = false;
            const long long value = constant(first, last, known);
            if (!known || value < 0 || value > 63)
            {
                say(result.errors, i,
                    "the " + std::string(word) + " of output '" + one.name + "' is not known");
            }
            else if (word == "location")
            {
                output.location = static_cast<int>(value);
            }
            else if (value != 0)
            {
                say(result.errors, i, "dual-source blending (index = 1) is not supported");
            }
        }
    }
}

void GlslFragment::edit(GlslEdit& edit, GlslEdit::Names& names) const
{
    names["main"] = "osgmr_userMain";
    names["gl_FragColor"] = _foldColor ? "osgmr_fragData[0]" : "osgmr_fragColor";
    names["gl_FragData"] = "osgmr_fragData";
    std::set<std::size_t> done;
    for (const GlslDeclaration& one : _source->declarations)
    {
        const GlslSpecifiers& specifiers = _source->specifiersOf(one);
        if (isOutput(one) && done.insert(one.specifiers).second)
        {
            edit.removeQualifiers(specifiers, OutputQualifiers);
        }
        const bool replaced =
            _outputs.count(one.name) || one.name == "gl_FragColor" || one.name == "gl_FragData";
        if (one.kind == GlslDeclaration::Kind::Redeclaration && replaced &&
            done.insert(one.specifiers).second)
        {
            edit.blank(specifiers.statement);
        }
    }
    insertDeclarations(edit);
}

/// Declares what stands for gl_FragColor and gl_FragData: before the first code, but not within an
/// #if that may be left out.
void GlslFragment::insertDeclarations(GlslEdit& edit) const
{
    std::string text;
    if (_usesColor && !_foldColor)
    {
        text += "vec4 osgmr_fragColor; ";
    }
    if (_usesData || (_usesColor && _foldColor))
    {
        text += "vec4 osgmr_fragData[gl_MaxDrawBuffers]; ";
    }
    if (text.empty())
    {
        return;
    }
    std::size_t token = _source->firstCode;
    for (const GlslRange& region : _source->conditionals)
    {
        if (_source->firstCodeConditional && region.first < token && token < region.last)
        {
            const bool extends = std::any_of(_source->directives.begin(), _source->directives.end(),
                                             [&](const GlslDirective& directive)
                                             {
                                                 return directive.name == "extension" &&
                                                        directive.token > region.first &&
                                                        directive.token < token;
                                             });
            if (!extends)
            {
                text.back() = '\n';
                token = region.first;
            }
            break;
        }
    }
    edit.insertBefore(token, text);
}

void mergeFragmentBuiltins(std::vector<GlslFragment>& fragments, GlslWrapped& result)
{
    bool color = false, data = false, freely = false;
    std::set<int> elements;
    for (const GlslFragment& fragment : fragments)
    {
        color = color || fragment.usesColor();
        data = data || fragment.usesData();
        freely = freely || fragment.dataIndexedFreely();
        elements.insert(fragment.dataElements().begin(), fragment.dataElements().end());
    }
    if (color && data)
    {
        // Legal where a condition chooses between them, which is not known here.
        elements.insert(0);
        for (GlslFragment& fragment : fragments)
        {
            fragment.foldColorIntoData();
        }
    }
    GlslOutput output;
    output.type = "vec4";
    output.location = 0;
    if (data)
    {
        output.name = "gl_FragData";
        output.variable = "osgmr_fragData";
        output.arraySize = freely ? GlslOutput::AllDrawBuffers : *elements.rbegin() + 1;
        if (!freely)
        {
            output.elements.assign(elements.begin(), elements.end());
        }
        result.outputs.push_back(output);
    }
    else if (color)
    {
        output.name = "gl_FragColor";
        output.variable = "osgmr_fragColor";
        output.broadcast = true;
        result.outputs.push_back(output);
    }
}

} // namespace osgMultiRender
