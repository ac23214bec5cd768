// SPDX-License-Identifier: MIT
#include "UpdateSamples.h"

#include <osgPagedTexture/TileShards.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

TilePackWriter::Options quick()
{
    TilePackWriter::Options options;
    options.durable = false;
    return options;
}

void buildShards(const UpdateSample& sample, int count)
{
    TileStoreOrigin origin = sample.origin();
    const AtlasLayout layout = sample.layout();
    origin.layoutHash = layout.getContentHash();
    for (int i = count - 1; i >= 0; --i)
    {
        buildTileShard(sample.store(), {i, count}, layout, origin, quick());
    }
}

std::size_t filesBeside(const UpdateSample& sample)
{
    const fs::directory_iterator files(fs::path(sample.store()).parent_path());
    return std::size_t(std::count_if(begin(files), end(files),
                                     [](const fs::directory_entry& each)
                                     { return each.path().extension() != ".lock"; }));
}

TEST(TileShards, partsMakeTheStoreOfOneProcess)
{
    for (const std::size_t photos : {0, 1, 30})
    {
        const UpdateSample sample(photos, 4);
        sample.build();
        const std::string store = UpdateSample::bytesOf(sample.store());
        const std::string kept = UpdateSample::bytesOf(keptPathOf(sample.store()));
        const std::size_t files = filesBeside(sample);
        for (const int count : {1, 2, 3, 7, 40})
        {
            fs::remove(sample.store());
            fs::remove(keptPathOf(sample.store()));
            buildShards(sample, count);
            EXPECT_EQ(countTileShards(sample.store()), count);
            mergeTileShards(sample.store(), count, quick());
            ASSERT_EQ(UpdateSample::bytesOf(sample.store()), store) << photos << " in " << count;
            ASSERT_EQ(UpdateSample::bytesOf(keptPathOf(sample.store())), kept) << count;
            EXPECT_EQ(filesBeside(sample), files) << "nothing is left";
        }
    }
}

TEST(TileShards, aMergedStoreCanBeUpdated)
{
    const UpdateSample sample(30, 4);
    sample.build();
    buildShards(sample, 3);
    mergeTileShards(sample.store(), 3, quick());
    const AtlasPhoto photo = sample.layout().photos[3];
    sample.writePhoto(fs::path(photo.path).filename().string(), photo.width, photo.height, 71);
    EXPECT_EQ(updateTileStore(sample.store()).rebuilt, "");
    EXPECT_TRUE(sample.equalsFullBuild());
}

TEST(TileShards, whatDoesNotFitTogetherIsRefused)
{
    const UpdateSample sample(10, 4);
    sample.build();
    const std::string before = UpdateSample::bytesOf(sample.store());
    EXPECT_THROW(countTileShards(sample.store()), TileStoreError) << "none are there";
    buildShards(sample, 3);
    fs::remove(TileShard{1, 3}.path(sample.store()));
    EXPECT_THROW(mergeTileShards(sample.store(), 3, quick()), TileStoreError) << "one is missing";
    buildShards(sample, 2);
    EXPECT_THROW(countTileShards(sample.store()), TileStoreError) << "of two builds";
    AtlasLayout layout = sample.layout();
    layout.photos.pop_back();
    writeAtlasLayout(sample.layoutFile(), layout);
    EXPECT_THROW(mergeTileShards(sample.store(), 2, quick()), TileStoreError) << "other layout";
    TileStoreOrigin origin = sample.origin();
    EXPECT_THROW(buildTileShard(sample.store(), {2, 2}, layout, origin, quick()), TileStoreError);
    EXPECT_EQ(UpdateSample::bytesOf(sample.store()), before);
}

} // namespace
