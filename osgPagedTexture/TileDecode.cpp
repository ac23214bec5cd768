// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileExtract.h>

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/JpegFile.h>
#include <osgPagedTexture/OiioModule.h>

#include <png.h>

#include <memory>

namespace osgPagedTexture
{

namespace
{

using Kind = TileStoreError::Kind;

[[noreturn]] void damaged(const std::string& name, const std::string& cause)
{
    throw TileStoreError(Kind::Damaged, "osgPagedTexture::TileStore: " + name + " is damaged (" +
                                            cause + "); build the store anew");
}

Pixels decodePng(const std::string& bytes, const std::string& name)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    const std::unique_ptr<png_image, void (*)(png_imagep)> freed(&image, png_image_free);
    if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()))
    {
        damaged(name, image.message);
    }
    // A tile's side is some hundred pixels: more is a damaged header that would take memory.
    constexpr png_uint_32 maxSide = 1 << 15;
    if (image.width > maxSide || image.height > maxSide)
    {
        damaged(name, "it is too large");
    }
    // 16 bits are light to libpng; palettes become colours.
    image.format &= PNG_FORMAT_FLAG_ALPHA | PNG_FORMAT_FLAG_COLOR;
    Pixels pixels(int(image.width), int(image.height), int(PNG_IMAGE_PIXEL_CHANNELS(image.format)));
    const auto stride = static_cast<png_int_32>(pixels.width * pixels.channels);
    if (!png_image_finish_read(&image, nullptr, pixels.bytes.data(), -stride, nullptr))
    {
        damaged(name, image.message);
    }
    return pixels;
}

Pixels decodeOther(const std::string& bytes, const std::string& name)
{
    try
    {
        return oiioFunctions().decodeTile(bytes, name);
    }
    catch (const ImageError& error) // the module is not there
    {
        throw TileStoreError(Kind::Unreadable, error.what());
    }
}

Pixels decodeJpeg(const std::string& bytes, const std::string& name)
{
    try
    {
        DecodedImage image = readJpegBytes(bytes, name);
        if (image.degraded)
        {
            throw TileStoreError(Kind::Damaged, "osgPagedTexture::TileStore: " + image.warning);
        }
        return std::move(image.pixels);
    }
    catch (const ImageError& error)
    {
        throw TileStoreError(Kind::Damaged, error.what());
    }
}

} // namespace

Pixels decodeTile(const std::string& bytes, const std::string& name)
{
    return isJpeg(bytes)                         ? decodeJpeg(bytes, name)
           : bytes.compare(0, 4, "\x89PNG") == 0 ? decodePng(bytes, name)
                                                 : decodeOther(bytes, name);
}

} // namespace osgPagedTexture
