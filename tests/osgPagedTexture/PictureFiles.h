// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pixels.h>

#include <string>

/// A picture with gradients, edges and some noise, as photographs have; the same for the same seed.
osgPagedTexture::Pixels samplePicture(int width, int height, int channels, unsigned int seed = 1);

struct JpegOptions
{
    int quality = 92;
    bool progressive = false;
    bool cmyk = false; ///< Of RGB pixels, stored inverted as Adobe does.
    bool adobe = true; ///< Whether CMYK bears Adobe's marker.
    bool fullChroma = true;
    int orientation = 0; ///< 0: no EXIF.
};

/// The bytes of a JPEG of 1 or 3 channels.
std::string encodeJpeg(const osgPagedTexture::Pixels& pixels, const JpegOptions& options = {});

/// Writes a picture through OpenImageIO, the format by the extension; `type` "uint8", "uint16",
/// "half", "float".
void writePicture(const std::string& path, const osgPagedTexture::Pixels& pixels,
                  const std::string& type = "uint8", bool tiled = false);

/// The bytes of a PNG file.
std::string encodePng(const osgPagedTexture::Pixels& pixels);

/// The largest difference of two pictures' channels; 256 where their shapes differ.
int largestDifference(const osgPagedTexture::Pixels& a, const osgPagedTexture::Pixels& b);

/// dB over all channels.
double psnr(const osgPagedTexture::Pixels& a, const osgPagedTexture::Pixels& b);

/// The mean over whole boxes of `side` pixels, in linear light or of code values.
osgPagedTexture::Pixels boxMean(const osgPagedTexture::Pixels& pixels, int side, bool linearLight);
