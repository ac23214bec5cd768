// SPDX-License-Identifier: MIT
// The declarations' part of GlslParser.
#include <osgMultiRender/GlslParser.h>
#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

// In tokens. A bound, so that looking ahead for each name of "a[a[a[…" stays linear.
constexpr std::size_t LongestArraySize = 64;

bool isStorage(std::string_view word)
{
    return word == "in" || word == "out" || word == "uniform" || word == "buffer";
}

} // namespace

/// True where a qualifier stands. A word that is none in this version is one where another word
/// follows it ("flat varying vec3 n", by an extension), unless it names a struct.
bool GlslParser::qualifiesHere() const
{
    if (word() == "layout")
    {
        return word(1) == "(";
    }
    if (!isQualifier(word()))
    {
        return false;
    }
    if (kind() == GlslToken::Kind::Keyword)
    {
        return true;
    }
    const GlslUse* known = lookUp(word());
    return !known && (isName(1) || kind(1) == GlslToken::Kind::Keyword);
}

/// True for "Type name", "Type[2] name" and "struct". A macro may stand for the type.
bool GlslParser::startsType(std::size_t ahead) const
{
    if (word(ahead) == "struct" ||
        (kind(ahead) == GlslToken::Kind::Keyword && isBuiltinType(word(ahead))))
    {
        // "vec4(…)" and "float[2](…)" are constructors.
        return word(ahead + 1) != "(";
    }
    if (!isName(ahead))
    {
        return false;
    }
    std::size_t next = ahead + 1;
    int depth = 0;
    while (word(next) == "[" || depth > 0)
    {
        const std::string_view text = word(next);
        if (text.empty() || text == ";" || text == "{" || text == "}" ||
            next > ahead + LongestArraySize)
        {
            return false;
        }
        depth += text == "[" ? 1 : text == "]" ? -1 : 0;
        ++next;
    }
    return isName(next);
}

bool GlslParser::startsDeclaration() const
{
    return word() == "precision" || qualifiesHere() || startsType(0) || findQualifierMacro();
}

/// The macro at the cursor if it stands for qualifiers alone, or for nothing: "#define OUT out".
const GlslMacro* GlslParser::findQualifierMacro() const
{
    const GlslMacro* macro = isName() ? _source.findMacro(word(), index()) : nullptr;
    if (!macro || macro->functionLike || macro->body.size() > 8)
    {
        return nullptr;
    }
    const bool qualifiers = std::all_of(macro->body.begin(), macro->body.end(),
                                        [this](const GlslToken& part)
                                        { return isQualifier(textOf(_source.text, part)); });
    return qualifiers ? macro : nullptr;
}

bool GlslParser::takeQualifierMacro(GlslSpecifiers& specifiers)
{
    const GlslMacro* macro = findQualifierMacro();
    if (!macro)
    {
        return false;
    }
    for (const GlslToken& part : macro->body)
    {
        specifiers.qualifiers.push_back(
            {std::string(textOf(_source.text, part)), {index(), index() + 1}});
    }
    resolve();
    ++_at;
    return true;
}

void GlslParser::parseLayout(GlslSpecifiers& specifiers)
{
    GlslQualifier qualifier;
    qualifier.word = word();
    qualifier.range.first = index();
    ++_at;
    int depth = 0;
    bool key = true;
    while (!ended() && word() != ";" && word() != "{" && word() != "}")
    {
        const std::string_view text = word();
        depth += text == "(" ? 1 : text == ")" ? -1 : 0;
        resolve();
        if (isName() && key && qualifier.word == "layout")
        {
            _source.uses[index()] = {GlslUse::Kind::LayoutName, 0};
        }
        key = text == "," || (text == "(" && depth == 1);
        ++_at;
        if (depth <= 0)
        {
            break;
        }
    }
    qualifier.range.last = _active.tokens[_at - 1] + 1;
    specifiers.qualifiers.push_back(std::move(qualifier));
}

/// Reads qualifiers and type. False if there is no type; qualifiers may have been read.
/// `inBody`: within a struct or block, which holds no further struct.
bool GlslParser::parseSpecifiers(GlslSpecifiers& specifiers, bool inBody)
{
    specifiers.statement = {index(), index()};
    for (;;)
    {
        if (qualifiesHere())
        {
            if (word(1) == "(")
            {
                parseLayout(specifiers);
                continue;
            }
            specifiers.qualifiers.push_back({std::string(word()), {index(), index() + 1}});
            resolve();
            ++_at;
        }
        else if (!takeQualifierMacro(specifiers))
        {
            break;
        }
    }
    if (word() == "struct" && !inBody)
    {
        parseStruct(specifiers);
        return true;
    }
    const bool type =
        startsType(0) || (kind() == GlslToken::Kind::Keyword && isBuiltinType(word()));
    if (!type || word() == "struct")
    {
        return false;
    }
    specifiers.typeToken = index();
    specifiers.type = word();
    resolve();
    ++_at;
    specifiers.typeArray = arrays();
    return true;
}

