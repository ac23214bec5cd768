// SPDX-License-Identifier: MIT
#include "osgMultiRender/MergeCases.h"

using namespace osgMultiRender;

namespace
{

const std::string Head = "varying vec3 n; varying vec2 uv; varying vec3 eye;\n";

Rendering severalObjects()
{
    Rendering one = mergeCase("severalShaderObjects", Head + R"(uniform float k;
float state = 0.25;
vec3 help(float x);
void main() { state += 0.25; gl_FragColor = vec4(help(uv.x) + state, 1.0); })");
    one.shaders.push_back({GlslStage::Fragment, Head + R"(uniform float k;
#define k2 (k * 2.0)
vec3 help(float x) { return vec3(x, uv.y, 0.5) * k2 * 0.25; })",
                           "help.frag"});
    return one;
}

std::string longFile()
{
    std::string text = Head + "vec3 sum = vec3(0.0);\n";
    for (int i = 0; i < 1500; ++i)
    {
        const std::string id = std::to_string(i);
        text += "const float c" + id + " = 0.0001;\nvoid f" + id + "(float x) { sum += c" + id + " * x; }\n";
    }
    text += "void main()\n{\n";
    for (int i = 0; i < 1500; ++i)
    {
        text += "    f" + std::to_string(i) + "(uv.x);\n";
    }
    return text + "    gl_FragColor = vec4(sum, 1.0);\n}\n";
}

} // namespace

