// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileExtract.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/JpegFile.h>

#include <algorithm>
#include <filesystem>

namespace osgPagedTexture
{

namespace
{

using Kind = TileStoreError::Kind;

[[noreturn]] void fail(Kind kind, const std::string& what)
{
    throw TileStoreError(kind, "osgPagedTexture::TileStore: " + what);
}

std::string oneLine(const std::string& text)
{
    return OIIO::Strutil::replace(OIIO::Strutil::strip(text), "\n", " ", true);
}

Pixels decodeByOiio(const std::string& bytes, const std::string& name)
{
    const bool dds = bytes.compare(0, 4, "DDS ") == 0;
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::create(dds ? "dds" : "png");
    if (!input || !input->set_ioproxy(&memory) || !input->open("tile", spec, config))
    {
        const std::string cause = oneLine(input ? input->geterror() : OIIO::geterror());
        fail(Kind::Damaged, name + " is no picture (" + cause + "); build the store anew");
    }
    // A tile's side is some hundred pixels: more is a damaged header that would take memory.
    constexpr int maxSide = 1 << 15;
    if (input->spec().width > maxSide || input->spec().height > maxSide ||
        input->spec().nchannels > 4)
    {
        fail(Kind::Damaged, name + " is no tile; build the store anew");
    }
    input->threads(1);
    Pixels pixels(input->spec().width, input->spec().height, input->spec().nchannels);
    const auto stride = static_cast<OIIO::stride_t>(pixels.width) * pixels.channels;
    if (!input->read_image(0, 0, 0, pixels.channels, OIIO::TypeUInt8, pixels.row(pixels.height - 1),
                           OIIO::AutoStride, -stride))
    {
        fail(Kind::Damaged,
             name + " is damaged (" + oneLine(input->geterror()) + "); build the store anew");
    }
    return pixels;
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

Pixels decodeTile(const std::string& bytes, const std::string& name)
{
    if (!isJpeg(bytes))
    {
        return decodeByOiio(bytes, name);
    }
    try
    {
        DecodedImage image = readJpegBytes(bytes, name);
        if (image.degraded)
        {
            fail(Kind::Damaged, image.warning);
        }
        return std::move(image.pixels);
    }
    catch (const ImageError& error)
    {
        throw TileStoreError(Kind::Damaged, error.what());
    }
}

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
    OIIO::ImageSpec spec(int(area.width), int(area.height), settings.channels, OIIO::TypeUInt8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("oiio:ColorSpace", "sRGB");
    auto output = OIIO::ImageOutput::create(path);
    const auto check = [&](bool good)
    {
        if (!good)
        {
            const std::string cause = oneLine(output ? output->geterror() : OIIO::geterror());
            fail(Kind::Unwritable, "'" + path + "' cannot be written (" + cause +
                                       "); name a file like region.png where there is room");
        }
    };
    check(output != nullptr);
    int y = 0;
    try
    {
        readRegion(reader, level, area, settings,
                   [&](const std::uint8_t* row)
                   {
                       // Not before the first tiles are read: no file comes of a damaged store.
                       check(y > 0 || output->open(path, spec));
                       check(output->write_scanline(y++, 0, OIIO::TypeUInt8, row));
                   });
        check(output->close());
    }
    catch (const TileStoreError&)
    {
        // Else libpng complains on the terminal about a picture that ends early.
        const std::vector<std::uint8_t> blank(std::size_t(area.width) * settings.channels);
        while (y > 0 && y < area.height &&
               output->write_scanline(y, 0, OIIO::TypeUInt8, blank.data()))
        {
            ++y;
        }
        output.reset();
        std::error_code error;
        if (y > 0)
        {
            std::filesystem::remove(path, error);
        }
        throw;
    }
}

} // namespace osgPagedTexture
