// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileExtract.h>

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/OiioModule.h>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

using Kind = TileStoreError::Kind;

[[noreturn]] void fail(Kind kind, const std::string& what)
{
    throw TileStoreError(kind, "osgPagedTexture::TileStore: " + what);
}

/// Spreads a pixel of 1 to 4 channels to red, green, blue and alpha.
TileColor colorOf(const std::uint8_t* pixel, int channels)
{
    const bool grey = channels < 3;
    const std::uint8_t alpha = channels == 2 ? pixel[1] : channels == 4 ? pixel[3] : 255;
    return {pixel[0], pixel[grey ? 0 : 1], pixel[grey ? 0 : 2], alpha};
}

/// The rows of a region that lie in one row of tiles.
class Band
{
public:
    Band(const TileReader& reader, int level, const PixelRect& area,
         const ExtractSettings& settings)
        : _reader(reader), _level(level), _area(area), _settings(settings),
          _bytes(std::size_t(area.width) * std::size_t(area.height) * settings.channels)
    {
    }

    void add(const TileKey& key)
    {
        const TileGrid& grid = _reader.getSettings().grid;
        const PixelRect whole = grid.getPixels(key);
        const PixelRect payload = grid.getPayloadPixels(key);
        const TileData tile = _reader.read(key);
        Pixels pixels;
        if (tile.kind == TileData::Kind::Encoded)
        {
            const std::string name = "tile " + std::to_string(key.x) + ", " +
                                     std::to_string(key.y) + " of level " + std::to_string(_level);
            pixels = decodeTile(tile.bytes, name);
            if (pixels.width != whole.width || pixels.height != whole.height)
            {
                fail(Kind::Damaged, name + " has " + std::to_string(pixels.width) + " x " +
                                        std::to_string(pixels.height) + " pixels instead of " +
                                        std::to_string(whole.width) + " x " +
                                        std::to_string(whole.height) + "; build the store anew");
            }
        }
        const TileColor flat =
            tile.kind == TileData::Kind::Uniform ? tile.color : _settings.background;
        const std::int64_t left = std::max(payload.x, _area.x);
        const std::int64_t right = std::min(payload.x + payload.width, _area.x + _area.width);
        for (std::int64_t y = _area.y; y < _area.y + _area.height; ++y)
        {
            const std::uint8_t* from =
                pixels.empty() ? nullptr : pixels.row(int(whole.y + whole.height - 1 - y));
            std::uint8_t* to = row(y) + (left - _area.x) * _settings.channels;
            for (std::int64_t x = left; x < right; ++x, to += _settings.channels)
            {
                const TileColor color =
                    from ? colorOf(from + (x - whole.x) * pixels.channels, pixels.channels) : flat;
                std::copy_n(color.begin(), _settings.channels, to);
            }
        }
    }

    std::uint8_t* row(std::int64_t y)
    {
        return _bytes.data() + std::size_t(y - _area.y) * _area.width * _settings.channels;
    }

private:
    const TileReader& _reader;
    const int _level;
    const PixelRect _area;
    const ExtractSettings& _settings;
    std::vector<std::uint8_t> _bytes;
};

/// What of a region lies on a level.
PixelRect cut(const TileGrid& grid, int level, const PixelRect& region)
{
    if (level < 0 || level >= grid.getLevels())
    {
        fail(Kind::Refused, "there is no level " + std::to_string(level) + "; name one from 0 to " +
                                std::to_string(grid.getLevels() - 1));
    }
    // Sums of the caller's numbers must not overflow.
    const auto clamp = [](std::int64_t value)
    { return std::clamp(value, -2 * TileGrid::MaxSide, 2 * TileGrid::MaxSide); };
    const std::int64_t x = std::max<std::int64_t>(clamp(region.x), 0);
    const std::int64_t y = std::max<std::int64_t>(clamp(region.y), 0);
    const std::int64_t right =
        std::min(clamp(region.x) + clamp(region.width), grid.getWidth(level));
    const std::int64_t bottom =
        std::min(clamp(region.y) + clamp(region.height), grid.getHeight(level));
    if (right <= x || bottom <= y)
    {
        fail(Kind::Refused, "the region holds nothing of level " + std::to_string(level) +
                                "; name one within " + std::to_string(grid.getWidth(level)) +
                                " x " + std::to_string(grid.getHeight(level)) + " pixels");
    }
    return {x, y, right - x, bottom - y};
}

} // namespace

void readRegion(const TileReader& reader, int level, const PixelRect& region,
                const ExtractSettings& settings,
                const std::function<void(const std::uint8_t* row)>& sink)
{
    const TileGrid& grid = reader.getSettings().grid;
    const PixelRect area = cut(grid, level, region);
    const std::int64_t payload = grid.getPayload();
    const std::int64_t bottom = area.y + area.height;
    for (std::int64_t y = area.y / payload; y * payload < bottom; ++y)
    {
        const std::int64_t top = std::max(area.y, y * payload);
        const PixelRect rows{area.x, top, area.width, std::min(bottom, (y + 1) * payload) - top};
        Band band(reader, level, rows, settings);
        for (std::int64_t x = area.x / payload; x * payload < area.x + area.width; ++x)
        {
            band.add({level, x, y});
        }
        for (std::int64_t row = rows.y; row < rows.y + rows.height; ++row)
        {
            sink(band.row(row));
        }
    }
}

namespace
{

std::unique_ptr<PictureWriter> openPicture(const std::string& path, int width, int height,
                                           int channels)
{
    try
    {
        return oiioFunctions().openWriter(path, width, height, channels);
    }
    catch (const ImageError& error) // the module is not there
    {
        throw TileStoreError(Kind::Unwritable, error.what());
    }
}

} // namespace

void extractRegion(const TileReader& reader, int level, const PixelRect& region,
                   const ExtractSettings& settings, const std::string& path)
{
    const PixelRect area = cut(reader.getSettings().grid, level, region);
    if (area.width > INT32_MAX || area.height > INT32_MAX)
    {
        fail(Kind::Refused, "a picture of " + std::to_string(area.width) + " x " +
                                std::to_string(area.height) +
                                " pixels is too large; name a smaller region");
    }
    const auto picture = openPicture(path, int(area.width), int(area.height), settings.channels);
    readRegion(reader, level, area, settings,
               [&](const std::uint8_t* row) { picture->write(row); });
    picture->finish();
}

} // namespace osgPagedTexture