std::vector<Rendering> nameCases()
{
    return {
        mergeCase("sameNamesForOtherThings", Head + R"(uniform vec4 k; float tint = 0.25; vec2 wave(float shade) { return uv * shade; }
vec3 light = vec3(0.5);
void main() { tint += 0.25; gl_FragColor = vec4(wave(0.5), k.x, 1.0) * tint + vec4(light, 0.0) * 0.25; })"),
        mergeCase("namesLikeMergedOnes", Head + R"(float x = 0.25; float x_0 = 0.5; float x_1b = 0.125;
void main() { float x_1 = 0.75; float discarded_1 = 0.5; gl_FragColor = vec4(x, x_0, x_1, 1.0) * uv.x * discarded_1 + x_1b; })"),
        mergeCase("namesLikeOurs", Head + R"(float osgmr_sum = 0.25; vec3 osgmr_varying0 = vec3(0.5); float osgmr_weight = 0.5;
void main() { gl_FragColor = vec4(osgmr_varying0 * osgmr_sum + uv.x * osgmr_weight, 1.0); })"),
        mergeCase("namesWithUnderlines", Head + R"(float _a = 0.25; float b_ = 0.5; float c_d_e = 0.75;
void main() { gl_FragColor = vec4(_a, b_, c_d_e, 1.0) * uv.x; })"),
        mergeCase("shadowedByALocal", Head + R"(vec3 color = vec3(0.25);
void main() { vec3 a = color; vec3 color = vec3(uv, 0.0); gl_FragColor = vec4(color + a, 1.0); })"),
        mergeCase("shadowedInItsOwnInitializer", Head + R"(float x = 0.5;
void main() { float y = 0.25; { float y = y + x; float x = y; gl_FragColor = vec4(uv * x, y, 1.0); } })"),
        mergeCase("shadowedByAParameter", Head + R"(vec3 shade = vec3(0.5);
float f(float shade, float uv) { return shade * uv; }
void main() { gl_FragColor = vec4(shade * f(uv.x, 0.5), 1.0); })"),
        mergeCase("declaredInFor", Head + R"(int i = 3; float sum = 0.25;
void main() { gl_FragColor = vec4(0.0); for (int i = 0, j = 2; i < 4; ++i, ++j) { float sum = 1.0; gl_FragColor += vec4(uv * 0.1, sum * 0.1, 0.0) * float(j > 2); }
gl_FragColor += vec4(sum) * float(i) * 0.1; })"),
        mergeCase("declaredInIfAndWhile", Head + R"(float a = 0.5; bool go = true;
void main() { float s = 0.0; if (uv.x > 0.5) { float a = 0.25; s += a; } else { s += a; }
int count = 0; while (go) { float a = 0.1; s += a; if (++count > 2) go = false; } gl_FragColor = vec4(s, uv, 1.0); })"),
        mergeCase("structs", Head + R"(struct Light { float power; vec3 color; };
Light make(float p) { Light l; l.power = p; l.color = vec3(uv, 0.5); return l; }
void main() { Light light = make(0.5); gl_FragColor = vec4(light.color * light.power, 1.0); })"),
        mergeCase("arraysOfStructs", Head + R"(struct Light { vec3 color; float weights[2]; };
struct Scene { Light lights[2]; float ambient; };
void main() { Scene s; for (int i = 0; i < 2; ++i) { s.lights[i].color = vec3(uv, float(i)); s.lights[i].weights[0] = 0.25; s.lights[i].weights[1] = 0.5; }
s.ambient = 0.1; gl_FragColor = vec4(s.lights[0].color * s.lights[1].weights[1] + s.lights[1].color * s.lights[0].weights[0] + s.ambient, 1.0); })"),
        mergeCase("structWithVariables", Head + R"(struct Pair { float a, b; } pair, other;
void main() { pair.a = uv.x; pair.b = 0.5; other = pair; gl_FragColor = vec4(other.a, other.b, pair.a * 0.5, 1.0); })"),
        mergeCase("unnamedStruct", Head + R"(struct { float a; vec2 b; } data;
void main() { data.a = 0.5; data.b = uv; gl_FragColor = vec4(data.b * 0.5, data.a, 1.0); })"),
        mergeCase("localStruct", Head + R"(struct S { float a; };
void main() { S first = S(0.25); struct S { vec2 a; }; S s; s.a = uv; gl_FragColor = vec4(s.a * 0.5, first.a, 1.0); })"),
        mergeCase("fieldsNamedAsGlobals", Head + R"(float wave = 0.5; struct Data { float wave; vec3 n; float uv; };
void main() { Data d = Data(0.25, vec3(uv, 0.0), 0.125); gl_FragColor = vec4(d.n * d.wave + wave * d.uv, 1.0); })"),
        mergeCase("swizzlesNamedAsGlobals", Head + R"(float x = 0.5; vec3 rgb = vec3(0.25); vec2 xy = vec2(0.5);
void main() { vec4 c = vec4(rgb, x); c.xy += uv.xy * xy; c.rgb *= rgb.x + x; gl_FragColor = vec4(c.xyz, 1.0); })"),
        mergeCase("overloads", Head + R"(float f(float x) { return x * 0.5; } float f(vec2 x) { return x.x * 0.25; } vec3 f(float x, float y) { return vec3(x, y, f(x)); }
void main() { gl_FragColor = vec4(f(uv.x, f(uv)), 1.0); })"),
        mergeCase("overloadsABuiltin", Head + R"(float max(float a, float b, float c) { return a > b ? c : b; }
vec3 mix(vec3 a, vec3 b) { return a * 0.75 + b * 0.25; }
void main() { gl_FragColor = vec4(mix(vec3(max(uv.x, uv.y, 0.5)), vec3(0.25)), 1.0); })"),
        mergeCase("functionNamedAsLaterBuiltin", Head + R"(float round(float x) { return floor(x + 0.5) * 0.25; } mat3 inverse(mat3 m) { return m * 0.5; }
vec3 texture(vec2 at) { return vec3(at, 0.5); } float isnan(float a) { return a * 0.25; }
void main() { gl_FragColor = vec4(inverse(mat3(1.0)) * texture(uv) + round(uv.x) + isnan(uv.y), 1.0); })"),
        mergeCase("prototypes", Head + R"(float f(float); vec3 g(in vec3 a, float b);
void main() { gl_FragColor = vec4(g(vec3(uv, 0.0), f(uv.x)), 1.0); }
vec3 g(in vec3 a, float b) { return a * b; } float f(float x) { return x * 0.5; })"),
        mergeCase("declaredTogether", Head + R"(uniform vec3 A, B; float a, b = 0.5, c[2];
void main() { a = 0.25; c[0] = uv.x; c[1] = uv.y; gl_FragColor = vec4(A * a + B * b * c[0] * c[1], 1.0); })"),
        mergeCase("constantsOfConstants", "#version 120\n" + Head + R"(const int N = 2; const int M = N * 2 - 1; const float W[M] = float[M](0.25, 0.5, 0.125);
float sums[N + 1];
void main() { for (int i = 0; i < M; ++i) sums[i] = W[i] * uv.x; gl_FragColor = vec4(sums[0], sums[1], sums[2], 1.0); })"),
        mergeCase("changedGlobals", Head + R"(vec3 tint = vec3(0.25); int count = 0;
void step1() { tint *= 1.5; ++count; }
void main() { for (int i = 0; i < 3; ++i) step1(); gl_FragColor = vec4(tint * float(count) * 0.25 + vec3(uv, 0.0) * 0.1, 1.0); })"),
        mergeCase("globalsOfVaryings", "#version 120\n" + Head + R"(vec3 m = normalize(n); vec3 half1 = m * 0.5; float f(float x) { return x + uv.x; } float g = f(0.25);
void main() { gl_FragColor = vec4(half1 + 0.5 * g, 1.0); })"),
        mergeCase("globalsOfUniforms", "#version 120\n" + Head + R"(uniform float k; float twice = k * 2.0;
void main() { twice += 0.1; gl_FragColor = vec4(uv * 0.25, twice * 0.25, 1.0); })"),
        mergeCase("switchAndTernary", "#version 130\n" + Head + R"(int color = 2;
void main() { int which = int(uv.x * 2.0); switch (which) { case 0: gl_FragColor = vec4(1.0, 0.0, 0.0, 1.0); break; case 1: { int color = 1; gl_FragColor = vec4(float(color) * 0.5); break; } default: gl_FragColor = vec4(uv, float(color) * 0.25, 1.0); }
gl_FragColor.g = uv.y > 1.0 ? 0.25 : gl_FragColor.g; })"),
        mergeCase("inoutParameters", Head + R"(void swap(inout float a, inout float b) { float t = a; a = b; b = t; } void both(const in float a, out vec2 result) { result = vec2(a, 1.0 - a); }
void main() { float a = uv.x * 0.5, b = 0.25; swap(a, b); vec2 r; both(a, r); gl_FragColor = vec4(r, b, 1.0); })"),
        mergeCase("arraysAsTypes", "#version 120\n" + Head + R"(float[2] pair(float x) { return float[2](x, x * 0.5); } vec2[2] table = vec2[2](vec2(0.1), vec2(0.2));
void main() { float[2] p = pair(uv.x); gl_FragColor = vec4(p[0], p[1], table[1].x, 1.0) * 0.5; })"),
        severalObjects(),
        mergeCase("veryLong", longFile()),
    };
}
