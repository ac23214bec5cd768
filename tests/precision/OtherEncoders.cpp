// SPDX-License-Identifier: MIT
#include <precision/OtherEncoders.h>

#ifdef OSGKITS_STB_DXT
#define STB_DXT_IMPLEMENTATION
#include <cstring>
#include <stb/stb_dxt.h>
#endif
#ifdef OSGKITS_SQUISH
#include <squish.h>
#endif
#ifdef OSGKITS_MAGICK
#include <wand/MagickWand.h>
#endif

#include <stdexcept>

namespace precision
{

namespace
{

using osgPagedTexture::Pixels;
using Bytes = std::vector<std::uint8_t>;

#if defined(OSGKITS_STB_DXT) || defined(OSGKITS_SQUISH)
/// Block by block through RGBA, as these encoders want it.
template <class Encode> Bytes encodeEach(const Pixels& pixels, Encode encode)
{
    Bytes bytes(std::size_t(pixels.width) * pixels.height / 2);
    std::uint8_t* out = bytes.data();
    for (int y = 0; y < pixels.height; y += 4)
        for (int x = 0; x < pixels.width; x += 4, out += 8)
        {
            std::uint8_t texels[64];
            for (int k = 0; k < 16; ++k)
            {
                const std::uint8_t* p = pixels.row(y + k / 4) + 3 * (x + k % 4);
                const std::uint8_t texel[4] = {p[0], p[1], p[2], 255};
                std::copy(texel, texel + 4, texels + 4 * k);
            }
            encode(texels, out);
        }
    return bytes;
}
#endif

#ifdef OSGKITS_MAGICK
/// A DDS file in memory, without its header.
Bytes encodeByMagick(const Pixels& pixels, bool clusterFit)
{
    static const bool started = []
    {
        MagickWandGenesis();
        MagickSetResourceLimit(ThreadResource, 1);
        return true;
    }();
    (void)started;
    MagickWand* wand = NewMagickWand();
    std::size_t size = 0;
    unsigned char* blob = nullptr;
    if (MagickConstituteImage(wand, pixels.width, pixels.height, "RGB", CharPixel,
                              pixels.bytes.data()) &&
        MagickSetImageFormat(wand, "DDS"))
    {
        MagickSetOption(wand, "dds:compression", "dxt1");
        MagickSetOption(wand, "dds:mipmaps", "0");
        MagickSetOption(wand, "dds:cluster-fit", clusterFit ? "true" : "false");
        blob = MagickGetImageBlob(wand, &size);
    }
    const std::size_t bytes = std::size_t(pixels.width) * pixels.height / 2, header = 128;
    const bool isWhole = blob && size == header + bytes;
    const Bytes encoded = isWhole ? Bytes(blob + header, blob + size) : Bytes();
    if (blob)
        MagickRelinquishMemory(blob);
    DestroyMagickWand(wand);
    if (!isWhole)
        throw std::runtime_error("ImageMagick wrote no DXT1 of " + std::to_string(bytes) +
                                 " bytes: " + std::to_string(size));
    return encoded;
}
#endif

} // namespace

std::vector<OtherEncoder> getOtherEncoders()
{
    std::vector<OtherEncoder> encoders;
#ifdef OSGKITS_STB_DXT
    encoders.push_back({"stb_dxt",
                        "quality",
                        {0, 1},
                        [](const Pixels& pixels, double value)
                        {
                            const int mode = value > 0 ? STB_DXT_HIGHQUAL : STB_DXT_NORMAL;
                            return encodeEach(pixels,
                                              [mode](const std::uint8_t* texels, std::uint8_t* out)
                                              { stb_compress_dxt_block(out, texels, 0, mode); });
                        }});
#endif
#ifdef OSGKITS_SQUISH
    encoders.push_back({"libsquish",
                        "range, cluster fit",
                        {0, 1},
                        [](const Pixels& pixels, double value)
                        {
                            const int flags = squish::kDxt1 | (value > 0 ? squish::kColourClusterFit
                                                                         : squish::kColourRangeFit);
                            return encodeEach(pixels,
                                              [flags](const std::uint8_t* texels, std::uint8_t* out)
                                              {
                                                  float metric[3] = {1.0f, 1.0f, 1.0f};
                                                  squish::Compress(texels, out, flags, metric);
                                              });
                        }});
#endif
#ifdef OSGKITS_MAGICK
    encoders.push_back(
        {"ImageMagick", "range, cluster fit", {0, 1}, [](const Pixels& pixels, double value) {
             return encodeByMagick(pixels, value > 0);
         }});
#endif
    return encoders;
}

} // namespace precision
