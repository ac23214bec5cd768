// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileEncoder.h>

#include <osgPagedTexture/DdsFile.h>

#include <algorithm>
#include <cstring>

namespace osgPagedTexture
{

namespace
{

class BlockTileEncoder : public TileEncoder
{
public:
    BlockTileEncoder(BlockFormat format, EncodeQuality quality) : _format(format), _quality(quality)
    {
    }

    std::string encode(const TileRows& tile) override
    {
        // Blocks go from the first row on, which in these files is the top one.
        Pixels pixels(tile.width, tile.height, tile.channels);
        for (int y = 0; y < tile.height; ++y)
        {
            std::copy_n(tile.rows[y], std::size_t(tile.width) * tile.channels, pixels.row(y));
        }
        const std::vector<std::uint8_t> blocks = encodeBlocks(pixels, _format, _quality);
        std::string bytes = ddsHeader(_format, tile.width, tile.height);
        bytes.append(reinterpret_cast<const char*>(blocks.data()), blocks.size());
        return bytes;
    }

private:
    const BlockFormat _format;
    const EncodeQuality _quality;
};

TileColor colorOf(const std::uint8_t* pixel, int channels)
{
    return channels == 1 ? TileColor{pixel[0], pixel[0], pixel[0], 255}
                         : TileColor{pixel[0], pixel[1], pixel[2],
                                     channels == 4 ? pixel[3] : std::uint8_t(255)};
}

} // namespace

std::string TileFormat::extension() const
{
    return coding == TileCoding::Jpeg ? "jpg" : coding == TileCoding::Png ? "png" : "dds";
}

std::unique_ptr<TileEncoder> makeTileEncoder(const TileFormat& format)
{
    switch (format.coding)
    {
    case TileCoding::Jpeg:
        return makeJpegTileEncoder(format.quality, format.chroma);
    case TileCoding::Png:
        return makePngTileEncoder(format.compression);
    case TileCoding::Bc1:
        return std::make_unique<BlockTileEncoder>(BlockFormat::BC1, format.blocks);
    case TileCoding::Bc3:
        return std::make_unique<BlockTileEncoder>(BlockFormat::BC3, format.blocks);
    case TileCoding::Bc7:
        break;
    }
    return std::make_unique<BlockTileEncoder>(BlockFormat::BC7, format.blocks);
}

UniformEncoder makeUniformEncoder(const TileFormat& format, int channels)
{
    const std::shared_ptr<TileEncoder> encoder = makeTileEncoder(format);
    return [encoder, channels](const TileColor& color, int width, int height)
    {
        std::vector<std::uint8_t> row(std::size_t(width) * channels);
        for (std::size_t i = 0; i < row.size(); ++i)
        {
            row[i] = color[i % channels];
        }
        const std::vector<const std::uint8_t*> rows(std::size_t(height), row.data());
        return encoder->encode({rows.data(), width, height, channels});
    };
}

bool isUniform(const TileRows& tile)
{
    const std::size_t bytes = std::size_t(tile.width) * tile.channels;
    const std::uint8_t* const first = tile.rows[0];
    if (std::memcmp(first, first + tile.channels, bytes - tile.channels) != 0)
    {
        return false;
    }
    return std::all_of(tile.rows + 1, tile.rows + tile.height,
                       [&](const std::uint8_t* row)
                       { return std::memcmp(row, first, bytes) == 0; });
}

TileData makeTile(const TileRows& tile, TileEncoder& encoder)
{
    if (isUniform(tile))
    {
        return TileData::uniform(colorOf(tile.rows[0], tile.channels));
    }
    return TileData::encoded(encoder.encode(tile));
}

} // namespace osgPagedTexture
