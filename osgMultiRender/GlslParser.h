// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/GlslPreprocessor.h>

namespace osgMultiRender
{

/// Fills in declarations, functions, structs, blocks, scopes and uses of a preprocessed source.
///
/// A single pass forward with an explicit stack: linear, whatever the nesting. It reads
/// declarations exactly and of expressions only the names.
class GlslParser
{
public:
    GlslParser(GlslSource& source, const GlslActiveTokens& active);

    void run();

private:
    enum class FrameKind
    {
        Global,
        Function,
        Block,
        Loop, ///< for, while, switch, else: ends with its statement.
        If,   ///< As Loop, but an "else" may follow.
        Do    ///< As Loop, but "while (…);" follows.
    };

    struct Frame
    {
        FrameKind kind;
        std::size_t scope;
        std::size_t undo;     ///< Size of `_declared` when it was opened.
        std::size_t function; ///< Of a Function frame.
        std::size_t opened;   ///< Token.
    };

    // Tokens.
    bool ended() const { return _at >= _active.tokens.size(); }
    std::size_t index(std::size_t ahead = 0) const;
    std::string_view word(std::size_t ahead = 0) const;
    GlslToken::Kind kind(std::size_t ahead = 0) const;
    bool isName(std::size_t ahead = 0) const { return kind(ahead) == GlslToken::Kind::Identifier; }
    bool accept(std::string_view text);
    void say(std::size_t token, const std::string& message);

    // Scopes and names.
    void open(FrameKind kind, GlslScope::Kind scope);
    void close();
    void declare(std::size_t nameToken, GlslUse::Kind kind, std::size_t target);
    const GlslUse* lookUp(std::string_view name) const;
    void resolve();

    // Statements.
    void statement();
    void globalStatement();
    bool controlStatement();
    void closeBrace();
    void endStatement();
    void forHeader();
    void whileHeader();

    // Expressions: up to a ";", an unmatched bracket, or a "," where `atComma` asks for it.
    void expression(bool atComma, bool braces);
    void bracketed();
    GlslRange arrays();

    // Declarations.
    bool startsDeclaration() const;
    bool startsType(std::size_t ahead) const;
    bool qualifiesHere() const;
    const GlslMacro* findQualifierMacro() const;
    bool takeQualifierMacro(GlslSpecifiers& specifiers);
    bool parseSpecifiers(GlslSpecifiers& specifiers, bool inBody);
    void parseLayout(GlslSpecifiers& specifiers);
    void parseStruct(GlslSpecifiers& specifiers);
    std::vector<std::size_t> members(GlslDeclaration::Kind kind);
    void declaration();
    void redeclarations(std::size_t specifiers);
    void declarators(std::size_t specifiers);
    std::size_t declarator(std::size_t specifiers, GlslDeclaration::Kind kind);
    void interfaceBlock(std::size_t specifiers);
    void function(std::size_t specifiers);
    std::vector<std::size_t> parameters();
    void finishStatement(std::size_t specifiers);

    GlslSource& _source;
    const GlslActiveTokens& _active;
    std::size_t _at = 0;
    std::vector<Frame> _frames;
    std::unordered_map<std::string_view, std::vector<GlslUse>> _names;
    std::vector<std::string_view> _declared;
};

} // namespace osgMultiRender
