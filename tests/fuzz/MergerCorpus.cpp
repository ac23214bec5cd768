// SPDX-License-Identifier: MIT
// MergerCorpus <folder>: writes one file a hard case of the tests, and a small project.
#include "osgMultiRender/MergeCases.h"

#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 2)
    {
        std::cerr << "MergerCorpus: name the folder to write to\n";
        return 2;
    }
    const std::string folder = argv[1];
    for (const osgMultiRender::Rendering& one : mergeCases())
    {
        // See MergerFuzz.cpp: options, then fragment and vertex texts of one or two renderings.
        std::ofstream file(folder + "/" + one.name, std::ios::binary);
        if (one.shaders[1].text.size() < 8192)
        {
            file << '\0' << one.shaders[1].text << '\xFF' << one.shaders[0].text << '\xFF'
                 << one.shaders[1].text;
        }
    }
    std::ofstream(folder + "/project", std::ios::binary)
        << "\x07<GLSLang><VPCount numero=\"1\"><Filenames><Filename0 VertexProgram=\"a.vert\"/>"
           "</Filenames></VPCount><FPCount numero=\"1\"><Filenames><Filename0 "
           "FragmentProgram=\"a.frag\"/></Filenames></FPCount><TexturedUsed NumberUsedTU=\"1\">"
           "<TextureUnit0 Filename=\"../wood.png\" MinFilter=\"9729\"/></TexturedUsed>"
           "<UniformVariables NumberOfVariables=\"2\"><Uniform0 Type=\"7\" Name=\"C\" "
           "ArraySize=\"1\" Min=\"0\" Max=\"1\"><Values Value0=\"0.6\"/></Uniform0>"
           "</UniformVariables><BuiltInStates><FrontMaterial DifR=\"0.5\" "
           "EmiR=\"1e20\"/><Light0 Enabled=\"True\" PosX=\"1\" DifR=\"1e25\"/>"
           "</BuiltInStates></GLSLang>";
    std::ofstream(folder + "/image", std::ios::binary)
        << "\x07void mainImage(out vec4 c, in vec2 at) { c = vec4(at / iResolution.xy, iTime, "
           "1.0); }";
    return 0;
}
