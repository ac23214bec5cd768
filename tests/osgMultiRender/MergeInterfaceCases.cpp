// SPDX-License-Identifier: MIT
#include "osgMultiRender/MergeCases.h"

using namespace osgMultiRender;

namespace
{

const std::string Head = "varying vec3 n; varying vec2 uv; varying vec3 eye;\n";
const std::string Compat = "#version 150 compatibility\n";

Rendering withTextures()
{
    Rendering one = mergeCase(
        "textures",
        Head + R"(uniform sampler2D wood; uniform sampler2D model; uniform sampler2D again;
void main() { gl_FragColor = texture2D(wood, uv) * 0.5 + texture2D(model, uv.yx) * 0.25 + texture2D(again, uv * 2.0) * 0.25; })");
    one.uniforms.resize(3);
    one.uniforms[0].name = "wood";
    one.uniforms[0].values = {2};
    one.uniforms[1].name = "model";
    one.uniforms[1].values = {0};
    one.uniforms[2].name = "again";
    one.uniforms[2].values = {2};
    one.textures.resize(1);
    one.textures[0].unit = 2;
    one.textures[0].fileName = "wood.png";
    return one;
}

/// A texture of its own in a member, the model's in others.
Rendering samplersInStructs()
{
    Rendering one =
        mergeCase("samplersInStructs", Head + R"(struct Layer { sampler2D map; vec2 scale; };
struct Surface { Layer layers[2]; sampler2D maps[2]; vec3 tint; };
uniform Surface surface;
uniform Layer others[2];
vec4 look(Layer layer) { return texture2D(layer.map, uv * layer.scale); }
void main() { gl_FragColor = (look(surface.layers[0]) + look(surface.layers[1]) + look(others[1]) + texture2D(surface.maps[1], uv.yx)) * vec4(surface.tint, 1.0) * 0.5; })");
    const auto set = [&](const char* name, const std::vector<double>& values)
    {
        one.uniforms.emplace_back();
        one.uniforms.back().name = name;
        one.uniforms.back().values = values;
    };
    set("surface.layers[0].map", {3});
    set("surface.layers[1].map", {2});
    set("surface.maps", {0, 1});
    set("others[1].map", {2});
    one.textures.resize(1);
    one.textures[0].unit = 2;
    one.textures[0].fileName = "stone.png";
    return one;
}

Rendering boundAttribute()
{
    Rendering one =
        mergeCase("boundAttribute",
                  "varying vec3 t;\nvoid main() { gl_FragColor = vec4(t * 0.5 + 0.5, 1.0); }",
                  "attribute vec3 tangent;\nvarying vec3 t;\nvoid main() { t = tangent; "
                  "gl_Position = ftransform(); }");
    one.attributeBindings["tangent"] = 6;
    return one;
}

Rendering flatColors()
{
    Rendering one =
        mergeCase("defaultVertexStage",
                  "void main() { gl_FragColor = gl_Color * 0.5 + gl_TexCoord[0] * 0.25; }");
    return one;
}

} // namespace

