// SPDX-License-Identifier: MIT
// Each update is compared, byte for byte, with a full build from the same layout.
#include "UpdateSamples.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

void changeAll(const UpdateSample& sample)
{
    for (const AtlasPhoto& photo : sample.layout().photos)
    {
        sample.writePhoto(fs::path(photo.path).filename().string(), photo.width, photo.height, 77);
    }
}

TileUpdateReport update(const UpdateSample& sample)
{
    TileUpdateSettings settings;
    settings.threads = 2;
    settings.pack.durable = false;
    return updateTileStore(sample.store(), settings);
}

class TileUpdate : public testing::TestWithParam<const char*>
{
};

TEST_P(TileUpdate, nothingHasChanged)
{
    const UpdateSample sample(20, 1, GetParam());
    sample.build();
    const std::string before = UpdateSample::bytesOf(sample.store());
    EXPECT_TRUE(update(sample).isNothing());
    EXPECT_EQ(UpdateSample::bytesOf(sample.store()), before);
}

TEST_P(TileUpdate, onePhotographHasChanged)
{
    const UpdateSample sample(62, 2, GetParam());
    sample.build();
    const AtlasPhoto photo = sample.layout().photos[30];
    sample.writePhoto(fs::path(photo.path).filename().string(), photo.width, photo.height, 999);
    const TileUpdateReport report = update(sample);
    EXPECT_EQ(report.changed, 1u);
    EXPECT_EQ(report.rebuilt, "");
    EXPECT_GT(report.changedTiles, 10u);
    EXPECT_LT(report.touchedTiles,
              TilePackReader(sample.store()).getSettings().grid.getTileCount() / 10);
    EXPECT_TRUE(sample.equalsFullBuild());
    EXPECT_TRUE(update(sample).isNothing());
}

TEST_P(TileUpdate, whatCannotBeReadIsTriedAgain)
{
    const UpdateSample sample(12, 3, GetParam());
    sample.build();
    const AtlasPhoto photo = sample.layout().photos[5];
    const std::string name = fs::path(photo.path).filename().string();
    sample.writePhoto(name, photo.width, photo.height, 999);
    fs::resize_file(sample.photo(name), fs::file_size(sample.photo(name)) / 2);
    for (int time = 0; time < 2; ++time)
    {
        const TileUpdateReport report = update(sample);
        ASSERT_EQ(report.failures.size(), 1u) << time;
        EXPECT_NE(report.failures.front().find(name), std::string::npos);
    }
    // The others are updated meanwhile.
    const AtlasPhoto other = sample.layout().photos[9];
    sample.writePhoto(fs::path(other.path).filename().string(), other.width, other.height, 998);
    EXPECT_EQ(update(sample).failures.size(), 1u);
    EXPECT_TRUE(sample.equalsFullBuild());

    sample.writePhoto(name, photo.width, photo.height, 999);
    EXPECT_TRUE(update(sample).failures.empty());
    EXPECT_TRUE(sample.equalsFullBuild());
    EXPECT_TRUE(update(sample).isNothing());
}

TEST_P(TileUpdate, everySinglePhotographCanChange)
{
    const UpdateSample sample(12, 3, GetParam());
    sample.build();
    for (std::size_t i = 0; i < 12; ++i)
    {
        const AtlasPhoto photo = sample.layout().photos[i];
        sample.writePhoto(fs::path(photo.path).filename().string(), photo.width, photo.height,
                          500 + unsigned(i));
        EXPECT_EQ(update(sample).changed, 1u);
        ASSERT_TRUE(sample.equalsFullBuild()) << photo.path;
    }
}

TEST_P(TileUpdate, severalPhotographsHaveChanged)
{
    const UpdateSample sample(40, 4, GetParam());
    sample.build();
    for (const std::size_t i : {3, 4, 5, 17, 39})
    {
        const AtlasPhoto photo = sample.layout().photos[i];
        sample.writePhoto(fs::path(photo.path).filename().string(), photo.width, photo.height,
                          700 + unsigned(i));
    }
    const TileUpdateReport report = update(sample);
    EXPECT_EQ(report.changed, 5u);
    EXPECT_EQ(report.rebuilt, "");
    EXPECT_TRUE(sample.equalsFullBuild());
}

