// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasPicture.h>

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/OiioModule.h>
#include <osgPagedTexture/TileWalk.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace osgPagedTexture
{

namespace fs = std::filesystem;

namespace
{

using Kind = TileStoreError::Kind;

/// A picture that takes its place when it is complete.
class Part
{
public:
    Part(const std::string& path, const PixelRect& area, int channels)
        : _path(path), _temporary(temporaryName(path)), _area(area)
    {
        try
        {
            _picture =
                oiioFunctions().openWriter(_temporary, int(area.width), int(area.height), channels);
        }
        catch (const ImageError& error) // the module is not there
        {
            throw TileStoreError(Kind::Unwritable, error.what());
        }
    }

    const PixelRect& getArea() const { return _area; }
    void write(const std::uint8_t* row) { _picture->write(row); }
    void finish()
    {
        _picture->finish();
        std::error_code error;
        fs::rename(_temporary, _path, error);
        if (error)
        {
            throw TileStoreError(Kind::Unwritable, "osgPagedTexture::AtlasPicture: '" + _path +
                                                       "' cannot be replaced: " + error.message());
        }
    }

private:
    /// The ending says the format, so that it has to stay.
    static std::string temporaryName(const fs::path& path)
    {
        return (path.parent_path() / path.stem()).string() + ".part" + path.extension().string();
    }

    const std::string _path, _temporary;
    const PixelRect _area;
    std::unique_ptr<PictureWriter> _picture;
};

/// The parts that hold any of some pixels.
class Parts
{
public:
    Parts(const AtlasLayout& layout, const AtlasPictureSettings& settings, const PixelRect& changed)
        : _settings(settings), _width(layout.width), _height(layout.height)
    {
        const std::int64_t side = settings.partSide;
        _first = std::max<std::int64_t>(changed.x, 0) / side;
        _top = std::max<std::int64_t>(changed.y, 0) / side;
        _last = (std::min(changed.x + changed.width, _width) + side - 1) / side;
        _bottom = (std::min(changed.y + changed.height, _height) + side - 1) / side;
    }

    bool empty() const { return _first >= _last || _top >= _bottom; }
    PixelRect getWindow() const
    {
        const std::int64_t side = _settings.partSide;
        return {_first * side, _top * side, std::min(_last * side, _width) - _first * side,
                std::min(_bottom * side, _height) - _top * side};
    }

    /// Rows from the top of the window on.
    void write(std::int64_t y, const std::uint8_t* pixels, std::vector<std::string>& files)
    {
        const std::int64_t side = _settings.partSide;
        if (y % side == 0)
        {
            open(y / side, files);
        }
        for (Part& part : _open)
        {
            part.write(pixels + (part.getArea().x - _first * side) * _settings.channels);
        }
        if (y + 1 == std::min((y / side + 1) * side, _height))
        {
            for (Part& part : _open)
            {
                part.finish();
            }
            _open.clear();
        }
    }

private:
    void open(std::int64_t row, std::vector<std::string>& files)
    {
        const std::int64_t side = _settings.partSide;
        for (std::int64_t column = _first; column < _last; ++column)
        {
            const PixelRect area{column * side, row * side, std::min(side, _width - column * side),
                                 std::min(side, _height - row * side)};
            files.push_back(nameOf(column, row));
            _open.emplace_back(files.back(), area, _settings.channels);
        }
    }
    std::string nameOf(std::int64_t column, std::int64_t row) const
    {
        if (_width <= _settings.partSide && _height <= _settings.partSide)
        {
            return _settings.path;
        }
        const fs::path path = _settings.path;
        return (path.parent_path() / path.stem()).string() + "_" + std::to_string(column) + "_" +
               std::to_string(row) + path.extension().string();
    }

    const AtlasPictureSettings& _settings;
    const std::int64_t _width, _height;
    std::int64_t _first, _top, _last, _bottom; ///< In parts, the last ones not included.
    std::vector<Part> _open;
};

} // namespace

AtlasPictureReport writeAtlas(const AtlasLayout& layout, const std::string& folder,
                              const AtlasPictureSettings& settings, const PixelRect& changed,
                              const TileBuilder::Progress& progress)
{
    constexpr std::int64_t mostSide = 1 << 30;
    if (settings.partSide < 1 || settings.partSide > mostSide)
    {
        throw TileStoreError(Kind::Refused,
                             "osgPagedTexture::AtlasPicture: a part's side is 1 to 2^30 pixels, "
                             "not " +
                                 std::to_string(settings.partSide));
    }
    checkAtlas(layout);
    AtlasPictureReport report;
    Parts parts(layout, settings, changed);
    if (parts.empty())
    {
        return report;
    }
    WalkSettings walk;
    walk.folder = folder;
    walk.window = parts.getWindow();
    walk.bandRows = 64;
    walk.channels = settings.channels;
    walk.background = settings.background;
    CoreTeam team(settings.threads);
    TileWalk tileWalk(layout, walk, {}, team);
    tileWalk.lastLevelRow = [&](std::int64_t y, const std::uint8_t* pixels)
    { parts.write(y, pixels, report.files); };
    tileWalk.progress = [&](std::int64_t rows)
    {
        if (progress)
        {
            progress(std::uint64_t(rows), std::uint64_t(walk.window.height));
        }
    };
    tileWalk.run();
    report.failures = tileWalk.getFailures();
    return report;
}

} // namespace osgPagedTexture
