// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslParser.h>

#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>

namespace osgMultiRender
{

GlslParser::GlslParser(GlslSource& source, const GlslActiveTokens& active)
    : _source(source), _active(active)
{
}

void GlslParser::run()
{
    open(FrameKind::Global, GlslScope::Kind::Global);
    while (!ended())
    {
        const std::size_t before = _at;
        statement();
        if (_at == before)
        {
            resolve();
            ++_at;
        }
    }
    while (_frames.size() > 1)
    {
        const Frame& frame = _frames.back();
        if (frame.kind == FrameKind::Block || frame.kind == FrameKind::Function)
        {
            say(frame.opened, "the brace is not closed");
        }
        close();
    }
    close();
}

std::size_t GlslParser::index(std::size_t ahead) const
{
    return _at + ahead < _active.tokens.size() ? _active.tokens[_at + ahead]
                                               : _source.tokens.size();
}

std::string_view GlslParser::word(std::size_t ahead) const
{
    const std::size_t token = index(ahead);
    return token < _source.tokens.size() ? _source.word(token) : std::string_view();
}

GlslToken::Kind GlslParser::kind(std::size_t ahead) const
{
    const std::size_t token = index(ahead);
    return token < _source.tokens.size() ? _source.tokens[token].kind : GlslToken::Kind::Other;
}

bool GlslParser::accept(std::string_view text)
{
    if (ended() || word() != text)
    {
        return false;
    }
    ++_at;
    return true;
}

void GlslParser::say(std::size_t token, const std::string& message)
{
    if (token < _source.tokens.size())
    {
        const GlslToken& at = _source.tokens[token];
        _source.messages.push_back({at.line, at.column, message});
    }
    else
    {
        _source.messages.push_back({0, 0, message});
    }
}

void GlslParser::open(FrameKind kind, GlslScope::Kind scopeKind)
{
    GlslScope scope;
    scope.kind = scopeKind;
    scope.parent = _frames.empty() ? 0 : _frames.back().scope;
    scope.range = {_frames.empty() ? 0 : index(), _source.tokens.size()};
    _frames.push_back({kind, _source.scopes.size(), _declared.size(), 0, index()});
    _source.scopes.push_back(scope);
}

void GlslParser::close()
{
    const Frame frame = _frames.back();
    const std::size_t end = index();
    _source.scopes[frame.scope].range.last =
        frame.kind == FrameKind::Global ? _source.tokens.size() : end;
    if (frame.kind == FrameKind::Function)
    {
        _source.functions[frame.function].body.last =
            _at ? _active.tokens[std::min(_at, _active.tokens.size()) - 1] + 1 : end;
    }
    for (; _declared.size() > frame.undo; _declared.pop_back())
    {
        _names[_declared.back()].pop_back();
    }
    _frames.pop_back();
}

void GlslParser::declare(std::size_t nameToken, GlslUse::Kind kind, std::size_t target)
{
    const GlslUse use{kind, target};
    _source.uses[nameToken] = use;
    const std::string_view name = _source.word(nameToken);
    _names[name].push_back(use);
    _declared.push_back(name);
}

const GlslUse* GlslParser::lookUp(std::string_view name) const
{
    const auto found = _names.find(name);
    return found == _names.end() || found->second.empty() ? nullptr : &found->second.back();
}

/// Says what the identifier at the cursor means.
void GlslParser::resolve()
{
    if (!isName())
    {
        return;
    }
    const std::string_view name = word();
    GlslUse& use = _source.uses[index()];
    const GlslUse* known = lookUp(name);
    if (_at > 0 && _source.word(_active.tokens[_at - 1]) == ".")
    {
        use.kind = GlslUse::Kind::Member;
    }
    else if (_source.findMacro(name, index()))
    {
        use.kind = GlslUse::Kind::Macro;
    }
    else if (known)
    {
        use = *known;
    }
    else
    {
        const bool builtin = name.substr(0, 3) == "gl_" || builtinFunctionSince(name) != 0;
        use.kind = builtin ? GlslUse::Kind::Builtin : GlslUse::Kind::Undeclared;
    }
}

void GlslParser::statement()
{
    if (accept(";"))
    {
        endStatement();
    }
    else if (word() == "}")
    {
        closeBrace();
    }
    else if (_frames.back().kind == FrameKind::Global)
    {
        globalStatement();
    }
    else if (word() == "{")
    {
        open(FrameKind::Block, GlslScope::Kind::Block);
        ++_at;
    }
    else if (controlStatement())
    {
        return;
    }
    else if (startsDeclaration())
    {
        declaration();
        endStatement();
    }
    else
    {
        const std::size_t before = _at;
        expression(false, false);
        if (accept(";") || _at == before)
        {
            endStatement();
        }
    }
}

void GlslParser::globalStatement()
{
    if (startsDeclaration())
    {
        declaration();
    }
    else if (word() == "{")
    {
        // The body of a function whose head is a macro.
        open(FrameKind::Block, GlslScope::Kind::Block);
        ++_at;
    }
    else
    {
        resolve();
        ++_at;
        if (word() == "(")
        {
            bracketed();
        }
    }
}

bool GlslParser::controlStatement()
{
    const std::string_view head = word();
    if (head == "if" || head == "switch")
    {
        open(head == "if" ? FrameKind::If : FrameKind::Loop, GlslScope::Kind::Statement);
        ++_at;
        bracketed();
    }
    else if (head == "for")
    {
        forHeader();
    }
    else if (head == "while")
    {
        whileHeader();
    }
    else if (head == "do")
    {
        open(FrameKind::Do, GlslScope::Kind::Statement);
        ++_at;
    }
    else if (head == "case" || head == "default")
    {
        while (!ended() && word() != ":" && word() != ";" && word() != "}" && word() != "{")
        {
            resolve();
            ++_at;
        }
        accept(":");
    }
    else if (head == "return" || head == "break" || head == "continue" || head == "discard" ||
             head == "else" || head == "precision")
    {
        ++_at;
    }
    else
    {
        return false;
    }
    return true;
}

void GlslParser::closeBrace()
{
    while (_frames.back().kind != FrameKind::Block && _frames.back().kind != FrameKind::Function &&
           _frames.back().kind != FrameKind::Global)
    {
        close();
    }
    if (_frames.back().kind == FrameKind::Global)
    {
        say(index(), "the closing brace has no opening one");
        ++_at;
        return;
    }
    ++_at;
    close();
    endStatement();
}

/// Closes the for, if, … whose controlled statement has ended.
void GlslParser::endStatement()
{
    for (;;)
    {
        const FrameKind kind = _frames.back().kind;
        if (kind == FrameKind::Global || kind == FrameKind::Function || kind == FrameKind::Block)
        {
            return;
        }
        close();
        if (kind == FrameKind::If && word() == "else")
        {
            open(FrameKind::Loop, GlslScope::Kind::Statement);
            ++_at;
            return;
        }
        if (kind == FrameKind::Do && accept("while"))
        {
            expression(false, false);
            accept(";");
        }
    }
}

void GlslParser::forHeader()
{
    open(FrameKind::Loop, GlslScope::Kind::Statement);
    ++_at;
    if (!accept("("))
    {
        return;
    }
    if (startsDeclaration())
    {
        declaration();
    }
    for (int part = 0; part < 3 && !ended() && word() != ")" && word() != "}"; ++part)
    {
        expression(false, false);
        accept(";");
    }
    if (!accept(")"))
    {
        say(_frames.back().opened, "the bracket of 'for' is not closed");
    }
}

void GlslParser::whileHeader()
{
    open(FrameKind::Loop, GlslScope::Kind::Statement);
    ++_at;
    if (word() != "(")
    {
        return;
    }
    ++_at;
    if (startsDeclaration())
    {
        declaration();
    }
    expression(false, false);
    accept(")");
}

void GlslParser::expression(bool atComma, bool braces)
{
    std::size_t brackets = 0, curly = 0, opened = 0;
    for (; !ended(); ++_at)
    {
        const std::string_view text = word();
        const char c = text.size() == 1 ? text[0] : '\0';
        if (c == ';' || (c == ',' && atComma && !brackets && !curly))
        {
            break;
        }
        if (c == '(' || c == '[')
        {
            ++brackets;
            opened = index();
        }
        else if (c == ')' || c == ']')
        {
            if (brackets == 0)
            {
                return;
            }
            --brackets;
        }
        else if (c == '{')
        {
            if (!braces)
            {
                break;
            }
            ++curly;
        }
        else if (c == '}')
        {
            if (curly == 0)
            {
                break;
            }
            --curly;
        }
        resolve();
    }
    if (brackets)
    {
        say(opened, "the bracket is not closed");
    }
}

/// Passes "( … )" over.
void GlslParser::bracketed()
{
    if (!accept("("))
    {
        return;
    }
    const std::size_t opened = _active.tokens[_at - 1];
    expression(false, false);
    if (!accept(")"))
    {
        say(opened, "the bracket is not closed");
    }
}

/// Passes "[2][3]" over.
GlslRange GlslParser::arrays()
{
    GlslRange range{index(), index()};
    while (accept("["))
    {
        expression(false, false);
        if (!accept("]"))
        {
            break;
        }
        range.last = _active.tokens[_at - 1] + 1;
    }
    return range;
}

} // namespace osgMultiRender
