// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/TileGrid.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace osgPagedTexture
{

/// Why a store could not be read or written: one line with file, cause and remedy.
class OSGPAGEDTEXTURE_EXPORT TileStoreError : public std::runtime_error
{
public:
    enum class Kind
    {
        Unreadable, ///< Missing, no right to it, or the disk fails.
        Unwritable, ///< Disk full or read-only; what was committed before is unharmed.
        Damaged,    ///< Bytes are not what was written.
        Busy,       ///< Another process writes it.
        Refused     ///< The numbers asked for make no sense.
    };
    TileStoreError(Kind kind, const std::string& line) : std::runtime_error(line), _kind(kind) {}
    Kind getKind() const { return _kind; }

private:
    Kind _kind;
};

using TileColor = std::array<std::uint8_t, 4>; ///< Red, green, blue (sRGB), alpha.

/// What a store knows of one tile.
struct TileData
{
    enum class Kind
    {
        None,    ///< Nothing is there.
        Uniform, ///< All pixels have one colour.
        Encoded  ///< The bytes of a picture file.
    };
    Kind kind = Kind::None;
    TileColor color{};
    std::string bytes;

    static TileData uniform(const TileColor& color) { return {Kind::Uniform, color, {}}; }
    static TileData encoded(std::string bytes) { return {Kind::Encoded, {}, std::move(bytes)}; }
    bool operator==(const TileData& other) const
    {
        return kind == other.kind && color == other.color && bytes == other.bytes;
    }
};

/// What holds for all tiles of a store.
struct TileStoreSettings
{
    TileGrid grid;
    std::string format =
        "jpg"; ///< File name extension of the tiles: jpg, png or dds; up to 7 letters.
    std::string description; ///< Free text of the builder, for instance its settings as JSON.
};

/// Takes the tiles of a store, from one thread. A writer that ends without commit() leaves a packed
/// store as it was.
class OSGPAGEDTEXTURE_EXPORT TileWriter
{
public:
    virtual ~TileWriter() = default;

    /// Sets a tile; Kind::None takes it away. Throws TileStoreError, also for a key outside.
    virtual void put(const TileKey& key, const TileData& tile) = 0;

    /// Makes all that was put since the last commit what readers find, at once where the kind of
    /// store can do that. Throws TileStoreError.
    virtual void commit() = 0;
};

/// Reads a store. Any number of threads at once.
class OSGPAGEDTEXTURE_EXPORT TileReader
{
public:
    virtual ~TileReader() = default;
    virtual const TileStoreSettings& getSettings() const = 0;

    /// Throws TileStoreError where the tile is damaged or unreadable. A tile outside is None.
    virtual TileData read(const TileKey& key) const = 0;
};

/// Encodes a picture of one colour, for stores that need a file for each tile.
using UniformEncoder = std::function<std::string(const TileColor& color, int width, int height)>;

/// Opens a packed store (a file), a folder of LibVT's layout, or a Deep Zoom picture (.dzi).
/// Throws TileStoreError.
OSGPAGEDTEXTURE_EXPORT std::unique_ptr<TileReader> openTileStore(const std::string& path);

} // namespace osgPagedTexture
