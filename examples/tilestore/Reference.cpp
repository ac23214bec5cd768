// SPDX-License-Identifier: MIT
#include "Model.h"
#include "PhotoChoice.h"
#include "Progress.h"
#include "Subcommand.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/MaskNames.h>
#include <osgPagedTexture/PhotoWarp.h>
#include <osgPagedTexture/PictureFile.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;

constexpr char Help[] =
    R"(osgtilestore reference MODEL PHOTOGRAPH...
Writes, for each photograph that is named, a picture of its size in layers: the photograph, and
above it each neighbour as the photograph's camera would see it. So the artist edits it with the
neighbours at hand. The camera is found from the model's own coordinates; where they are no view of
a camera, what fits best along the seam takes its place, and a line says so.

  --output FOLDER   default: reference, beside the model. NAME.tif has the layers as pages; the
                    same as one PNG a layer are in the folder NAME
  --most N          neighbours at most, those with the longest seams; default 16
  --json            what was written as JSON
  --help            this text
)";

const char* nameOf(PhotoCamera::Kind kind)
{
    return kind == PhotoCamera::Kind::Perspective ? "perspective"
           : kind == PhotoCamera::Kind::Plane     ? "plane"
                                                  : "affine";
}

/// What all photographs need.
struct Surroundings
{
    const ModelPhotos& model;
    const std::vector<std::string> names = namesOfPhotos(model.photos);
    const std::vector<PhotoSeam> seams = findSeams(model.photos);
    const std::vector<std::vector<PhotoNeighbour>> neighbours = findNeighbours(model.photos, seams);
};

Json makeReference(const Surroundings& all, std::size_t photo, const std::string& folder,
                   std::size_t most)
{
    const Photo& own = all.model.photos[photo];
    const PhotoCamera camera = fitCamera(pointsOf(own));
    Json json{{"photograph", all.names[photo]},
              {"camera", nameOf(camera.kind)},
              {"cameraErrorPixels", camera.error},
              {"layers", Json::array()}};
    std::vector<PictureLayer> layers{{all.names[photo], readImageFile(own.file).pixels}};
    for (std::size_t i = 0; i < std::min(most, all.neighbours[photo].size()); ++i)
    {
        const std::size_t other = all.neighbours[photo][i].photo;
        const PhotoCamera along =
            camera.kind != PhotoCamera::Kind::Affine
                ? camera
                : fitCamera(seamPointsOf(all.model.photos, all.seams, photo, other));
        layers.push_back(
            {all.names[other],
             warpPhoto(all.model.photos[other], readImageFile(all.model.photos[other].file).pixels,
                       along, own.width, own.height)});
    }
    for (std::size_t i = 0; i < layers.size(); ++i)
    {
        const std::string file = folder + "/" + all.names[photo] + "/" + std::to_string(i) + "-" +
                                 std::filesystem::path(layers[i].name).filename().string() + ".png";
        writePictureFile(file, layers[i].pixels);
        json["layers"].push_back({{"name", layers[i].name}, {"file", file}});
    }
    const std::string file = folder + "/" + all.names[photo] + ".tif";
    writeLayers(file, layers);
    json["file"] = file;
    return json;
}

int run(const Arguments& arguments)
{
    const auto& files = arguments.files(2, 1000000, "MODEL PHOTOGRAPH...");
    const auto most = std::size_t(arguments.number("--most", 16, 1, 1000));
    const std::filesystem::path standard =
        std::filesystem::path(files[0]).parent_path() / "reference";
    const std::string folder = arguments.get("--output", standard.string());
    const ModelPhotos model = readModel(files[0], true);
    requireFiles(model, files[0]);
    const Surroundings all{model};
    const auto chosen = choosePhotos(model.photos, all.names, {files.begin() + 1, files.end()});
    Json list = Json::array();
    Progress progress("references", "photographs");
    for (std::size_t i = 0; i < chosen.size(); ++i)
    {
        progress.show(i, chosen.size());
        list.push_back(makeReference(all, chosen[i], folder, most));
        if (!arguments.isJson())
            std::printf("%s: %zu neighbours, camera: %s, off by %.2f pixels\n",
                        list.back()["file"].get<std::string>().c_str(),
                        list.back()["layers"].size() - 1,
                        list.back()["camera"].get<std::string>().c_str(),
                        list.back()["cameraErrorPixels"].get<double>());
    }
    if (arguments.isJson())
        print({{"references", list}});
    return 0;
}

} // namespace

const Subcommand ReferenceCommand{"reference",
                                  "a photograph in layers with its neighbours",
                                  Help,
                                  {{"--output"}, {"--most"}},
                                  run};

} // namespace tilestore
