// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/BoxReducer.h>
#include <osgPagedTexture/ImageFile.h>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// A picture opened by its content.
class OiioReader
{
public:
    /// Throws ImageError.
    OiioReader(const std::string& path, std::uint64_t fileBytes, const ImageLimits& limits);

    const OIIO::ImageSpec& spec() const { return _input->spec(); }
    std::string format() const { return _input->format_name(); }
    int channels() const { return std::min(spec().nchannels, 4); }
    int alphaChannel() const { return channels() == 2 || channels() == 4 ? channels() - 1 : -1; }
    int orientation() const { return std::clamp(spec().get_int_attribute("Orientation", 1), 1, 8); }

    /// How many rows are best read at a time, as they were compressed: a row of tiles, or some.
    int bandRows() const { return spec().tile_width ? spec().tile_height : 64; }
    /// Rows `y` and, at most bandRows(), those below, as 8-bit channels [first, last); `y` is a
    /// multiple of bandRows(). They stay until the next call.
    const std::uint8_t* readBand(int y, int first, int last);
    /// All rows from the top, as 8-bit channels [first, last).
    void readRows(int first, int last, const std::atomic<bool>* cancelled,
                  const BoxReducer::Sink& sink);

private:
    void checkSize(std::uint64_t fileBytes, const ImageLimits& limits) const;
    bool isFloating() const { return spec().format.is_floating_point(); }
    void readInto(int first, int last, int top, int bottom, OIIO::TypeDesc type, void* target);
    void encodeFloats(int first, int channelCount);
    void undoWebp(int first, int channelCount);

    std::string _path;
    std::unique_ptr<OIIO::ImageInput> _input;
    std::vector<std::uint8_t> _band;
    std::vector<float> _floats;
};

} // namespace osgPagedTexture
