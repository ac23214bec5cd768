// SPDX-License-Identifier: MIT
// AtlasLayoutCorpus <folder>: writes layouts of a few photographs, of parts of them, and one that
// an update has left.
#include <osgPagedTexture/AtlasLayout.h>

#include <iostream>

using namespace osgPagedTexture;

int main(int argc, char** argv)
{
    if (argc != 2)
    {
        std::cerr << "AtlasLayoutCorpus: name the folder to write to\n";
        return 2;
    }
    const std::string folder = argv[1];
    std::vector<AtlasPhoto> photos;
    for (int i = 0; i < 3; ++i)
    {
        AtlasPhoto photo;
        photo.path = "photo" + std::to_string(i) + ".jpg";
        photo.width = 40 + 30 * i;
        photo.height = 60;
        photo.bytes = 1234;
        photo.hash = "00112233445566778899aabbccddeeff";
        photos.push_back(photo);
    }
    writeAtlasLayout(folder + "/whole", packAtlas(photos, AtlasSettings::forTiles(40, 4)));
    photos[1].used = {{16, 16, 32, 16}};
    AtlasLayout layout = packAtlas(photos, {});
    layout.photoFolder = "photos";
    layout.pending = {{0, 0, 8, 8}};
    layout.pendingSince = "0011";
    writeAtlasLayout(folder + "/parts", layout);
    return 0;
}
