// SPDX-License-Identifier: MIT
// What the plan of a merged program says: names, units, limits, what is left out.
#include "osgMultiRender/MergeChecks.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace mergeChecks;

namespace
{

TEST(MergePlanTest, whatMovesVerticesOtherwiseIsNamed)
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

TEST(MergePlanTest, usualWritingsOfThePositionAreTheSame)
{
    for (const char* position : {"gl_ModelViewProjectionMatrix * gl_Vertex",
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

TEST(MergePlanTest, uniformsAreFoundByRenderingAndName)
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

TEST(MergePlanTest, membersOfBlocksWithoutANameAreFoundByRenderingAndName)
{
    const std::string text =
        "#version 330 compatibility\nlayout(std140) uniform Light { vec4 tint; float power[2]; };\n"
        "uniform Named { vec4 own; } named;\n"
        "void main() { gl_FragColor = tint * power[1] + named.own; }";
    const Merged merged = merge({mergeCase("a", text), mergeCase("b", text)});
    ASSERT_TRUE(merged.ok);
    for (const std::size_t rendering : {std::size_t(0), std::size_t(1)})
    {
        const MergedUniform* tint = merged.findUniform(rendering, "tint");
        ASSERT_TRUE(tint);
        EXPECT_TRUE(tint->inBlock);
        EXPECT_EQ(tint->type, "vec4");
        EXPECT_NE(merged.fragment.find("vec4 " + tint->merged + ";"), std::string::npos)
            << merged.fragment;
        EXPECT_NE(merged.fragment.find(merged.nameOf(rendering, "power[1]")), std::string::npos);
        EXPECT_FALSE(merged.findUniform(rendering, "own")) << "it is named.own";
        EXPECT_FALSE(merged.findUniform(rendering, "Light")->inBlock);
    }
    EXPECT_NE(merged.nameOf(0, "tint"), merged.nameOf(1, "tint"));
}

TEST(MergePlanTest, texturesOfTheirOwnGetUnitsWithoutCollision)
{
    const std::string text =
        Head + "uniform sampler2D t; void main() { gl_FragColor = texture2D(t, uv); }";
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

TEST(MergePlanTest, samplersOfOtherKindsNeverShareAUnit)
{
    const Merged merged = merge(
        {mergeCase("a",
                   Head + "uniform sampler2D t; void main() { gl_FragColor = texture2D(t, uv); }"),
         mergeCase(
             "b",
             Head + "uniform samplerCube t; void main() { gl_FragColor = textureCube(t, n); }")});
    EXPECT_NE(merged.findUniform(0, "t")->units, merged.findUniform(1, "t")->units);
}

TEST(MergePlanTest, samplersInStructsHaveUnitsAndTextures)
{
    Rendering b = mergeCase("b", Head + "struct Layer { sampler2D map; float scale; };\n"
                                        "uniform Layer layers[2];\nvoid main() { gl_FragColor = "
                                        "texture2D(layers[0].map, uv) * layers[1].scale + "
                                        "texture2D(layers[1].map, uv); }");
    RenderingTexture texture;
    for (const char* name : {"layers[0].map", "layers[1].map"})
    {
        b.uniforms.emplace_back();
        b.uniforms.back().name = name;
        b.uniforms.back().values = {double(texture.unit)};
        texture.fileName = std::string(1, 'x' + char(texture.unit)) + ".png";
        b.textures.push_back(texture);
        ++texture.unit;
    }
    MergeOptions options;
    options.occupiedUnits = {0, 1, 2};
    const Merged merged = merge({mergePartner(), b}, options);
    const MergedUniform* first = merged.findUniform(1, "layers[0].map");
    const MergedUniform* second = merged.findUniform(1, "layers[1].map");
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->merged, "layers_1[0].map");
    EXPECT_EQ(first->units, std::vector<unsigned int>{3});
    EXPECT_EQ(second->units, std::vector<unsigned int>{4});
    EXPECT_EQ(merged.textures.size(), 2u);
    EXPECT_EQ(merged.statistics.fragmentSamplers, 2);
    EXPECT_EQ(merged.nameOf(1, "layers[1].scale"), "layers_1[1].scale");
    options.limits.fragmentSamplers = 1;
    EXPECT_NE(errorsOf(merge({mergePartner(), b}, options)).find("2 fragment samplers of 1"),
              std::string::npos);
}

TEST(MergePlanTest, whatUniformsTakeIsCountedByStage)
{
    const Rendering one =
        mergeCase("one",
                  "varying float shade;\nstruct Part { vec3 list[4]; float f; };\n"
                  "uniform Part parts[2]; uniform vec4 unused[100]; uniform float both;\n"
                  "void main() { gl_FragColor = vec4(parts[1].list[2] * both * shade, 1.0); }",
                  "uniform sampler2D heights; uniform float both; varying float shade;\n"
                  "void main() { shade = texture2D(heights, gl_Vertex.xy).x * both; "
                  "gl_Position = ftransform(); }");
    MergeOptions options;
    const Merged merged = merge({one}, options);
    EXPECT_EQ(merged.statistics.fragmentUniformComponents, 2 * (4 * 3 + 1) + 1);
    EXPECT_EQ(merged.statistics.vertexUniformComponents, 1 + 1);
    EXPECT_EQ(merged.statistics.vertexSamplers, 1);
    EXPECT_EQ(merged.statistics.fragmentSamplers, 0);
    const MergedUniform* both = merged.findUniform(0, "both");
    ASSERT_TRUE(both);
    EXPECT_TRUE(both->vertex && both->fragment);
    options.limits.vertexSamplers = 0;
    EXPECT_NE(errorsOf(merge({one}, options)).find("1 vertex samplers of 0"), std::string::npos);
}

TEST(MergePlanTest, fieldsThatBecomeKeywordsAreFoundByTheirAuthorsName)
{
    const Rendering one =
        mergeCase("one", Head + "struct Part { float sample; };\nuniform Part part;\n"
                                "void main() { gl_FragColor = vec4(uv, part.sample, 1.0); }");
    MergeOptions options;
    options.version.number = 400;
    const Merged merged = merge({one}, options);
    EXPECT_EQ(merged.nameOf(0, "part.sample"), "part_0.sample_0");
    EXPECT_NE(merged.fragment.find("float sample_0;"), std::string::npos);
}

TEST(MergePlanTest, bindingsOfSamplersAreTheirUnits)
{
    const Rendering one =
        mergeCase("one", "#version 420 compatibility\nin vec2 uv; out vec4 c;\n"
                         "layout(binding = 3) uniform sampler2D maps[2];\n"
                         "void main() { c = texture(maps[0], uv) + texture(maps[1], uv); }");
    const Merged merged = merge({one});
    const MergedUniform* maps = merged.findUniform(0, "maps");
    ASSERT_TRUE(maps);
    EXPECT_EQ(maps->units, (std::vector<unsigned int>{3, 4}));
}

TEST(MergePlanTest, attributesKeepTheirBindings)
{
    const std::string fragment = "varying vec3 t;\nvoid main() { gl_FragColor = vec4(t, 1.0); }";
    Rendering a = mergeCase("a", fragment,
                            "attribute vec3 tangent; varying vec3 t;\nvoid main() { t = tangent; "
                            "gl_Position = ftransform(); }");
    Rendering b = mergeCase("b", fragment,
                            "attribute vec4 T; varying vec3 t;\nvoid main() { float tangent = 2.0; "
                            "t = T.xyz * tangent; gl_Position = ftransform(); }");
    a.attributeBindings["tangent"] = b.attributeBindings["T"] = 6;
    const Merged merged = merge({a, b});
    ASSERT_EQ(merged.attributes.size(), 1u);
    EXPECT_EQ(merged.attributes[0].location, 6);
    // Not "tangent": the local of the other rendering would hide it.
    EXPECT_NE(merged.attributes[0].merged, "tangent");
    const Merged alone = merge({a});
    EXPECT_EQ(alone.attributes[0].merged, "tangent");
}

TEST(MergePlanTest, theLeastImportantIsLeftOutWhereALimitIsPassed)
{
    std::vector<Rendering> all;
    for (int i = 0; i < 3; ++i)
    {
        const std::string name(1, static_cast<char>('a' + i));
        all.push_back(
            mergeCase(name.c_str(),
                      "uniform float k; varying vec4 x, y;\nvoid main() { gl_FragColor = x * y; }",
                      "uniform float k; varying vec4 x, y;\nvoid main() { x = gl_Vertex * k; y = x "
                      "* k; gl_Position = ftransform(); }"));
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

TEST(MergePlanTest, eachLimitIsChecked)
{
    const Rendering big =
        mergeCase("big", Head + "uniform vec4 list[300]; uniform sampler2D maps[20];\nvoid main() "
                                "{ gl_FragColor = list[int(uv.x)] + texture2D(maps[3], uv); }");
    const Rendering small = mergeCase("small", Plain);
    MergeOptions options;
    EXPECT_NE(errorsOf(merge({small, big}, options)).find("20 fragment samplers of 16"),
              std::string::npos);
    options.limits.fragmentSamplers = 32;
    EXPECT_NE(errorsOf(merge({small, big}, options)).find("fragment uniform components of 1024"),
              std::string::npos);
    options.limits.fragmentUniformComponents = 2000;
    EXPECT_EQ(errorsOf(merge({small, big}, options)), "");
    options.limits.version = 110;
    options.limits.vertexAttributes = 1;
    EXPECT_NE(errorsOf(merge({small, big}, options)).find("vertex attributes of 1"),
              std::string::npos);
}

struct Refused
{
    const char* fragment;
    const char* cause;
};

TEST(MergePlanTest, whatCantBeMergedIsLeftOutWithItsCauseAndPlace)
{
    const Refused all[] = {
        {"void main() { gl_FragColor = vec4(1.0);", "a.frag:1: the brace is not closed"},
        {"float f;", "a: no shader object defines main of the fragment stage"},
        {"/* open\nvoid main() {}", "a.frag:1: the comment is not closed"},
        {"#if 1\nvoid main() {}", "a.frag:1: #if without #endif"},
        {"#error too old\nvoid main() {}", "a.frag:1: #error too old"},
        {"#define f(x) f2(x x)\n#define f2(x) f3(x x)\n#define f3(x) f4(x x)\n#define f4(x) f5(x "
         "x)\n"
         "#define f5(x) f6(x x)\n#define f6(x) f7(x x)\n#define f7(x) f8(x x)\n#define f8(x) f9(x "
         "x)\n"
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
        {"#version 410 compatibility\nin vec2 uv; out vec4 c; subroutine uniform float s;\nvoid "
         "main() { c = vec4(1.0); }",
         "a.frag:2: subroutines can't be merged"},
        {"#version 400 compatibility\nin vec2 uv; out vec4 c;\nvoid main() { c = "
         "vec4(interpolateAtCentroid(uv), 0.0, 1.0); }",
         "a.frag:3: interpolateAtCentroid can't be merged: varyings are packed"},
        {"uniform float n; void main() { gl_FragColor = vec4(n); }",
         "a: the uniform 'n' is float, but vec3 in the vertex stage"},
        {"uniform vec3 osg_FrameTime;\nvoid main() { gl_FragColor = vec4(osg_FrameTime, 1.0); }",
         "a: the uniform 'osg_FrameTime' is vec3, but float in another rendering"},
    };
    const Rendering good = mergeCase(
        "good",
        Head + "uniform float osg_FrameTime; void main() { gl_FragColor = vec4(osg_FrameTime); }");
    for (const Refused& one : all)
    {
        const bool uniform = std::string(one.fragment).compare(0, 15, "uniform float n") == 0;
        const Merged merged = merge(
            {good, mergeCase("a", one.fragment,
                             uniform ? "uniform vec3 n; void main() { gl_Position = vec4(n, 1.0); }"
                                     : "")});
        EXPECT_TRUE(merged.ok) << one.cause;
        EXPECT_FALSE(merged.renderings[1].included) << one.cause;
        EXPECT_EQ(errorsOf(merged).substr(0, std::string(one.cause).size()), one.cause);
        EXPECT_EQ(merged.fragment.find("a_1_main"), std::string::npos);
    }
}

TEST(MergePlanTest, otherStagesAreRefused)
{
    Rendering one = mergeCase("a", Plain);
    one.shaders.push_back({GlslStage::Geometry, "void main() {}", "a.geom"});
    EXPECT_EQ(
        errorsOf(merge({one})),
        "a.geom: only vertex and fragment stages can be merged, not geometry or tessellation\n");
}

TEST(MergePlanTest, nothingToMergeIsNotOk)
{
    EXPECT_FALSE(merge({}).ok);
    EXPECT_FALSE(mergeRenderings({{nullptr, 1.0}}).ok);
    MergeOptions options;
    options.version.number = 120;
    const Merged merged = merge({mergePartner()}, options);
    EXPECT_FALSE(merged.ok);
    EXPECT_EQ(merged.renderings.size(), 1u);
}

TEST(MergePlanTest, logsAreExplainedWithTheirFilesAndLines)
{
    const Merged merged = merge({mergePartner(), mergeCase("a", Plain)});
    EXPECT_EQ(merged.explain("2:12(5): error: `x' undeclared"),
              "a.vert:12: error: `x' undeclared\n");
    EXPECT_EQ(merged.explain("3(7) : error C1008: undefined"),
              "a.frag:7: error C1008: undefined\n");
    EXPECT_EQ(merged.explain("ERROR: 1:3: 'x' : undeclared"), "partner.frag:3: 'x' : undeclared\n");
    EXPECT_EQ(merged.explain("4:9(1): warning: y"), "merged program:9: warning: y\n");
    // Mesa's own way: the file is in the line's number.
    EXPECT_EQ(merged.explain("0:300012(5): error: y"), "a.vert:12: error: y\n");
    EXPECT_EQ(merged.explain("linking failed\n\n99:1: z"), "linking failed\n99:1: z\n");
}

TEST(MergePlanTest, depthIsTestedEarlyWhereNoRenderingDiscards)
{
    MergeOptions options;
    options.outside = MergeOutside::Transparent;
    const Rendering cut = mergeCase(
        "cut", Head + "void main() { if (uv.x > 0.5) discard; gl_FragColor = vec4(1.0); }");
    EXPECT_EQ(
        merge({mergeCase("a", Plain), mergeCase("b", Plain)}, options).fragment.find("discard"),
        std::string::npos);
    EXPECT_NE(merge({mergeCase("a", Plain), cut}, options).fragment.find("discard"),
              std::string::npos);
}

TEST(MergePlanTest, aPositionThatARenderingInterpolatesIsUsedForTheWeights)
{
    MergeOptions options;
    options.weights =
        "void at(vec3 p) {} void begin() {} float osgmr_weight(int i) { return 1.0; }";
    options.begin = "begin();";
    options.beginAt = "at";
    const auto calls = [&](const std::string& eye, const std::string& position, const char* call)
    {
        const std::string vertex = "varying vec2 uv; varying vec3 n, eye;\nvoid main() { uv = "
                                   "vec2(0.5); n = gl_Normal; eye = " +
                                   eye + "; gl_Position = " + position + "; }";
        const std::string text = Head + "void main() { gl_FragColor = vec4(eye + n, uv.x); }";
        return countOf(merge({mergeCase("a", text, vertex)}, options).fragment, call);
    };
    const std::string usual = "gl_ModelViewProjectionMatrix * gl_Vertex";
    for (const char* eye :
         {"vec3(gl_ModelViewMatrix * gl_Vertex)", "(gl_ModelViewMatrix * gl_Vertex).xyz"})
    {
        EXPECT_EQ(calls(eye, usual, "    at(osgmr"), 1u) << eye;
        EXPECT_EQ(calls(eye, usual, "    begin();"), 0u) << eye;
    }
    EXPECT_EQ(calls("vec3(gl_ModelViewMatrix * gl_Vertex) * 2.0", usual, "    begin();"), 1u);
    EXPECT_EQ(calls("vec3(gl_ModelViewMatrix * gl_Vertex)", usual + " + vec4(1.0)", "    begin();"),
              1u);
}

TEST(MergePlanTest, earlyFragmentTestsAreNamedAsNotTaken)
{
    const Rendering early = mergeCase("early", "#version 420 compatibility\n"
                                               "layout(early_fragment_tests) in;\n"
                                               "void main() { gl_FragColor = vec4(1.0); }");
    const Merged merged = merge({mergeCase("a", Plain), early});
    ASSERT_TRUE(merged.renderings[1].included);
    EXPECT_EQ(merged.fragment.find("early_fragment_tests"), std::string::npos);
    const auto names = [](const MergeMessage& message)
    {
        return message.severity == MergeSeverity::Note && message.rendering == 1 &&
               message.text.find("early: early_fragment_tests is not taken") == 0;
    };
    EXPECT_EQ(std::count_if(merged.messages.begin(), merged.messages.end(), names), 1);
}

} // namespace
