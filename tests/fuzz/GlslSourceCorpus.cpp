// SPDX-License-Identifier: MIT
// GlslSourceCorpus <folder>: writes one file a shader text of the tests' samples.
#include "osgMultiRender/GlslSamples.h"

#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 2)
    {
        std::cerr << "GlslSourceCorpus: name the folder to write to\n";
        return 2;
    }
    for (const glslSamples::Sample& sample : glslSamples::fragmentSamples())
    {
        for (std::size_t i = 0; i < sample.fragments.size(); ++i)
        {
            const std::string name = std::string(argv[1]) + "/" + sample.name + std::to_string(i);
            // The first byte picks the target version, see GlslSourceFuzz.cpp.
            std::ofstream(name, std::ios::binary) << '\0' << sample.fragments[i];
        }
    }
    return 0;
}
