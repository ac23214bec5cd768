// SPDX-License-Identifier: MIT
// GlslPairCorpus <folder>: writes the hard cases of the tests as pairs with side files.
#include "osgMultiRender/MergeCases.h"

#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 2)
    {
        std::cerr << "GlslPairCorpus: name the folder to write to\n";
        return 2;
    }
    const std::string folder = argv[1];
    for (const osgMultiRender::Rendering& one : mergeCases())
    {
        if (one.shaders.size() < 2 || one.shaders[1].text.size() > 8192)
        {
            continue;
        }
        std::ofstream file(folder + "/" + one.name, std::ios::binary);
        file << one.shaders[0].text << '\xFF' << one.shaders[1].text << '\xFF';
        for (const osgMultiRender::RenderingUniform& uniform : one.uniforms)
        {
            file << uniform.name << " = 0.5, 1e-3 [0, 2]\n";
        }
    }
    std::ofstream(folder + "/side", std::ios::binary)
        << "void main() { gl_Position = ftransform(); }\xFF"
           "uniform vec3 color; // = 1, 0.5, 0 min 0 max 1\n"
           "uniform sampler2D wood; // = \"wood.png\"\n"
           "uniform float gloss = 40.0; /* = 40 [1, 200] */\n"
           "void main() { gl_FragColor = vec4(color * gloss, 1.0) * texture2D(wood, vec2(0.5)); }"
           "\xFF# a comment\ncolor = 0.2 0.3 0.4\nwood = \"other.png\"\nno value\ngloss = nan\n";
    return 0;
}
