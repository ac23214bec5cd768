// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslEdit.h>
#include <osgMultiRender/GlslSource.h>

#include <gtest/gtest.h>

using namespace osgMultiRender;

namespace
{

using Kind = GlslUse::Kind;

/// The meaning of each occurrence of a name, in the order of the text.
std::vector<Kind> uses(const GlslSource& source, const std::string& name)
{
    std::vector<Kind> result;
    for (std::size_t i = 0; i < source.tokens.size(); ++i)
    {
        if (source.uses[i].kind != Kind::None && source.word(i) == name)
        {
            result.push_back(source.uses[i].kind);
        }
    }
    return result;
}

using Kinds = std::vector<Kind>;

std::string renamed(const std::string& text, const std::string& from, const std::string& to)
{
    const GlslSource source = parseGlsl(text);
    GlslEdit edit(source);
    edit.rename({{from, to}});
    return edit.getText();
}

std::vector<std::string> messages(const std::string& text)
{
    std::vector<std::string> result;
    for (const GlslMessage& message : parseGlsl(text).messages)
    {
        result.push_back(std::to_string(message.line) + ":" + std::to_string(message.column) + " " +
                         message.message);
    }
    return result;
}

} // namespace

TEST(GlslSourceTest, versionAndProfileAreRead)
{
    EXPECT_EQ(parseGlsl("void main(){}").version.number, 110);
    EXPECT_EQ(parseGlsl("// c\n #version 410 core\n").version.number, 410);
    EXPECT_EQ(parseGlsl("#version 410 core").version.profile, GlslVersion::Profile::Core);
    EXPECT_EQ(parseGlsl("#version 300 es").version.profile, GlslVersion::Profile::Es);
    EXPECT_EQ(parseGlsl("#version 100").version.profile, GlslVersion::Profile::Es);
    EXPECT_EQ(parseGlsl("#version 150").version.profile, GlslVersion::Profile::None);
}