TEST_P(TileUpdate, allPhotographsHaveChanged)
{
    const UpdateSample sample(20, 5, GetParam());
    sample.build();
    changeAll(sample);
    const TileUpdateReport report = update(sample);
    EXPECT_EQ(report.changed, 20u);
    EXPECT_NE(report.rebuilt, "");
    EXPECT_TRUE(sample.equalsFullBuild());
}

TEST_P(TileUpdate, allPhotographsCanBeUpdatedPieceByPiece)
{
    const UpdateSample sample(20, 5, GetParam());
    sample.build();
    changeAll(sample);
    TileUpdateSettings settings;
    settings.rebuildShare = 1e9;
    settings.pack.durable = false;
    EXPECT_EQ(updateTileStore(sample.store(), settings).rebuilt, "");
    EXPECT_TRUE(sample.equalsFullBuild());
}

TEST_P(TileUpdate, aPhotographHasMoved)
{
    const UpdateSample sample(20, 6, GetParam());
    sample.build();
    fs::create_directories(sample.photo("other"));
    fs::rename(sample.photo(UpdateSample::nameOf(7)), sample.photo("other/x.jpg"));
    const TileUpdateReport report = update(sample);
    EXPECT_EQ(report.moved, 1u);
    EXPECT_EQ(report.touchedTiles, 0u);
    EXPECT_EQ(report.added + report.removed, 0u);
    EXPECT_TRUE(sample.equalsFullBuild());
}

TEST_P(TileUpdate, photographsHaveCome)
{
    const UpdateSample sample(20, 7, GetParam());
    sample.build();
    const std::int64_t height = sample.layout().height;
    sample.writePhoto("small.jpg", 16, 9, 31);
    EXPECT_EQ(update(sample).added, 1u);
    EXPECT_EQ(sample.layout().height, height) << "there was room";
    EXPECT_TRUE(sample.equalsFullBuild());
    for (int i = 0; i < 5; ++i)
    {
        sample.writePhoto("new/photo" + std::to_string(i) + ".jpg", 300, 200, 800 + unsigned(i));
    }
    EXPECT_EQ(update(sample).added, 5u);
    EXPECT_GT(sample.layout().height, height) << "the atlas has grown";
    EXPECT_TRUE(sample.equalsFullBuild());
}

TEST_P(TileUpdate, anAtlasGrowsLevelByLevel)
{
    const UpdateSample sample(9, 8, GetParam());
    sample.build();
    const int levels = TilePackReader(sample.store()).getSettings().grid.getLevels();
    TileUpdateSettings settings;
    settings.rebuildShare = 1e9;
    settings.pack.durable = false;
    for (int i = 0; i < 4; ++i)
    {
        sample.writePhoto("tall" + std::to_string(i) + ".jpg", 200, 500, 900 + unsigned(i));
        EXPECT_EQ(updateTileStore(sample.store(), settings).rebuilt, "");
        ASSERT_TRUE(sample.equalsFullBuild()) << i;
    }
    EXPECT_GT(TilePackReader(sample.store()).getSettings().grid.getLevels(), levels);
}

TEST_P(TileUpdate, aPhotographHasGone)
{
    const UpdateSample sample(20, 9, GetParam());
    sample.build();
    fs::remove(sample.photo(UpdateSample::nameOf(11)));
    EXPECT_EQ(update(sample).removed, 1u);
    EXPECT_EQ(sample.layout().photos.size(), 19u);
    EXPECT_TRUE(sample.equalsFullBuild());
}

TEST_P(TileUpdate, aPhotographHasAnotherSize)
{
    const UpdateSample sample(20, 10, GetParam());
    sample.build();
    const AtlasPhoto photo = sample.layout().photos[4];
    const std::string name = fs::path(photo.path).filename().string();
    sample.writePhoto(name, photo.width - 30, photo.height - 50, 51);
    TileUpdateReport report = update(sample);
    EXPECT_EQ(report.changed, 1u);
    EXPECT_TRUE(report.notes.empty()) << "it has room where it is";
    EXPECT_EQ(sample.layout().photos[4].x, photo.x);
    EXPECT_TRUE(sample.equalsFullBuild());
    sample.writePhoto(name, 700, 90, 52);
    report = update(sample);
    EXPECT_EQ(report.notes.size(), 1u);
    EXPECT_TRUE(sample.equalsFullBuild());
}

INSTANTIATE_TEST_SUITE_P(Formats, TileUpdate, testing::Values("jpg", "png", "lossless"));

} // namespace
