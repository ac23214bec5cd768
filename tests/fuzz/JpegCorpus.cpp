// SPDX-License-Identifier: MIT
// JpegCorpus <folder>: writes small JPEGs of each kind.
#include "osgPagedTexture/PictureFiles.h"

#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 2)
    {
        std::cerr << "JpegCorpus: name the folder to write to\n";
        return 2;
    }
    for (int variant = 0; variant < 24; ++variant)
    {
        JpegOptions options;
        options.progressive = variant & 1;
        options.fullChroma = variant & 2;
        options.cmyk = variant >= 8 && variant < 16;
        options.adobe = variant & 4;
        options.orientation = variant % 9;
        const auto picture = samplePicture(17 + variant, 23, variant < 16 ? 3 : 1, variant);
        std::ofstream(std::string(argv[1]) + "/" + std::to_string(variant) + ".jpg",
                      std::ios::binary)
            << encodeJpeg(picture, options);
    }
    return 0;
}