void GlslParser::parseStruct(GlslSpecifiers& specifiers)
{
    specifiers.typeToken = index();
    ++_at;
    const std::size_t made = _source.structs.size();
    _source.structs.emplace_back();
    if (isName())
    {
        GlslStruct& type = _source.structs.back();
        type.name = word();
        type.nameToken = index();
        specifiers.type = word();
        specifiers.typeToken = index();
        declare(index(), GlslUse::Kind::Type, made);
        ++_at;
    }
    if (accept("{"))
    {
        std::vector<std::size_t> inner = members(GlslDeclaration::Kind::Member);
        _source.structs[made].members = std::move(inner);
    }
    specifiers.typeArray = arrays();
}

/// Reads "type a, b[2]; …" up to the closing brace and over it.
std::vector<std::size_t> GlslParser::members(GlslDeclaration::Kind kind)
{
    std::vector<std::size_t> result;
    while (!ended() && !accept("}"))
    {
        const std::size_t before = _at;
        const std::size_t made = _source.specifiers.size();
        GlslSpecifiers specifiers;
        const bool typed = parseSpecifiers(specifiers, true);
        _source.specifiers.push_back(std::move(specifiers));
        while (typed && isName())
        {
            result.push_back(declarator(made, kind));
            if (!accept(","))
            {
                break;
            }
        }
        finishStatement(made);
        if (_at == before)
        {
            resolve();
            ++_at;
        }
    }
    return result;
}

void GlslParser::declaration()
{
    if (accept("precision"))
    {
        expression(false, false);
        accept(";");
        return;
    }
    const std::size_t before = _at;
    GlslSpecifiers specifiers;
    const bool typed = parseSpecifiers(specifiers, false);
    const bool storage = std::any_of(specifiers.qualifiers.begin(), specifiers.qualifiers.end(),
                                     [](const GlslQualifier& q) { return isStorage(q.word); });
    const std::size_t made = _source.specifiers.size();
    _source.specifiers.push_back(std::move(specifiers));
    if (typed)
    {
        isName() && word(1) == "(" ? function(made) : declarators(made);
    }
    else if (isName() && word(1) == "{" && storage)
    {
        interfaceBlock(made);
    }
    else if (isName() && _at != before)
    {
        redeclarations(made);
    }
    else
    {
        // "layout(early_fragment_tests) in;"
        finishStatement(made);
    }
}

/// "invariant gl_Position, color;"
void GlslParser::redeclarations(std::size_t specifiers)
{
    while (isName())
    {
        GlslDeclaration again;
        again.kind = GlslDeclaration::Kind::Redeclaration;
        again.name = word();
        again.nameToken = index();
        again.specifiers = specifiers;
        again.scope = _frames.back().scope;
        again.conditional = _active.conditional[_at];
        _source.declarations.push_back(std::move(again));
        resolve();
        ++_at;
        if (!accept(","))
        {
            break;
        }
    }
    finishStatement(specifiers);
}

void GlslParser::declarators(std::size_t specifiers)
{
    const bool global = _frames.back().kind == FrameKind::Global;
    const auto kind = global ? GlslDeclaration::Kind::Global : GlslDeclaration::Kind::Local;
    while (isName() || this->kind() == GlslToken::Kind::Keyword)
    {
        if (!isName())
        {
            say(index(), "'" + std::string(word()) + "' is a keyword, not a name");
            ++_at;
            break;
        }
        declarator(specifiers, kind);
        if (!accept(","))
        {
            break;
        }
    }
    finishStatement(specifiers);
}

