// SPDX-License-Identifier: MIT
#include "osgMultiRender/GlslSamples.h"

namespace glslSamples
{

const std::vector<Sample>& fragmentSamples()
{
    static const std::vector<Sample> samples = {
        {"FragColor", {R"(varying vec2 uv;
void main() { gl_FragColor = vec4(uv, 0.5, 1.0); }
)"}},
        {"FragColorByComponents", {R"(#version 110
varying vec2 uv;
void main(void)
{
    gl_FragColor = vec4(1.0);
    gl_FragColor.rg = uv;
    gl_FragColor.b *= 0.25;
    gl_FragColor[3] = uv.x;
}
)"}},
        {"FragColorReadBack", {R"(#version 120
varying vec2 uv;
void darken() { gl_FragColor = gl_FragColor * 0.5 + gl_FragColor.gbra * 0.25; }
void main() { gl_FragColor = vec4(uv, uv.x * uv.y, 1.0); darken(); }
)"}},
        {"EarlyReturn", {R"(#version 120
varying vec2 uv;
void main()
{
    gl_FragColor = vec4(uv, 0.0, 1.0);
    if (uv.x > 0.5) return;
    gl_FragColor.b = 1.0;
}
)"}},
        {"Discard", {R"(#version 120
varying vec2 uv;
void main()
{
    if (fract(uv.x * 8.0) < 0.5) discard;
    gl_FragColor = vec4(uv.yx, 1.0, 1.0);
}
)"}},
        {"FragDepth", {R"(#version 120
varying vec2 uv;
void main() { gl_FragColor = vec4(uv, 1.0, 1.0); gl_FragDepth = uv.x; }
)"}},
        {"FragDataConstantIndices",
         {R"(#version 120
varying vec2 uv;
void main()
{
    gl_FragData[0] = vec4(uv, 0.0, 1.0);
    gl_FragData[2] = vec4(0.0, uv, 1.0);
    gl_FragData [ 1 ] = vec4(uv.yx, 1.0, 1.0);
}
)"},
         3},
        {"FragDataDynamicIndex",
         {R"(#version 120
varying vec2 uv;
void main()
{
    for (int i = 0; i < gl_MaxDrawBuffers; ++i)
        gl_FragData[i] = vec4(uv, float(i) / 8.0, 1.0);
}
)"},
         4},
        {"FragDataThroughMacro",
         {R"(#version 120
#define TARGET(n) gl_FragData[n]
varying vec2 uv;
void main() { TARGET(0) = vec4(uv, 0.0, 1.0); TARGET(1) = vec4(1.0 - uv, 0.0, 1.0); }
)"},
         2},
        {"FragColorThroughMacro", {R"(#version 120
#define OUTPUT \
    gl_FragColor
#define WRITE(c) OUTPUT = (c)
varying vec2 uv;
void main() { WRITE(vec4(uv, 0.25, 1.0)); }
)"}},
        {"MainThroughMacro", {R"(#version 120
#define ENTRY void main()
varying vec2 uv;
ENTRY { gl_FragColor = vec4(uv, 0.75, 1.0); }
)"}},
        {"PlainOut", {R"(#version 130
in vec2 uv;
out vec4 color;
void main() { color = vec4(uv, 0.0, 1.0); }
)"}},
        {"LayoutLocation",
         {R"(#version 330 core
in vec2 uv;
layout(location = 1) out vec4 second;
layout(location = 0) out vec4 first;
void main() { first = vec4(uv, 0.0, 1.0); second = vec4(0.0, uv, 1.0); }
)"},
         2},
        {"BoundByApplication",
         {R"(#version 150
in vec2 uv;
out vec4 albedo, glow;
void main() { albedo = vec4(uv, 0.0, 1.0); glow = vec4(1.0 - uv, 1.0, 1.0); }
)"},
         2,
         false,
         {{"albedo", 1}, {"glow", 0}}},
        {"CommaListWithLayout",
         {R"(#version 330
in vec2 uv;
layout(location = 0) out highp /* why not */ vec3 color;
layout(location = 1)
    out
    float one;
void main() { color = vec3(uv, 1.0); one = uv.x; }
)"},
         2},
        {"ArrayOfOutputs",
         {R"(#version 330
const int Count = 3;
in vec2 uv;
layout(location = 0) out vec4 colors[Count];
void main() { for (int i = 0; i < 3; ++i) colors[i] = vec4(uv, float(i) * 0.25, 1.0); }
)"},
         3},
        {"ArrayTypeOfOutputs",
         {R"(#version 440 core
#define COUNT (1 + 1)
in vec2 uv;
layout(location = 1 - 1) out vec4[COUNT] colors;
void main() { colors[0] = vec4(uv, 0.0, 1.0); colors[1] = vec4(uv.yx, 0.0, 1.0); }
)"},
         2},
        {"UnsignedOutput",
         {R"(#version 130
in vec2 uv;
out uvec4 value;
void main() { value = uvec4(uint(uv.x * 255.0), uint(uv.y * 255.0), 7u, 255u); }
)"},
         1,
         true},
        {"ShadowingLocals", {R"(#version 330
in vec2 uv;
layout(location = 0) out vec4 color;
struct Light { vec4 color; };
vec4 shade(vec4 color) { return color * 0.5; }
void main()
{
    Light light;
    light.color = vec4(uv, 0.0, 1.0);
    { vec4 color = light.color; color *= 2.0; }
    for (int color = 0; color < 2; ++color) light.color.b += 0.25;
    color = shade(light.color);
    color.a = 1.0;
}
)"}},
        {"TwoShaderObjects",
         {R"(#version 120
void paint(vec2 at);
varying vec2 uv;
void main() { paint(uv); }
)",
          R"(#version 120
void paint(vec2 at) { gl_FragColor = vec4(at, 1.0, 1.0); }
)"}},
        {"ThreeObjectsMixedVersions",
         {R"(vec3 tint(vec2 at);
varying vec2 uv;
void main() { gl_FragColor = vec4(tint(uv), 1.0); }
)",
          R"(#version 130
float wave(float x);
vec3 tint(vec2 at) { return vec3(at, wave(at.x)); }
)",
          R"(#version 120
float wave(float x) { return 0.5 + 0.5 * sin(20.0 * x); }
)"}},
        {"NewerKeywordsAsNames", {R"(#version 110
varying vec2 uv;
struct Point { float flat; vec2 smooth; };
float uint(float common) { return common * 0.5; }
vec4 active = vec4(0.25);
void main()
{
    Point partition;
    partition.flat = uv.x;
    partition.smooth = uv;
    float filter = uint(partition.flat);
    float layout = partition.smooth.y;
    gl_FragColor = vec4(filter, layout, active.x, 1.0);
}
)"}},
        {"OwnVersionsOfNewerFunctions", {R"(#version 110
varying vec2 uv;
float round(float x) { return floor(x + 0.25); }
vec2 round(vec2 x) { return floor(x + 0.75); }
float trunc(float x);
mat2 inverse(mat2 m) { return m * 0.5; }
float sinh(float x) { return x * x; }
bool isnan(float x) { return x > 0.5; }
vec4 texture(vec2 at) { return vec4(at, 0.0, 1.0); }
void main()
{
    vec4 c = texture(uv);
    c.b = round(uv.x * 4.0) / 4.0 + trunc(uv.y) * 0.1;
    c.rg = inverse(mat2(uv.x, 0.0, 0.0, uv.y)) * round(uv * 2.0) + sinh(uv.x) * 0.1;
    if (isnan(uv.y)) c.g = 1.0;
    gl_FragColor = c;
}
float trunc(float x) { return x - 0.5; }
)"}},
        {"VariableNamedTexture", {R"(#version 120
uniform sampler2D texture;
varying vec2 uv;
void main() { gl_FragColor = texture2D(texture, uv); }
)"}},
        {"VersionCondition", {R"(#if __VERSION__ >= 130
in vec2 uv;
out vec4 result;
#else
varying vec2 uv;
#define result gl_FragColor
#endif
void main() { result = vec4(uv, 0.125, 1.0); }
)"}},
        {"UnknownCondition", {R"(#version 120
#pragma import_defines(MANY)
varying vec2 uv;
void main()
{
#ifdef MANY
    gl_FragData[0] = vec4(uv, 0.0, 1.0);
    gl_FragData[1] = vec4(uv, 1.0, 1.0);
#else
    gl_FragColor = vec4(uv, 0.5, 1.0);
#endif
}
)"}},
        {"UnbalancedBranches", {R"(#version 120
varying vec2 uv;
#ifdef GL_ARB_surely_not_there
void main() { if (uv.x > 0.5) {
#else
void main() { if (uv.x > 0.25) {
#endif
    gl_FragColor = vec4(uv, 0.0, 1.0);
    } else gl_FragColor = vec4(1.0);
}
)"}},
        {"ExtensionsAndConditionFirst", {R"(#version 120
#extension GL_ARB_shader_texture_lod : enable
#ifdef GL_ARB_shader_texture_lod
varying vec2 uv;
#else
varying vec2 uv;
#endif
void main() { gl_FragColor = vec4(uv, 0.0, 1.0); }
)"}},
        {"EsGuards", {R"(#ifdef GL_ES
precision mediump float;
#endif
varying vec2 uv;
#define PI 3.14159265
void main() { gl_FragColor = vec4(0.5 + 0.5 * sin(uv.x * PI * 4.0), uv.y, 0.0, 1.0); }
)"}},
        {"FixedFunctionState", {R"(#version 120
varying vec2 uv;
void main() { gl_FragColor = gl_Color * vec4(uv, 1.0, 1.0) + gl_FrontMaterial.ambient * 0.1; }
)"}},
        {"QualifierMacros", {R"(#version 140
#define FRAGMENT_IN in
#define FRAGMENT_OUT out
#define COLOR vec4
FRAGMENT_IN vec2 uv;
FRAGMENT_OUT COLOR color;
void main() { color = vec4(uv, 0.625, 1.0); }
)"}},
        {"CarriageReturns",
         {"#version 120\r\nvarying vec2 uv; // here\r\nvoid main()\r\n{\r\n"
          "    gl_FragColor = vec4(uv, \\\r\n 0.1, 1.0);\r\n}\r\n"}},
        {"NoLineEndAtTheEnd",
         {"varying vec2 uv; void main() { gl_FragColor = vec4(uv, 0., 1.); }"}},
    };
    return samples;
}

} // namespace glslSamples
