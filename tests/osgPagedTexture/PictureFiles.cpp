// SPDX-License-Identifier: MIT
#include "PictureFiles.h"

#include <support/TemporaryFolder.h>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>

#include <jpeglib.h>

using osgPagedTexture::Pixels;

Pixels samplePicture(int width, int height, int channels, unsigned int seed)
{
    std::mt19937 random(seed);
    Pixels pixels(width, height, channels);
    for (int y = 0; y < height; ++y)
    {
        for (int x = 0; x < width; ++x)
        {
            for (int c = 0; c < channels; ++c)
            {
                const double wave = std::sin(0.05 * x * (c + 1) + seed) * std::cos(0.07 * y + c);
                const bool inside = (x / 24 + y / 40 + c) % 5 == 0;
                const double value = 128 + 70 * wave + (inside ? 40 : 0) + int(random() % 9) - 4;
                pixels.row(y)[x * channels + c] =
                    static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
            }
        }
    }
    return pixels;
}

namespace
{

std::string exifSegment(int orientation)
{
    std::string text("Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0", 25);
    text.push_back(static_cast<char>(orientation));
    return text + std::string(6, '\0');
}

} // namespace

std::string encodeJpeg(const Pixels& pixels, const JpegOptions& options)
{
    jpeg_compress_struct jpeg;
    jpeg_error_mgr errors;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* target = nullptr;
    unsigned long bytes = 0;
    jpeg_mem_dest(&jpeg, &target, &bytes);
    jpeg.image_width = pixels.width;
    jpeg.image_height = pixels.height;
    jpeg.input_components = options.cmyk ? 4 : pixels.channels;
    jpeg.in_color_space =
        options.cmyk ? JCS_CMYK : (pixels.channels == 1 ? JCS_GRAYSCALE : JCS_RGB);
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, options.quality, TRUE);
    if (options.cmyk)
    {
        jpeg_set_colorspace(&jpeg, options.adobe ? JCS_YCCK : JCS_CMYK);
        jpeg.write_Adobe_marker = options.adobe;
    }
    if (options.fullChroma)
    {
        for (int i = 0; i < jpeg.num_components; ++i)
        {
            jpeg.comp_info[i].h_samp_factor = jpeg.comp_info[i].v_samp_factor = 1;
        }
    }
    if (options.progressive)
    {
        jpeg_simple_progression(&jpeg);
    }
    jpeg_start_compress(&jpeg, TRUE);
    if (options.orientation)
    {
        const std::string exif = exifSegment(options.orientation);
        jpeg_write_marker(&jpeg, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(exif.data()),
                          static_cast<unsigned int>(exif.size()));
    }
    std::vector<std::uint8_t> row(std::size_t(pixels.width) * jpeg.input_components);
    for (int y = pixels.height - 1; y >= 0; --y)
    {
        const std::uint8_t* source = pixels.row(y);
        std::copy(source, source + std::size_t(pixels.width) * pixels.channels, row.begin());
        for (int x = 0; options.cmyk && x < pixels.width; ++x)
        {
            for (int c = 0; c < 4; ++c)
            {
                const int light = c < 3 ? source[3 * x + c] : 255;
                row[4 * x + c] = static_cast<std::uint8_t>(options.adobe ? light : 255 - light);
            }
        }
        JSAMPROW line = row.data();
        jpeg_write_scanlines(&jpeg, &line, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    std::string text(reinterpret_cast<const char*>(target), bytes);
    std::free(target);
    return text;
}

void writePicture(const std::string& path, const Pixels& pixels, const std::string& type,
                  bool tiled)
{
    const auto output = OIIO::ImageOutput::create(path);
    OIIO::ImageSpec spec(pixels.width, pixels.height, pixels.channels, OIIO::TypeDesc(type));
    if (pixels.hasAlpha())
    {
        spec.alpha_channel = pixels.channels - 1;
        spec.attribute("oiio:UnassociatedAlpha", 1);
    }
    if (tiled)
    {
        spec.tile_width = spec.tile_height = 64;
    }
    const OIIO::stride_t row = OIIO::stride_t(pixels.width) * pixels.channels;
    if (!output || !output->open(path, spec) ||
        !output->write_image(OIIO::TypeUInt8, pixels.row(pixels.height - 1), pixels.channels,
                             -row) ||
        !output->close())
    {
        throw std::runtime_error(path + ": " + (output ? output->geterror() : OIIO::geterror()));
    }
}

std::string encodePng(const Pixels& pixels)
{
    const support::TemporaryFolder folder;
    const std::string path = folder.file("picture.png");
    writePicture(path, pixels);
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

int largestDifference(const Pixels& a, const Pixels& b)
{
    if (a.width != b.width || a.height != b.height || a.channels != b.channels)
    {
        return 256;
    }
    int largest = 0;
    for (std::size_t i = 0; i < a.bytes.size(); ++i)
    {
        largest = std::max(largest, std::abs(a.bytes[i] - b.bytes[i]));
    }
    return largest;
}

double psnr(const Pixels& a, const Pixels& b)
{
    if (largestDifference(a, b) == 256)
    {
        return 0.0;
    }
    double sum = 1e-9;
    for (std::size_t i = 0; i < a.bytes.size(); ++i)
    {
        const double difference = a.bytes[i] - b.bytes[i];
        sum += difference * difference;
    }
    return 10.0 * std::log10(255.0 * 255.0 * double(a.bytes.size()) / sum);
}

Pixels boxMean(const Pixels& pixels, int side, bool linearLight)
{
    const auto decode = [&](double v) {
        return !linearLight ? v : v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    const auto encode = [&](double v) {
        return !linearLight ? v : v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    };
    Pixels mean(pixels.width / side, pixels.height / side, pixels.channels);
    for (int y = 0; y < mean.height; ++y)
    {
        for (int at = 0; at < mean.width * mean.channels; ++at)
        {
            const int x = at / mean.channels, c = at % mean.channels;
            double sum = 0.0;
            for (int i = 0; i < side * side; ++i)
            {
                const int column = x * side + i % side;
                sum += decode(pixels.row(y * side + i / side)[column * mean.channels + c] / 255.0);
            }
            mean.row(y)[at] =
                static_cast<std::uint8_t>(std::lround(255.0 * encode(sum / (side * side))));
        }
    }
    return mean;
}
