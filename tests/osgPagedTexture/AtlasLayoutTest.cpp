// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/TileStore.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace osgPagedTexture;

namespace
{

AtlasPhoto photo(const std::string& path, int width, int height)
{
    AtlasPhoto result;
    result.path = path;
    result.width = width;
    result.height = height;
    result.hash = path;
    return result;
}

/// Sizes as from several cameras, upright and lying, some cropped.
std::vector<AtlasPhoto> randomPhotos(std::size_t count, unsigned int seed)
{
    std::mt19937 random(seed);
    std::vector<AtlasPhoto> photos;
    for (std::size_t i = 0; i < count; ++i)
    {
        int width = 300 + int(random() % 700), height = width * 2 / 3;
        if (random() % 3 == 0)
        {
            std::swap(width, height);
        }
        photos.push_back(photo("p" + std::to_string(i) + ".jpg", width, height));
    }
    return photos;
}

/// Whether two photographs have both their paddings between them, asked of all pairs.
bool keepDistance(const AtlasLayout& layout)
{
    for (std::size_t i = 0; i < layout.photos.size(); ++i)
    {
        const PixelRect a = layout.photos[i].getPlace();
        for (std::size_t k = 0; k < i; ++k)
        {
            const PixelRect b = layout.photos[k].getPlace();
            const std::int64_t gap = 2 * layout.padding;
            if (a.x < b.x + b.width + gap && b.x < a.x + a.width + gap &&
                a.y < b.y + b.height + gap && b.y < a.y + a.height + gap)
            {
                return false;
            }
        }
    }
    return true;
}

std::vector<std::pair<std::int64_t, std::int64_t>> placesOf(const AtlasLayout& layout,
                                                            std::size_t count)
{
    std::vector<std::pair<std::int64_t, std::int64_t>> places;
    for (std::size_t i = 0; i < count; ++i)
    {
        places.push_back({layout.photos[i].x, layout.photos[i].y});
    }
    return places;
}

TEST(AtlasLayout, photographsKeepDistanceAndAlignment)
{
    for (const int padding : {0, 5, 12, 48})
    {
        AtlasSettings settings;
        settings.padding = padding;
        settings.alignmentOffset = 8;
        const AtlasLayout layout = packAtlas(randomPhotos(200, 1 + padding), settings);
        EXPECT_TRUE(keepDistance(layout)) << padding;
        EXPECT_NO_THROW(checkAtlas(layout));
        for (const AtlasPhoto& each : layout.photos)
        {
            EXPECT_EQ(each.x % 16, 8);
            EXPECT_EQ(each.y % 16, 8);
        }
    }
}

TEST(AtlasLayout, tilesStartAtBlocksOfEveryPhotograph)
{
    for (const int border : {0, 1, 8, 16, 24})
    {
        const int side = 256 + 2 * border;
        const AtlasLayout layout =
            packAtlas(randomPhotos(20, 3), AtlasSettings::forTiles(side, border));
        const TileGrid grid(layout.width, layout.height, side, border);
        for (const AtlasPhoto& each : layout.photos)
        {
            const PixelRect tile = grid.getPixels({0, 1, 1});
            EXPECT_EQ((tile.x - each.x) % 16, 0) << border;
            EXPECT_EQ((tile.y - each.y) % 16, 0) << border;
        }
    }
}

TEST(AtlasLayout, anAtlasIsAboutSquareAndWellFilled)
{
    AtlasSettings settings;
    settings.padding = 4;
    // Of such photographs' cells 94 % are pixels, the rest is padding and alignment.
    for (const auto& [count, share] :
         {std::pair(62, 0.85), std::pair(500, 0.88), std::pair(5000, 0.91)})
    {
        const AtlasLayout layout = packAtlas(randomPhotos(count, 7), settings);
        EXPECT_GT(layout.getOccupiedShare(), share) << count;
        EXPECT_LT(double(layout.width) / double(layout.height), 1.25) << count;
        EXPECT_GT(double(layout.width) / double(layout.height), 0.8) << count;
    }
}

TEST(AtlasLayout, theOrderOfTheListDoesNotCount)
{
    std::vector<AtlasPhoto> photos = randomPhotos(300, 2);
    const AtlasLayout forward = packAtlas(photos);
    std::reverse(photos.begin(), photos.end());
    AtlasLayout backward = packAtlas(photos);
    std::reverse(backward.photos.begin(), backward.photos.end());
    EXPECT_EQ(placesOf(forward, 300), placesOf(backward, 300));
}

TEST(AtlasLayout, aWidthThatIsAskedForIsKept)
{
    AtlasSettings settings;
    settings.maxWidth = 2000;
    const AtlasLayout layout = packAtlas(randomPhotos(300, 2), settings);
    EXPECT_LE(layout.width, 2000);
    EXPECT_TRUE(keepDistance(layout));
    settings.maxWidth = 100;
    EXPECT_EQ(packAtlas({photo("a", 600, 10), photo("b", 600, 10)}, settings).width, 600);
}

TEST(AtlasLayout, extremeSizesArePlaced)
{
    EXPECT_EQ(packAtlas({}).width, 1);
    EXPECT_EQ(packAtlas({}).photos.size(), 0u);
    const AtlasLayout one = packAtlas({photo("a", 1, 1)}, AtlasSettings{0, 1, 0, 0});
    EXPECT_EQ(one.width, 1);
    EXPECT_EQ(one.height, 1);
    std::vector<AtlasPhoto> photos;
    for (int i = 0; i < 100; ++i)
    {
        photos.push_back(photo("long" + std::to_string(i), 60000, 3));
        photos.push_back(photo("tall" + std::to_string(i), 3, 60000));
        photos.push_back(photo("dot" + std::to_string(i), 1, 1));
    }
    photos.push_back(photo("large", 100000, 100000));
    const AtlasLayout layout = packAtlas(photos);
    EXPECT_TRUE(keepDistance(layout));
    EXPECT_NO_THROW(checkAtlas(layout));
}

TEST(AtlasLayout, sameNamesInDifferentFoldersAreDifferentPhotographs)
{
    const AtlasLayout layout =
        packAtlas({photo("north/1.jpg", 64, 64), photo("south/1.jpg", 64, 64)});
    EXPECT_EQ(layout.photos.size(), 2u);
    EXPECT_TRUE(keepDistance(layout));
}

TEST(AtlasLayout, sizesThatMakeNoSenseAreRefused)
{
    EXPECT_THROW(packAtlas({photo("a", 0, 5)}), TileStoreError);
    EXPECT_THROW(packAtlas({}, AtlasSettings{-1, 16, 0, 0}), TileStoreError);
    EXPECT_THROW(packAtlas({}, AtlasSettings{0, 16, 16, 0}), TileStoreError);
    AtlasPhoto outside = photo("a", 10, 10);
    outside.used = {{5, 5, 6, 5}};
    EXPECT_THROW(packAtlas({outside}), TileStoreError);
}

TEST(AtlasLayout, onlyUsedPartsTakeRoom)
{
    std::vector<AtlasPhoto> pieces;
    for (int i = 0; i < 50; ++i)
    {
        AtlasPhoto piece = photo("p" + std::to_string(i), 4000, 3000);
        piece.used = {{1000 + 7 * i, 500, 100, 80}, {1050 + 7 * i, 560, 120, 90}};
        pieces.push_back(piece);
    }
    const AtlasLayout layout = packAtlas(pieces);
    EXPECT_LT(layout.width, 2500);
    EXPECT_TRUE(keepDistance(layout));
    EXPECT_NO_THROW(checkAtlas(layout));
    for (const AtlasPhoto& each : layout.photos)
    {
        EXPECT_EQ(((each.x % 16) + 16) % 16, 0);
    }
}

TEST(AtlasLayout, addedPhotographsLeaveTheOthersWhereTheyAre)
{
    AtlasLayout layout = packAtlas(randomPhotos(300, 5));
    const auto before = placesOf(layout, 300);
    std::vector<AtlasPhoto> more = randomPhotos(200, 6);
    addPhotos(layout, more);
    ASSERT_EQ(layout.photos.size(), 500u);
    EXPECT_EQ(placesOf(layout, 300), before);
    EXPECT_EQ(layout.photos[300].path, more[0].path);
    EXPECT_TRUE(keepDistance(layout));
    EXPECT_NO_THROW(checkAtlas(layout));
    EXPECT_GT(layout.getOccupiedShare(), 0.75);
}

TEST(AtlasLayout, aPhotographTakesThePlaceOfARemovedOneOfItsSize)
{
    const AtlasLayout full = packAtlas(randomPhotos(100, 8));
    for (std::size_t index = 0; index < 100; ++index)
    {
        AtlasLayout layout = full;
        AtlasPhoto back = layout.photos[index];
        back.path = "new";
        removePhoto(layout, index);
        addPhotos(layout, {back});
        EXPECT_EQ(layout.width, full.width) << index;
        EXPECT_EQ(layout.height, full.height) << index;
        EXPECT_TRUE(keepDistance(layout)) << index;
    }
}

TEST(AtlasLayout, aWiderPhotographWidensTheAtlas)
{
    AtlasLayout layout = packAtlas(randomPhotos(10, 8));
    addPhotos(layout, {photo("panorama", 9000, 100)});
    EXPECT_EQ(layout.width, 9000);
    EXPECT_NO_THROW(checkAtlas(layout));
}

TEST(AtlasLayout, aPhotographOfAnotherSizeStaysWhereItHasRoom)
{
    AtlasSettings settings;
    settings.padding = 0;
    settings.maxWidth = 64;
    const AtlasLayout layout = packAtlas({photo("a", 64, 32), photo("b", 60, 32)}, settings);
    EXPECT_TRUE(fitsInPlace(layout, 0, 40, 20));
    EXPECT_TRUE(fitsInPlace(layout, 1, 64, 32));
    EXPECT_FALSE(fitsInPlace(layout, 0, 64, 33)) << "lies over b";
    EXPECT_FALSE(fitsInPlace(layout, 1, 65, 32)) << "leaves the atlas";
}

TEST(AtlasLayout, coveredPixelsIncludeThePaddingInsideTheAtlas)
{
    AtlasSettings settings;
    settings.padding = 12;
    const AtlasLayout layout = packAtlas({photo("a", 100, 100), photo("b", 100, 100)}, settings);
    const bool side = layout.photos[1].x > layout.photos[0].x;
    const PixelRect covered = layout.getCovered(layout.photos[0]);
    EXPECT_EQ(covered.x, 0);
    EXPECT_EQ(side ? covered.width : covered.height, 112);
    EXPECT_EQ(side ? covered.height : covered.width, 100);
}

TEST(AtlasLayout, theContentHashIsThatOfPixelsAndPlaces)
{
    const AtlasLayout layout = packAtlas(randomPhotos(5, 1));
    AtlasLayout other = layout;
    other.photos[2].path = "renamed";
    other.photos[2].modified = 77;
    other.pending = {{0, 0, 5, 5}};
    EXPECT_EQ(other.getContentHash(), layout.getContentHash());
    other.photos[2].hash = "other";
    EXPECT_NE(other.getContentHash(), layout.getContentHash());
    other = layout;
    other.photos[2].x += 16;
    EXPECT_NE(other.getContentHash(), layout.getContentHash());
}

} // namespace
