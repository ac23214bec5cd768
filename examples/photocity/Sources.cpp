// SPDX-License-Identifier: MIT
#include "Sources.h"

#include "../city/CityRandom.h"
#include "EachCore.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{

constexpr int MostSide = 2560, LeastSide = 640;

bool isJpeg(const fs::path& file)
{
    return file.extension() == ".jpg" || file.extension() == ".jpeg";
}

bool isPicture(const fs::path& file)
{
    return isJpeg(file) || file.extension() == ".png" || file.extension() == ".webp";
}

/// Sorted by name, so that the order of a folder's entries does not matter.
std::vector<fs::path> filesOf(const std::string& folder)
{
    std::error_code failure;
    std::vector<fs::path> files;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied,
                                           failure);
    for (; !failure && entry != fs::recursive_directory_iterator(); entry.increment(failure))
        if (isPicture(entry->path()) && entry->is_regular_file(failure))
            files.push_back(entry->path());
    if (failure)
        throw std::runtime_error("cannot read the folder '" + folder + "': " + failure.message());
    std::sort(files.begin(), files.end());
    return files;
}

/// The mean of squares of `step` pixels, of the first three channels or the first one.
Source reduced(const std::vector<std::uint8_t>& bytes, int width, int height, int channels,
               int step)
{
    Source source;
    source.width = width / step;
    source.height = height / step;
    source.pixels.resize(std::size_t(source.width) * source.height);
    for (int y = 0; y < source.height; ++y)
        for (int x = 0; x < source.width; ++x)
        {
            std::uint32_t pixel = 0;
            for (int channel = 0; channel < 3; ++channel)
            {
                int sum = 0;
                for (int i = 0; i < step * step; ++i)
                    sum += bytes[(std::size_t(y * step + i / step) * width + x * step + i % step) *
                                     channels +
                                 (channels < 3 ? 0 : channel)];
                pixel |= std::uint32_t(sum / (step * step)) << (8 * channel);
            }
            source.pixels[std::size_t(y) * source.width + x] = pixel;
        }
    return source;
}

/// Empty for a file that is small, damaged or of no known format: another one serves as well.
Source readSource(const fs::path& file)
{
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input)
    {
        OIIO::geterror();
        return {};
    }
    const OIIO::ImageSpec& spec = input->spec();
    if (std::min(spec.width, spec.height) < LeastSide || spec.depth > 1 || spec.nchannels < 1 ||
        double(spec.width) * spec.height > 1e8)
        return {};
    std::vector<std::uint8_t> bytes(std::size_t(spec.width) * spec.height * spec.nchannels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, bytes.data()))
        return {};
    const int step = (std::max(spec.width, spec.height) + MostSide - 1) / MostSide;
    return reduced(bytes, spec.width, spec.height, spec.nchannels, step);
}

/// Smooth noise of period `size` cells, -1 to 1.
double noise(const std::vector<float>& lattice, int size, double x, double y)
{
    const int column = int(x), row = int(y);
    const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const double right = smooth(x - column), down = smooth(y - row);
    const auto at = [&](int i, int j)
    { return double(lattice[std::size_t((row + j) % size * size + (column + i) % size)]); };
    const double top = at(0, 0) + (at(1, 0) - at(0, 0)) * right;
    const double bottom = at(0, 1) + (at(1, 1) - at(0, 1)) * right;
    return top + (bottom - top) * down;
}

Source makeSource(std::uint32_t seed)
{
    constexpr int Side = 1536, Lattice = 512;
    CityRandom random(seed);
    std::vector<float> lattice(std::size_t(Lattice) * Lattice);
    for (float& value : lattice)
        value = float(random(-1.0, 1.0));
    const double color[] = {random(70, 200), random(70, 200), random(70, 200)};
    const double strength[] = {random(30, 90), random(30, 90), random(30, 90)};
    Source source{Side, Side, std::vector<std::uint32_t>(std::size_t(Side) * Side)};
    for (int y = 0; y < Side; ++y)
        for (int x = 0; x < Side; ++x)
        {
            double value = 0.0;
            for (int octave = 2; octave < 9; ++octave)
                value += noise(lattice, Lattice, double(x << octave) / Side,
                               double(y << octave) / Side) *
                         std::pow(0.72, octave);
            std::uint32_t pixel = 0;
            for (int i = 0; i < 3; ++i)
                pixel |= std::uint32_t(std::clamp(color[i] + strength[i] * value, 0.0, 255.0))
                         << (8 * i);
            source.pixels[std::size_t(y) * Side + x] = pixel;
        }
    return source;
}

} // namespace

std::vector<Source> readSources(const std::vector<std::string>& folders, unsigned int most,
                                std::uint32_t seed)
{
    std::vector<fs::path> files;
    for (const std::string& folder : folders)
        for (const fs::path& file : filesOf(folder))
            files.push_back(file);
    CityRandom random(seed);
    for (std::size_t i = files.size(); i > 1; --i)
        std::swap(files[i - 1], files[random.choice(unsigned(i))]);
    std::stable_partition(files.begin(), files.end(), isJpeg);
    files.resize(std::min(files.size(), std::size_t(most)));
    std::vector<Source> sources(files.size());
    forEachOnAllCores(files.size(), [&](std::size_t i) { sources[i] = readSource(files[i]); });
    sources.erase(std::remove_if(sources.begin(), sources.end(),
                                 [](const Source& source) { return source.pixels.empty(); }),
                  sources.end());
    return sources;
}

std::vector<std::string> systemPhotoFolders()
{
    std::vector<std::string> folders;
    for (const char* folder :
         {"/usr/share/backgrounds", "/usr/share/wallpapers", "/usr/local/share/backgrounds"})
        if (std::error_code failure; fs::is_directory(folder, failure))
            folders.push_back(folder);
    return folders;
}

std::vector<Source> makeSources(std::uint32_t seed)
{
    std::vector<Source> sources(8);
    forEachOnAllCores(sources.size(),
                      [&](std::size_t i) { sources[i] = makeSource(seed + std::uint32_t(i)); });
    return sources;
}
