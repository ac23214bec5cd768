// SPDX-License-Identifier: MIT
#include <osgPagedTexture/OiioFile.h>

#include <osgPagedTexture/BlockFormat.h>
#include <osgPagedTexture/BoxReducer.h>
#include <osgPagedTexture/ExifOrientation.h>
#include <osgPagedTexture/OiioReader.h>

#include <algorithm>

#ifdef _WIN32
#define OSGPAGEDTEXTURE_OIIO_ENTRY __declspec(dllexport)
#else
#define OSGPAGEDTEXTURE_OIIO_ENTRY __attribute__((visibility("default")))
#endif

namespace osgPagedTexture::oiio
{

namespace
{

bool isTranslucent(OiioReader& reader)
{
    bool translucent = false;
    const int alpha = reader.alphaChannel();
    const int width = reader.spec().width;
    if (alpha >= 0)
    {
        reader.readRows(alpha, alpha + 1, nullptr,
                        [&](const std::uint8_t* row, int)
                        {
                            translucent = translucent || std::any_of(row, row + width,
                                                                     [](std::uint8_t value)
                                                                     { return value < 255; });
                        });
    }
    return translucent;
}

} // namespace

ImageInfo readInfo(const std::string& path, std::uint64_t fileBytes, const ImageLimits& limits,
                   bool lookAtAlpha)
{
    OiioReader reader(path, fileBytes, limits);
    const bool turned = isTransposed(reader.orientation());
    ImageInfo info;
    info.width = turned ? reader.spec().height : reader.spec().width;
    info.height = turned ? reader.spec().width : reader.spec().height;
    info.channels = reader.channels();
    info.format = reader.format();
    info.fileBytes = fileBytes;
    info.translucent = lookAtAlpha ? isTranslucent(reader) : reader.alphaChannel() >= 0;
    return info;
}

DecodedImage readFile(const std::string& path, std::uint64_t fileBytes,
                      const ReadSettings& settings)
{
    OiioReader reader(path, fileBytes, settings.limits);
    const int fullWidth = reader.spec().width;
    const int fullHeight = reader.spec().height;
    const int width = levelSide(fullWidth, settings.reduction);
    const int height = levelSide(fullHeight, settings.reduction);
    const int orientation = reader.orientation();
    const Placement placement = placementOf(width, height, orientation);

    DecodedImage image;
    image.fullWidth = isTransposed(orientation) ? fullHeight : fullWidth;
    image.fullHeight = isTransposed(orientation) ? fullWidth : fullHeight;
    image.fileBytes = fileBytes;
    image.pixels = Pixels(placement.width, placement.height, reader.channels());
    const auto place = [&](const std::uint8_t* row, int y)
    { placeRow(row, width, y, placement, image.pixels); };
    if (settings.reduction <= 0)
    {
        reader.readRows(0, reader.channels(), settings.cancelled, place);
        return image;
    }
    BoxReducer reducer({fullWidth, reader.channels(), double(fullWidth), double(fullHeight), width,
                        height, settings.linearLight},
                       place);
    reader.readRows(0, reader.channels(), settings.cancelled,
                    [&](const std::uint8_t* row, int) { reducer.add(row); });
    return image;
}

} // namespace osgPagedTexture::oiio

extern "C" OSGPAGEDTEXTURE_OIIO_ENTRY const osgPagedTexture::OiioFunctions*
osgPagedTexture::osgPagedTextureOiio()
{
    static constexpr OiioFunctions functions{oiio::readInfo,   oiio::readFile,   oiio::openRows,
                                             oiio::decodeTile, oiio::openWriter, oiio::writePicture,
                                             oiio::writePages};
    return &functions;
}