std::vector<Rendering> interfaceCases()
{
    return {
        withTextures(),
        samplersInStructs(),
        boundAttribute(),
        flatColors(),
        mergeCase("varyingsDeclaredTogether",
                  "varying vec3 a, b;\nvoid main() { gl_FragColor = vec4(b * 0.5 + 0.5, 1.0); }",
                  "varying vec3 a, b;\nvoid main() { a = gl_Normal; b = gl_Normal.zxy; gl_Position "
                  "= ftransform(); }"),
        mergeCase("varyingArrays",
                  "varying vec2 at[3];\nvoid main() { gl_FragColor = vec4(at[0].x, at[1].y * 0.5, "
                  "at[2].x * 0.25, 1.0); }",
                  "varying vec2 at[3];\nvoid main() { for (int i = 0; i < 3; ++i) at[i] = "
                  "gl_MultiTexCoord0.xy * float(i + 1); gl_Position = ftransform(); }"),
        mergeCase("varyingMatrices",
                  "#version 120\nvarying mat3 m; varying mat2 q;\nvoid main() { gl_FragColor = "
                  "vec4(m * vec3(0.5) + vec3(q[1], 0.0) * 0.5, 1.0); }",
                  "#version 120\nvarying mat3 m; varying mat2 q;\nvoid main() { m = "
                  "mat3(gl_Normal, gl_Color.rgb, vec3(0.25)); q = mat2(gl_MultiTexCoord0.xy, "
                  "gl_MultiTexCoord0.yx); gl_Position = ftransform(); }"),
        mergeCase(
            "flatIntegers",
            "#version 130\nflat in int id; flat in uvec2 pair; in vec2 uv;\nvoid main() { "
            "gl_FragColor = vec4(float(id) / 256.0, float(pair.y) / 256.0, uv.x * 0.5, 1.0); }",
            "#version 130\nflat out int id; flat out uvec2 pair; out vec2 uv;\nvoid main() { id = "
            "int(gl_Color.r * 255.0); pair = uvec2(1u, uint(gl_Color.g * 255.0)); uv = "
            "gl_MultiTexCoord0.xy; gl_Position = ftransform(); }"),
        mergeCase("interpolations",
                  "#version 130\nnoperspective in vec2 screen; flat in vec3 facet; smooth in vec2 "
                  "uv; centroid in float c;\nvoid main() { gl_FragColor = vec4(screen * 0.25 + uv "
                  "* 0.25, facet.x * 0.25 + c * 0.25, 1.0); }",
                  "#version 130\nnoperspective out vec2 screen; flat out vec3 facet; smooth out "
                  "vec2 uv; centroid out float c;\nvoid main() { uv = gl_MultiTexCoord0.xy; screen "
                  "= uv; facet = gl_Normal; c = uv.x; gl_Position = ftransform(); }"),
        mergeCase("blockWithInstance",
                  Compat + "in Data { vec3 n; vec2 uv; } data;\nvoid main() { gl_FragColor = "
                           "vec4(data.n * 0.5 + 0.5, 1.0) * data.uv.x; }",
                  Compat + "out Data { vec3 n; vec2 uv; } from;\nvoid main() { from.n = gl_Normal; "
                           "from.uv = gl_MultiTexCoord0.xy; gl_Position = ftransform(); }"),
        mergeCase("blockWithoutInstance",
                  Compat + "in Data { vec3 n; noperspective vec2 uv; };\nvoid main() { "
                           "gl_FragColor = vec4(n * 0.5 + 0.5, 1.0) * uv.x; }",
                  Compat + "out Data { vec3 n; noperspective vec2 uv; };\nvoid main() { n = "
                           "gl_Normal; uv = gl_MultiTexCoord0.xy; gl_Position = ftransform(); }"),
        mergeCase("structVarying",
                  Compat + "struct V { vec3 a; float b[2]; };\nin V v;\nvoid main() { gl_FragColor "
                           "= vec4(v.a * v.b[1], v.b[0]); }",
                  Compat +
                      "struct V { vec3 a; float b[2]; };\nout V v;\nvoid main() { v.a = "
                      "gl_Color.rgb; v.b[0] = 1.0; v.b[1] = 0.5; gl_Position = ftransform(); }"),
        mergeCase("unusedVaryings",
                  "varying vec3 never; varying vec2 uv; varying vec4 unread;\nvoid main() { "
                  "gl_FragColor = vec4(uv, 0.0, 1.0); }",
                  "varying vec2 uv; varying vec4 unread; varying vec3 never; varying mat4 "
                  "big;\nvoid main() { uv = gl_MultiTexCoord0.xy; unread = gl_Vertex; big = "
                  "mat4(1.0); gl_Position = ftransform(); }"),
        mergeCase("texCoords",
                  "void main() { gl_FragColor = gl_TexCoord[0] * 0.25 + gl_TexCoord[1] * 0.5; }",
                  "void main() { gl_TexCoord[0] = gl_MultiTexCoord0; gl_TexCoord[1] = "
                  "gl_MultiTexCoord1; gl_Position = ftransform(); }"),
        mergeCase(
            "texCoordsByIndex",
            "varying vec4 gl_TexCoord[2];\nvoid main() { vec4 s = vec4(0.0); for (int i = 0; i < "
            "2; ++i) s += gl_TexCoord[i] * 0.25; gl_FragColor = s; }",
            "varying vec4 gl_TexCoord[2];\nvoid main() { for (int i = 0; i < 2; ++i) "
            "gl_TexCoord[i] = gl_MultiTexCoord0 * (float(i) + 1.0); gl_Position = ftransform(); }"),
        mergeCase("colorsOfTheVertexStage",
                  "void main() { gl_FragColor = gl_Color * 0.5 + gl_SecondaryColor * 0.5; }",
                  "void main() { gl_FrontColor = gl_Color * 1.5; gl_FrontSecondaryColor = "
                  "gl_SecondaryColor.zyxw; gl_Position = ftransform(); }"),
        mergeCase("fog",
                  "void main() { float f = clamp(exp(-gl_Fog.density * gl_FogFragCoord * 0.2), "
                  "0.0, 1.0); gl_FragColor = mix(gl_Fog.color, gl_Color, f); }",
                  "void main() { gl_FrontColor = gl_Color; gl_FogFragCoord = -(gl_ModelViewMatrix "
                  "* gl_Vertex).z; gl_Position = ftransform(); }"),
        mergeCase("readsBackItsColor", "void main() { gl_FragColor = gl_Color; }",
                  "void main() { gl_FrontColor = gl_Color; gl_FrontColor.rgb *= 0.5; "
                  "gl_FrontColor.a = gl_FrontColor.r; gl_Position = ftransform(); }"),
        mergeCase("lightsOfGL", Head +
                                    "void main() { gl_FragColor = vec4(vec3(max(dot(normalize(n), "
                                    "normalize(gl_LightSource[0].position.xyz)), 0.0)), 1.0) + "
                                    "gl_FrontMaterial.ambient; }"),
        mergeCase(
            "positionByMatrices",
            Head + "void main() { gl_FragColor = vec4(eye * 0.25 + 0.75, 1.0); }",
            Head +
                "void main() { vec4 p = gl_ModelViewMatrix * gl_Vertex; eye = p.xyz; n = "
                "gl_Normal; uv = gl_MultiTexCoord0.xy; gl_Position = gl_ProjectionMatrix * p; }"),
        mergeCase("attributes",
                  "varying vec3 t; varying float w;\nvoid main() { gl_FragColor = vec4(t * 0.5 + "
                  "0.5, w); }",
                  "attribute vec3 tangent; attribute float weight;\nvarying vec3 t; varying float "
                  "w;\nvoid main() { t = tangent; w = weight; gl_Position = ftransform(); }"),
        mergeCase("uniformsInBothStages",
                  "uniform float k; uniform vec3 tint; varying float v;\nvoid main() { "
                  "gl_FragColor = vec4(tint * v * k, 1.0); }",
                  "uniform vec3 tint; uniform float k;\nvarying float v;\nvoid main() { v = k + "
                  "tint.x * gl_MultiTexCoord0.x; gl_Position = ftransform(); }"),
        mergeCase(
            "uniformsOfAllKinds",
            "#version 120\n" + Head +
                R"(uniform vec2 list[3]; uniform mat3 m; uniform mat4 big; uniform int count; uniform bool on; uniform ivec2 pair;
void main() { gl_FragColor = vec4(m * vec3(list[0], list[2].y) * 0.3 + (big * vec4(uv, 0.0, 0.1)).xyz * 0.1 + float(count + pair.x) * 0.1, on ? 1.0 : 0.5); })"),
        mergeCase(
            "uniformStructs",
            Head +
                R"(struct Light { vec3 color; float power; }; uniform Light lights[2]; uniform Light one;
void main() { gl_FragColor = vec4(lights[0].color * lights[1].power + one.color * uv.x * 0.25, 1.0); })"),
        mergeCase("uniformStructInBothStages",
                  "struct Light { vec3 color; float power; }; uniform Light light; varying float "
                  "v;\nvoid main() { gl_FragColor = vec4(light.color * v, 1.0); }",
                  "struct Light { vec3 color; float power; }; uniform Light light; varying float "
                  "v;\nvoid main() { v = light.power * gl_MultiTexCoord0.x; gl_Position = "
                  "ftransform(); }"),
        mergeCase("uniformOfItsOwnStruct",
                  Head +
                      "uniform struct Fade { float from, to; } fade;\nvoid main() { gl_FragColor = "
                      "vec4(vec3(smoothstep(fade.from * 0.1, fade.to, uv.x)), 1.0); }"),
        mergeCase("arraysOfSamplers",
                  "#version 130\n" + Head +
                      "uniform sampler2D maps[2];\nvoid main() { gl_FragColor = texture2D(maps[0], "
                      "uv) * 0.5 + texture2D(maps[1], uv) * 0.5; }"),
        mergeCase(
            "samplersAsParameters",
            Head + "uniform sampler2D map;\nvec4 look(sampler2D from, vec2 at) { return "
                   "texture2D(from, at); }\nvoid main() { gl_FragColor = look(map, uv) * 0.5; }"),
        mergeCase("lookupsWithLevels",
                  "#version 130\n" + Head +
                      "uniform sampler2D map;\nvoid main() { gl_FragColor = textureLod(map, uv, "
                      "1.0) * 0.5 + texelFetch(map, ivec2(uv * 4.0), 0) * 0.5; }"),
        mergeCase("timeOfOsg", Head + "uniform float osg_FrameTime;\nvoid main() { gl_FragColor = "
                                      "vec4(uv, fract(osg_FrameTime), 1.0); }"),
    };
}
