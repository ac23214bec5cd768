// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasLayout.h>

#include <osgPagedTexture/AtlasCells.h>
#include <osgPagedTexture/ContentHash.h>
#include <osgPagedTexture/TileStore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace osgPagedTexture
{

namespace
{

constexpr int MaxPadding = 65536;
constexpr int MaxAlignment = 4096;

[[noreturn]] void refuse(const std::string& what)
{
    throw TileStoreError(TileStoreError::Kind::Refused, "osgPagedTexture::AtlasLayout: " + what);
}

std::string sizeText(std::int64_t width, std::int64_t height)
{
    return std::to_string(width) + " x " + std::to_string(height);
}

void checkPhoto(const AtlasPhoto& photo)
{
    if (photo.width < 1 || photo.height < 1)
    {
        refuse("photograph '" + photo.path + "' of " + sizeText(photo.width, photo.height) +
               " pixels has no place; leave it out");
    }
    for (const PixelRect& part : photo.used)
    {
        if (part.x < 0 || part.y < 0 || part.width < 1 || part.height < 1 ||
            part.width > photo.width - part.x || part.height > photo.height - part.y)
        {
            refuse("a used part of photograph '" + photo.path +
                   "' is empty or outside of it; make its parts again");
        }
    }
}

std::vector<AtlasCell> cellsOf(const AtlasLayout& layout, const std::vector<AtlasPhoto>& photos)
{
    std::vector<AtlasCell> cells;
    cells.reserve(photos.size());
    for (const AtlasPhoto& photo : photos)
    {
        cells.push_back(cellOf(layout, photo));
    }
    return cells;
}

/// By the photographs' names, so that the order of the list does not count.
std::vector<AtlasCell*> inOrder(std::vector<AtlasCell>& cells,
                                const std::vector<AtlasPhoto>& photos)
{
    std::vector<std::size_t> order(photos.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return photos[a].path < photos[b].path; });
    std::vector<AtlasCell*> ordered;
    for (const std::size_t i : order)
    {
        ordered.push_back(&cells[i]);
    }
    return ordered;
}

std::vector<AtlasCell*> largestFirst(std::vector<AtlasCell*> cells)
{
    std::stable_sort(cells.begin(), cells.end(),
                     [](const AtlasCell* a, const AtlasCell* b)
                     { return a->width * a->height > b->width * b->height; });
    return cells;
}

/// Places the cells in the strip that is nearest to a square, of several widths around the root of
/// the area.
void packSquare(std::vector<AtlasCell>& cells, const std::vector<AtlasPhoto>& photos,
                std::int64_t least, std::int64_t most)
{
    double area = 0.0;
    for (const AtlasCell& cell : cells)
    {
        area += double(cell.width) * double(cell.height);
    }
    // A million photographs fill any width; few of them only some.
    const int tries = int(std::clamp<std::size_t>(200000 / (cells.size() + 1), 1, 64));
    const std::vector<AtlasCell*> ordered = inOrder(cells, photos);
    std::int64_t bestSide = std::numeric_limits<std::int64_t>::max();
    std::vector<AtlasCell> best;
    for (int i = 0; i < tries; ++i)
    {
        const double share = tries > 1 ? 0.98 + 0.3 * i / (tries - 1) : 1.02;
        const std::int64_t width =
            std::clamp<std::int64_t>(std::llround(std::sqrt(area) * share), least, most);
        AtlasSkyline skyline(width);
        skyline.placeAll(ordered);
        if (std::max(width, skyline.getBottom()) < bestSide)
        {
            bestSide = std::max(width, skyline.getBottom());
            best = cells;
        }
    }
    cells.swap(best);
}

void appendNumber(std::string& text, std::int64_t number)
{
    text += std::to_string(number);
    text += ' ';
}

} // namespace

