// SPDX-License-Identifier: MIT
#include "osgMultiRender/MergeCases.h"

using namespace osgMultiRender;

namespace
{

const std::string Head = "varying vec3 n; varying vec2 uv; varying vec3 eye;\n";
const std::string Head130 = "#version 130\nin vec3 n; in vec2 uv; in vec3 eye;\n";
const std::string Head330 = "#version 330 compatibility\nin vec3 n; in vec2 uv; in vec3 eye;\n";

Rendering boundOutputs()
{
    Rendering one = mergeCase("boundOutputs", Head330 + R"(out vec4 a; out vec4 b;
void main() { a = vec4(1.0); b = vec4(uv, 0.0, 1.0); })",
                              "#version 330 compatibility\nout vec3 n; out vec2 uv; out vec3 eye;\n"
                              "void main() { n = gl_Normal; uv = gl_MultiTexCoord0.xy; eye = n; "
                              "gl_Position = ftransform(); }");
    one.fragmentDataBindings = {{"a", 1}, {"b", 0}};
    return one;
}

/// Its project's state has an alpha test.
Rendering alphaTested(const char* name, unsigned int function, float reference)
{
    Rendering one =
        mergeCase(name, Head + "void main() { gl_FragColor = vec4(uv, 0.25, fract(uv.x * 3.0)); }");
    one.state.given = one.state.alphaTest = true;
    one.state.alphaFunction = function;
    one.state.alphaReference = reference;
    return one;
}

} // namespace

