// SPDX-License-Identifier: MIT
#include "Model.h"
#include "Progress.h"
#include "Subcommand.h"

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/PhotoMask.h>
#include <osgPagedTexture/UsedParts.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;

constexpr char Help[] =
    R"(osgtilestore layout MODEL LAYOUT
Lays the photographs that a model shows out in one atlas and writes the layout's file, from which
`build` makes the store and `atlas` the model's coordinates.

  --tight          only the parts that the model shows, each with a place of its own
  --flat           what the model does not show of them becomes the background, in blocks of 16
                   pixels, so that the store gets smaller
  --margin N       with --tight and --flat: pixels around what is shown, 0 to 4096; default 16
  --tile-side N    of the store that will be built, with borders; default 256
  --border N       of its tiles; default 8
  --padding N      pixels around photographs that repeat their edge; default 12
  --json           what was laid out as JSON
  --help           this text
)";

std::string relativeTo(const std::filesystem::path& layout, const std::string& file)
{
    std::error_code failure;
    const std::filesystem::path folder =
        std::filesystem::weakly_canonical(std::filesystem::absolute(layout), failure).parent_path();
    return std::filesystem::path(file).lexically_relative(folder).generic_string();
}

/// Which parts of photographs have places, and what of them is not flat.
struct Parts
{
    bool tight = false, flat = false;
    int margin = 16;
};

/// A photograph's places.
std::vector<AtlasPhoto> placesOf(AtlasPhoto photo, const Pixels& mask, const Parts& wanted)
{
    const std::vector<PixelRect> blocks =
        wanted.flat ? findUsedBlocks(mask) : std::vector<PixelRect>();
    std::vector<AtlasPhoto> places;
    if (!wanted.tight)
    {
        photo.used = blocks;
        if (!blocks.empty())
            places.push_back(photo);
        return places;
    }
    for (const PixelRect& part : findUsedParts(mask))
    {
        photo.used.clear();
        for (const PixelRect& block : blocks) // each is in one part as a whole
            if (block.x >= part.x && block.x < part.x + part.width && block.y >= part.y &&
                block.y < part.y + part.height)
                photo.used.push_back(block);
        if (blocks.empty())
            photo.used = {part};
        places.push_back(photo);
    }
    return places;
}

std::vector<AtlasPhoto> partsOf(const ModelPhotos& model, const std::string& layout,
                                const Parts& wanted)
{
    osg::ref_ptr<osg::GraphicsContext> context;
    std::unique_ptr<MaskRenderer> renderer;
    if ((wanted.tight || wanted.flat) && !model.photos.empty())
    {
        context = makeOffscreenContext();
        renderer = std::make_unique<MaskRenderer>(*context);
    }
    MaskSettings masks;
    masks.conservative = true;
    masks.margin = wanted.margin;
    const std::string folder = std::filesystem::absolute(layout).parent_path().string();
    std::vector<AtlasPhoto> parts;
    Progress progress("layout", "photographs");
    for (std::size_t i = 0; i < model.photos.size(); ++i)
    {
        progress.show(i, model.photos.size());
        const Photo& photo = model.photos[i];
        AtlasPhoto part = describePhoto(folder, relativeTo(layout, photo.file));
        if (!renderer)
        {
            parts.push_back(part);
            continue;
        }
        for (const AtlasPhoto& place :
             placesOf(part, renderer->render(photo, masks).pixels, wanted))
            parts.push_back(place);
    }
    return parts;
}

int run(const Arguments& arguments)
{
    const auto& files = arguments.files(2, 2, "MODEL LAYOUT");
    const int side = int(arguments.number("--tile-side", 256, 16, 4096));
    const int border = int(arguments.number("--border", 8, 0, (side - 1) / 2));
    AtlasSettings settings = AtlasSettings::forTiles(side, border);
    settings.padding = int(arguments.number("--padding", settings.padding, 0, 65536));
    const ModelPhotos model = readModel(files[0]);
    requireFiles(model, files[0]);
    const Parts wanted{arguments.has("--tight"), arguments.has("--flat"),
                       int(arguments.number("--margin", 16, 0, 4096))};
    const AtlasLayout layout = packAtlas(partsOf(model, files[1], wanted), settings);
    writeAtlasLayout(files[1], layout);
    double pixels = 0.0, placed = 0.0;
    for (const Photo& photo : model.photos)
        pixels += double(photo.width) * photo.height;
    for (const AtlasPhoto& photo : layout.photos)
        placed += double(photo.getPlace().width) * double(photo.getPlace().height);
    if (arguments.isJson())
        print({{"layout", files[1]},
               {"width", layout.width},
               {"height", layout.height},
               {"photographs", model.photos.size()},
               {"places", layout.photos.size()},
               {"placedPixels", placed},
               {"photographPixels", pixels}});
    else
        std::printf("%s: %s x %s pixels, %s places for %s photographs, %.1f %% of their pixels\n",
                    files[1].c_str(), grouped(std::uint64_t(layout.width)).c_str(),
                    grouped(std::uint64_t(layout.height)).c_str(),
                    grouped(layout.photos.size()).c_str(), grouped(model.photos.size()).c_str(),
                    pixels > 0.0 ? 100.0 * placed / pixels : 0.0);
    return 0;
}

} // namespace

const Subcommand LayoutCommand{"layout",
                               "an atlas of the photographs that a model shows",
                               Help,
                               {{"--tight", false},
                                {"--flat", false},
                                {"--margin"},
                                {"--tile-side"},
                                {"--border"},
                                {"--padding"}},
                               run};

} // namespace tilestore
