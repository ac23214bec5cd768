// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/TileStore.h>

#include <cstdint>
#include <memory>
#include <string>

namespace osgPagedTexture
{

class JpegCutter;

/// The rows of a photograph, the top one first as shown, decoded as they are asked for: a wall of
/// photographs is never in memory as a whole.
class PhotoRows
{
public:
    virtual ~PhotoRows() = default;

    /// The next row. Throws ImageError.
    virtual void read(std::uint8_t* row) = 0;
    /// Goes past rows. Throws ImageError.
    virtual void skip(int rows) = 0;
    /// To be called after the last row was read: what the decoder found wrong, one line; else
    /// empty. Throws ImageError.
    virtual std::string finish() { return {}; }

    /// What cuts parts out of the photograph without loss, after its first row was read; null where
    /// that is not asked for or not possible.
    virtual std::shared_ptr<JpegCutter> getCutter() const { return nullptr; }
};

struct PhotoRowsSettings
{
    int width = 0; ///< That the picture must have, as shown.
    int height = 0;
    int channels = 3;       ///< To make of it: 1, 3 or 4; 1 is the first of more.
    TileColor background{}; ///< Below translucent pixels where there are fewer than 4 channels.
    bool cut = false;       ///< Parts of it are to be cut out without loss.
};

/// Opens any picture that readImageFile() reads: JPEG and PPM piece by piece, most other formats
/// some rows at a time, pictures that are stored turned as a whole. Throws ImageError, also where
/// the picture has another size.
std::unique_ptr<PhotoRows> openPhotoRows(const std::string& path,
                                         const PhotoRowsSettings& settings);

/// The kinds of them; null where it is not binary PPM or PGM of 8 bits.
std::unique_ptr<PhotoRows> openJpegRows(const std::string& path, std::uint64_t fileBytes,
                                        const PhotoRowsSettings& settings);
std::unique_ptr<PhotoRows> openPnmRows(const std::string& path, std::uint64_t fileBytes,
                                       const PhotoRowsSettings& settings);

/// Fills `info` from the start of a binary PPM or PGM file of 8 bits; false where it is none or is
/// cut off. Throws ImageError where it exceeds the limits.
bool readPnmInfo(const std::string& head, std::uint64_t fileBytes, const std::string& path,
                 const ImageLimits& limits, ImageInfo& info);

/// Of `channels` (1 to 4) to those of the settings.
OSGPAGEDTEXTURE_EXPORT void convertRow(const std::uint8_t* source, int channels,
                                       const PhotoRowsSettings& settings, std::uint8_t* row);

} // namespace osgPagedTexture
