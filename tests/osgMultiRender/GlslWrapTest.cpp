// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslWrap.h>

#include <gtest/gtest.h>

using namespace osgMultiRender;

namespace
{

const GlslVersion Target330{330, GlslVersion::Profile::Compatibility};
const GlslVersion Target430{430, GlslVersion::Profile::Compatibility};

GlslWrapped wrap(const std::string& fragment, const GlslVersion& target = Target330)
{
    return wrapProgram({{GlslStage::Fragment, fragment}}, target);
}

/// The first error as "shader line: message".
std::string error(const GlslWrapped& wrapped)
{
    if (wrapped.errors.empty())
    {
        return "none";
    }
    const GlslWrapMessage& first = wrapped.errors[0];
    return std::to_string(first.shader) + " " + std::to_string(first.where.line) + ": " +
           first.where.message;
}

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

} // namespace

TEST(GlslWrapTest, mainAndFragColorBecomeAFunctionAndAGlobal)
{
    const GlslWrapped wrapped = wrap("void main()\n{\n    gl_FragColor = vec4(1.0);\n}\n");
    ASSERT_TRUE(wrapped.ok) << error(wrapped);
    EXPECT_EQ(
        wrapped.texts[0],
        "#version 330 compatibility\n#line 1\nvec4 osgmr_fragColor; void osgmr_userMain()\n{\n"
        "    osgmr_fragColor = vec4(1.0);\n}\n");
    ASSERT_EQ(wrapped.outputs.size(), 1u);
    EXPECT_EQ(wrapped.outputs[0].name, "gl_FragColor");
    EXPECT_EQ(wrapped.outputs[0].variable, "osgmr_fragColor");
    EXPECT_TRUE(wrapped.outputs[0].broadcast);
}

TEST(GlslWrapTest, fragDataTellsWhichElementsAreWritten)
{
    const GlslWrapped constant =
        wrap("void main() { gl_FragData[0] = gl_FragData[3] = vec4(1.0); }");
    ASSERT_EQ(constant.outputs.size(), 1u);
    EXPECT_EQ(constant.outputs[0].elements, (std::vector<int>{0, 3}));
    EXPECT_EQ(constant.outputs[0].arraySize, 4);
    const GlslWrapped free = wrap("uniform int i; void main() { gl_FragData[i] = vec4(1.0); }");
    EXPECT_EQ(free.outputs[0].arraySize, GlslOutput::AllDrawBuffers);
    EXPECT_TRUE(contains(free.texts[0], "vec4 osgmr_fragData[gl_MaxDrawBuffers];"));
}

TEST(GlslWrapTest, outVariablesLoseTheirQualifiersAndAreListed)
{
    const GlslWrapped wrapped =
        wrap("#version 330 core\nlayout(location = 2) out vec4 a; out highp uvec2 b[3], c;\n"
             "invariant a;\nvoid main() { a = vec4(1.0); }\n");
    ASSERT_TRUE(wrapped.ok) << error(wrapped);
    EXPECT_EQ(wrapped.texts[0], "#version 330 core\n    vec4 a;  highp uvec2 b[3], c;\n \n"
                                "void osgmr_userMain() { a = vec4(1.0); }\n");
    ASSERT_EQ(wrapped.outputs.size(), 3u);
    EXPECT_EQ(wrapped.outputs[0].location, 2);
    EXPECT_EQ(wrapped.outputs[1].type, "uvec2");
    EXPECT_EQ(wrapped.outputs[1].arraySize, 3);
    EXPECT_EQ(wrapped.outputs[2].location, -1);
}

TEST(GlslWrapTest, fragDepthAndDiscardStay)
{
    const GlslWrapped wrapped =
        wrap("#version 420\nlayout(depth_less) out float gl_FragDepth;\nout vec4 c;\n"
             "void main() { if (true) discard; gl_FragDepth = 0.5; }\n");
    ASSERT_TRUE(wrapped.ok) << error(wrapped);
    EXPECT_TRUE(contains(wrapped.texts[0], "layout(depth_less) out float gl_FragDepth;"));
    EXPECT_TRUE(contains(wrapped.texts[0], "discard; gl_FragDepth = 0.5;"));
    EXPECT_EQ(wrapped.outputs.size(), 1u);
}

TEST(GlslWrapTest, boundOutputsGetTextThenBindingThenTheNextFreeLocation)
{
    GlslWrapped wrapped =
        wrap("#version 330\nlayout(location = 0) out vec4 a; out vec4 b, c, d[2];\n"
             "void main() {}\n");
    std::string cause;
    ASSERT_TRUE(bindOutputs(wrapped.outputs, {{"a", 7}, {"c", 1}}, cause)) << cause;
    EXPECT_EQ(wrapped.outputs[0].location, 0);
    EXPECT_EQ(wrapped.outputs[1].location, 2);
    EXPECT_EQ(wrapped.outputs[2].location, 1);
    EXPECT_EQ(wrapped.outputs[3].location, 3);
    wrapped = wrap("#version 330\nlayout(location = 0) out vec4 a, b; void main() {}\n");
    EXPECT_FALSE(bindOutputs(wrapped.outputs, {}, cause));
    EXPECT_EQ(cause, "outputs 'a' and 'b' are both at location 0");
}