PixelRect AtlasPhoto::getBox() const
{
    if (used.empty())
    {
        return {0, 0, width, height};
    }
    std::int64_t left = width, top = height, right = 0, bottom = 0;
    for (const PixelRect& part : used)
    {
        left = std::min(left, part.x);
        top = std::min(top, part.y);
        right = std::max(right, part.x + part.width);
        bottom = std::max(bottom, part.y + part.height);
    }
    return {left, top, right - left, bottom - top};
}

PixelRect AtlasPhoto::getPlace() const
{
    const PixelRect box = getBox();
    return {x + box.x, y + box.y, box.width, box.height};
}

AtlasSettings AtlasSettings::forTiles(int tileSide, int border, int cleanLevels)
{
    AtlasSettings settings;
    settings.padding = paddingForLevels(cleanLevels);
    const int payload = tileSide - 2 * border;
    settings.alignment = 16; // the largest block of a JPEG with halved colour
    settings.alignmentOffset = payload % settings.alignment == 0 ? (16 - border % 16) % 16 : 0;
    return settings;
}

PixelRect AtlasLayout::getCovered(const AtlasPhoto& photo) const
{
    const PixelRect place = photo.getPlace();
    const std::int64_t left = std::max<std::int64_t>(place.x - padding, 0);
    const std::int64_t top = std::max<std::int64_t>(place.y - padding, 0);
    return {left, top, std::min(place.x + place.width + padding, width) - left,
            std::min(place.y + place.height + padding, height) - top};
}

std::string AtlasLayout::getContentHash() const
{
    std::string text;
    for (const std::int64_t number : {width, height, std::int64_t(padding)})
    {
        appendNumber(text, number);
    }
    for (const AtlasPhoto& photo : photos)
    {
        text += photo.hash;
        for (const std::int64_t number :
             {std::int64_t(photo.width), std::int64_t(photo.height), photo.x, photo.y})
        {
            appendNumber(text, number);
        }
        for (const PixelRect& part : photo.used)
        {
            for (const std::int64_t number : {part.x, part.y, part.width, part.height})
            {
                appendNumber(text, number);
            }
        }
        text += '\n';
    }
    return hashText(text).text();
}

double AtlasLayout::getOccupiedShare() const
{
    double pixels = 0.0;
    for (const AtlasPhoto& photo : photos)
    {
        const PixelRect place = photo.getPlace();
        pixels += double(place.width) * double(place.height);
    }
    return pixels / (double(width) * double(height));
}

AtlasLayout packAtlas(std::vector<AtlasPhoto> photos, const AtlasSettings& settings)
{
    if (settings.padding < 0 || settings.padding > MaxPadding || settings.alignment < 1 ||
        settings.alignment > MaxAlignment || settings.alignmentOffset < 0 ||
        settings.alignmentOffset >= settings.alignment || settings.maxWidth < 0)
    {
        refuse("padding must be in 0..65536, alignment in 1..4096 and its offset below that");
    }
    AtlasLayout layout;
    layout.padding = settings.padding;
    layout.alignment = settings.alignment;
    layout.alignmentOffset = settings.alignmentOffset;
    std::for_each(photos.begin(), photos.end(), checkPhoto);
    std::vector<AtlasCell> cells = cellsOf(layout, photos);
    std::int64_t widest = 1;
    for (const AtlasCell& cell : cells)
    {
        widest = std::max(widest, cell.width);
    }
    const std::int64_t most = settings.maxWidth > 0
                                  ? std::max(unitsIn(layout, settings.maxWidth), widest)
                                  : std::max(unitsIn(layout, TileGrid::MaxSide), widest);
    packSquare(cells, photos, widest, most);
    for (std::size_t i = 0; i < photos.size(); ++i)
    {
        moveToCell(layout, photos[i], cells[i].x, cells[i].y);
    }
    layout.photos = std::move(photos);
    growAroundPhotos(layout);
    return layout;
}