TEST(GlslSourceTest, directivesAreListedWithTheirParts)
{
    const GlslSource source =
        parseGlsl("#extension GL_EXT_x : enable\n#pragma debug(on)\n#define F(a, b) a + b\n");
    ASSERT_EQ(source.directives.size(), 3u);
    EXPECT_EQ(source.directives[0].name, "extension");
    EXPECT_EQ(textOf(source.text, source.directives[0].parts[0]), "GL_EXT_x");
    EXPECT_EQ(source.directives[1].name, "pragma");
    ASSERT_EQ(source.macros.size(), 1u);
    EXPECT_TRUE(source.macros[0].functionLike);
    EXPECT_EQ(source.macros[0].parameters, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(source.macros[0].body.size(), 3u);
    EXPECT_FALSE(parseGlsl("#define F (a)\n").macros[0].functionLike);
}

TEST(GlslSourceTest, eachDeclaratorOfAListStandsAlone)
{
    const GlslSource source = parseGlsl(
        "#version 330\nlayout(location = 1) flat in vec4[2] a,\n b[3] , c = vec4(f(1, 2), 3);");
    ASSERT_EQ(source.declarations.size(), 3u);
    EXPECT_EQ(source.declarations[0].name, "a");
    EXPECT_EQ(source.declarations[1].name, "b");
    EXPECT_EQ(source.spell(source.declarations[1].array), "[3]");
    EXPECT_EQ(source.tokens[source.declarations[1].nameToken].line, 3u);
    EXPECT_EQ(source.spell(source.declarations[2].initializer), "vec4(f(1, 2), 3)");
    const GlslSpecifiers& shared = source.specifiersOf(source.declarations[2]);
    EXPECT_EQ(shared.type, "vec4");
    EXPECT_EQ(source.spell(shared.typeArray), "[2]");
    ASSERT_EQ(shared.qualifiers.size(), 3u);
    EXPECT_EQ(source.spell(shared.qualifiers[0].range), "layout(location = 1)");
    EXPECT_TRUE(shared.has("flat") && shared.has("in"));
}

TEST(GlslSourceTest, structsHoldTheirMembersAndDeclareTheirName)
{
    const GlslSource source =
        parseGlsl("struct Light { vec3 at, color; float power[2]; } sun, moon;\n"
                  "uniform Light lamp; struct { int i; } unnamed;");
    ASSERT_EQ(source.structs.size(), 2u);
    EXPECT_EQ(source.structs[0].members.size(), 3u);
    EXPECT_EQ(source.declarations[source.structs[0].members[1]].name, "color");
    ASSERT_TRUE(source.findGlobal("moon"));
    EXPECT_EQ(source.specifiersOf(*source.findGlobal("lamp")).type, "Light");
    EXPECT_TRUE(source.findGlobal("unnamed"));
    EXPECT_EQ(uses(source, "Light"), (Kinds{Kind::Type, Kind::Type}));
}

TEST(GlslSourceTest, blockMembersAreGlobalOnlyWithoutAnInstanceName)
{
    const GlslSource source =
        parseGlsl("#version 330\nlayout(std140) uniform A { vec4 x; mat4 m[2]; };\n"
                  "in B { vec4 x; } b[2];\nvec4 f() { return x + b[0].x; }");
    ASSERT_EQ(source.blocks.size(), 2u);
    EXPECT_EQ(source.blocks[0].members.size(), 2u);
    EXPECT_EQ(source.blocks[0].instance, "");
    EXPECT_EQ(source.blocks[1].instance, "b");
    EXPECT_EQ(uses(source, "x"),
              (Kinds{Kind::BlockMember, Kind::Member, Kind::BlockMember, Kind::Member}));
    EXPECT_EQ(uses(source, "b"), (Kinds{Kind::Global, Kind::Global}));
    EXPECT_EQ(uses(source, "std140"), (Kinds{Kind::LayoutName}));
}

TEST(GlslSourceTest, functionsKeepOverloadsParametersAndBodies)
{
    const GlslSource source =
        parseGlsl("float f(float); vec2 f(const in vec2 a, inout float b[2]) { return a; }\n"
                  "void main(void) { f(1.0); }");
    ASSERT_EQ(source.functions.size(), 3u);
    EXPECT_TRUE(source.functions[0].body.empty());
    EXPECT_EQ(source.spell(source.functions[1].body), "{ return a; }");
    ASSERT_EQ(source.functions[1].parameters.size(), 2u);
    EXPECT_EQ(source.declarations[source.functions[1].parameters[1]].name, "b");
    EXPECT_EQ(source.specifiers[source.functions[1].specifiers].type, "vec2");
    EXPECT_EQ(uses(source, "f"), (Kinds{Kind::Function, Kind::Function, Kind::Function}));
    EXPECT_TRUE(source.functions[2].parameters.empty());
}

TEST(GlslSourceTest, localsShadowGlobalsWithinTheirScope)
{
    const GlslSource source = parseGlsl("float x;\n"
                                        "void f(float x) { x; { int x = x; x; } x; }\n"
                                        "void g() { x; for (int x = 0; x < 2; ++x) x; x; }\n");
    EXPECT_EQ(uses(source, "x"),
              (Kinds{Kind::Global, Kind::Parameter, Kind::Parameter,
                     Kind::Local,     // "int x"
                     Kind::Parameter, // its initializer
                     Kind::Local, Kind::Parameter,
                     Kind::Global, // g
                     Kind::Local, Kind::Local, Kind::Local, Kind::Local, Kind::Global}));
}

TEST(GlslSourceTest, loopVariablesEndWithTheirStatement)
{
    const GlslSource source = parseGlsl("int i;\nvoid f() {\n"
                                        "for (int i = 0; ; ) if (i > 1) i; else i;\ni;\n"
                                        "while (bool i = g()) { i; } i;\n"
                                        "do { float i; } while (i < 2); i;\n"
                                        "if (i > 0) for (int i; ; ) i; else i;\n"
                                        "switch (i) { case 1: int i; i; default: break; } i; }");
    EXPECT_EQ(uses(source, "i"),
              (Kinds{Kind::Global,                                              //
                     Kind::Local,  Kind::Local,  Kind::Local,  Kind::Local,     // for
                     Kind::Global,                                              //
                     Kind::Local,  Kind::Local,  Kind::Global,                  // while
                     Kind::Local,  Kind::Global, Kind::Global,                  // do
                     Kind::Global, Kind::Local,  Kind::Local,  Kind::Global,    // if
                     Kind::Global, Kind::Local,  Kind::Local,  Kind::Global})); // switch
}

TEST(GlslSourceTest, builtinsAndUndeclaredNamesAreToldApart)
{
    const GlslSource source = parseGlsl("void f() { gl_FragColor = mix(other(), gl_Color, 1.0); }");
    EXPECT_EQ(uses(source, "gl_FragColor"), (Kinds{Kind::Builtin}));
    EXPECT_EQ(uses(source, "mix"), (Kinds{Kind::Builtin}));
    EXPECT_EQ(uses(source, "other"), (Kinds{Kind::Undeclared}));
}

TEST(GlslSourceTest, branchesThatAreNotCompiledAreLeftOut)
{
    const GlslSource source = parseGlsl(
        "#version 120\n#define A 2\n#if A > 1 && !defined(B) && __VERSION__ < 130\nint yes;\n"
        "#else\nint no;\n#endif\n#ifdef GL_ES\nint es;\n#elif 0x10 == 020 - 0\nint hex;\n#endif\n");
    EXPECT_TRUE(source.findGlobal("yes"));
    EXPECT_FALSE(source.findGlobal("no"));
    EXPECT_FALSE(source.findGlobal("es"));
    EXPECT_TRUE(source.findGlobal("hex"));
    EXPECT_EQ(uses(source, "no"), (Kinds{Kind::Inactive}));
    EXPECT_TRUE(parseGlsl(source.text, 330).findGlobal("no"));
}

TEST(GlslSourceTest, branchesOfUnknownConditionsAreAllRead)
{
    const GlslSource source = parseGlsl(
        "#pragma import_defines(A, B)\n#ifdef A\nint a;\n#elif B > 1\nint b;\n#else\nint c;\n"
        "#endif\n#if 0 && A\nint d;\n#endif\nint e;");
    ASSERT_TRUE(source.findGlobal("a") && source.findGlobal("b") && source.findGlobal("c"));
    EXPECT_TRUE(source.findGlobal("b")->conditional);
    EXPECT_FALSE(source.findGlobal("d"));
    EXPECT_FALSE(source.findGlobal("e")->conditional);
}

TEST(GlslSourceTest, unbalancedBranchesOfAnUnknownConditionKeepTheFirst)
{
    const GlslSource source =
        parseGlsl("#ifdef GL_x\nvoid f() { if (a) {\n#else\nvoid f() { {\n#endif\n"
                  "} }\nvoid g() {}");
    EXPECT_EQ(source.functions.size(), 2u);
    EXPECT_TRUE(source.messages.empty());
}

TEST(GlslSourceTest, faultsAreReportedWithLineAndColumn)
{
    using List = std::vector<std::string>;
    EXPECT_EQ(messages("void f() {\n  {"),
              (List{"1:10 the brace is not closed", "2:3 the brace is not closed"}));
    EXPECT_EQ(messages("int a;\n}"), (List{"2:1 the closing brace has no opening one"}));
    EXPECT_EQ(messages("int a; /* b"), (List{"1:8 the comment is not closed"}));
    EXPECT_EQ(messages("void f() { g((1; }"), (List{"1:14 the bracket is not closed"}));
    EXPECT_EQ(messages("#if A\n"), (List{"1:1 #if without #endif"}));
    EXPECT_EQ(messages("#else\n#endif"), (List{"1:1 #else without #if", "2:1 #endif without #if"}));
    EXPECT_EQ(messages("void main() { for (int i = 0; i < 2; ++i) { a[i] = f(b, c); } }"), List{});
}

TEST(GlslSourceTest, renamingFollowsTheScopes)
{
    EXPECT_EQ(renamed("vec4 c; struct S { vec4 c; } s;\nvoid f(vec4 c) { c; } void g() { s.c = c; "
                      "{ int c; c; } c; }",
                      "c", "k"),
              "vec4 k; struct S { vec4 c; } s;\nvoid f(vec4 c) { c; } void g() { s.c = k; "
              "{ int c; c; } k; }");
    EXPECT_EQ(
        renamed("float f(int); float f(float a) { return a; } void main() { f(1); }", "f", "g"),
        "float g(int); float g(float a) { return a; } void main() { g(1); }");
}

TEST(GlslSourceTest, renamingReachesMacrosButNotTheirParameters)
{
    EXPECT_EQ(
        renamed(
            "float c;\n#define X (c + s.c)\n#define Y(c) c\n#if defined(Z) || c\n#endif\n#undef c2",
            "c", "k"),
        "float k;\n#define X (k + s.c)\n#define Y(c) c\n#if defined(Z) || k\n#endif\n#undef c2");
    EXPECT_EQ(renamed("float c;\n#define X \\\n c\n#if 0\nc;\n#endif\n", "c", "k"),
              "float k;\n#define X \\\n k\n#if 0\nk;\n#endif\n");
}

TEST(GlslSourceTest, localsThatAMacroMayMeanAreRenamedAlike)
{
    EXPECT_EQ(renamed("float c;\n#define X c\nvoid f() { int c = 1; X; }", "c", "k"),
              "float k;\n#define X k\nvoid f() { int k = 1; X; }");
}

TEST(GlslSourceTest, renamingMainThereAndBackGivesTheText)
{
    const std::string text = "void helper();\nvoid main(void) { int mainly = 0; helper(); }\n";
    EXPECT_EQ(renamed(text, "main", "user"),
              "void helper();\nvoid user(void) { int mainly = 0; helper(); }\n");
    EXPECT_EQ(renamed(renamed(text, "main", "user"), "user", "main"), text);
}

TEST(GlslSourceTest, qualifiersAreRemovedAndReplaced)
{
    const GlslSource source =
        parseGlsl("#version 330\nlayout(location = 0) /* a */ out\nvec4 a, b;\n");
    const GlslSpecifiers& specifiers = source.specifiersOf(*source.findGlobal("b"));
    GlslEdit remove(source);
    remove.removeQualifiers(specifiers, {"layout", "out"});
    EXPECT_EQ(remove.getText(), "#version 330\n   /* a */ \nvec4 a, b;\n");
    GlslEdit replace(source);
    replace.setQualifiers(specifiers, "uniform");
    EXPECT_EQ(replace.getText(), "#version 330\nuniform    /* a */ \nvec4 a, b;\n");
}

TEST(GlslSourceTest, insertedLinesAreFollowedByALineDirective)
{
    const GlslSource source = parseGlsl("#version 330\nint a;\nint b;\n");
    GlslEdit edit(source);
    edit.insertBefore(source.specifiersOf(*source.findGlobal("b")).statement.first,
                      "int x;\nint y;\n");
    EXPECT_EQ(edit.getText(), "#version 330\nint a;\nint x;\nint y;\n#line 3\nint b;\n");
    // Below 330 the directive's own line has the number.
    EXPECT_EQ(edit.getText(150), "#version 330\nint a;\nint x;\nint y;\n#line 2\nint b;\n");
    GlslEdit sameLine(source);
    sameLine.insertBefore(source.specifiersOf(*source.findGlobal("b")).statement.first, "int x; ");
    EXPECT_EQ(sameLine.getText(), "#version 330\nint a;\nint x; int b;\n");
}

TEST(GlslSourceTest, lineDirectivesGoOnFromTheUsersOwn)
{
    const GlslSource source = parseGlsl("#version 330\n#line 100 7\nint a;\nint b;\n");
    GlslEdit edit(source);
    edit.insertBefore(source.specifiersOf(*source.findGlobal("b")).statement.first, "int x;\n");
    EXPECT_EQ(edit.getText(), "#version 330\n#line 100 7\nint a;\nint x;\n#line 101 7\nint b;\n");
}
