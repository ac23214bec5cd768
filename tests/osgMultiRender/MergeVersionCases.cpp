// SPDX-License-Identifier: MIT
#include "osgMultiRender/MergeCases.h"

using namespace osgMultiRender;

namespace
{

const std::string Head = "varying vec3 n; varying vec2 uv; varying vec3 eye;\n";

/// Core profiles have the matrix in a uniform, which the tests set by name: it is built here.
std::string coreVertex(const std::string& version, const std::string& rest)
{
    return "#version " + version + "\nlayout(location = 0) in vec3 position;\n" + rest +
           "\nvoid main() { uv = position.xy; gl_Position = vec4(position.xy * 0.7, position.z, 1.0); }";
}

Rendering webGl1()
{
    Rendering one = mergeCase("webGl1", "#version 100\nprecision mediump float;\nvarying vec2 uv;\nuniform lowp vec3 tint;\nvoid main() { gl_FragColor = vec4(tint * uv.x, 1.0); }",
                  "#version 100\nattribute vec3 weight;\nvarying vec2 uv;\nattribute vec4 position;\nvoid main() { uv = position.xy + weight.xy * 0.1; gl_Position = vec4(position.xy * 0.7, position.z, 1.0); }");
    one.attributeBindings = {{"position", 0}, {"weight", 5}};
    return one;
}

} // namespace

std::vector<Rendering> versionCases()
{
    return {
        mergeCase("glsl110", "#version 110\n" + Head + "void main() { float x = 0.5; gl_FragColor = vec4(uv * x, 0.25, 1.0); }"),
        mergeCase("glsl120", "#version 120\n" + Head + "uniform float k = 0.75; void main() { float a[2] = float[2](1, 2); gl_FragColor = vec4(uv * k, a.length() / 4.0, 1); }"),
        mergeCase("glsl130", "#version 130\nin vec3 n; in vec2 uv;\nout vec4 color;\nvoid main() { uint bits = 5u & 4u; color = vec4(uv, float(bits) / 8.0, trunc(1.5)); }"),
        mergeCase("glsl150", "#version 150 compatibility\nin vec3 n; in vec2 uv;\nout vec4 color;\nvoid main() { color = vec4(uv, determinant(mat2(0.5)), 1.0); }"),
        mergeCase("glsl330", "#version 330 compatibility\nin vec3 n; in vec2 uv;\nlayout(location = 0) out vec4 color;\nvoid main() { color = vec4(uv, intBitsToFloat(floatBitsToInt(0.25)), 1.0); }"),
        mergeCase("glsl400", "#version 400 compatibility\nin vec2 uv;\nout vec4 color;\nvoid main() { precise float x = fma(uv.x, 0.5, 0.25); color = vec4(x, uv.y, float(bitCount(7)) / 8.0, 1.0); }"),
        mergeCase("glsl430", "#version 430 compatibility\nlayout(location = 0) in vec2 at;\nlayout(location = 5) uniform float k;\nout vec4 color;\nvoid main() { color = vec4(at, k, 1.0); }",
                  "#version 430 compatibility\nlayout(location = 0) out vec2 other;\nvoid main() { other = gl_MultiTexCoord0.xy; gl_Position = ftransform(); }"),
        mergeCase("glsl450", "#version 450 compatibility\nin vec2 uv;\nlayout(binding = 1) uniform sampler2D map;\nout vec4 color;\nvoid main() { color = texture(map, uv) + vec4(0.0, dFdxFine(uv.x), 0.0, 0.0); }"),
        mergeCase("keywordsOfLaterVersions", Head + R"(uniform float sample; float buffer = 0.25; struct shared { float precise; float patch; };
float coherent(float restrict) { return restrict * 0.5; }
void main() { shared s = shared(0.5, 0.25); float flat = s.precise; vec2 smooth = uv; gl_FragColor = vec4(smooth * flat, coherent(sample) + s.patch * buffer, 1.0); })"),
        mergeCase("variablesNamedAsLaterBuiltins", Head + R"(uniform float round; vec2 texture = vec2(0.5); float inverse = 0.25;
void main() { float isnan = 0.5; gl_FragColor = vec4(uv * texture * round, inverse * isnan, 1.0); })"),
        mergeCase("precisionOfTheWeb", "#ifdef GL_ES\nprecision mediump float;\n#endif\n" + Head + "void main() { gl_FragColor = vec4(uv, 0.25, 1.0); }"),
        webGl1(),
        mergeCase("webGl2", "#version 300 es\nprecision highp float;\nin vec2 uv;\nout vec4 color;\nvoid main() { color = vec4(uv, 0.25, 1.0); }",
                  coreVertex("300 es", "out vec2 uv;")),
        mergeCase("core330", "#version 330 core\nin vec2 uv;\nout vec4 color;\nvec4 texture2D(vec2 x) { return vec4(x, 0.25, 1.0); }\nvoid main() { color = texture2D(uv); }",
                  coreVertex("330 core", "out vec2 uv;")),
    };
}
