// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/TileGrid.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// A photograph, or a piece of one, and its place in an atlas.
struct AtlasPhoto
{
    std::string path; ///< Of the file, relative to the folder of the layout's file, with '/'.
    int width = 0;    ///< Of the whole photograph as shown, in pixels.
    int height = 0;
    std::uint64_t bytes = 0;   ///< Of the file.
    std::int64_t modified = 0; ///< In ns since 1970; 0: unknown, only the content tells.
    std::string hash;          ///< Of the file's content, ContentHash::text().

    /// Of the photograph's top left corner, from the atlas's top left corner. Negative only where a
    /// piece is placed whose photograph's corner is not in it.
    std::int64_t x = 0;
    std::int64_t y = 0;

    /// Which parts are placed, in pixels from the photograph's top left corner; empty: all of it.
    /// Pieces of a photograph that have places of their own are several AtlasPhoto of one path.
    std::vector<PixelRect> used;

    /// What encloses the placed parts, in pixels of the photograph.
    OSGPAGEDTEXTURE_EXPORT PixelRect getBox() const;
    /// The same in pixels of the atlas.
    OSGPAGEDTEXTURE_EXPORT PixelRect getPlace() const;
};

struct AtlasSettings
{
    /// Pixels around each photograph that repeat its edge, 0 to 65536; see paddingForLevels().
    int padding = 12;
    /// A photograph's x and y are a multiple of this plus the offset, 1 to 4096. Where tiles start
    /// at the same places within blocks of a JPEG they can be cut without decoding.
    int alignment = 16;
    int alignmentOffset = 0;   ///< 0 to alignment - 1.
    std::int64_t maxWidth = 0; ///< Of the atlas, unless one photograph is wider; 0: about square.

    /// For tiles whose level 0 is cut from JPEGs without loss, wherever their distance (the side
    /// less both borders) is a multiple of 16.
    OSGPAGEDTEXTURE_EXPORT static AtlasSettings forTiles(int tileSide, int border,
                                                         int cleanLevels = 3);
};

/// The padding with which bilinear lookups on levels 0 to `levels` see no other photograph.
inline int paddingForLevels(int levels)
{
    return levels > 0 ? 3 << (levels - 1) : 2; // a texel and a half of the coarsest one
}

/// Where photographs lie in one large picture, which need not exist. Places are pinned: adding and
/// removing photographs leaves the others where they are.
struct AtlasLayout
{
    std::int64_t width = 1;
    std::int64_t height = 1;
    int padding = 0;
    int alignment = 1;
    int alignmentOffset = 0;
    std::vector<AtlasPhoto> photos;

    /// Where photographs that are added later are looked for, relative to the folder of the
    /// layout's file; empty: nowhere.
    std::string photoFolder;

    /// Parts of the atlas of which a tile store made from an earlier state may hold other pixels:
    /// what an update has still to do. Outside of the atlas they count for nothing.
    std::vector<PixelRect> pending;
    /// What getContentHash() was of the layout that such a store was made from; else empty.
    std::string pendingSince;

    /// A photograph's place and its padding, inside the atlas.
    OSGPAGEDTEXTURE_EXPORT PixelRect getCovered(const AtlasPhoto& photo) const;

    /// Of the picture, what photographs take without their padding: 0 to 1.
    OSGPAGEDTEXTURE_EXPORT double getOccupiedShare() const;

    /// Stands for all that decides a store's pixels: sizes, places and contents, not names, times
    /// or what is pending. 32 hexadecimal digits.
    OSGPAGEDTEXTURE_EXPORT std::string getContentHash() const;
};

/// Places photographs of any number and size, about square, the same whatever their order. They
/// keep their order in the list. n log n for n photographs of like sizes, n^1.5 at most. Throws
/// TileStoreError::Kind::Refused for sizes below 1 and settings out of range.
OSGPAGEDTEXTURE_EXPORT AtlasLayout packAtlas(std::vector<AtlasPhoto> photos,
                                             const AtlasSettings& settings = {});

/// Places more photographs into free space, else below the others; they come last in the list. The
/// atlas gets wider only for a photograph that is wider. Throws as packAtlas().
OSGPAGEDTEXTURE_EXPORT void addPhotos(AtlasLayout& layout, std::vector<AtlasPhoto> photos);

/// Takes a photograph out of the list. The atlas keeps its size.
OSGPAGEDTEXTURE_EXPORT void removePhoto(AtlasLayout& layout, std::size_t index);

/// Whether a photograph of this size, instead of the one at `index`, leaves the others room.
OSGPAGEDTEXTURE_EXPORT bool fitsInPlace(const AtlasLayout& layout, std::size_t index, int width,
                                        int height);

/// Throws TileStoreError::Kind::Damaged where a photograph is not in the atlas or lies over another
/// one, naming it.
OSGPAGEDTEXTURE_EXPORT void checkAtlas(const AtlasLayout& layout);

/// A layout's file: JSON, a line for each photograph. Replaced as a whole, and on the disk on
/// return. Throws TileStoreError, also for names that are not UTF-8.
OSGPAGEDTEXTURE_EXPORT void writeAtlasLayout(const std::string& path, const AtlasLayout& layout);

/// Reads and checks it. Throws TileStoreError, which names the file and what is wrong in it.
OSGPAGEDTEXTURE_EXPORT AtlasLayout readAtlasLayout(const std::string& path);

/// The right to change a layout's file and what is made of it, held until the end of the object or
/// of the process.
class OSGPAGEDTEXTURE_EXPORT AtlasLock
{
public:
    /// Throws TileStoreError::Kind::Busy where another process holds it for longer than this.
    explicit AtlasLock(const std::string& layoutPath, double waitSeconds = 0.0);
    ~AtlasLock();

private:
    struct Content;
    std::unique_ptr<Content> _content;
};

/// Reads a photograph's header, and its whole file for the hash. `folder` is that of the layout's
/// file; nothing but `path` goes into the result. Throws ImageError.
OSGPAGEDTEXTURE_EXPORT AtlasPhoto describePhoto(const std::string& folder, const std::string& path);

} // namespace osgPagedTexture
