// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/TileStore.h>

#include "PictureFiles.h"

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

using namespace osgPagedTexture;

namespace
{

AtlasLayout sampleLayout()
{
    AtlasPhoto a;
    a.path = "north/\"quoted\" ü.jpg";
    a.width = 300;
    a.height = 200;
    a.bytes = 123456789012;
    a.modified = 1700000000123456789;
    a.hash = "00112233445566778899aabbccddeeff";
    AtlasPhoto b = a;
    b.path = "south/b.jpg";
    b.used = {{16, 32, 48, 64}, {100, 50, 5, 6}};
    AtlasLayout layout = packAtlas({a, b});
    layout.pending = {{1, 2, 3, 4}};
    layout.pendingSince = "ff";
    return layout;
}

std::string textOf(const std::string& path)
{
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

/// What reading a file with this text throws.
std::string errorOf(const std::string& text)
{
    const support::TemporaryFolder folder;
    try
    {
        readAtlasLayout(folder.write("layout.json", text));
    }
    catch (const TileStoreError& error)
    {
        return error.what();
    }
    return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.find(from);
    return at == std::string::npos ? "not found" : text.replace(at, from.size(), to);
}

TEST(AtlasLayoutFile, aLayoutSurvivesItsFile)
{
    const support::TemporaryFolder folder;
    const AtlasLayout layout = sampleLayout();
    writeAtlasLayout(folder.file("layout.json"), layout);
    const AtlasLayout back = readAtlasLayout(folder.file("layout.json"));
    EXPECT_EQ(back.getContentHash(), layout.getContentHash());
    EXPECT_EQ(back.alignment, layout.alignment);
    EXPECT_EQ(back.photos[0].path, layout.photos[0].path);
    EXPECT_EQ(back.photos[0].bytes, layout.photos[0].bytes);
    EXPECT_EQ(back.photos[0].modified, layout.photos[0].modified);
    ASSERT_EQ(back.photos[1].used.size(), 2u);
    EXPECT_EQ(back.photos[1].used[1].height, 6);
    ASSERT_EQ(back.pending.size(), 1u);
    EXPECT_EQ(back.pending[0].width, 3);
    EXPECT_EQ(back.pendingSince, "ff");

    const std::string text = textOf(folder.file("layout.json"));
    writeAtlasLayout(folder.file("layout.json"), back);
    EXPECT_EQ(textOf(folder.file("layout.json")), text);
}

TEST(AtlasLayoutFile, anEmptyLayoutSurvivesItsFile)
{
    const support::TemporaryFolder folder;
    writeAtlasLayout(folder.file("layout.json"), packAtlas({}));
    EXPECT_TRUE(readAtlasLayout(folder.file("layout.json")).photos.empty());
}

TEST(AtlasLayoutFile, whatIsWrongIsNamed)
{
    const support::TemporaryFolder folder;
    writeAtlasLayout(folder.file("layout.json"), sampleLayout());
    const std::string good = textOf(folder.file("layout.json"));
    const auto errorWith = [&](const std::string& from, const std::string& to)
    { return errorOf(replaced(good, from, to)); };
    EXPECT_EQ(errorOf(good), "no error");
    EXPECT_NE(errorOf("").find("is no JSON"), std::string::npos);
    EXPECT_NE(errorOf(good.substr(0, good.size() / 2)).find("is no JSON"), std::string::npos);
    EXPECT_NE(errorOf("[1,2]").find("is no atlas layout"), std::string::npos);
    EXPECT_NE(errorWith("layout 1", "layout 9").find("is no atlas layout"), std::string::npos);
    EXPECT_NE(errorWith("\"width\":300", "\"width\":\"300\"").find("photograph 1 has no width"),
              std::string::npos);
    EXPECT_NE(errorWith("\"width\":300", "\"width\":99999999999").find("photograph 1 has no width"),
              std::string::npos);
    EXPECT_NE(errorWith("\"hash\"", "\"hush\"").find("photograph 1 has no text hash"),
              std::string::npos);
    EXPECT_NE(errorWith("[16,32,48,64]", "[16,32,48]").find("photograph 2 has in used"),
              std::string::npos);
    EXPECT_NE(errorWith("[16,32,48,64]", "[16,32,1099511627776,-64]").find("is empty or outside"),
              std::string::npos);
    EXPECT_NE(errorWith("\"x\":0", "\"x\":5000").find("is not inside"), std::string::npos);
    EXPECT_NE(errorWith("\"photographs\"", "\"photos\"").find("has no list photographs"),
              std::string::npos);
}

TEST(AtlasLayoutFile, photographsOverEachOtherAreNamed)
{
    AtlasLayout layout = packAtlas(sampleLayout().photos);
    layout.photos[1].used.clear();
    layout.photos[1].x = layout.photos[0].x;
    layout.photos[1].y = layout.photos[0].y;
    try
    {
        checkAtlas(layout);
        FAIL();
    }
    catch (const TileStoreError& error)
    {
        EXPECT_NE(std::string(error.what()).find("'south/b.jpg' lie over each other"),
                  std::string::npos);
    }
}

TEST(AtlasLayoutFile, aNameThatIsNoTextIsRefusedAndNothingIsLeft)
{
    const support::TemporaryFolder folder;
    AtlasLayout layout = sampleLayout();
    layout.photos[0].path = "\xff\xfe.jpg";
    EXPECT_THROW(writeAtlasLayout(folder.file("layout.json"), layout), TileStoreError);
    EXPECT_TRUE(std::filesystem::is_empty(folder.getPath()));
}

TEST(AtlasLayoutFile, aPhotographIsDescribedByItsContent)
{
    const support::TemporaryFolder folder;
    const std::string file = folder.write("a.jpg", encodeJpeg(samplePicture(64, 48, 3)));
    const AtlasPhoto fresh = describePhoto(folder.getPath().string(), "a.jpg");
    EXPECT_EQ(fresh.width, 64);
    EXPECT_EQ(fresh.height, 48);
    EXPECT_EQ(fresh.bytes, std::filesystem::file_size(file));
    EXPECT_EQ(fresh.modified, 0) << "a fresh time stands for nothing";
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) -
                                               std::chrono::seconds(100));
    EXPECT_GT(describePhoto(folder.getPath().string(), "a.jpg").modified, 0);
    folder.write("a.jpg", encodeJpeg(samplePicture(64, 48, 3, 2)));
    EXPECT_NE(describePhoto(folder.getPath().string(), "a.jpg").hash, fresh.hash);
    EXPECT_THROW(describePhoto(folder.getPath().string(), "b.jpg"), ImageError);
}

} // namespace
