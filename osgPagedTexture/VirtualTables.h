// SPDX-License-Identifier: MIT
// The texture that tells shaders where pages are. Not installed.
#pragma once

#include <osgPagedTexture/TileGrid.h>
#include <osgPagedTexture/UploadTexture.h>
#include <osgPagedTexture/VirtualPager.h>

#include <map>

namespace osgPagedTexture
{

/// Page tables of several virtual textures in one texture of 32-bit integers, with what shaders
/// need to know beside them (virtual.glsl):
///
///     row i                 of texture i: width, height, payload and border, levels, and where
///                           each of these begins
///     the next ones         when the page of each slot came, as the bits of a float
///     below                 the tables
///
/// For one graphics context.
class VirtualTables
{
public:
    explicit VirtualTables(int slots);

    void add(std::uint32_t texture, const TileGrid& grid);
    void apply(const TablePatch& patch);
    /// The finest level in the texture's table.
    int finestOf(std::uint32_t texture) const;
    /// Where the texture's coarsest page is, as PageEntry; Empty before it is there.
    std::uint32_t coarsestOf(std::uint32_t texture) const;
    /// The page of a slot came at this time, in seconds.
    void setTime(int slot, float seconds);

    /// Makes the texture what the tables are.
    void upload(osg::State& state);
    UploadTexture* getTexture() const { return _texture.get(); }
    int getTimeRow() const { return _timeRow; }

    static constexpr unsigned int MaxTextures = 65535; ///< What shaders and feedback can number.

private:
    struct Table
    {
        TileGrid grid;
        std::shared_ptr<const PageTableLayout> layout;
        int row = 0; ///< The first one of its entries.
    };
    void arrange();
    void writeHeader(std::uint32_t number, const Table& table);
    void touch(int row, int rows);
    std::uint32_t* rowAt(int row) { return _words.data() + std::size_t(row) * _width; }

    const int _slots;
    std::map<std::uint32_t, Table> _tables;
    std::vector<float> _times;
    std::vector<std::uint32_t> _words;
    int _width = 0, _height = 0, _timeRow = 0;
    bool _isArranged = false;
    int _firstTouched = 0, _lastTouched = -1;
    osg::ref_ptr<UploadTexture> _texture;
};

} // namespace osgPagedTexture