TEST(GlslWrapTest, ourMainAssignsAndCallsSnippets)
{
    GlslOutput color;
    color.name = color.variable = "color";
    color.type = "vec3";
    color.location = 0;
    GlslOutput array = color;
    array.name = array.variable = "more";
    array.type = "uint";
    array.location = 1;
    array.arraySize = 2;
    GlslMainOptions options;
    options.snippets = {{"void kit();", "    kit();"}};
    EXPECT_EQ(
        wrapperMain(Target330, {color, array}, options),
        "#version 330 compatibility\nvoid osgmr_userMain();\nvec3 color;\nuint more[2];\n"
        "layout(location = 0) out vec3 osgmr_out0;\nlayout(location = 1) out uint osgmr_out1;\n"
        "layout(location = 2) out uint osgmr_out2;\nvoid kit();\nvec4 osgmr_surface()\n{\n"
        "    osgmr_userMain();\n    return vec4(color, 1.0);\n}\nvoid main()\n{\n"
        "    osgmr_surface();\n    osgmr_out0 = color;\n    osgmr_out1 = more[0];\n"
        "    osgmr_out2 = more[1];\n    kit();\n}\n");
}

TEST(GlslWrapTest, allTextsOfAProgramAreRaisedAlike)
{
    const GlslWrapped wrapped = wrapProgram(
        {{GlslStage::Vertex, "attribute vec3 n;\nvoid main() { gl_Position = ftransform(); }\n"},
         {GlslStage::Geometry, "#version 150\nvoid main() {}\n"},
         {GlslStage::Fragment, "# version 120 // old\nvoid main() { gl_FragColor = vec4(1.0); }\n"},
         {GlslStage::Fragment, "#version 410 core\nfloat f() { return 1.0; }\n"}},
        Target330);
    ASSERT_TRUE(wrapped.ok) << error(wrapped);
    EXPECT_EQ(wrapped.texts[0], "#version 330 compatibility\n#line 1\nattribute vec3 n;\n"
                                "void main() { gl_Position = ftransform(); }\n");
    EXPECT_EQ(wrapped.texts[1], "#version 330 core\n#line 1\n\nvoid main() {}\n");
    EXPECT_EQ(wrapped.texts[2].substr(0, 36), "#version 330 compatibility\n#line 1\n\n");
    EXPECT_EQ(wrapped.texts[3], "#version 410 core\nfloat f() { return 1.0; }\n");
    EXPECT_EQ(wrapped.version.number, 410);
}

TEST(GlslWrapTest, aRaisedTextStillAsksForTheVersionThatItWasWrittenFor)
{
    const std::string text = "#if __VERSION__ >= 130\nout vec4 color;\n#define C color\n#else\n"
                             "#define C gl_FragColor\n#endif\n"
                             "void main() { C = vec4(__VERSION__, x__VERSION__, 0, 1); }\n";
    const GlslWrapped old = wrap("#version 120\nuniform float x__VERSION__;\n" + text);
    ASSERT_TRUE(old.ok) << error(old);
    ASSERT_EQ(old.outputs.size(), 1u);
    EXPECT_EQ(old.outputs[0].name, "gl_FragColor");
    EXPECT_TRUE(contains(old.texts[0], "vec4(120, x__VERSION__, 0, 1)")) << old.texts[0];
    const GlslWrapped none = wrap(text);
    EXPECT_TRUE(contains(none.texts[0], "#if 110 >= 130")) << none.texts[0];
    const GlslWrapped newer =
        wrap("#version 400 compatibility\nuniform float x__VERSION__;\n" + text);
    ASSERT_TRUE(newer.ok) << error(newer);
    EXPECT_EQ(newer.outputs[0].name, "color");
    EXPECT_TRUE(contains(newer.texts[0], "vec4(__VERSION__,")) << newer.texts[0];
}

TEST(GlslWrapTest, privateNamesThatBecameKeywordsAreRenamed)
{
    const GlslWrapped wrapped =
        wrap("#version 120\nfloat buffer(float shared) { return shared; }\n"
             "struct P { float patch; };\n#define GET(p) p.patch\n"
             "void main() { P sample; sample.patch = buffer(1.0); GET(sample); }\n",
             Target430);
    ASSERT_TRUE(wrapped.ok) << error(wrapped);
    EXPECT_TRUE(contains(wrapped.texts[0], "float osgmr_user_buffer(float osgmr_user_shared)"));
    EXPECT_TRUE(contains(wrapped.texts[0], "#define GET(p) p.osgmr_user_patch"));
    EXPECT_TRUE(
        contains(wrapped.texts[0], "osgmr_user_sample.osgmr_user_patch = osgmr_user_buffer(1.0)"));
    // Nothing to do where they are no keywords yet.
    EXPECT_FALSE(
        contains(wrap("#version 120\nvoid main() { float buffer; }\n").texts[0], "osgmr_user_"));
}

