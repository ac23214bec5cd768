// SPDX-License-Identifier: MIT
#include "Model.h"
#include "Progress.h"
#include "Subcommand.h"

#include <osgPagedTexture/MaskNames.h>
#include <osgPagedTexture/PhotoMask.h>
#include <osgPagedTexture/PictureFile.h>

#include <cstdio>
#include <filesystem>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;

constexpr char Help[] =
    R"(osgtilestore mask MODEL
Writes a mask for each photograph that a model shows: a picture of the same size, white where a
triangle uses the photograph, black elsewhere. MODEL is of any format that OSG reads. Masks are
drawn with OpenGL, without a window. They are named as their photographs, with the folder where two
have one name.

  --output FOLDER   where masks go; default: masks, beside the model
  --conservative    every pixel that a triangle touches is white; else those whose middle it covers
  --margin N        white grows by N pixels to all sides, 0 to 65536; default 0
  --piece N         what is drawn at once is N pixels wide at most; default: what the GPU can
  --json            photographs, their masks and shares as JSON
  --help            this text
)";

MaskSettings settingsOf(const Arguments& arguments)
{
    MaskSettings settings;
    settings.conservative = arguments.has("--conservative");
    settings.margin = int(arguments.number("--margin", 0, 0, 65536));
    settings.largestPiece = int(arguments.number("--piece", 0, 0, 65536));
    return settings;
}

Json describe(const Photo& photo, const std::string& file, const PhotoMask& mask)
{
    Json json{{"photograph", photo.file.empty() ? photo.name : photo.file},
              {"mask", file},
              {"width", photo.width},
              {"height", photo.height},
              {"usedShare", mask.usedShare}};
    if (mask.skipped > 0)
        json["skippedTriangles"] = mask.skipped;
    if (mask.whole > 0)
        json["wholeTriangles"] = mask.whole;
    return json;
}

void printLine(const Photo& photo, const std::string& file, const PhotoMask& mask)
{
    std::printf("%6.2f %%  %d x %d  %s", 100.0 * mask.usedShare, photo.width, photo.height,
                file.c_str());
    if (mask.skipped > 0)
        std::printf("  (%s triangles without finite coordinates)", grouped(mask.skipped).c_str());
    std::printf("\n");
}

int run(const Arguments& arguments)
{
    const std::string path = arguments.files(1, 1, "MODEL")[0];
    const MaskSettings settings = settingsOf(arguments);
    const std::filesystem::path standard = std::filesystem::path(path).parent_path() / "masks";
    const std::filesystem::path folder = arguments.get("--output", standard.string());
    const ModelPhotos model = readModel(path);
    Json list = Json::array();
    if (!model.photos.empty())
    {
        const osg::ref_ptr<osg::GraphicsContext> context = makeOffscreenContext();
        MaskRenderer renderer(*context);
        const std::vector<std::string> names = namesOfPhotos(model.photos);
        Progress progress("masks", "photographs");
        for (std::size_t i = 0; i < model.photos.size(); ++i)
        {
            progress.show(i, model.photos.size());
            const std::string file = (folder / (names[i] + ".png")).string();
            const PhotoMask mask = renderer.render(model.photos[i], settings);
            writePictureFile(file, mask.pixels);
            list.push_back(describe(model.photos[i], file, mask));
            if (!arguments.isJson())
                printLine(model.photos[i], file, mask);
        }
    }
    if (arguments.isJson())
        print({{"masks", list}, {"left", leftOf(model)}});
    return 0;
}

} // namespace

const Subcommand MaskCommand{"mask",
                             "what of each photograph a model shows",
                             Help,
                             {{"--output"}, {"--conservative", false}, {"--margin"}, {"--piece"}},
                             run};

} // namespace tilestore