std::vector<Rendering> outputCases()
{
    return {
        mergeCase("fragColor", Head + "void main() { gl_FragColor = vec4(uv, 0.5, 1.0); }"),
        mergeCase("earlyReturn", Head + R"(void main()
{
    gl_FragColor = vec4(1.0, 0.0, 0.0, 1.0);
    if (uv.x > 1.0)
        return;
    gl_FragColor = vec4(0.0, uv.y, 1.0, 1.0);
})"),
        mergeCase("returnInEachBranch", Head + R"(void main()
{
    if (uv.x > 1.0) { gl_FragColor = vec4(n, 1.0); return; }
    else { gl_FragColor = vec4(uv, 0.0, 1.0); return; }
})"),
        mergeCase("returnInALoop", Head + R"(void main()
{
    gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
    for (int i = 0; i < 8; ++i)
    {
        if (uv.x * 4.0 < float(i)) return;
        gl_FragColor.g += 0.125;
    }
})"),
        mergeCase("returnOfAFunctionStays",
                  Head + R"(float f(float x) { if (x > 1.0) return 0.25; return x; }
void main() { gl_FragColor = vec4(f(uv.x), f(uv.y), 0.0, 1.0); return; })"),
        mergeCase("partialWrites",
                  Head + "void main() { gl_FragColor.rgb = n * 0.5 + 0.5; gl_FragColor.a = 1.0; }"),
        mergeCase("swizzledWrites", Head + "void main() { gl_FragColor.bgra = vec4(uv, 0.25, "
                                           "0.5).xyzw; gl_FragColor.xw = vec2(0.75, 1.0); }"),
        mergeCase("writesByIndex", Head + "void main() { for (int i = 0; i < 4; ++i) "
                                          "gl_FragColor[i] = 0.25 * float(i) * uv.x; }"),
        mergeCase("addsToItsColor", Head + "void main() { gl_FragColor = vec4(0.25); gl_FragColor "
                                           "+= vec4(uv, uv) * 0.25; gl_FragColor *= 0.5; }"),
        mergeCase("fragData", Head + "void main() { gl_FragData[0] = vec4(uv, 1.0, 1.0); }"),
        mergeCase(
            "severalFragData",
            Head +
                "void main() { gl_FragData[0] = vec4(uv, 1.0, 1.0); gl_FragData[1] = vec4(1.0); }"),
        mergeCase(
            "fragDataByConstant",
            Head +
                "const int Target = 1 - 1;\nvoid main() { gl_FragData[Target] = vec4(n, 1.0); }"),
        mergeCase("outVec4",
                  Head130 + "out vec4 color;\nvoid main() { color = vec4(n * 0.5 + 0.5, 1.0); }"),
        mergeCase("outVec3", Head130 + "out vec3 color;\nvoid main() { color = n * 0.5 + 0.5; }"),
        mergeCase("outByLocation", R"(#version 330 compatibility
in vec3 n; in vec2 uv;
layout(location = 1) out vec4 other;
layout(location = 0) out vec4 color;
void main() { other = vec4(1.0); color = vec4(uv, 0.0, 1.0); })"),
        mergeCase("outArray", Head330 + "out vec4 colors[2];\nvoid main() { colors[0] = vec4(uv, "
                                        "0.0, 1.0); colors[1] = vec4(1.0); }"),
        mergeCase("outIsReadBack", Head330 + "out vec4 color;\nvoid main() { color = vec4(uv, 0.0, "
                                             "1.0); color.rgb = color.gbr * 0.5; }"),
        boundOutputs(),
        mergeCase("writesInACallee", Head + R"(void put(vec3 c) { gl_FragColor = vec4(c, 1.0); }
void main() { put(vec3(uv, 0.25)); })"),
        mergeCase("passesItsColor", Head + R"(void put(inout vec4 c) { c.rg += uv * 0.25; }
void main() { gl_FragColor = vec4(0.25, 0.25, 0.25, 1.0); put(gl_FragColor); })"),
        mergeCase("discards", Head + R"(void main()
{
    if (fract(uv.x * 4.0) > 0.5) discard;
    gl_FragColor = vec4(uv, 0.0, 1.0);
})"),
        mergeCase("discardsOrElse", Head + R"(void main()
{
    if (fract(uv.y * 4.0) > 0.5) discard; else gl_FragColor = vec4(uv, 0.0, 1.0);
})"),
        mergeCase("discardsInACallee", Head + R"(void cut(float x) { if (x > 0.5) { discard; } }
void main() { cut(fract(uv.x * 3.0)); gl_FragColor = vec4(uv, 0.0, 1.0); })"),
        mergeCase("discardsInAFunctionWithResult",
                  "#version 120\n" + Head + R"(struct Hit { vec3 at; float t; };
Hit trace(float x) { if (x > 0.5) discard; return Hit(vec3(x), x); }
float[2] two(float x) { if (x < 0.1) discard; return float[2](x, x); }
void main() { Hit h = trace(fract(uv.x * 3.0)); gl_FragColor = vec4(h.at, h.t) * two(uv.y)[1]; })"),
        mergeCase("discardEndsAnEndlessLoop",
                  Head + R"(bool find(float x) { if (x > 0.5) discard; return x < 0.25; }
void main()
{
    float x = fract(uv.x * 3.0);
    while (true) { if (find(x)) break; x *= x < 0.5 ? 0.5 : 1.0; }
    do { x += 0.01; } while (!find(0.1));
    for (;;) if (find(0.0)) break;
    gl_FragColor = vec4(x, uv, 1.0);
})"),
        alphaTested("alphaTested", 0x0204, 0.5f),      // GL_GREATER
        alphaTested("alphaTestedLess", 0x0201, 0.25f), // GL_LESS
        alphaTested("alphaTestedNever", 0x0200, 0.0f), // GL_NEVER
        alphaTested("alphaTestedAlways", 0x0207, 0.5f),
        mergeCase("alwaysDiscards", Head + "void main() { gl_FragColor = vec4(1.0); discard; }"),
        mergeCase("writesDepth", Head + "void main() { gl_FragColor = vec4(uv, 0.0, 1.0); "
                                        "gl_FragDepth = gl_FragCoord.z * 0.5; }"),
        mergeCase("writesDepthAndDiscards", Head + R"(void main()
{
    if (uv.y > 1.5) discard;
    gl_FragColor = vec4(uv, 0.0, 1.0);
    gl_FragDepth = uv.x * 0.5;
})"),
        mergeCase("takesDerivatives", Head + "void main() { gl_FragColor = vec4(abs(dFdx(uv)) * "
                                             "20.0, abs(dFdy(uv.x)) * 20.0, 1.0); }"),
        mergeCase(
            "takesDerivativesInACallee",
            Head +
                R"(float lines(float x) { return clamp(abs(fract(x) - 0.5) / fwidth(x), 0.0, 1.0); }
void main() { gl_FragColor = vec4(vec3(lines(uv.x * 4.0)), 1.0); })"),
        mergeCase("usesFragCoord", Head + "void main() { gl_FragColor = vec4(gl_FragCoord.xy / "
                                          "64.0, gl_FragCoord.z, 1.0); }"),
        mergeCase(
            "usesFrontFacing",
            Head +
                "void main() { gl_FragColor = gl_FrontFacing ? vec4(uv, 0.0, 1.0) : vec4(1.0); }"),
    };
}