void addPhotos(AtlasLayout& layout, std::vector<AtlasPhoto> photos)
{
    std::for_each(photos.begin(), photos.end(), checkPhoto);
    std::vector<AtlasCell> cells = cellsOf(layout, layout.photos);
    std::vector<AtlasCell> added = cellsOf(layout, photos);
    std::int64_t width = std::max<std::int64_t>(unitsIn(layout, layout.width), 1);
    for (const AtlasCell& cell : added)
    {
        width = std::max(width, cell.width);
    }
    const std::size_t tries = std::clamp<std::size_t>(4000000 / (photos.size() + 1), 64, 100000);
    // The last cells of rows and columns may begin where the atlas leaves less than their units.
    const int rest = layout.alignment - 1;
    AtlasHoles holes(unitsIn(layout, layout.width + rest), unitsIn(layout, layout.height + rest),
                     cells);
    std::vector<AtlasCell*> below;
    for (AtlasCell* const cell : largestFirst(inOrder(added, photos)))
    {
        AtlasPhoto& photo = photos[static_cast<std::size_t>(cell - added.data())];
        const auto isInside = [&](const AtlasCell& place)
        {
            moveToCell(layout, photo, place.x, place.y);
            const PixelRect pixels = photo.getPlace();
            return pixels.x + pixels.width <= layout.width &&
                   pixels.y + pixels.height <= layout.height;
        };
        holes.place(*cell, tries, isInside) ? cells.push_back(*cell) : below.push_back(cell);
    }
    AtlasSkyline(width, cells).placeAll(below);
    for (std::size_t i = 0; i < photos.size(); ++i)
    {
        moveToCell(layout, photos[i], added[i].x, added[i].y);
        layout.photos.push_back(std::move(photos[i]));
    }
    growAroundPhotos(layout);
}

void removePhoto(AtlasLayout& layout, std::size_t index)
{
    layout.photos.erase(layout.photos.begin() + static_cast<std::ptrdiff_t>(index));
}

bool fitsInPlace(const AtlasLayout& layout, std::size_t index, int width, int height)
{
    AtlasPhoto photo = layout.photos[index];
    photo.width = width;
    photo.height = height;
    const PixelRect box = photo.getBox();
    if (!photo.used.empty())
    {
        return box.x + box.width <= width && box.y + box.height <= height;
    }
    const PixelRect place = photo.getPlace();
    const AtlasCell cell = cellOf(layout, photo);
    const auto isFree = [&](const AtlasPhoto& other)
    { return &other == &layout.photos[index] || !cellOf(layout, other).overlaps(cell); };
    return place.x + place.width <= layout.width && place.y + place.height <= layout.height &&
           std::all_of(layout.photos.begin(), layout.photos.end(), isFree);
}

void checkAtlas(const AtlasLayout& layout)
{
    const auto damaged = [](const std::string& what) {
        throw TileStoreError(TileStoreError::Kind::Damaged,
                             "osgPagedTexture::AtlasLayout: " + what);
    };
    std::for_each(layout.photos.begin(), layout.photos.end(), checkPhoto);
    AtlasLayout pixels; // places, without padding and alignment
    std::vector<AtlasCell> places = cellsOf(pixels, layout.photos);
    AtlasCellIndex index(places);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        const AtlasPhoto& photo = layout.photos[i];
        const AtlasCell& place = places[i];
        if (place.x < 0 || place.y < 0 || place.right() > layout.width ||
            place.bottom() > layout.height)
        {
            damaged("photograph '" + photo.path + "' at " + std::to_string(photo.x) + ", " +
                    std::to_string(photo.y) + " is not inside of the atlas of " +
                    sizeText(layout.width, layout.height) + " pixels; make the layout anew");
        }
        index.anyOver(place,
                      [&](std::size_t other)
                      {
                          damaged("photographs '" + layout.photos[other].path + "' and '" +
                                  photo.path + "' lie over each other; make the layout anew");
                          return true;
                      });
        index.add(place);
    }
}

} // namespace osgPagedTexture
