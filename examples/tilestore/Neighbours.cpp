// SPDX-License-Identifier: MIT
#include "Model.h"
#include "PhotoChoice.h"
#include "Subcommand.h"

#include <osgPagedTexture/MaskNames.h>
#include <osgPagedTexture/PhotoSeams.h>

#include <cstdio>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;

constexpr char Help[] =
    R"(osgtilestore neighbours MODEL [PHOTOGRAPH...]
Says which photographs adjoin each photograph, or those that are named, on the model, and how long
the seams are: in units of the model and in pixels of the photograph.

  --json   the same as JSON
  --help   this text
)";

/// Or what the model calls a picture that is inside of it.
std::string fileOf(const Photo& photo)
{
    return photo.file.empty() ? photo.name : photo.file;
}

int run(const Arguments& arguments)
{
    const auto& files = arguments.files(1, 1000000, "MODEL [PHOTOGRAPH...]");
    const ModelPhotos model = readModel(files[0], true);
    const std::vector<std::string> names = namesOfPhotos(model.photos);
    const auto neighbours = findNeighbours(model.photos, findSeams(model.photos));
    Json list = Json::array();
    for (std::size_t photo : choosePhotos(model.photos, names, {files.begin() + 1, files.end()}))
    {
        Json line{{"photograph", names[photo]},
                  {"file", fileOf(model.photos[photo])},
                  {"neighbours", Json::array()}};
        if (!arguments.isJson())
            std::printf("%s\n", names[photo].c_str());
        for (const PhotoNeighbour& each : neighbours[photo])
        {
            line["neighbours"].push_back({{"photograph", names[each.photo]},
                                          {"file", fileOf(model.photos[each.photo])},
                                          {"seamLength", each.length},
                                          {"seamPixels", each.pixels},
                                          {"edges", each.edges}});
            if (!arguments.isJson())
                std::printf("  %12g %10.0f pixels  %s\n", each.length, each.pixels,
                            names[each.photo].c_str());
        }
        list.push_back(line);
    }
    if (arguments.isJson())
        print({{"photographs", list}, {"left", leftOf(model)}});
    return 0;
}

} // namespace

const Subcommand NeighboursCommand{
    "neighbours", "which photographs adjoin, and how far", Help, {}, run};

} // namespace tilestore
