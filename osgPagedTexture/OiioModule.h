// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/PhotoRows.h>
#include <osgPagedTexture/PictureFile.h>

#include <cstdint>
#include <memory>
#include <string>

namespace osgPagedTexture
{

/// Writes a picture row by row, the top one first. Throws TileStoreError; what is written so far
/// goes away then, and where it ends early.
class PictureWriter
{
public:
    virtual ~PictureWriter() = default;
    virtual void write(const std::uint8_t* row) = 0;
    virtual void finish() = 0;
};

/// All that is asked of OpenImageIO. It brings some 250 libraries along, which take a quarter of a
/// second to load: so it is behind a module of its own that is loaded when the first of these is
/// needed, which with JPEG files and tiles is never.
struct OiioFunctions
{
    ImageInfo (*readInfo)(const std::string& path, std::uint64_t fileBytes,
                          const ImageLimits& limits, bool lookAtAlpha);
    DecodedImage (*readFile)(const std::string& path, std::uint64_t fileBytes,
                             const ReadSettings& settings);
    /// Null where it has to be read as a whole.
    std::unique_ptr<PhotoRows> (*openRows)(const std::string& path, std::uint64_t fileBytes,
                                           const PhotoRowsSettings& settings);
    Pixels (*decodeTile)(const std::string& bytes, const std::string& name);
    std::unique_ptr<PictureWriter> (*openWriter)(const std::string& path, int width, int height,
                                                 int channels);
    /// As writePictureFile() and writeLayers(), in place. Throw TileStoreError where the file
    /// cannot be written, else std::runtime_error.
    void (*writePicture)(const std::string& path, const Pixels& pixels, int quality);
    void (*writePages)(const std::string& path, const std::vector<PictureLayer>& layers);
};

/// Throws ImageError::Kind::Unsupported where the module cannot be loaded.
const OiioFunctions& oiioFunctions();

/// What the module has.
extern "C" const OiioFunctions* osgPagedTextureOiio();
using OiioEntry = decltype(&osgPagedTextureOiio);

} // namespace osgPagedTexture
