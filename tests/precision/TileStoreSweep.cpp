// SPDX-License-Identifier: MIT
// Tile stores: what filter, format and quality cost and how far from the exact levels they are.
#include "../osgPagedTexture/AtlasReference.h"
#include "../osgPagedTexture/MosaicFile.h"

#include <precision/Sweep.h>

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/TileBuilder.h>
#include <osgPagedTexture/TileExtract.h>
#include <osgPagedTexture/TilePack.h>

#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>

#include <sys/resource.h>

namespace
{

using namespace precision;
using namespace osgPagedTexture;

constexpr int Side = 2048, CellSide = 512, Levels = 5;

double getProcessSeconds()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double getChildSeconds()
{
    rusage use{};
    getrusage(RUSAGE_CHILDREN, &use);
    return double(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
           1e-6 * double(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
}

/// A mosaic of photographs, its exact levels, and stores made of it.
class Mosaic
{
public:
    Mosaic()
    {
        writeMosaic(_folder.file("mosaic.ppm"), Side, CellSide);
        AtlasPhoto photo;
        photo.path = "mosaic.ppm";
        photo.width = photo.height = Side;
        _layout.width = _layout.height = Side;
        _layout.photos.push_back(photo);
        const std::vector<Pixels> pixels{readImageFile(_folder.file("mosaic.ppm")).pixels};
        LightPicture level = paintReference(_layout, pixels, 3, {255, 255, 255, 255});
        for (int i = 0; i < Levels; ++i, level = halveReference(level))
        {
            _exact.emplace_back();
            for (int y = 0; y < level.height; ++y)
                for (int x = 0; x < level.width; ++x)
                {
                    const auto code = level.code(x, y);
                    for (int c = 0; c < 3; ++c)
                        _exact.back().push_back(float(code[c]));
                }
        }
    }

    Outcome build(const std::string& name, const TileBuildSettings& settings)
    {
        const std::string path = _folder.file("store");
        Outcome outcome;
        const double start = getProcessSeconds();
        {
            TileBuilder builder(_layout, _folder.getPath().string(), settings);
            TileStoreSettings store;
            store.grid = builder.getGrid();
            store.format = settings.format.extension();
            TilePackWriter::Options options;
            options.durable = false;
            TilePackWriter writer(path, store, options);
            builder.build(writer, nullptr);
            writer.commit();
        }
        outcome.seconds = getProcessSeconds() - start;
        outcome.number = errorOf(name, path);
        return outcome;
    }

    Outcome dzsave(const std::string& name, int quality)
    {
        std::filesystem::remove_all(_folder.file("vips_files"));
        support::ChildProcess vips;
        vips.arguments = {"vips",
                          "dzsave",
                          _folder.file("mosaic.ppm"),
                          _folder.file("vips"),
                          "--suffix",
                          ".jpg[subsample_mode=on,Q=" + std::to_string(quality) + "]",
                          "--tile-size",
                          "256",
                          "--overlap",
                          "0"};
        vips.environment["VIPS_CONCURRENCY"] = "1";
        Outcome outcome;
        const double start = getChildSeconds();
        if (vips.run().exitCode != 0)
            throw std::runtime_error("vips dzsave failed; is libvips-tools installed?");
        outcome.seconds = getChildSeconds() - start;
        outcome.number = errorOf(name, _folder.file("vips.dzi"));
        return outcome;
    }

private:
    /// Root of the mean square over all levels, each counting alike; measured once for each name.
    double errorOf(const std::string& name, const std::string& store)
    {
        const auto known = _errors.find(name);
        if (known != _errors.end())
            return known->second;
        const auto reader = openTileStore(store);
        double sum = 0.0;
        for (int level = 0; level < Levels; ++level)
        {
            const float* exact = _exact[std::size_t(level)].data();
            const int side = Side >> level;
            double square = 0.0;
            readRegion(*reader, level, {0, 0, side, side}, {},
                       [&](const std::uint8_t* row)
                       {
                           for (int i = 0; i < 3 * side; ++i, ++exact)
                               square += (row[i] - *exact) * (row[i] - *exact);
                       });
            sum += square / (3.0 * side * side);
        }
        return _errors[name] = std::sqrt(sum / Levels);
    }

    support::TemporaryFolder _folder;
    AtlasLayout _layout;
    std::vector<std::vector<float>> _exact; ///< Code values by level, rows from the top.
    std::map<std::string, double> _errors;
};

TileBuildSettings settingsOf(TileCoding coding, bool linearLight,
                             ChromaSampling chroma = ChromaSampling::Quarter)
{
    TileBuildSettings settings;
    settings.border = 0;
    settings.threads = 1;
    settings.linearLight = linearLight;
    settings.format.coding = coding;
    settings.format.chroma = chroma;
    return settings;
}

using Change = std::function<void(TileBuildSettings& settings, int value)>;

Method oursWith(const std::shared_ptr<Mosaic>& mosaic, const std::string& name,
                const std::string& knob, std::vector<double> values,
                const TileBuildSettings& settings, const Change& change)
{
    return {name, knob, std::move(values),
            [=](double value)
            {
                TileBuildSettings changed = settings;
                change(changed, int(value));
                return mosaic->build(name + std::to_string(int(value)), changed);
            }};
}

Sweep makeSweep()
{
    const auto mosaic = std::make_shared<Mosaic>();
    const std::vector<double> qualities{50, 65, 75, 85, 92, 97};
    const Change quality = [](TileBuildSettings& settings, int value)
    { settings.format.quality = value; };
    const Change compression = [](TileBuildSettings& settings, int value)
    { settings.format.compression = value; };
    const Change blocks = [](TileBuildSettings& settings, int value)
    { settings.format.blocks = EncodeQuality(value); };
    const auto jpeg = [&](const std::string& name, bool linear, ChromaSampling chroma)
    {
        return oursWith(mosaic, name, "quality", qualities,
                        settingsOf(TileCoding::Jpeg, linear, chroma), quality);
    };
    Sweep sweep;
    sweep.name = "tile-stores";
    sweep.title = "Tile stores of 2048x2048 pixels, five levels against exact ones";
    sweep.errorName = "error [RMS, 1/255]";
    sweep.getError = [](const Outcome& outcome, const Outcome&) { return outcome.number; };
    sweep.renderer = "one CPU thread";
    sweep.methods = {jpeg("JPEG 4:2:0, light", true, ChromaSampling::Quarter),
                     jpeg("JPEG 4:2:0, code values", false, ChromaSampling::Quarter),
                     jpeg("JPEG 4:4:4, light", true, ChromaSampling::Full),
                     oursWith(mosaic, "PNG, light", "compression", {1, 6},
                              settingsOf(TileCoding::Png, true), compression),
                     oursWith(mosaic, "PNG, code values", "compression", {1},
                              settingsOf(TileCoding::Png, false), compression),
                     oursWith(mosaic, "BC1, light", "quality", {0, 1, 2},
                              settingsOf(TileCoding::Bc1, true), blocks),
                     oursWith(mosaic, "BC7, light", "quality", {0, 1, 2},
                              settingsOf(TileCoding::Bc7, true), blocks),
                     {"vips dzsave 4:2:0", "Q", qualities, [=](double value) {
                          return mosaic->dzsave("vips" + std::to_string(int(value)), int(value));
                      }}};
    return sweep;
}

const Registration tileStores("tile-stores", makeSweep);

} // namespace
