// SPDX-License-Identifier: MIT
// Time of merging programs of 200 lines, on the CPU, without the driver's part.
#include <osgMultiRender/Merger.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

using namespace osgMultiRender;

namespace
{

constexpr char Vertex[] =
    R"(varying vec3 normal; varying vec3 eye; varying vec2 uv; uniform float scale;
void main()
{
    vec4 p = gl_ModelViewMatrix * gl_Vertex;
    eye = p.xyz;
    normal = gl_NormalMatrix * gl_Normal * scale;
    uv = gl_MultiTexCoord0.xy;
    gl_Position = gl_ProjectionMatrix * p;
}
)";

/// A fragment shader of about 190 lines: lights, noise, macros; `number` makes it differ.
std::string fragment(int number)
{
    std::string text = "#define OCTAVES 4\n#define SQUARE(x) ((x) * (x))\n"
                       "varying vec3 normal; varying vec3 eye; varying vec2 uv;\n"
                       "uniform vec3 color;\nuniform float power;\nuniform sampler2D map;\n"
                       "struct Light\n{\n    vec3 direction;\n    float power;\n};\n";
    for (int i = 0; i < 14; ++i)
    {
        const std::string id = std::to_string(i);
        const std::string value = std::to_string(i % 2 ? i : i + number * 14);
        text += "// Wave " + id + " of the surface.\nfloat wave" + id +
                "(vec2 at, float t)\n{\n"
                "    float sum = 0.0;\n    for (int i = 0; i < OCTAVES; ++i)\n    {\n"
                "        sum += sin(at.x * float(i) + t) * " +
                value +
                ".5;\n"
                "        at = at.yx * 1.5 + vec2(0.25, SQUARE(t));\n    }\n"
                "    return sum / SQUARE(float(OCTAVES));\n}\n\n";
    }
    text += "void main()\n{\n    Light light = Light(normalize(vec3(1.0, 2.0, 3.0)), power);\n"
            "    vec3 n = normalize(normal);\n    float h = 0.0;\n";
    for (int i = 0; i < 14; ++i)
    {
        text += "    h += wave" + std::to_string(i) + "(uv, light.power);\n";
    }
    return text +
           "    vec3 c = color * max(dot(n, light.direction), 0.0) + texture2D(map, uv).rgb;\n"
           "    if (h < -100.0)\n        discard;\n    gl_FragColor = vec4(c * h, 1.0);\n}\n";
}

} // namespace

int main()
{
    std::vector<Rendering> renderings(50);
    for (int i = 0; i < 50; ++i)
    {
        Rendering& one = renderings[static_cast<std::size_t>(i)];
        one.name = "program" + std::to_string(i);
        one.shaders = {{GlslStage::Vertex, Vertex, one.name + ".vert"},
                       {GlslStage::Fragment, fragment(i), one.name + ".frag"}};
    }
    const auto lines = std::count(renderings[0].shaders[1].text.begin(),
                                  renderings[0].shaders[1].text.end(), '\n') +
                       std::count(renderings[0].shaders[0].text.begin(),
                                  renderings[0].shaders[0].text.end(), '\n');
    std::printf(
        "programs of %ld lines\nprograms  best ms  median ms  shared functions  varying vectors\n",
        long(lines));
    for (std::size_t count : {1u, 2u, 5u, 10u, 20u, 50u})
    {
        std::vector<MergeEntry> entries;
        for (std::size_t i = 0; i < count; ++i)
        {
            entries.push_back({&renderings[i], 1.0});
        }
        MergeOptions options;
        options.limits.varyingVectors = options.limits.fragmentSamplers = 1000;
        std::vector<double> times;
        Merged merged;
        for (int run = 0; run < 25; ++run)
        {
            // Of the processor: other programs may run beside.
            const std::clock_t start = std::clock();
            merged = mergeRenderings(entries, options);
            times.push_back(1000.0 * double(std::clock() - start) / CLOCKS_PER_SEC);
        }
        std::sort(times.begin(), times.end());
        std::printf("%8zu %8.2f %10.2f %17zu %16d\n", count, times[0], times[times.size() / 2],
                    merged.statistics.sharedFunctions, merged.statistics.varyingVectors);
        if (!merged.ok)
        {
            return 1;
        }
    }
    return 0;
}
