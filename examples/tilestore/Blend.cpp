// SPDX-License-Identifier: MIT
#include "Model.h"
#include "Progress.h"
#include "Subcommand.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/MaskNames.h>
#include <osgPagedTexture/PhotoMask.h>
#include <osgPagedTexture/PictureFile.h>
#include <osgPagedTexture/SeamBlend.h>

#include <cstdio>
#include <filesystem>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;

constexpr char Help[] =
    R"(osgtilestore blend MODEL
Takes the steps of colour out of a model where photographs adjoin: writes copies of the photographs,
to which a smooth correction is added in what the model shows of them. Their gradients stay, and at
seams both sides become equal (Poisson editing of all photographs at once). Copies have 8 bits a
channel. Says the mean step at the seams before and after, in steps of 0 to 255.

  --output FOLDER   where copies go; default: blended, beside the model
  --format F        of the copies: same as the photographs (default), or jpg, png, tif
  --quality N       of jpg, 1 to 100; default 95
  --cell N          pixels between values of the correction: 1, 2, 4 ... 256; default: 4, or more
                    where that were over a million values
  --iterations N    of the solver on the finest grid at most; default 200
  --error E         share of the equations' right side that may be left, 1 in E; default 10000
  --json            what was done as JSON
  --help            this text
)";

BlendSettings settingsOf(const Arguments& arguments)
{
    BlendSettings settings;
    settings.cell = int(arguments.number("--cell", 0, 0, 256));
    if ((settings.cell & (settings.cell - 1)) != 0)
        throw UsageError("--cell needs a power of two");
    settings.iterations = int(arguments.number("--iterations", 200, 1, 1000000));
    settings.error = 1.0 / double(arguments.number("--error", 10000, 1, 1000000000000));
    return settings;
}

/// The copy's name: that of the photograph, below the folder.
std::string copyOf(const Photo& photo, const std::string& name, const std::string& folder,
                   const std::string& format)
{
    const std::filesystem::path file(photo.file);
    const std::string extension = format == "same" ? file.extension().string() : "." + format;
    const bool ends = std::filesystem::path(name).extension() == file.extension();
    const std::string stem =
        ends ? name.substr(0, name.size() - file.extension().string().size()) : name;
    return folder + "/" + stem + extension;
}

Json describe(const BlendReport& report)
{
    return {{"cell", report.cell},
            {"values", report.values},
            {"iterations", report.iterations},
            {"residual", report.residual},
            {"solveSeconds", report.solveSeconds}};
}

struct Options
{
    std::string folder, format;
    int quality = 95;
    BlendSettings settings;
};

Options optionsOf(const Arguments& arguments, const std::string& model)
{
    Options options;
    options.settings = settingsOf(arguments);
    options.format = arguments.get("--format", "same");
    if (options.format != "same" && options.format != "jpg" && options.format != "png" &&
        options.format != "tif")
        throw UsageError("--format needs same, jpg, png or tif, not '" + options.format + "'");
    options.quality = int(arguments.number("--quality", 95, 1, 100));
    options.folder = arguments.get(
        "--output", (std::filesystem::path(model).parent_path() / "blended").string());
    return options;
}

void readSeams(const std::vector<Photo>& photos, std::vector<SeamSample>& samples)
{
    Progress progress("seams", "photographs");
    for (std::size_t i = 0; i < photos.size(); ++i)
    {
        progress.show(i, photos.size());
        readSamples(samples, i, readImageFile(photos[i].file).pixels);
    }
}

/// Samples get the colours of the copies as they are in the files: JPEG changes them a little.
Json writeCopies(const std::vector<Photo>& photos, const SeamBlend& blend, const Options& options,
                 std::vector<SeamSample>& samples)
{
    const std::vector<std::string> names = namesOfPhotos(photos);
    Json copies = Json::array();
    Progress progress("copies", "photographs");
    for (std::size_t i = 0; i < photos.size(); ++i)
    {
        progress.show(i, photos.size());
        Pixels pixels = readImageFile(photos[i].file).pixels;
        blend.apply(i, pixels);
        const std::string file = copyOf(photos[i], names[i], options.folder, options.format);
        writePictureFile(file, pixels, options.quality);
        readSamples(samples, i, readImageFile(file).pixels);
        copies.push_back({{"photograph", photos[i].file}, {"copy", file}});
    }
    return copies;
}

int run(const Arguments& arguments)
{
    const std::string path = arguments.files(1, 1, "MODEL")[0];
    const Options options = optionsOf(arguments, path);
    const ModelPhotos model = readModel(path, true);
    requireFiles(model, path);
    std::vector<SeamSample> samples = sampleSeams(model.photos, findSeams(model.photos));
    readSeams(model.photos, samples);
    const double before = meanSeamStep(samples);
    const osg::ref_ptr<osg::GraphicsContext> context = makeOffscreenContext();
    MaskRenderer renderer(*context);
    MaskSettings masks;
    masks.conservative = true;
    masks.margin = 2; // What bilinear lookups at the edge of the mask see.
    SeamBlend blend(model.photos, samples,
                    [&](std::size_t i) { return renderer.render(model.photos[i], masks).pixels; });
    const BlendReport report = blend.solve(options.settings);
    const Json copies = writeCopies(model.photos, blend, options, samples);
    const double after = meanSeamStep(samples);
    if (arguments.isJson())
        print({{"meanStepBefore", before},
               {"meanStepAfter", after},
               {"solution", describe(report)},
               {"copies", copies}});
    else
        std::printf("%s photographs in %s; mean step at seams %.3f before, %.3f after\n"
                    "%s values %d pixels apart, %d iterations, %.2f s\n",
                    grouped(copies.size()).c_str(), options.folder.c_str(), before, after,
                    grouped(report.values).c_str(), report.cell, report.iterations,
                    report.solveSeconds);
    return 0;
}

} // namespace

const Subcommand BlendCommand{
    "blend",
    "copies of photographs without steps of colour at seams",
    Help,
    {{"--output"}, {"--format"}, {"--quality"}, {"--cell"}, {"--iterations"}, {"--error"}},
    run};

} // namespace tilestore
