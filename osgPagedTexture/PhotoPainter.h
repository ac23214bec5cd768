// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/LevelRows.h>
#include <osgPagedTexture/PhotoRows.h>

#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// Paints a photograph's rows of an atlas, from the top to the bottom, with the padding around it,
/// which repeats its edge. One thread at a time.
class PhotoPainter
{
public:
    struct Settings
    {
        std::string folder;
        int channels = 3;
        TileColor background{};
        bool cut = false; ///< Tiles are to be cut out without loss.
    };
    /// `covered`: its place with padding.
    PhotoPainter(const AtlasPhoto& photo, const PixelRect& covered, const Settings& settings,
                 std::size_t index);

    const PixelRect& getCovered() const { return _covered; }
    std::size_t getIndex() const { return _index; }

    /// Its part of rows y to endY - 1, which come after those of the last call. The row before is
    /// still in `rows`.
    void paint(std::int64_t y, std::int64_t endY, LevelRows& rows);

    /// What cuts a part of the atlas out of the photograph's file; null where it cannot. `inPhoto`
    /// becomes the part, from the photograph's corner.
    std::shared_ptr<JpegCutter> findCutter(const PixelRect& inAtlas, PixelRect& inPhoto) const;

    /// What has gone wrong since the last call, one line; else empty.
    std::string takeFailure();

private:
    void paintRow(std::int64_t y, LevelRows& rows);
    void readRow(std::int64_t photoRow, std::uint8_t* row);
    void keepUsed(std::int64_t photoRow, std::uint8_t* row) const;
    void repeatEdges(std::int64_t y, const std::uint8_t* firstPixel, const std::uint8_t* lastPixel,
                     LevelRows& rows) const;

    const AtlasPhoto& _photo;
    const PixelRect _covered;
    const PixelRect _box;   ///< What of the photograph is placed.
    const PixelRect _place; ///< Where, in the atlas.
    const Settings _settings;
    const std::size_t _index;
    std::unique_ptr<PhotoRows> _rows;
    std::vector<std::uint8_t> _row; ///< Of the whole photograph, where only a part is shown.
    std::int64_t _nextRow = 0;      ///< Of the photograph.
    std::int64_t _shownRow = -1;    ///< The row that the atlas's last row shows.
    std::shared_ptr<JpegCutter> _cutter;
    bool _failed = false;
    std::string _failure;
};

} // namespace osgPagedTexture
