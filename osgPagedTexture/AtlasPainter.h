// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/LevelRows.h>
#include <osgPagedTexture/TileBuilder.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace osgPagedTexture
{

class JpegCutter;
class PhotoPainter;

/// Paints rows of an atlas from its photographs, which are decoded as the rows go down: each once,
/// and only those that cross the current band of rows are open.
class AtlasPainter
{
public:
    struct Settings
    {
        std::string folder; ///< That the photographs' paths are relative to.
        PixelRect window;   ///< What of the atlas is painted.
        int channels = 3;
        TileColor background{}; ///< Where there is no photograph, or a broken one.
        bool cut = false;       ///< Tiles are to be cut out of photographs without loss.
    };
    AtlasPainter(const AtlasLayout& layout, const Settings& settings);
    ~AtlasPainter();
    AtlasPainter(const AtlasPainter&) = delete;
    AtlasPainter& operator=(const AtlasPainter&) = delete;

    /// Goes on to rows y to endY - 1, which follow those of the last call, and returns how many
    /// parts there are to paint.
    std::size_t begin(std::int64_t y, std::int64_t endY);
    /// The photographs that begin with the current rows, their padding included.
    const std::vector<std::size_t>& getBegun() const { return _begun; }
    /// Paints a part; different ones in different threads.
    void paint(std::size_t part, LevelRows& rows);

    /// What cuts a part of the current rows out of a photograph; see PhotoPainter.
    std::shared_ptr<JpegCutter> findCutter(const PixelRect& inAtlas, PixelRect& inPhoto) const;

    /// After the last rows, ordered by photograph.
    std::vector<PhotoFailure> getFailures() const;

private:
    void fillGaps(LevelRows& rows) const;

    const AtlasLayout& _layout;
    const Settings _settings;
    std::vector<std::size_t> _order; ///< Photographs in the window by their first rows.
    std::size_t _nextPhoto = 0;      ///< In _order.
    std::vector<std::size_t> _begun;
    std::vector<std::unique_ptr<PhotoPainter>> _open; ///< From left to right.
    std::int64_t _y = 0, _endY = 0;
    mutable std::mutex _mutex; ///< Of the failures.
    std::vector<PhotoFailure> _failures;
};

/// Sets pixels of a row to one colour.
void fillPixels(std::uint8_t* pixels, std::int64_t count, int channels, const TileColor& color);

} // namespace osgPagedTexture
