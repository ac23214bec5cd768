// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PhotoPainter.h>

#include <osgPagedTexture/AtlasPainter.h>
#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/JpegCutter.h>

#include <algorithm>
#include <utility>

namespace osgPagedTexture
{

PhotoPainter::PhotoPainter(const AtlasPhoto& photo, const PixelRect& covered,
                           const Settings& settings, std::size_t index)
    : _photo(photo), _covered(covered), _box(photo.getBox()), _place(photo.getPlace()),
      _settings(settings), _index(index)
{
}

std::string PhotoPainter::takeFailure()
{
    return std::exchange(_failure, std::string());
}

/// Reads a row that is not above the last one.
void PhotoPainter::readRow(std::int64_t photoRow, std::uint8_t* row)
{
    if (!_rows)
    {
        PhotoRowsSettings settings;
        settings.width = _photo.width;
        settings.height = _photo.height;
        settings.channels = _settings.channels;
        settings.background = _settings.background;
        settings.cut = _settings.cut;
        _rows = openPhotoRows(_settings.folder.empty() ? _photo.path
                                                       : _settings.folder + "/" + _photo.path,
                              settings);
        _cutter = _rows->getCutter();
    }
    if (photoRow > _nextRow)
    {
        _rows->skip(static_cast<int>(photoRow - _nextRow));
    }
    _rows->read(row);
    _nextRow = photoRow + 1;
    if (_nextRow == _photo.height)
    {
        _failure = _rows->finish();
        _rows.reset();
    }
}

/// Makes what lies between the parts that are used flat: it costs next to nothing then.
void PhotoPainter::keepUsed(std::int64_t photoRow, std::uint8_t* row) const
{
    const int channels = _settings.channels;
    std::vector<std::uint8_t> flat(std::size_t(_box.width) * channels);
    fillPixels(flat.data(), _box.width, channels, _settings.background);
    for (const PixelRect& part : _photo.used)
    {
        if (photoRow >= part.y && photoRow < part.y + part.height)
        {
            std::copy_n(row + part.x * channels, part.width * channels,
                        flat.data() + (part.x - _box.x) * channels);
        }
    }
    std::copy(flat.begin(), flat.end(), row + _box.x * channels);
}

std::shared_ptr<JpegCutter> PhotoPainter::findCutter(const PixelRect& inAtlas,
                                                     PixelRect& inPhoto) const
{
    const bool inside = inAtlas.x >= _place.x && inAtlas.y >= _place.y &&
                        inAtlas.x + inAtlas.width <= _place.x + _place.width &&
                        inAtlas.y + inAtlas.height <= _place.y + _place.height;
    inPhoto = {inAtlas.x - _photo.x, inAtlas.y - _photo.y, inAtlas.width, inAtlas.height};
    // A file that is broken further down shows the background there.
    const bool usable = _cutter && !_failed && inside && _photo.used.size() < 2;
    return usable && _cutter->canCut(inPhoto) ? _cutter : nullptr;
}

void PhotoPainter::repeatEdges(std::int64_t y, const std::uint8_t* firstPixel,
                               const std::uint8_t* lastPixel, LevelRows& rows) const
{
    const int channels = rows.getChannels();
    const std::int64_t end = rows.getX() + rows.getWidth();
    TileColor first{}, last{};
    std::copy_n(firstPixel, channels, first.begin());
    std::copy_n(lastPixel, channels, last.begin());
    const std::int64_t left = std::max(_covered.x, rows.getX());
    const std::int64_t placeEnd = _place.x + _place.width;
    const std::int64_t right = std::max(placeEnd, rows.getX());
    if (left < std::min(_place.x, end))
    {
        fillPixels(rows.at(left, y), std::min(_place.x, end) - left, channels, first);
    }
    if (right < std::min(_covered.x + _covered.width, end))
    {
        fillPixels(rows.at(right, y), std::min(_covered.x + _covered.width, end) - right, channels,
                   last);
    }
}

void PhotoPainter::paintRow(std::int64_t y, LevelRows& rows)
{
    const int channels = rows.getChannels();
    const std::int64_t end = rows.getX() + rows.getWidth();
    const std::int64_t left = std::max(_place.x, rows.getX());
    const std::int64_t right = std::min(_place.x + _place.width, end);
    const std::int64_t photoRow =
        std::clamp(y, _place.y, _place.y + _place.height - 1) - _place.y + _box.y;
    if (photoRow == _shownRow)
    {
        const std::int64_t from = std::max(_covered.x, rows.getX());
        const std::int64_t to = std::min(_covered.x + _covered.width, end);
        std::copy_n(rows.at(from, y - 1), (to - from) * channels, rows.at(from, y));
        return;
    }
    _shownRow = photoRow;
    const bool isWhole = _box.width == _photo.width && _photo.used.size() < 2;
    if (isWhole && left == _place.x && right == _place.x + _place.width)
    {
        std::uint8_t* row = rows.at(left, y);
        readRow(photoRow, row);
        repeatEdges(y, row, row + (_place.width - 1) * channels, rows);
        return;
    }
    _row.resize(std::size_t(_photo.width) * channels);
    readRow(photoRow, _row.data());
    if (_photo.used.size() > 1)
    {
        keepUsed(photoRow, _row.data());
    }
    const std::uint8_t* const box = _row.data() + _box.x * channels;
    if (left < right)
    {
        std::copy_n(box + (left - _place.x) * channels, (right - left) * channels,
                    rows.at(left, y));
    }
    repeatEdges(y, box, box + (_box.width - 1) * channels, rows);
}

void PhotoPainter::paint(std::int64_t y, std::int64_t endY, LevelRows& rows)
{
    const std::int64_t end = std::min(endY, _covered.y + _covered.height);
    y = std::max(y, _covered.y);
    try
    {
        for (; y < end && !_failed; ++y)
        {
            paintRow(y, rows);
        }
    }
    catch (const ImageError& error)
    {
        _failed = true;
        _failure = error.what();
        _rows.reset();
    }
    const std::int64_t left = std::max(_covered.x, rows.getX());
    const std::int64_t right = std::min(_covered.x + _covered.width, rows.getX() + rows.getWidth());
    for (; y < end; ++y)
    {
        fillPixels(rows.at(left, y), right - left, rows.getChannels(), _settings.background);
    }
}

} // namespace osgPagedTexture
