// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileEncoder.h>

#include <osgPagedTexture/TileStore.h>

#include <png.h>
#include <zlib.h>

#include <csetjmp>

namespace osgPagedTexture
{

namespace
{

void append(png_structp png, png_bytep bytes, png_size_t count)
{
    static_cast<std::string*>(png_get_io_ptr(png))
        ->append(reinterpret_cast<const char*>(bytes), count);
}

/// libpng's errors are jumps: nothing with a destructor may live in here.
bool compress(png_structp png, png_infop info, const TileRows& tile, int compression)
{
    if (setjmp(png_jmpbuf(png)))
    {
        return false;
    }
    png_set_IHDR(png, info, static_cast<png_uint_32>(tile.width),
                 static_cast<png_uint_32>(tile.height), 8,
                 tile.channels == 1   ? PNG_COLOR_TYPE_GRAY
                 : tile.channels == 3 ? PNG_COLOR_TYPE_RGB
                                      : PNG_COLOR_TYPE_RGB_ALPHA,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (compression <= 1)
    {
        // Repeats are rare in photographs: differences and their frequencies are what shrinks.
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
        png_set_compression_level(png, 1);
        png_set_compression_strategy(png, Z_RLE);
    }
    else
    {
        png_set_compression_level(png, compression);
    }
    png_write_info(png, info);
    png_write_image(png, const_cast<png_bytepp>(tile.rows));
    png_write_end(png, nullptr);
    return true;
}

class PngTileEncoder : public TileEncoder
{
public:
    explicit PngTileEncoder(int compression) : _compression(compression) {}

    std::string encode(const TileRows& tile) override
    {
        std::string bytes;
        png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
        png_infop info = png ? png_create_info_struct(png) : nullptr;
        bool good = info != nullptr;
        if (good)
        {
            png_set_write_fn(png, &bytes, append, nullptr);
            good = compress(png, info, tile, _compression);
        }
        png_destroy_write_struct(&png, &info);
        if (!good)
        {
            throw TileStoreError(
                TileStoreError::Kind::Refused,
                "osgPagedTexture::TileEncoder: a tile of " + std::to_string(tile.width) + " x " +
                    std::to_string(tile.height) + " pixels is no PNG; choose another format");
        }
        return bytes;
    }

private:
    const int _compression;
};

} // namespace

std::unique_ptr<TileEncoder> makePngTileEncoder(int compression)
{
    return std::make_unique<PngTileEncoder>(compression);
}

} // namespace osgPagedTexture
