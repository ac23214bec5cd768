// SPDX-License-Identifier: MIT
#include <osgPagedTexture/FolderDescription.h>

#include <osgPagedTexture/StoreFile.h>

#include <nlohmann/json.hpp>

#include <charconv>
#include <filesystem>

namespace osgPagedTexture
{

namespace
{

using nlohmann::json;

constexpr std::uint64_t MaxDescriptionBytes = 64 << 20;

[[noreturn]] void damaged(const std::string& path, const std::string& what)
{
    throw TileStoreError(TileStoreError::Kind::Damaged,
                         "osgPagedTexture::TileFolders: '" + path + "': " + what +
                             "; copy the store again or build it anew");
}

std::string readAll(const std::string& path)
{
    const StoreFile file(path, StoreFile::Mode::Read);
    const std::uint64_t bytes = file.getBytes();
    if (bytes > MaxDescriptionBytes)
    {
        damaged(path, "is too large to describe a store");
    }
    std::string text(bytes, '\0');
    file.read(text.data(), text.size(), 0);
    return text;
}

/// The value of an attribute of any element of a small XML file.
std::string attribute(const std::string& path, const std::string& text, const std::string& name)
{
    for (std::size_t at = text.find(name + "="); at != std::string::npos;
         at = text.find(name + "=", at + 1))
    {
        const std::size_t quote = at + name.size() + 1;
        const bool whole = at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\n' ||
                                      text[at - 1] == '\t' || text[at - 1] == '\r');
        const std::size_t end =
            quote < text.size() ? text.find(text[quote], quote + 1) : std::string::npos;
        if (whole && end != std::string::npos && (text[quote] == '"' || text[quote] == '\''))
        {
            return text.substr(quote + 1, end - quote - 1);
        }
    }
    damaged(path, "has no attribute " + name);
}

std::int64_t number(const std::string& path, const std::string& text, const std::string& name)
{
    const std::string digits = attribute(path, text, name);
    std::int64_t value = 0;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    // Far above any tile and below what sums of it could overflow.
    if (result.ec != std::errc() || result.ptr != digits.data() + digits.size() || value < 0 ||
        value > TileGrid::MaxSide)
    {
        damaged(path, "attribute " + name + " is '" + digits + "', no number of pixels");
    }
    return value;
}

int sideOf(const std::string& path, std::int64_t value)
{
    if (value < 0 || value > (1 << 20))
    {
        damaged(path, "tiles of " + std::to_string(value) + " pixels are too large");
    }
    return static_cast<int>(value);
}

TileStoreSettings readDeepZoom(const std::string& path)
{
    const std::string text = readAll(path);
    const int border = sideOf(path, number(path, text, "Overlap"));
    const int payload = sideOf(path, number(path, text, "TileSize"));
    TileStoreSettings settings;
    settings.grid = TileGrid(number(path, text, "Width"), number(path, text, "Height"),
                             payload + 2 * border, border, TileGrid::Edge::Clipped);
    settings.format = attribute(path, text, "Format");
    return settings;
}

TileStoreSettings readLibVT(const std::string& path)
{
    const std::string file = descriptionFile(path, FolderLayout::LibVT);
    const json text = json::parse(readAll(file), nullptr, false);
    const auto integer = [&](const char* name) -> std::int64_t
    {
        if (!text.is_object() || !text.contains(name) || !text[name].is_number_integer())
        {
            damaged(file, std::string("has no number ") + name);
        }
        return text[name].get<std::int64_t>();
    };
    const auto word = [&](const char* name) -> std::string
    {
        const bool there = text.contains(name) && text[name].is_string();
        return there ? text[name].get<std::string>() : std::string();
    };
    TileStoreSettings settings;
    settings.grid = TileGrid(integer("width"), integer("height"), sideOf(file, integer("tileSide")),
                             sideOf(file, integer("border")));
    settings.format = word("format");
    settings.description = word("description");
    return settings;
}

} // namespace

std::string descriptionFile(const std::string& path, FolderLayout layout)
{
    return layout == FolderLayout::LibVT ? (std::filesystem::path(path) / "tiles.json").string()
                                         : path;
}

std::string writeDescription(FolderLayout layout, const TileStoreSettings& settings)
{
    const TileGrid& grid = settings.grid;
    if (layout == FolderLayout::LibVT)
    {
        const json text = {{"width", grid.getWidth()},           {"height", grid.getHeight()},
                           {"tileSide", grid.getTileSide()},     {"border", grid.getBorder()},
                           {"levels", grid.getLevels()},         {"format", settings.format},
                           {"description", settings.description}};
        return text.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
    }
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<Image xmlns=\"http://schemas.microsoft.com/deepzoom/2008\" Format=\"" +
           settings.format + "\" Overlap=\"" + std::to_string(grid.getBorder()) + "\" TileSize=\"" +
           std::to_string(grid.getPayload()) + "\">\n  <Size Width=\"" +
           std::to_string(grid.getWidth()) + "\" Height=\"" + std::to_string(grid.getHeight()) +
           "\"/>\n</Image>\n";
}

TileStoreSettings readDescription(const std::string& path, FolderLayout layout)
{
    TileStoreSettings settings =
        layout == FolderLayout::LibVT ? readLibVT(path) : readDeepZoom(path);
    // It becomes a part of file names.
    if (settings.format.empty() || settings.format.find_first_of("/\\.") != std::string::npos)
    {
        damaged(descriptionFile(path, layout), "'" + settings.format + "' is no tile format");
    }
    return settings;
}

} // namespace osgPagedTexture