TEST(GlslWrapTest, addressedNamesThatBecameKeywordsForbidRaising)
{
    const std::string main = "void main() {}\n";
    EXPECT_EQ(error(wrap("#version 120\nuniform vec4 flat;\n" + main)),
              "0 2: 'flat' is a keyword from GLSL 130 on and must keep its name: the version can't "
              "be raised");
    EXPECT_NE(error(wrap("varying vec2 smooth;\n" + main)), "none");
    EXPECT_NE(error(wrap("struct L { vec4 common; };\nuniform L lamp;\n" + main)), "none");
    EXPECT_NE(error(wrap("#version 150\nuniform B { vec4 sample; };\n" + main, Target430)), "none");
    EXPECT_NE(error(wrapProgram({{GlslStage::Vertex, "attribute vec3 layout;\n" + main},
                                 {GlslStage::Fragment, main}},
                                Target330)),
              "none");
    EXPECT_TRUE(wrap("struct L { vec4 common; };\nL lamp;\n" + main).ok);
    EXPECT_TRUE(wrap("#version 330\nuniform vec4 sample;\n" + main).ok);
}

TEST(GlslWrapTest, ownFunctionsNamedLikeNewerBuiltinsAreRenamedInTheWholeStage)
{
    const GlslWrapped wrapped = wrapProgram(
        {{GlslStage::Fragment,
          "#version 110\nfloat round(float x);\nvoid main() { float trunc = round(1.0); }\n"},
         {GlslStage::Fragment, "#version 330\nfloat round(float x) { return x; }\n"},
         {GlslStage::Fragment, "#version 330\nfloat g() { return round(1.5); }\n"}},
        Target330);
    ASSERT_TRUE(wrapped.ok) << error(wrapped);
    EXPECT_TRUE(contains(wrapped.texts[0], "float osgmr_user_round(float x);"));
    EXPECT_TRUE(contains(wrapped.texts[0], "float trunc = osgmr_user_round(1.0)"));
    EXPECT_TRUE(contains(wrapped.texts[1], "float osgmr_user_round(float x)"));
    EXPECT_TRUE(contains(wrapped.texts[2], "return round(1.5)"));
}

TEST(GlslWrapTest, usersLineDirectivesAreCarriedOver)
{
    EXPECT_TRUE(
        contains(wrap("#version 120\n#line 41\nvoid main() {}\n").texts[0], "\n#line 42\nvoid"));
    EXPECT_TRUE(
        contains(wrap("#version 330\n#line 41\nvoid main() {}\n").texts[0], "\n#line 41\nvoid"));
}

TEST(GlslWrapTest, theGlobalIsNotDeclaredWithinACondition)
{
    const GlslWrapped wrapped =
        wrap("#pragma import_defines(A)\n#ifdef A\nuniform float a;\n#endif\n"
             "void main() { gl_FragColor = vec4(1.0); }\n");
    EXPECT_TRUE(contains(wrapped.texts[0], "vec4 osgmr_fragColor;\n#line 2\n#ifdef A\n"));
}

TEST(GlslWrapTest, whatCannotBeWrappedSaysWhy)
{
    EXPECT_EQ(error(wrap("float f() { return 1.0; }")),
              "1 0: no fragment shader object defines main");
    EXPECT_EQ(error(wrapProgram({{GlslStage::Vertex, "void main() {}"}}, Target330)),
              "1 0: the program has no fragment shader");
    EXPECT_EQ(error(wrap("#version 300 es\nvoid main() {}")), "0 0: GLSL ES is not supported");
    EXPECT_EQ(error(wrap("void main() {}", {150, GlslVersion::Profile::Core})),
              "1 0: GLSL 330 or later is needed, not 150 core");
    EXPECT_EQ(
        error(wrap("#version 330\nlayout(location = 0, index = 1) out vec4 c;\nvoid main() {}")),
        "0 2: dual-source blending (index = 1) is not supported");
    EXPECT_EQ(error(wrap("#version 330\nuniform int n;\nout vec4 c[n];\nvoid main() {}")),
              "0 3: the array size of output 'c' is not known");
    EXPECT_EQ(error(wrap("void main() { float osgmr_x; }")),
              "0 1: names that begin with 'osgmr_' are reserved");
    EXPECT_EQ(error(wrap("#define C(x) gl_Frag##x\nvoid main() { C(Color) = vec4(1.0); }")),
              "0 1: a pasted 'gl_Frag' name can't be followed");
    EXPECT_EQ(error(wrap("#extension GL_EXT_geometry_shader4 : enable\nvoid main() {}")),
              "0 1: GL_EXT_geometry_shader4 is not geometry shaders of GLSL 150: the version can't "
              "be raised");
    EXPECT_EQ(error(wrap("void main() {} /* open")), "none");
    EXPECT_EQ(error(wrap("/* open\nvoid main() {}")),
              "1 0: no fragment shader object defines main");
}
