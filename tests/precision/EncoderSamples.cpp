// SPDX-License-Identifier: MIT
#include "osgPagedTexture/BlockSamples.h"

#include <precision/EncoderSamples.h>

#include <osgPagedTexture/ImageFile.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

namespace precision
{

namespace
{

using osgPagedTexture::Pixels;

constexpr int Side = 512;
constexpr std::size_t NumPhotographs = 28;

Pixels middleOf(const Pixels& pixels)
{
    const int x0 = (pixels.width - Side) / 2, y0 = (pixels.height - Side) / 2;
    return blockSamples::make(Side, Side, 3,
                              [&](int x, int y, int c)
                              {
                                  const int channel = pixels.channels < 3 ? 0 : c;
                                  return pixels.row(y0 + y)[(x0 + x) * pixels.channels + channel];
                              });
}

/// One a folder at first, since a folder's pictures are often one picture at several sizes.
std::vector<std::string> photographFiles()
{
    namespace fs = std::filesystem;
    std::vector<std::string> files;
    for (const char* root : {"/usr/share/backgrounds", "/usr/share/wallpapers"})
    {
        std::error_code error;
        for (fs::recursive_directory_iterator entry(root, error), end; entry != end;
             entry.increment(error))
        {
            const std::string ending = entry->path().extension().string();
            if (entry->is_regular_file(error) && entry->file_size(error) > 300000 &&
                (ending == ".jpg" || ending == ".png" || ending == ".webp"))
                files.push_back(entry->path().string());
        }
    }
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end(),
                            [](const std::string& a, const std::string& b)
                            {
                                return fs::path(a).parent_path() == fs::path(b).parent_path() &&
                                       a.find("wallpapers") != std::string::npos;
                            }),
                files.end());
    return files;
}

std::vector<Pixels> photographs()
{
    std::vector<Pixels> samples;
    for (const std::string& file : photographFiles())
    {
        if (samples.size() == NumPhotographs)
            break;
        try
        {
            const Pixels pixels = osgPagedTexture::readImageFile(file, {}).pixels;
            if (pixels.width >= Side && pixels.height >= Side)
                samples.push_back(middleOf(pixels));
        }
        catch (const osgPagedTexture::ImageError&)
        {
            // A format that this machine's OpenImageIO does not know.
        }
    }
    while (samples.size() < NumPhotographs)
        samples.push_back(blockSamples::photograph(Side, Side));
    return samples;
}

Pixels normalMap(int seed)
{
    const auto height = [seed](double x, double y)
    {
        double sum = 0.0;
        for (int i = 1; i <= 6; ++i)
            sum += std::sin(x * 0.02 * i * i + seed * i) *
                   std::cos(y * 0.017 * i * (i + seed % 3)) / i;
        return 6.0 * sum;
    };
    return blockSamples::make(Side, Side, 3,
                              [&](int x, int y, int c)
                              {
                                  const double dx = height(x + 1, y) - height(x - 1, y);
                                  const double dy = height(x, y + 1) - height(x, y - 1);
                                  const double length = std::sqrt(dx * dx + dy * dy + 4.0);
                                  const double v[3] = {-dx / length, -dy / length, 2.0 / length};
                                  return int(std::lround((v[c] + 1.0) * 127.5));
                              });
}

/// Rings and rays of one colour on another, antialiased.
Pixels lineArt(int seed)
{
    const int ink[3] = {seed * 40 % 120, seed * 70 % 120, seed * 90 % 120};
    return blockSamples::make(
        Side, Side, 3,
        [&](int x, int y, int c)
        {
            const double u = x - 256.0 + seed, v = y - 256.0, radius = std::hypot(u, v);
            const double ring = std::abs(std::fmod(radius, 17.0 + seed) - 8.0) - 1.0;
            const double ray =
                std::abs(std::fmod(std::atan2(v, u) + 4.0, 0.2) - 0.1) * radius - 0.8;
            const double cover = std::min(1.0, std::max(0.0, 0.5 - std::min(ring, ray)));
            return int(std::lround(255.0 + (ink[c] - 255.0) * cover));
        });
}

double luma(const Pixels& pixels, int x, int y)
{
    const std::uint8_t* p = pixels.row(y) + std::size_t(x) * pixels.channels;
    return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
}

} // namespace

std::vector<Pixels> makeEncoderSamples(EncoderSubject subject)
{
    if (subject == EncoderSubject::Photographs)
        return photographs();
    std::vector<Pixels> samples;
    for (int seed = 0; seed < 6; ++seed)
        samples.push_back(subject == EncoderSubject::NormalMaps ? normalMap(seed) : lineArt(seed));
    return samples;
}

double squaredError(const Pixels& a, const Pixels& b)
{
    double sum = 0.0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c)
            {
                const double difference =
                    double(a.row(y)[x * a.channels + c]) - b.row(y)[x * b.channels + c];
                sum += difference * difference;
            }
    return sum;
}

double similarity(const Pixels& a, const Pixels& b)
{
    const double c1 = 6.5025, c2 = 58.5225; // (0.01 * 255)^2, (0.03 * 255)^2
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y + 8 <= a.height; y += 4)
        for (int x = 0; x + 8 <= a.width; x += 4, ++count)
        {
            double ma = 0.0, mb = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
            for (int k = 0; k < 64; ++k)
            {
                const double u = luma(a, x + k % 8, y + k / 8), v = luma(b, x + k % 8, y + k / 8);
                ma += u / 64.0;
                mb += v / 64.0;
                aa += u * u / 64.0;
                bb += v * v / 64.0;
                ab += u * v / 64.0;
            }
            sum += (2 * ma * mb + c1) * (2 * (ab - ma * mb) + c2) /
                   ((ma * ma + mb * mb + c1) * (aa - ma * ma + bb - mb * mb + c2));
        }
    return sum / count;
}

} // namespace precision
