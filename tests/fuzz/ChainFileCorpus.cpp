// SPDX-License-Identifier: MIT
// ChainFileCorpus <folder>: writes an entry of the disk cache for each format.
#include "fuzz/ChainFileText.h"
#include "osgPagedTexture/ChainSamples.h"

#include <fstream>
#include <iostream>

using namespace osgPagedTexture;

int main(int argc, char** argv)
{
    if (argc != 2)
    {
        std::cerr << "ChainFileCorpus: name the folder to write to\n";
        return 2;
    }
    for (int i = 0; i <= static_cast<int>(BlockFormat::BC7); ++i)
    {
        const auto format = static_cast<BlockFormat>(i);
        const std::string file = chainFileText({1, 2}, sampleChain(format, 9 + i, 6, i % 3));
        std::ofstream(std::string(argv[1]) + "/" + formatName(format), std::ios::binary)
            << '\0' << file;
    }
    std::ofstream(std::string(argv[1]) + "/damage", std::ios::binary) << "\x01\x04\x08\x05\x01text";
    return 0;
}
