// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/Pixels.h>

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace osgPagedTexture
{

/// Why a picture could not be read: one line with file, cause and remedy.
class OSGPAGEDTEXTURE_EXPORT ImageError : public std::runtime_error
{
public:
    enum class Kind
    {
        Unreadable, ///< Missing, no right to read it, or the disk fails: may pass.
        Refused,    ///< Larger than the limits, or than its bytes can honestly hold.
        Damaged,    ///< Not what its format says.
        Unsupported,
        Cancelled ///< ReadSettings::cancelled became true.
    };
    ImageError(Kind kind, const std::string& path, const std::string& causeAndRemedy);
    ImageError(Kind kind, const std::string& line) : std::runtime_error(line), _kind(kind) {}
    Kind getKind() const { return _kind; }

private:
    Kind _kind;
};

/// What a file says before its pixels are decoded.
struct ImageInfo
{
    int width = 0;  ///< As shown, after the EXIF orientation.
    int height = 0; ///< As shown.
    int channels = 0;
    bool translucent = false; ///< A pixel's alpha is below 1.
    std::string format;       ///< By content: "jpeg", or OpenImageIO's name, "png".
    std::uint64_t fileBytes = 0;
    std::uint64_t decoderBytes = 0; ///< Memory that decoding takes besides the pixels.
};

/// Which pictures are refused before memory is taken for their pixels. Besides these, a picture
/// that is larger than its file can hold is refused: more than 1,200 pixels a byte of a JPEG, more
/// than 1,100 decoded bytes a byte of another file where they are over 64 MiB (deflate reaches
/// 1,032 at most).
struct ImageLimits
{
    std::uint64_t maxPixels = std::uint64_t(1) << 28; ///< 16384 x 16384.
    std::uint64_t maxBytes = std::uint64_t(1) << 30;  ///< Of decoded pixels at full size.

    /// Throws ImageError, Refused, where a picture of this size and as many bytes a pixel is
    /// beyond them; `name` is for the message.
    OSGPAGEDTEXTURE_EXPORT void check(const std::string& name, std::uint64_t width,
                                      std::uint64_t height, unsigned int channels) const;
};

struct ReadSettings
{
    int reduction = 0;       ///< Mip level to read: sides are levelSide(side, reduction).
    bool linearLight = true; ///< Where pixels are averaged; false for data and normal maps.
    ImageLimits limits;
    const std::atomic<bool>* cancelled = nullptr; ///< Looked at every few rows; may be null.
};

struct DecodedImage
{
    Pixels pixels;     ///< At the size of the reduction, orientation applied, row 0 at the bottom.
    int fullWidth = 0; ///< Of the file's picture as shown, level 0.
    int fullHeight = 0;
    std::uint64_t fileBytes = 0;

    /// The decoder met data that are not as its format says, and the picture may be wrong in part:
    /// a picture to show only where a user asked for it, never as a good one, and not to be
    /// cached. Every warning of libjpeg-turbo counts.
    bool degraded = false;
    std::string warning; ///< Then: what was wrong, one line that names the file.
};

/// Reads what the header says. Where there is an alpha channel, `lookAtAlpha` decodes it to see
/// whether it is used; else it counts as used. The format is that of the content, whatever the
/// extension. Throws ImageError. Any thread.
OSGPAGEDTEXTURE_EXPORT ImageInfo readImageInfo(const std::string& path,
                                               const ImageLimits& limits = {},
                                               bool lookAtAlpha = true);

/// Reads a picture at the size of a mip level. JPEG is scaled by 1/2, 1/4, 1/8 while its blocks are
/// decoded, in the colour space of the file; the rest is averaged over the texels' areas. Grey, 16
/// bits, floating point (linear light, clamped to 0..1), CMYK (without its profile) and palettes
/// become 8-bit pixels of 1 to 4 channels. Throws ImageError. Any thread.
OSGPAGEDTEXTURE_EXPORT DecodedImage readImageFile(const std::string& path,
                                                  const ReadSettings& settings = {});

/// The same from the bytes of a JPEG file; `name` is for messages.
OSGPAGEDTEXTURE_EXPORT DecodedImage readJpegBytes(const std::string& bytes, const std::string& name,
                                                  const ReadSettings& settings = {});

} // namespace osgPagedTexture
