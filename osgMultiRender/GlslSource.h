// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/GlslToken.h>

#include <string>
#include <unordered_map>
#include <vector>

namespace osgMultiRender
{

/// What "#version" says.
struct GlslVersion
{
    enum class Profile
    {
        None, ///< Not named: core from 150 on.
        Core,
        Compatibility,
        Es
    };

    int number = 110;
    Profile profile = Profile::None;
};

/// Tokens [first, last) of a source.
struct GlslRange
{
    std::size_t first = 0;
    std::size_t last = 0;

    bool empty() const { return first >= last; }
};

/// One line of the preprocessor.
struct GlslDirective
{
    std::string name;             ///< "version", "define", "if"; empty for a lone "#".
    std::size_t token = 0;        ///< Index of its token.
    bool active = true;           ///< False inside of a branch that is known not to be compiled.
    std::vector<GlslToken> parts; ///< Without blanks and comments, without "#" and the name.
};

/// A "#define".
struct GlslMacro
{
    std::string name;
    std::size_t token = 0;                                ///< Index of the token of its directive.
    std::size_t undefined = static_cast<std::size_t>(-1); ///< Token of its #undef.
    bool functionLike = false;
    bool conditional = false; ///< Defined or undefined under a condition that is not known here.
    std::vector<std::string> parameters;
    std::vector<GlslToken> body;
};

/// One qualifier word, or "layout" with its bracket.
struct GlslQualifier
{
    std::string word;
    GlslRange range;
};

/// What the declarators of one statement share: "layout(location = 0) out vec4[2]".
struct OSGMULTIRENDER_EXPORT GlslSpecifiers
{
    std::vector<GlslQualifier> qualifiers;
    std::string type; ///< Empty for "invariant gl_Position;". "" too for an unnamed struct.
    std::size_t typeToken = 0;
    GlslRange typeArray; ///< "[2]" of "vec4[2] a;".
    GlslRange statement; ///< With the semicolon; of a parameter: up to its comma or bracket.

    bool has(std::string_view word) const;
};

/// One name that is declared; "float a, b[2] = x;" are two.
struct GlslDeclaration
{
    enum class Kind
    {
        Global,
        Local,
        Parameter,
        Member,       ///< Of a struct or of an interface block with an instance name.
        BlockMember,  ///< Of an interface block without one: a global name.
        Redeclaration ///< "invariant color;": qualifiers for a name declared elsewhere.
    };

    Kind kind = Kind::Global;
    std::string name;
    std::size_t nameToken = 0;
    std::size_t specifiers = 0; ///< Index of its GlslSpecifiers.
    GlslRange array;            ///< "[2]" behind the name.
    GlslRange initializer;      ///< Without "=".
    std::size_t scope = 0;
    bool conditional = false; ///< Inside of an #if whose condition is not known here.
};

/// A prototype or a definition; overloads are functions of the same name.
struct GlslFunction
{
    std::string name;
    std::size_t nameToken = 0;
    std::size_t specifiers = 0;          ///< The return type.
    std::vector<std::size_t> parameters; ///< Indices of declarations.
    GlslRange body;                      ///< With its braces; empty for a prototype.
    bool conditional = false;
};

struct GlslStruct
{
    std::string name; ///< Empty if it has none.
    std::size_t nameToken = 0;
    std::vector<std::size_t> members; ///< Indices of declarations.
};

/// "uniform Name { … } instance[2];"
struct GlslBlock
{
    std::string name;
    std::size_t nameToken = 0;
    std::size_t specifiers = 0;
    std::vector<std::size_t> members;
    std::string instance; ///< Empty: the members are global names.
};

/// A stretch of text with names of its own; scope 0 is the global one.
struct GlslScope
{
    enum class Kind
    {
        Global,
        Function, ///< Parameters and body.
        Block,
        Statement ///< for, while, if, else, switch: up to the end of the controlled statement.
    };

    Kind kind = Kind::Global;
    std::size_t parent = 0;
    GlslRange range;
};

/// What an identifier means at its place.
struct GlslUse
{
    enum class Kind : unsigned char
    {
        None, ///< No identifier.
        Global,
        BlockMember,
        Local,
        Parameter,
        Function,
        Type,
        BlockName,
        Member,     ///< Behind a dot, or a member's declaration.
        Macro,      ///< Of this source.
        Builtin,    ///< "gl_…" or a built-in function.
        LayoutName, ///< "location" of "layout(location = 0)".
        Undeclared, ///< Declared in another shader object, or nowhere.
        Inactive    ///< In a branch of the preprocessor that is not looked at.
    };

    Kind kind = Kind::None;
    std::size_t target = 0; ///< Index of the declaration, function or struct it names.
};

/// A GLSL text and what is in it.
///
/// Made by parseGlsl(). The text need not be correct: what can't be understood is passed over, and
/// what is surely wrong is in `messages`.
struct OSGMULTIRENDER_EXPORT GlslSource
{
    std::string text;
    GlslVersion version;
    std::vector<GlslToken> tokens;
    std::vector<GlslUse> uses; ///< One a token.
    std::vector<GlslDirective> directives;
    std::vector<GlslMacro> macros;
    std::vector<GlslRange> conditionals; ///< From #if to #endif, the outermost ones.
    std::size_t firstCode = 0; ///< The first token that is compiled; the number of tokens if none.
    bool firstCodeConditional = false; ///< Whether that depends on an unknown condition.
    std::vector<GlslSpecifiers> specifiers;
    std::vector<GlslDeclaration> declarations;
    std::vector<GlslFunction> functions;
    std::vector<GlslStruct> structs;
    std::vector<GlslBlock> blocks;
    std::vector<GlslScope> scopes;
    std::vector<GlslMessage> messages; ///< In the order of the text.

    std::string_view word(std::size_t token) const { return textOf(text, tokens[token]); }
    const GlslSpecifiers& specifiersOf(const GlslDeclaration& declaration) const
    {
        return specifiers[declaration.specifiers];
    }

    /// The text of a range with blanks and comments as single blanks, none at the ends.
    std::string spell(const GlslRange& range) const;

    /// The first global, function, struct or block of a name; null if there is none.
    const GlslDeclaration* findGlobal(std::string_view name) const;
    const GlslFunction* findFunction(std::string_view name) const;

    /// The #define in force at a token, null if none; the last one wins where it is not known.
    const GlslMacro* findMacro(std::string_view name, std::size_t token) const;

    /// Index into `macros` by name, in the order of the text.
    std::unordered_map<std::string, std::vector<std::size_t>> macrosByName;
};

/// Reads a text. Linear time, any bytes, any nesting; never throws but std::bad_alloc.
///
/// Conditions of #if are worked out as far as the text itself decides them: branches that are
/// surely not compiled are left out, those that may be compiled are all read (names of
/// `#pragma import_defines` and extension macros are unknown). `version` is the value of
/// `__VERSION__`; 0: what the text says.
OSGMULTIRENDER_EXPORT GlslSource parseGlsl(std::string text, int version = 0);

/// "core", "compatibility", "es" or "".
OSGMULTIRENDER_EXPORT const char* toString(GlslVersion::Profile profile);

} // namespace osgMultiRender
