// SPDX-License-Identifier: MIT
#include <osgPagedTexture/MaskNames.h>

#include <gtest/gtest.h>

using namespace osgPagedTexture;

namespace
{

using Names = std::vector<std::string>;

Names namesOf(const Names& files)
{
    std::vector<Photo> photos;
    for (const std::string& file : files)
    {
        photos.emplace_back();
        photos.back().file = file;
    }
    return namesOfPhotos(photos);
}

TEST(MaskNamesTest, aPhotographIsCalledByItsFile)
{
    EXPECT_EQ(namesOf({"/m/wall.jpg", "/m/floor.png"}), (Names{"wall", "floor"}));
    EXPECT_EQ(namesOf({}), Names());
}

TEST(MaskNamesTest, sameNamesInDifferentFoldersStayApart)
{
    EXPECT_EQ(namesOf({"/m/a/wall.jpg", "/m/b/wall.jpg", "/m/c/door.jpg"}),
              (Names{"a/wall.jpg", "b/wall.jpg", "door"}));
    EXPECT_EQ(namesOf({"/m/wall.jpg", "/m/wall.png"}), (Names{"wall.jpg", "wall.png"}));
}

TEST(MaskNamesTest, namesThatDifferInCaseAloneStayApart)
{
    EXPECT_EQ(namesOf({"/m/Wall.jpg", "/m/wall.jpg"}), (Names{"Wall.jpg.1", "wall.jpg.2"}));
}

TEST(MaskNamesTest, photographsWithoutAFileHaveNumbers)
{
    EXPECT_EQ(namesOf({"", "/m/wall.jpg", ""}), (Names{"photograph1", "wall", "photograph3"}));
}

} // namespace
