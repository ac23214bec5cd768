// SPDX-License-Identifier: MIT
#include "osgMultiRender/MergeCases.h"

using namespace osgMultiRender;

namespace
{

const std::string Head = "varying vec3 n; varying vec2 uv; varying vec3 eye;\n";

std::string withLineEnds(std::string text, const std::string& end)
{
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
    {
        text.replace(at, 1, end);
    }
    return text;
}

} // namespace

std::vector<Rendering> macroCases()
{
    return {
        mergeCase("macroNamesAGlobal", Head + R"(uniform float k;
#define STRENGTH (k * 0.5)
void main() { gl_FragColor = vec4(uv * STRENGTH, STRENGTH, 1.0); })"),
        mergeCase("macroNamesALocal", Head + R"(float v = 0.25;
#define TWICE (v * 2.0)
void main() { float a = TWICE; float v = uv.x * 0.25; gl_FragColor = vec4(a, TWICE, v, 1.0); })"),
        mergeCase("macroWithArguments", Head + R"(#define SQUARE(x) ((x) * (x))
#define LERP(a, b, t) ((a) + ((b) - (a)) * (t))
void main() { gl_FragColor = vec4(SQUARE(LERP(uv.x, uv.y, 0.5)), SQUARE(uv.x) * 0.25, LERP(max(uv.x, 0.5), 0.25, SQUARE(0.5)), 1.0); })"),
        mergeCase("macroOverSeveralLines", Head + "#define BODY(c) \\\n    { \\\n        gl_FragColor = vec4(c, 1.0); \\\n    }\nvoid main()\nBODY(\n    vec3(uv,\n         0.5))\n"),
        mergeCase("macroPastes", Head + R"(uniform float v1; uniform float v2;
#define V(i) v##i
#define JOIN(a, b) a ## b
void main() { gl_FragColor = vec4(V(1), V(2), JOIN(v, 1) * uv.x, 1.0); })"),
        mergeCase("macroDeclares", R"(#define DECLARE(type, name) varying type name;
DECLARE(vec3, n) DECLARE(vec2, uv)
#define FUNCTION(name, value) float name(float x) { return x * value; }
FUNCTION(half1, 0.5)
void main() { gl_FragColor = vec4(half1(uv.x), n.y * 0.5 + 0.5, 0.0, 1.0); })"),
        mergeCase("macroIsMain", Head + "#define ENTRY void main()\n#define OUTPUT gl_FragColor\nENTRY { OUTPUT = vec4(uv, 0.25, 1.0); }"),
        mergeCase("macroIsAType", Head + "#define real float\n#define real3 vec3\nreal3 f(real x) { return real3(x); }\nvoid main() { gl_FragColor = vec4(f(uv.x * 0.5), 1.0); }"),
        mergeCase("macroIsAKeyword", Head + "#define highp\n#define lowp\nvoid main() { highp vec4 c = vec4(uv, 0.0, 1.0); gl_FragColor = c; }"),
        mergeCase("macroOfItsOwnName", Head + "float shade(float x) { return x * 0.5; }\n#define shade(x) shade((x) + 0.25)\nvoid main() { gl_FragColor = vec4(shade(uv.x)); }"),
        mergeCase("macroOfMacros", Head + "#define A B * 0.5\n#define B C\n#define C (uv.x + 0.25)\n#define CALL(f, x) f(x)\n#define F(x) ((x) * 0.25)\nvoid main() { gl_FragColor = vec4(A, CALL(F, B), 0.0, 1.0); }"),
        mergeCase("macroIsUndefined", Head + "#define X 0.25\nfloat a = X;\n#undef X\n#define X 0.75\nfloat b = X;\n#undef X\nvoid main() { float X = 0.5; gl_FragColor = vec4(a, b, X * uv.x, 1.0); }"),
        mergeCase("macroNamedAsPartnersGlobal", Head + "#define wave 0.25\n#define tint vec3(0.5)\n#define PI 3.0\n#define SCALE uv.x\nvoid main() { gl_FragColor = vec4(tint * wave * PI * SCALE, 1.0); }"),
        mergeCase("conditionalDeclarations", Head + R"(#define QUALITY 2
#if QUALITY > 1 && defined(QUALITY)
uniform vec3 fine; vec3 look() { return fine * uv.x; }
#else
uniform float coarse; vec3 look() { return vec3(coarse); }
#endif
#ifdef MISSING
syntax error here
#elif (QUALITY & 2) == 2
float g = 0.25;
#endif
void main() { gl_FragColor = vec4(look() * g, 1.0); })"),
        mergeCase("conditionalInAFunction", Head + R"(#define WAVY
void main()
{
    float x = uv.x;
#ifdef WAVY
    x = 0.5 + 0.5 * sin(x * 9.0);
#else
    x = 0.0;
#endif
    gl_FragColor = vec4(vec3(x), 1.0);
})"),
        mergeCase("conditionalBraces", Head + R"(#define BRANCH 1
void main()
{
#if BRANCH
    if (uv.x > 1.0) {
#else
    {
#endif
        gl_FragColor = vec4(uv, 0.0, 1.0);
    }
    else gl_FragColor = vec4(0.25);
})"),
        mergeCase("asksForItsVersion", "#version 120\n" + Head + R"(#if __VERSION__ == 120
float g = 0.25;
#else
float g = 1.0;
#endif
void main() { gl_FragColor = vec4(uv * g, float(__VERSION__) / 240.0, 1.0); })"),
        mergeCase("asksForItsLine", Head + "\n\nvoid main()\n{\n    gl_FragColor = vec4(float(__LINE__) * 0.1, uv, 1.0);\n}\n"),
        mergeCase("commentsHoldCode", Head + R"(/* gl_FragColor = vec4(1.0); void main() { */ // discard; \
   return; }
void main(/* nothing */) { gl_FragColor /* = */ = vec4(uv /* x */, 0.25, 1.0); // return;
})"),
        mergeCase("continuedLines", Head + "void main() { gl_FragColor = vec4(uv, \\\n 0.25, \\\n 1.0); }\n"),
        mergeCase("windowsLines", withLineEnds(Head + "#define X 0.25\n#if 1\n#endif\n// end\nvoid main()\n{\n gl_FragColor = vec4(uv, 0.25, 1.0);\n}\n", "\r\n")),
        mergeCase("umlauts", Head + "// Gr\xC3\xBC\xC3\x9F" "e: \xE2\x82\xAC\n/* \xC3\xA4 */ void main() { gl_FragColor = vec4(uv, 0.5, 1.0); }"),
        mergeCase("noLineEndAtTheEnd", Head + "void main() { gl_FragColor = vec4(uv, 0.5, 1.0); } // end"),
        mergeCase("linesOfItsOwn", "#version 120\n" + Head + "#line 100\nvoid main() { gl_FragColor = vec4(uv, 0.5, 1.0); }\n#line 7 3\n"),
        mergeCase("pragmas", "#version 120\n#pragma optimize(on)\n#pragma debug(off)\n" + Head + "void main() { gl_FragColor = vec4(uv, 0.5, 1.0); }"),
        mergeCase("extensions", "#version 120\n// first\n#extension GL_ARB_texture_rectangle : enable\n#extension GL_EXT_gpu_shader4 : enable\n" + Head + R"(#ifdef GL_ARB_texture_rectangle
#endif
void main() { gl_FragColor = vec4(uv, 0.5, 1.0); })"),
    };
}
