// SPDX-License-Identifier: MIT
// The texts of merged programs. That they draw the same is tested with OpenGL.
#include "osgMultiRender/MergeChecks.h"

#include <gtest/gtest.h>

using namespace mergeChecks;

namespace
{

TEST(MergerTest, mainsAreNamedByRenderingAndNumber)
{
    const Merged merged =
        merge({mergeCase("electronic microscope", Plain), mergeCase("7 hills", Plain)});
    ASSERT_TRUE(merged.ok);
    EXPECT_NE(merged.fragment.find("vec4 electronic_microscope_0_main()"), std::string::npos);
    EXPECT_NE(merged.fragment.find("vec4 rendering_7_hills_1_main()"), std::string::npos);
    EXPECT_EQ(definitionsOf(merged.fragment, "main"), 1u);
}

TEST(MergerTest, allHardCasesAreMergedAtOnce)
{
    MergeOptions options;
    options.limits.varyingVectors = options.limits.fragmentSamplers = 1000;
    options.limits.textureUnits = options.limits.vertexSamplers = 1000;
    options.limits.fragmentUniformComponents = options.limits.vertexUniformComponents = 100000;
    options.limits.vertexAttributes = 1000;
    const Merged merged = merge(mergeCases(), options);
    EXPECT_EQ(errorsOf(merged), "");
    for (const MergedRendering& one : merged.renderings)
    {
        EXPECT_TRUE(one.included) << one.name;
    }
    EXPECT_TRUE(parseGlsl(merged.fragment).messages.empty());
}

TEST(MergerTest, mergingIsRepeatable)
{
    const Merged first = merge({mergePartner(), mergeCase("a", Plain)});
    const Merged second = merge({mergePartner(), mergeCase("a", Plain)});
    EXPECT_EQ(first.vertex, second.vertex);
    EXPECT_EQ(first.fragment, second.fragment);
}

TEST(MergerTest, equalFunctionsConstantsAndStructsAreDeclaredOnce)
{
    const std::string rest = R"(
const float Pi = 3.0; struct Ray { vec3 at; };
float noise1d(float x) { return fract(sin(x) * Pi); }  // a comment
Ray trace(vec2 x) { return Ray(vec3(noise1d(x.x))); }
void main() { gl_FragColor = vec4(trace(uv).at, 1.0); })";
    std::string spaced = rest;
    spaced.replace(spaced.find("fract(sin"), 9, "fract( /* other */ sin");
    const Merged merged = merge({mergeCase("a", Head + rest), mergeCase("b", Head + spaced)});
    ASSERT_TRUE(merged.ok);
    EXPECT_EQ(definitionsOf(merged.fragment, "noise1d_"), 1u);
    EXPECT_EQ(definitionsOf(merged.fragment, "trace_"), 1u);
    EXPECT_EQ(countOf(merged.fragment, "struct Ray_"), 1u);
    EXPECT_EQ(merged.statistics.sharedFunctions, 2u);
    EXPECT_EQ(merged.statistics.sharedConstants, 1u);
    EXPECT_EQ(merged.statistics.sharedStructs, 1u);
}

TEST(MergerTest, functionsThatReadUniformsAreNotShared)
{
    const std::string text =
        Head +
        "uniform float k; float f(float x) { return x * k; } float g(float x) { return f(x); }\n"
        "void main() { gl_FragColor = vec4(g(uv.x)); }";
    const Merged merged = merge({mergeCase("a", text), mergeCase("b", text)});
    EXPECT_EQ(merged.statistics.sharedFunctions, 0u);
    EXPECT_EQ(definitionsOf(merged.fragment, "g_"), 2u);
}

TEST(MergerTest, functionsOfOtherBodiesAreNotShared)
{
    const std::string end = " } void main() { gl_FragColor = vec4(f(uv.x)); }";
    const Merged merged =
        merge({mergeCase("a", Head + "float f(float x) { return x;" + end),
               mergeCase("b", Head + "float f(float x) { return x + 1.0;" + end)});
    EXPECT_EQ(merged.statistics.sharedFunctions, 0u);
    EXPECT_EQ(definitionsOf(merged.fragment, "f_"), 2u);
}

