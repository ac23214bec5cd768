// SPDX-License-Identifier: MIT
#include "osgMultiRender/MergeCases.h"

using namespace osgMultiRender;

namespace
{

constexpr char Vertex[] = R"(varying vec3 n; varying vec2 uv; varying vec3 eye;
void main()
{
    n = normalize(gl_NormalMatrix * gl_Normal);
    uv = gl_MultiTexCoord0.xy;
    eye = vec3(gl_ModelViewMatrix * gl_Vertex);
    gl_FrontColor = gl_Color;
    gl_TexCoord[0] = gl_MultiTexCoord0;
    gl_Position = ftransform();
}
)";

constexpr char Partner[] = R"(
#define SCALE 3.0
#define MIX(a, b) mix(a, b, 0.25)
varying vec3 n; varying vec2 uv; varying vec3 eye;
uniform vec3 tint;
uniform float k;
struct Light { vec3 direction; float power; };
const float PI = 3.14159265;
float wave = 0.5;
vec3 x_0 = vec3(0.25), x_1 = vec3(0.125);
vec3 shade(vec3 normal, Light light) { return max(dot(normal, light.direction), 0.0) * light.power * tint; }
float shade(float x) { return 0.5 + 0.5 * sin(x * PI); }
void main()
{
    Light light = Light(normalize(vec3(1.0, 2.0, 3.0)), 0.8);
    wave += 0.25 * shade(uv.x * SCALE);
    vec3 color = shade(normalize(n), light) * wave + x_0 + x_1 * k;
    gl_FragColor = vec4(MIX(color, vec3(0.5, 0.25, 1.0)), 1.0);
}
)";

std::vector<Rendering> all()
{
    std::vector<Rendering> cases;
    for (const auto& some :
         {outputCases(), nameCases(), macroCases(), interfaceCases(), versionCases()})
    {
        cases.insert(cases.end(), some.begin(), some.end());
    }
    return cases;
}

} // namespace

Rendering mergeCase(const char* name, const std::string& fragment, const std::string& vertex)
{
    Rendering rendering;
    rendering.name = name;
    const std::string stem = name;
    rendering.shaders.push_back(
        {GlslStage::Vertex, vertex.empty() ? Vertex : vertex, stem + ".vert"});
    rendering.shaders.push_back({GlslStage::Fragment, fragment, stem + ".frag"});
    return rendering;
}

const std::vector<Rendering>& mergeCases()
{
    static const std::vector<Rendering> cases = all();
    return cases;
}

const Rendering& mergePartner()
{
    static const Rendering partner = mergeCase("partner", Partner);
    return partner;
}
