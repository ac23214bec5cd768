// SPDX-License-Identifier: MIT
#include "PictureFiles.h"

#include <osgPagedTexture/ContentHash.h>
#include <osgPagedTexture/PhotoFolder.h>
#include <osgPagedTexture/TileStore.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace
{

namespace fs = std::filesystem;
using namespace osgPagedTexture;
using Paths = std::vector<std::string>;

TEST(PhotoFolderTest, picturesOfAllFoldersAreFoundSortedAndNothingElse)
{
    const support::TemporaryFolder folder;
    for (const char* name : {"b", "a/deep", ".thumbnails"})
        fs::create_directories(folder.file(name));
    for (const char* name : {"b/wall.JPG", "a/deep/wall.jpg", "wall.tiff", "notes.txt", "wall",
                             ".thumbnails/wall.jpg", ".wall.jpg"})
        folder.write(name, "x");
    fs::create_directories(folder.file("folder.jpg"));
    fs::create_symlink("nowhere.jpg", folder.file("link.jpg"));
    EXPECT_EQ(findPhotos(folder.getPath().string()),
              (Paths{"a/deep/wall.jpg", "b/wall.JPG", "wall.tiff"}));
    EXPECT_THROW(findPhotos(folder.file("none")), TileStoreError);
}

TEST(PhotoFolderTest, aPhotographOfMoreThanTwoGigabytesIsDescribed)
{
    const support::TemporaryFolder folder;
    const std::string path = folder.write("wall.pgm", "P5 46400 46400 255\n");
    const std::uintmax_t bytes = 19 + std::uintmax_t(46400) * 46400;
    fs::resize_file(path, bytes); // sparse
    const AtlasPhoto photo = describePhoto(folder.getPath().string(), "wall.pgm");
    EXPECT_EQ(photo.width, 46400);
    EXPECT_EQ(photo.bytes, bytes);
    // What is hashed in pieces has the hash of the whole.
    const std::string some(3000000, 'x');
    folder.write("b.pgm", "P5 1000 3000 255\n" + some);
    EXPECT_EQ(describePhoto(folder.getPath().string(), "b.pgm").hash,
              hashText("P5 1000 3000 255\n" + some).text());
}

TEST(PhotoFolderTest, photographsAreDescribedInTheirOrderAndBrokenOnesNamed)
{
    const support::TemporaryFolder folder;
    Paths paths;
    for (int i = 0; i < 150; ++i)
    {
        paths.push_back("photo" + std::to_string(i) + ".jpg");
        folder.write(paths.back(), i % 50 == 7 ? std::string("no picture")
                                               : encodeJpeg(samplePicture(8 + i, 9, 3)));
    }
    std::uint64_t told = 0;
    const DescribedPhotos described = describePhotos(folder.getPath().string(), paths, 3,
                                                     [&](std::uint64_t done, std::uint64_t total)
                                                     {
                                                         EXPECT_GT(done, told);
                                                         EXPECT_EQ(total, 150u);
                                                         told = done;
                                                     });
    EXPECT_EQ(told, 150u);
    ASSERT_EQ(described.photos.size(), 147u);
    ASSERT_EQ(described.failures.size(), 3u);
    EXPECT_EQ(described.failures[1].path, "photo57.jpg");
    EXPECT_NE(described.failures[1].cause.find("photo57.jpg"), std::string::npos);
    EXPECT_EQ(described.photos[7].path, "photo8.jpg");
    EXPECT_EQ(described.photos[7].width, 16);
    EXPECT_FALSE(described.photos[7].hash.empty());
}

} // namespace
