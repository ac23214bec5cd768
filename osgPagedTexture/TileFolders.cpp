// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileFolders.h>

#include <osgPagedTexture/FolderDescription.h>
#include <osgPagedTexture/StoreFile.h>

#include <filesystem>
#include <utility>

namespace osgPagedTexture
{

namespace fs = std::filesystem;

namespace
{

constexpr std::size_t MaxUniformFiles = 256;
constexpr std::uint64_t MaxTileBytes = std::uint64_t(1) << 30;

[[noreturn]] void refuse(const std::string& path, const std::string& what)
{
    throw TileStoreError(TileStoreError::Kind::Refused,
                         "osgPagedTexture::TileFolders: '" + path + "': " + what);
}

void makeFolder(const fs::path& path)
{
    std::error_code error;
    fs::create_directories(path, error);
    if (error)
    {
        throw TileStoreError(TileStoreError::Kind::Unwritable,
                             "osgPagedTexture::TileFolders: '" + path.string() +
                                 "' cannot be made: " + error.message() +
                                 "; name a folder that can be written");
    }
}

/// Replaces a file as a whole.
void replaceFile(const std::string& path, const std::string& bytes)
{
    const std::string part = path + ".part";
    try
    {
        StoreFile file(part, StoreFile::Mode::Create);
        file.write(bytes.data(), bytes.size(), 0);
        file.moveTo(path, false);
    }
    catch (const TileStoreError&)
    {
        std::error_code error;
        fs::remove(part, error);
        throw;
    }
}

} // namespace

std::string tileFileName(const std::string& path, FolderLayout layout,
                         const TileStoreSettings& settings, const TileKey& key)
{
    const std::string x = std::to_string(key.x), y = std::to_string(key.y);
    if (layout == FolderLayout::LibVT)
    {
        const std::string level = std::to_string(key.level);
        return path + "/tiles_b" + std::to_string(settings.grid.getBorder()) + "_level" + level +
               "/tile_" + level + "_" + x + "_" + y + "." + settings.format;
    }
    const int level = settings.grid.getLevels() - 1 - key.level;
    return fs::path(path).replace_extension().string() + "_files/" + std::to_string(level) + "/" +
           x + "_" + y + "." + settings.format;
}

TileFolderWriter::TileFolderWriter(const std::string& path, FolderLayout layout,
                                   const TileStoreSettings& settings, UniformEncoder encode)
    : _path(path), _layout(layout), _settings(settings), _encode(std::move(encode))
{
    const bool deepZoom = layout == FolderLayout::DeepZoom;
    if (deepZoom && fs::path(path).extension() != ".dzi")
    {
        refuse(path, "does not end in .dzi; name a Deep Zoom picture so");
    }
    if (deepZoom != (settings.grid.getEdge() == TileGrid::Edge::Clipped))
    {
        refuse(path, deepZoom ? "Deep Zoom has clipped tiles; use a clipped grid"
                              : "LibVT's tiles have one size; use a padded grid");
    }
    for (int level = 0; level < settings.grid.getLevels(); ++level)
    {
        makeFolder(fs::path(tileFileName(path, layout, settings, {level, 0, 0})).parent_path());
    }
}

void TileFolderWriter::put(const TileKey& key, const TileData& tile)
{
    if (!_settings.grid.contains(key))
    {
        refuse(_path, "tile " + std::to_string(key.x) + ", " + std::to_string(key.y) +
                          " of level " + std::to_string(key.level) +
                          " lies outside; name a tile of the grid");
    }
    const std::string file = tileFileName(_path, _layout, _settings, key);
    if (tile.kind == TileData::Kind::None)
    {
        std::error_code error; // none was there, or the reader will meet it
        fs::remove(file, error);
        return;
    }
    replaceFile(file, tile.kind == TileData::Kind::Encoded
                          ? tile.bytes
                          : uniformFile(tile.color, _settings.grid.getPixels(key)));
}

const std::string& TileFolderWriter::uniformFile(const TileColor& color, const PixelRect& pixels)
{
    if (_uniformFiles.size() >= MaxUniformFiles)
    {
        _uniformFiles.clear();
    }
    std::string& file =
        _uniformFiles[{color[0], color[1], color[2], color[3], pixels.width, pixels.height}];
    if (file.empty())
    {
        file = _encode(color, static_cast<int>(pixels.width), static_cast<int>(pixels.height));
    }
    return file;
}

void TileFolderWriter::commit()
{
    replaceFile(descriptionFile(_path, _layout), writeDescription(_layout, _settings));
}

TileFolderReader::TileFolderReader(const std::string& path, FolderLayout layout)
    : _path(path), _layout(layout), _settings(readDescription(path, layout))
{
}

TileData TileFolderReader::read(const TileKey& key) const
{
    const std::string name = tileFileName(_path, _layout, _settings, key);
    std::error_code error;
    if (!_settings.grid.contains(key) || (!fs::exists(name, error) && !error))
    {
        return {};
    }
    const StoreFile file(name, StoreFile::Mode::Read);
    const std::uint64_t bytes = file.getBytes();
    if (bytes == 0 || bytes > MaxTileBytes)
    {
        throw TileStoreError(TileStoreError::Kind::Damaged,
                             "osgPagedTexture::TileFolders: '" + name + "' has " +
                                 std::to_string(bytes) +
                                 " bytes; a tile has 1 byte to 1 GiB: build the store anew");
    }
    std::string text(bytes, '\0');
    file.read(text.data(), text.size(), 0);
    return TileData::encoded(std::move(text));
}

} // namespace osgPagedTexture
