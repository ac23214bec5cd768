// SPDX-License-Identifier: MIT
// What the plan of a merged program says. That it draws the same is tested with OpenGL.
#include "osgMultiRender/MergeCases.h"

#include <osgMultiRender/GlslSource.h>
#include <osgMultiRender/Merger.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace osgMultiRender;

namespace
{

const std::string Head = "varying vec3 n; varying vec2 uv; varying vec3 eye;\n";
const std::string Plain = Head + "void main() { gl_FragColor = vec4(uv, 0.0, 1.0); }";

Merged merge(const std::vector<Rendering>& renderings, const MergeOptions& options = {})
{
    std::vector<MergeEntry> entries;
    for (const Rendering& one : renderings)
    {
        entries.push_back({&one, 1.0});
    }
    return mergeRenderings(entries, options);
}

std::string errorsOf(const Merged& merged)
{
    std::string text;
    for (const MergeMessage& message : merged.messages)
    {
        text += message.severity == MergeSeverity::Error ? message.text + "\n" : "";
    }
    return text;
}

std::size_t countOf(const std::string& text, const std::string& word)
{
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at)
    {
        ++count;
    }
    return count;
}

std::size_t definitionsOf(const std::string& text, const std::string& prefix)
{
    const GlslSource source = parseGlsl(text);
    return static_cast<std::size_t>(
        std::count_if(source.functions.begin(), source.functions.end(),
                      [&](const GlslFunction& function)
                      { return function.name.compare(0, prefix.size(), prefix) == 0; }));
}

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
        Head + "uniform float k; float f(float x) { return x * k; } float g(float x) { return f(x); }\n"
               "void main() { gl_FragColor = vec4(g(uv.x)); }";
    const Merged merged = merge({mergeCase("a", text), mergeCase("b", text)});
    EXPECT_EQ(merged.statistics.sharedFunctions, 0u);
    EXPECT_EQ(definitionsOf(merged.fragment, "g_"), 2u);
}