/// Reads "name[2] = value"; the name is known behind its initializer.
std::size_t GlslParser::declarator(std::size_t specifiers, GlslDeclaration::Kind kind)
{
    const std::size_t made = _source.declarations.size();
    GlslDeclaration one;
    one.kind = kind;
    one.name = word();
    one.nameToken = index();
    one.specifiers = specifiers;
    one.scope = _frames.back().scope;
    one.conditional = _active.conditional[_at];
    ++_at;
    one.array = arrays();
    if (accept("="))
    {
        one.initializer.first = index();
        expression(true, true);
        one.initializer.last = index();
    }
    const std::size_t name = one.nameToken;
    _source.declarations.push_back(std::move(one));
    switch (kind)
    {
    case GlslDeclaration::Kind::Global:
        declare(name, GlslUse::Kind::Global, made);
        break;
    case GlslDeclaration::Kind::BlockMember:
        declare(name, GlslUse::Kind::BlockMember, made);
        break;
    case GlslDeclaration::Kind::Local:
        declare(name, GlslUse::Kind::Local, made);
        break;
    case GlslDeclaration::Kind::Parameter:
        // Known only within the body: function() declares it.
        _source.uses[name] = {GlslUse::Kind::Parameter, made};
        break;
    default:
        _source.uses[name] = {GlslUse::Kind::Member, made};
        break;
    }
    return made;
}

void GlslParser::interfaceBlock(std::size_t specifiers)
{
    const std::size_t made = _source.blocks.size();
    GlslBlock block;
    block.name = word();
    block.nameToken = index();
    block.specifiers = specifiers;
    _source.uses[index()] = {GlslUse::Kind::BlockName, made};
    _source.blocks.push_back(std::move(block));
    _at += 2;
    const std::size_t firstName = _declared.size();
    std::vector<std::size_t> inner = members(GlslDeclaration::Kind::BlockMember);
    if (isName())
    {
        // With an instance name the members are no global names after all.
        for (; _declared.size() > firstName; _declared.pop_back())
        {
            _names[_declared.back()].pop_back();
        }
        for (std::size_t member : inner)
        {
            GlslDeclaration& one = _source.declarations[member];
            one.kind = GlslDeclaration::Kind::Member;
            _source.uses[one.nameToken] = {GlslUse::Kind::Member, member};
        }
        _source.blocks[made].instance = word();
        declarator(specifiers, GlslDeclaration::Kind::Global);
    }
    _source.blocks[made].members = std::move(inner);
    finishStatement(specifiers);
}

void GlslParser::function(std::size_t specifiers)
{
    const std::size_t made = _source.functions.size();
    GlslFunction function;
    function.name = word();
    function.nameToken = index();
    function.specifiers = specifiers;
    function.conditional = _active.conditional[_at];
    const GlslUse* known = lookUp(word());
    const bool overload = known && known->kind == GlslUse::Kind::Function;
    declare(index(), GlslUse::Kind::Function, overload ? known->target : made);
    _source.functions.push_back(std::move(function));
    _at += 2;
    std::vector<std::size_t> declared = parameters();
    if (word() == "{")
    {
        open(FrameKind::Function, GlslScope::Kind::Function);
        _frames.back().function = made;
        _source.functions[made].body = {index(), _source.tokens.size()};
        for (std::size_t parameter : declared)
        {
            GlslDeclaration& one = _source.declarations[parameter];
            one.scope = _frames.back().scope;
            declare(one.nameToken, GlslUse::Kind::Parameter, parameter);
        }
        _source.specifiers[specifiers].statement.last = index();
        ++_at;
    }
    else
    {
        finishStatement(specifiers);
    }
    _source.functions[made].parameters = std::move(declared);
}

/// Reads parameters up to the closing bracket and over it.
std::vector<std::size_t> GlslParser::parameters()
{
    std::vector<std::size_t> result;
    while (!ended() && !accept(")"))
    {
        if (word() == ";" || word() == "{" || word() == "}")
        {
            say(index(), "the bracket of the parameters is not closed");
            break;
        }
        const std::size_t before = _at;
        const std::size_t made = _source.specifiers.size();
        GlslSpecifiers specifiers;
        const bool typed = parseSpecifiers(specifiers, true);
        _source.specifiers.push_back(std::move(specifiers));
        if (typed && isName())
        {
            result.push_back(declarator(made, GlslDeclaration::Kind::Parameter));
        }
        _source.specifiers[made].statement.last = index();
        if (!accept(",") && _at == before)
        {
            resolve();
            ++_at;
        }
    }
    return result;
}

/// Passes the rest of a statement over, with its semicolon.
void GlslParser::finishStatement(std::size_t specifiers)
{
    expression(false, false);
    accept(";");
    _source.specifiers[specifiers].statement.last =
        _at ? _active.tokens[_at - 1] + 1 : _source.tokens.size();
}

} // namespace osgMultiRender