TEST(MergerTest, overloadsAreSharedTogetherOrNotAtAll)
{
    const std::string one = "float f(float x) { return x; }";
    const std::string end = " void main() { gl_FragColor = vec4(f(uv.x)); }";
    const Merged merged =
        merge({mergeCase("a", Head + one + "float f(vec2 x) { return x.x; }" + end),
               mergeCase("b", Head + one + "float f(vec2 x) { return x.y; }" + end)});
    EXPECT_EQ(merged.statistics.sharedFunctions, 0u);
}

TEST(MergerTest, builtinsBesideOverloadsOfTheirNameAreToldApartByArguments)
{
    const Merged merged = merge({mergeCase("a", Head + R"(
float max(float a, float b, float c) { return max(max(a, b), c); }
void main() { gl_FragColor = vec4(max(uv.x, 0.5), max(uv.x, uv.y, 0.25), 0.0, 1.0); })")});
    EXPECT_NE(merged.fragment.find("return max(max(a, b), c);"), std::string::npos);
    EXPECT_NE(merged.fragment.find("vec4(max(uv_0.x, 0.5), max_0(uv_0.x, uv_0.y, 0.25)"),
              std::string::npos);
}

TEST(MergerTest, varyingsOfEqualValueAreOne)
{
    const std::string vertex =
        "varying vec3 n; varying vec2 uv; varying vec3 eye;\nvoid main() { vec4 p = "
        "gl_ModelViewMatrix * gl_Vertex; eye = p.xyz; n = gl_NormalMatrix * gl_Normal; uv = "
        "gl_MultiTexCoord0.xy; gl_Position = ftransform(); }";
    const std::string text = Head + "void main() { gl_FragColor = vec4(n + eye, uv.x); }";
    const Merged merged = merge({mergeCase("a", text, vertex), mergeCase("b", text, vertex)});
    EXPECT_EQ(merged.statistics.sharedVaryings, 3u);
    EXPECT_EQ(merged.statistics.varyingComponents, 8);
    EXPECT_EQ(merged.statistics.varyingVectors, 3);
}

/// How many varyings two programs share whose vertex stages end in `last`.
std::size_t sharedBehind(const std::string& before, const std::string& last)
{
    const std::string vertex = "varying vec3 n; uniform float k;\n" + before +
                               "void main() { n = gl_Normal; " + last +
                               " gl_Position = ftransform(); }";
    const std::string text = "varying vec3 n;\nvoid main() { gl_FragColor = vec4(n, 1.0); }";
    const Merged merged = merge({mergeCase("a", text, vertex), mergeCase("b", text, vertex)});
    EXPECT_TRUE(merged.ok);
    return merged.statistics.sharedVaryings;
}

TEST(MergerTest, varyingsThatBranchesOrUniformsDecideAreNotShared)
{
    EXPECT_EQ(sharedBehind("", ""), 1u);
    EXPECT_EQ(sharedBehind("", "n = n * 2.0;"), 1u);
    for (const char* last :
         {"if (gl_Color.r > 0.5) n = gl_Vertex.xyz;", "n.x += 1.0;", "n *= 2.0;", "n = n * k;",
          "for (int i = 0; i < 2; ++i) n += 1.0;", "{ n = gl_Vertex.xyz; }", "n[1] = 0.0;",
          "vec3 a = n++;", "do n = -n; while (n.x > 0.0);", "return;"})
    {
        EXPECT_EQ(sharedBehind("", last), 0u) << last;
    }
    EXPECT_EQ(sharedBehind("void change() { n *= 2.0; }\n", "change();"), 0u);
    EXPECT_EQ(sharedBehind("void change(inout vec3 x) { x *= 2.0; }\n", "change(n);"), 0u);
}

TEST(MergerTest, varyingsArePackedIntoFullVectors)
{
    const Merged merged = merge(
        {mergeCase("a",
                   "varying float a, b, c, d; varying vec2 e, f; varying vec3 g;\nvoid main() "
                   "{ gl_FragColor = vec4(a + b, c + d, e.x + f.x, g.x); }",
                   "varying float a, b, c, d; varying vec2 e, f; varying vec3 g;\nvoid main() { a "
                   "= b = c = d = 1.0; e = f = vec2(1.0); g = vec3(1.0); gl_Position = "
                   "ftransform(); }")});
    EXPECT_EQ(merged.statistics.varyingComponents, 11);
    EXPECT_EQ(merged.statistics.varyingVectors, 3);
}

TEST(MergerTest, whatTakesDerivativesIsOutsideOfBranches)
{
    const Merged merged = merge(
        {mergeCase("a", Plain),
         mergeCase("b", Head + "void main() { gl_FragColor = vec4(fwidth(uv), 0.0, 1.0); }"),
         mergeCase("c",
                   Head + "uniform sampler2D t; void main() { gl_FragColor = texture2D(t, uv); }"),
         mergeCase("d", "#version 130\n" + Head +
                            "uniform sampler2D t; void main() { gl_FragColor "
                            "= textureLod(t, uv, 0.0); }")});
    EXPECT_FALSE(merged.renderings[0].usesDerivatives);
    EXPECT_TRUE(merged.renderings[1].usesDerivatives);
    EXPECT_TRUE(merged.renderings[2].usesDerivatives);
    EXPECT_FALSE(merged.renderings[3].usesDerivatives);
    EXPECT_NE(merged.fragment.find("\n    osgmr_c = b_1_main();"), std::string::npos);
    EXPECT_NE(merged.fragment.find("\n        osgmr_c = a_0_main();"), std::string::npos);
}

TEST(MergerTest, versionsAndExtensionsAreJoined)
{
    const Merged merged = merge(
        {mergeCase("a", "#version 120\n#extension GL_ARB_texture_rectangle : enable\n" + Plain),
         mergeCase("b", "#version 400 compatibility\n#extension GL_ARB_texture_rectangle : "
                        "require\n#extension GL_ARB_gpu_shader5 : warn\nin vec2 uv; out vec4 "
                        "c; void main() { c = vec4(uv, 0.0, 1.0); }")});
    EXPECT_EQ(merged.version.number, 400);
    EXPECT_EQ(merged.fragment.find("#version 400 compatibility\n#extension GL_ARB_gpu_shader5 : "
                                   "warn\n#extension GL_ARB_texture_rectangle : require\n"),
              0u);
    EXPECT_EQ(countOf(merged.fragment, "#version"), 1u);
}

TEST(MergerTest, commentsFollowTheNewNames)
{
    const Merged merged =
        merge({mergeCase("a", Head + "uniform float waveHeight; // waveHeight, not the wave\nvoid "
                                     "main() { gl_FragColor = vec4(waveHeight); }")});
    EXPECT_NE(merged.fragment.find("// waveHeight_0, not the wave"), std::string::npos);
}

TEST(MergerTest, aHundredOfTheSameAreMerged)
{
    MergeOptions options;
    options.limits.fragmentUniformComponents = options.limits.vertexUniformComponents = 10000;
    const Merged merged = merge(std::vector<Rendering>(100, mergePartner()), options);
    EXPECT_EQ(errorsOf(merged), "");
    // All varyings have equal values.
    EXPECT_LE(merged.statistics.varyingVectors, 3);
    EXPECT_EQ(definitionsOf(merged.fragment, "partner_"), 100u);
}

TEST(MergerTest, limitsAreFoundAmongAHundred)
{
    std::vector<Rendering> all;
    for (int i = 0; i < 100; ++i)
    {
        all.push_back(
            mergeCase(("r" + std::to_string(i)).c_str(),
                      "uniform float k; varying vec4 x;\nvoid main() { gl_FragColor = x; }",
                      "uniform float k; varying vec4 x;\nvoid main() { x = gl_Vertex * "
                      "k; gl_Position = ftransform(); }"));
    }
    const Merged merged = merge(all);
    EXPECT_EQ(std::count_if(merged.renderings.begin(), merged.renderings.end(),
                            [](const MergedRendering& one) { return one.included; }),
              15);
}

} // namespace