TEST(MergerTest, functionsOfOtherBodiesAreNotShared)
{
    const std::string end = " } void main() { gl_FragColor = vec4(f(uv.x)); }";
    const Merged merged = merge({mergeCase("a", Head + "float f(float x) { return x;" + end),
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

TEST(MergerTest, varyingsThatBranchesOrUniformsDecideAreNotShared)
{
    for (const char* last : {"if (gl_Color.r > 0.5) n = gl_Vertex.xyz;", "n.x += 1.0;", "n *= k;",
                             "change();", "for (int i = 0; i < 2; ++i) n += 1.0;"})
    {
        const std::string vertex =
            std::string("varying vec3 n; uniform float k; void change() { n *= 2.0; }\n"
                        "void main() { n = gl_Normal; ") +
            last + " gl_Position = ftransform(); }";
        const std::string text = "varying vec3 n;\nvoid main() { gl_FragColor = vec4(n, 1.0); }";
        const Merged merged = merge({mergeCase("a", text, vertex), mergeCase("b", text, vertex)});
        EXPECT_TRUE(merged.ok);
        EXPECT_EQ(merged.statistics.sharedVaryings, 0u) << last;
    }
}

TEST(MergerTest, varyingsArePackedIntoFullVectors)
{
    const Merged merged = merge(
        {mergeCase("a", "varying float a, b, c, d; varying vec2 e, f; varying vec3 g;\nvoid main() "
                        "{ gl_FragColor = vec4(a + b, c + d, e.x + f.x, g.x); }",
                   "varying float a, b, c, d; varying vec2 e, f; varying vec3 g;\nvoid main() { a "
                   "= b = c = d = 1.0; e = f = vec2(1.0); g = vec3(1.0); gl_Position = "
                   "ftransform(); }")});
    EXPECT_EQ(merged.statistics.varyingComponents, 11);
    EXPECT_EQ(merged.statistics.varyingVectors, 3);
}

TEST(MergerTest, whatMovesVerticesOtherwiseIsNamed)
{
    const std::string text = Plain;
    const std::string wave =
        "varying vec3 n; varying vec2 uv; varying vec3 eye;\nvoid main() { uv = vec2(0.0); "
        "gl_Position = gl_ModelViewProjectionMatrix * (gl_Vertex + sin(gl_Vertex.x)); }";
    const Merged merged = merge({mergeCase("a", text), mergeCase("wave", text, wave)});
    EXPECT_FALSE(merged.renderings[0].movesVertices);
    EXPECT_TRUE(merged.renderings[1].movesVertices);
    ASSERT_FALSE(merged.messages.empty());
    EXPECT_EQ(merged.messages.back().text,
              "wave: it may move vertices otherwise than 'a', whose positions are shown");
}

TEST(MergerTest, usualWritingsOfThePositionAreTheSame)
{
    for (const char* position :
         {"gl_ModelViewProjectionMatrix * gl_Vertex",
          "gl_ProjectionMatrix * gl_ModelViewMatrix * gl_Vertex",
          "gl_ProjectionMatrix * (gl_ModelViewMatrix * gl_Vertex)"})
    {
        const std::string vertex = std::string("varying vec2 uv; varying vec3 n, eye;\nvoid main() "
                                               "{ uv = vec2(0.5); gl_Position = ") +
                                   position + "; }";
        const Merged merged = merge({mergeCase("a", Plain), mergeCase("b", Plain, vertex)});
        EXPECT_FALSE(merged.renderings[1].movesVertices) << position;
    }
}

TEST(MergerTest, whatTakesDerivativesIsOutsideOfBranches)
{
    const Merged merged = merge(
        {mergeCase("a", Plain),
         mergeCase("b", Head + "void main() { gl_FragColor = vec4(fwidth(uv), 0.0, 1.0); }"),
         mergeCase("c", Head + "uniform sampler2D t; void main() { gl_FragColor = texture2D(t, uv); }"),
         mergeCase("d", "#version 130\n" + Head + "uniform sampler2D t; void main() { gl_FragColor "
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
    const Merged merged =
        merge({mergeCase("a", "#version 120\n#extension GL_ARB_texture_rectangle : enable\n" + Plain),
               mergeCase("b", "#version 400 compatibility\n#extension GL_ARB_texture_rectangle : "
                              "require\n#extension GL_ARB_gpu_shader5 : warn\nin vec2 uv; out vec4 "
                              "c; void main() { c = vec4(uv, 0.0, 1.0); }")});
    EXPECT_EQ(merged.version.number, 400);
    EXPECT_EQ(merged.fragment.find("#version 400 compatibility\n#extension GL_ARB_gpu_shader5 : "
                                   "warn\n#extension GL_ARB_texture_rectangle : require\n"),
              0u);
    EXPECT_EQ(countOf(merged.fragment, "#version"), 1u);
}

TEST(MergerTest, uniformsAreFoundByRenderingAndName)
{
    const std::string text =
        Head + "uniform vec3 color; uniform struct { float power; } lights[2];\nuniform float "
               "osg_FrameTime;\nvoid main() { gl_FragColor = vec4(color * lights[1].power * "
               "osg_FrameTime, 1.0); }";
    const Merged merged = merge({mergeCase("a", text), mergeCase("b", text)});
    EXPECT_EQ(merged.nameOf(0, "color"), "color_0");
    EXPECT_EQ(merged.nameOf(1, "color"), "color_1");
    EXPECT_EQ(merged.nameOf(1, "lights[1].power"), "lights_1[1].power");
    EXPECT_EQ(merged.nameOf(1, "osg_FrameTime"), "osg_FrameTime");
    EXPECT_EQ(countOf(merged.fragment, "uniform float osg_FrameTime"), 1u);
    EXPECT_EQ(merged.nameOf(0, "nothing"), "");
    EXPECT_EQ(merged.nameOf(7, "color"), "");
}

TEST(MergerTest, texturesOfTheirOwnGetUnitsWithoutCollision)
{
    const std::string text = Head + "uniform sampler2D t; void main() { gl_FragColor = texture2D(t, uv); }";
    std::vector<Rendering> all(4, mergeCase("a", text));
    all[1].textures.resize(1); // unit 0, a file of its own
    all[1].textures[0].fileName = "wood.png";
    all[2].textures = all[1].textures; // the same file: the same unit
    all[3].textures = all[1].textures;
    all[3].textures[0].wrap[0] = 0x812F;
    MergeOptions options;
    options.occupiedUnits = {1};
    const Merged merged = merge(all, options);
    EXPECT_EQ(merged.findUniform(0, "t")->units, std::vector<unsigned int>{0});
    EXPECT_EQ(merged.findUniform(1, "t")->units, std::vector<unsigned int>{2});
    EXPECT_EQ(merged.findUniform(2, "t")->units, std::vector<unsigned int>{2});
    EXPECT_EQ(merged.findUniform(3, "t")->units, std::vector<unsigned int>{3});
    EXPECT_EQ(merged.textures.size(), 3u);
    EXPECT_FALSE(merged.textures[0].own);
}

TEST(MergerTest, samplersOfOtherKindsNeverShareAUnit)
{
    const Merged merged =
        merge({mergeCase("a", Head + "uniform sampler2D t; void main() { gl_FragColor = texture2D(t, uv); }"),
               mergeCase("b", Head + "uniform samplerCube t; void main() { gl_FragColor = textureCube(t, n); }")});
    EXPECT_NE(merged.findUniform(0, "t")->units, merged.findUniform(1, "t")->units);
}

TEST(MergerTest, attributesKeepTheirBindings)
{
    const std::string fragment = "varying vec3 t;\nvoid main() { gl_FragColor = vec4(t, 1.0); }";
    Rendering a = mergeCase("a", fragment, "attribute vec3 tangent; varying vec3 t;\nvoid main() { t = tangent; gl_Position = ftransform(); }");
    Rendering b = mergeCase("b", fragment, "attribute vec4 T; varying vec3 t;\nvoid main() { float tangent = 2.0; t = T.xyz * tangent; gl_Position = ftransform(); }");
    a.attributeBindings["tangent"] = b.attributeBindings["T"] = 6;
    const Merged merged = merge({a, b});
    ASSERT_EQ(merged.attributes.size(), 1u);
    EXPECT_EQ(merged.attributes[0].location, 6);
    // Not "tangent": the local of the other rendering would hide it.
    EXPECT_NE(merged.attributes[0].merged, "tangent");
    const Merged alone = merge({a});
    EXPECT_EQ(alone.attributes[0].merged, "tangent");
}

TEST(MergerTest, theLeastImportantIsLeftOutWhereALimitIsPassed)
{
    std::vector<Rendering> all;
    for (int i = 0; i < 3; ++i)
    {
        const std::string name(1, static_cast<char>('a' + i));
        all.push_back(mergeCase(name.c_str(),
                                "uniform float k; varying vec4 x, y;\nvoid main() { gl_FragColor = x * y; }",
                                "uniform float k; varying vec4 x, y;\nvoid main() { x = gl_Vertex * k; y = x * k; gl_Position = ftransform(); }"));
    }
    std::vector<MergeEntry> entries = {{&all[0], 1.0}, {&all[1], 0.25}, {&all[2], 0.5}};
    MergeOptions options;
    options.limits.varyingVectors = 5;
    const Merged merged = mergeRenderings(entries, options);
    EXPECT_EQ(errorsOf(merged), "b: left out: with 'c' the program has 6 varying vectors of 5\n");
    EXPECT_TRUE(merged.renderings[0].included);
    EXPECT_FALSE(merged.renderings[1].included);
    EXPECT_TRUE(merged.renderings[2].included);
    EXPECT_EQ(merged.nameOf(2, "k"), "k_2");
}

TEST(MergerTest, eachLimitIsChecked)
{
    const Rendering big = mergeCase("big", Head + "uniform vec4 list[300]; uniform sampler2D maps[20];\nvoid main() { gl_FragColor = list[int(uv.x)] + texture2D(maps[3], uv); }");
    const Rendering small = mergeCase("small", Plain);
    MergeOptions options;
    EXPECT_NE(errorsOf(merge({small, big}, options)).find("20 fragment samplers of 16"), std::string::npos);
    options.limits.fragmentSamplers = 32;
    EXPECT_NE(errorsOf(merge({small, big}, options)).find("fragment uniform components of 1024"),
              std::string::npos);
    options.limits.fragmentUniformComponents = 2000;
    EXPECT_EQ(errorsOf(merge({small, big}, options)), "");
    options.limits.version = 110;
    options.limits.vertexAttributes = 1;
    EXPECT_NE(errorsOf(merge({small, big}, options)).find("vertex attributes of 1"), std::string::npos);
}

struct Refused
{
    const char* fragment;
    const char* cause;
};

TEST(MergerTest, whatCantBeMergedIsLeftOutWithItsCauseAndPlace)
{
    const Refused all[] = {
        {"void main() { gl_FragColor = vec4(1.0);", "a.frag:1: the brace is not closed"},
        {"float f;", "a: no shader object defines main of the fragment stage"},
        {"/* open\nvoid main() {}", "a.frag:1: the comment is not closed"},
        {"#if 1\nvoid main() {}", "a.frag:1: #if without #endif"},
        {"#error too old\nvoid main() {}", "a.frag:1: #error too old"},
        {"#define f(x) f2(x x)\n#define f2(x) f3(x x)\n#define f3(x) f4(x x)\n#define f4(x) f5(x x)\n"
         "#define f5(x) f6(x x)\n#define f6(x) f7(x x)\n#define f7(x) f8(x x)\n#define f8(x) f9(x x)\n"
         "#define f9(x) g(x x)\n#define g(x) h(x x)\n#define h(x) i(x x)\n#define i(x) j(x x)\n"
         "#define j(x) k(x x)\n#define k(x) l(x x)\n#define l(x) m(x x)\n#define m(x) x x x x\n"
         "void main() { f(1 2 3 4) }",
         "a.frag:17: the macro 'f' expands without end"},
        {"\nvarying vec3 missing;\nvoid main() { gl_FragColor = vec4(missing, 1.0); }",
         "a.frag:2: the vertex stage does not declare the varying 'missing'"},
        {"varying vec4 uv;\nvoid main() { gl_FragColor = uv; }",
         "a.frag:1: the varying 'uv' is vec4, but vec2 in the vertex stage"},
        {"#version 330 compatibility\nout uvec4 id;\nvoid main() { id = uvec4(1u); }",
         "a: its colour is of type uvec4, which can't be blended"},
        {"#version 410 compatibility\nin vec2 uv; out vec4 c; subroutine uniform float s;\nvoid main() { c = vec4(1.0); }",
         "a.frag:2: subroutines can't be merged"},
        {"#version 400 compatibility\nin vec2 uv; out vec4 c;\nvoid main() { c = vec4(interpolateAtCentroid(uv), 0.0, 1.0); }",
         "a.frag:3: interpolateAtCentroid can't be merged: varyings are packed"},
        {"uniform vec3 osg_FrameTime;\nvoid main() { gl_FragColor = vec4(osg_FrameTime, 1.0); }",
         "a: the uniform 'osg_FrameTime' is vec3, but float in another rendering"},
    };
    const Rendering good = mergeCase("good", Head + "uniform float osg_FrameTime; void main() { gl_FragColor = vec4(osg_FrameTime); }");
    for (const Refused& one : all)
    {
        const Merged merged = merge({good, mergeCase("a", one.fragment)});
        EXPECT_TRUE(merged.ok) << one.cause;
        EXPECT_FALSE(merged.renderings[1].included) << one.cause;
        EXPECT_EQ(errorsOf(merged).substr(0, std::string(one.cause).size()), one.cause);
        EXPECT_EQ(merged.fragment.find("a_1_main"), std::string::npos);
    }
}

TEST(MergerTest, otherStagesAreRefused)
{
    Rendering one = mergeCase("a", Plain);
    one.shaders.push_back({GlslStage::Geometry, "void main() {}", "a.geom"});
    EXPECT_EQ(errorsOf(merge({one})),
              "a.geom: only vertex and fragment stages can be merged, not geometry or tessellation\n");
}

TEST(MergerTest, nothingToMergeIsNotOk)
{
    EXPECT_FALSE(merge({}).ok);
    EXPECT_FALSE(mergeRenderings({{nullptr, 1.0}}).ok);
    MergeOptions options;
    options.version.number = 120;
    const Merged merged = merge({mergePartner()}, options);
    EXPECT_FALSE(merged.ok);
    EXPECT_EQ(merged.renderings.size(), 1u);
}

TEST(MergerTest, logsAreExplainedWithTheirFilesAndLines)
{
    const Merged merged = merge({mergePartner(), mergeCase("a", Plain)});
    EXPECT_EQ(merged.explain("2:12(5): error: `x' undeclared"), "a.vert:12: error: `x' undeclared\n");
    EXPECT_EQ(merged.explain("3(7) : error C1008: undefined"), "a.frag:7: error C1008: undefined\n");
    EXPECT_EQ(merged.explain("ERROR: 1:3: 'x' : undeclared"), "partner.frag:3: 'x' : undeclared\n");
    EXPECT_EQ(merged.explain("4:9(1): warning: y"), "merged program:9: warning: y\n");
    EXPECT_EQ(merged.explain("linking failed\n\n99:1: z"), "linking failed\n99:1: z\n");
}

TEST(MergerTest, commentsFollowTheNewNames)
{
    const Merged merged = merge({mergeCase("a", Head + "uniform float waveHeight; // waveHeight, not the wave\nvoid main() { gl_FragColor = vec4(waveHeight); }")});
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

} // namespace
