// SPDX-License-Identifier: MIT
#include "AtlasSamples.h"
#include "CapturedWall.h"

#include <osgPagedTexture/AtlasModel.h>
#include <osgPagedTexture/CellSplit.h>
#include <osgPagedTexture/PictureFile.h>
#include <osgPagedTexture/UsedParts.h>

#include <osg/Texture2D>
#include <osg/TriangleFunctor>
#include <osg/ValueObject>
#include <osgDB/ReadFile>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <random>

using namespace osgPagedTexture;

namespace
{

Pixels flatPicture(int width, int height)
{
    Pixels pixels(width, height, 3);
    std::fill(pixels.bytes.begin(), pixels.bytes.end(), std::uint8_t(90));
    return pixels;
}

/// A grid of jittered points whose coordinates go over many repeats.
osg::ref_ptr<osg::Geometry> repeatedGrid(const std::string& photograph, int side)
{
    const osg::ref_ptr<osg::Geometry> grid =
        texturedSquare(photograph, osg::Texture::REPEAT, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    std::mt19937 random(7);
    std::uniform_real_distribution<float> jitter(-0.3f, 0.3f);
    osg::ref_ptr<osg::Vec3Array> places = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec2Array> coordinates = new osg::Vec2Array;
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (int y = 0; y <= side; ++y)
    {
        for (int x = 0; x <= side; ++x)
        {
            places->push_back({x + jitter(random), y + jitter(random), jitter(random)});
            coordinates->push_back({0.9f * x + jitter(random), 0.7f * y + jitter(random) - 3.0f});
        }
    }
    for (int y = 0; y < side; ++y)
    {
        for (int x = 0; x < side; ++x)
        {
            const unsigned int a = unsigned(y * (side + 1) + x), b = a + unsigned(side) + 1;
            for (unsigned int i : {a, a + 1, b + 1, a, b + 1, b})
                triangles->push_back(i);
        }
    }
    grid->setVertexArray(places);
    grid->setTexCoordArray(0, coordinates, osg::Array::BIND_PER_VERTEX);
    grid->removePrimitiveSet(0);
    grid->addPrimitiveSet(triangles);
    return grid;
}

struct EdgeCounter
{
    std::map<std::pair<osg::Vec3, osg::Vec3>, int>* edges = nullptr;
    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c) const
    {
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
            ++(*edges)[from < to ? std::pair(from, to) : std::pair(to, from)];
    }
};

/// Edges that only one triangle has, and their length.
double openLength(const osg::Geometry& geometry)
{
    std::map<std::pair<osg::Vec3, osg::Vec3>, int> edges;
    osg::TriangleFunctor<EdgeCounter> counter;
    counter.edges = &edges;
    geometry.accept(counter);
    double length = 0.0;
    for (const auto& [edge, count] : edges)
    {
        EXPECT_LE(count, 2);
        if (count == 1)
            length += (edge.first - edge.second).length();
    }
    return length;
}

class AtlasModelTest : public testing::Test
{
protected:
    void SetUp() override
    {
        _photograph = _folder.file("photograph.png");
        writePictureFile(_photograph, flatPicture(64, 48));
    }

    AtlasModelReport move(ModelPhotos& model, const AtlasModelSettings& settings = {})
    {
        if (model.photos.empty())
            collectPhotos(model, false);
        const std::string folder = _folder.getPath().string();
        return moveToAtlas(model, layoutOf(model, folder), folder, settings);
    }

    support::TemporaryFolder _folder;
    std::string _photograph;
};

TEST_F(AtlasModelTest, cutsOfNeighboursMeetToTheLastBit)
{
    const osg::ref_ptr<osg::Geometry> grid = repeatedGrid(_photograph, 40);
    const double before = openLength(*grid);
    ModelPhotos model;
    model.model = grid;
    const AtlasModelReport report = move(model);
    EXPECT_GT(report.split, 1500u);
    EXPECT_GT(report.written, 2 * report.triangles);
    // The outer border alone is open, as before: an edge that does not meet its neighbour's would
    // count twice.
    EXPECT_NEAR(openLength(*grid), before, 1e-4 * before);
}

TEST_F(AtlasModelTest, everyCoordinateLiesInThePhotographsPlace)
{
    const osg::ref_ptr<osg::Geometry> grid = repeatedGrid(_photograph, 20);
    ModelPhotos model;
    model.model = grid;
    collectPhotos(model, false);
    const AtlasLayout layout = layoutOf(model, _folder.getPath().string());
    moveToAtlas(model, layout, _folder.getPath().string(), {});
    const PixelRect place = layout.photos.at(0).getPlace();
    const auto& coordinates = static_cast<const osg::Vec2Array&>(*grid->getTexCoordArray(0));
    for (const osg::Vec2& each : coordinates)
    {
        // A float of a coordinate up to 1 is off by 2^-25 at most.
        const double error = double(layout.width) / (1 << 25);
        EXPECT_GE(each.x() * double(layout.width), double(place.x) - error);
        EXPECT_LE(each.x() * double(layout.width), double(place.x + place.width) + error);
        EXPECT_GE((1.0 - each.y()) * double(layout.height), double(place.y) - error);
        EXPECT_LE((1.0 - each.y()) * double(layout.height), double(place.y + place.height) + error);
    }
}

TEST_F(AtlasModelTest, coordinatesThatAreNotFiniteDoNotSpoilTheRest)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    ModelPhotos model;
    const osg::ref_ptr<osg::Geometry> square =
        texturedSquare(_photograph, osg::Texture::REPEAT, {{0, 0}, {nan, 0}, {1, 1}, {0, 1}});
    model.model = square;
    const AtlasModelReport report = move(model);
    EXPECT_EQ(report.notFinite, 1u);
    EXPECT_EQ(report.drawables, 1u);
    for (const osg::Vec2& each : static_cast<const osg::Vec2Array&>(*square->getTexCoordArray(0)))
        EXPECT_TRUE(std::isfinite(each.x()) && std::isfinite(each.y()));

    ModelPhotos other;
    other.model = texturedSquare(_photograph, osg::Texture::CLAMP,
                                 {{0, 0}, {-infinite, 0}, {1, 1}, {0, 1e38f}});
    EXPECT_EQ(move(other).notFinite, 1u);
}

TEST_F(AtlasModelTest, trianglesOfABorderStayOnTheirSide)
{
    // From 1 to 2 exactly: one cell, not three.
    const auto parts =
        splitAtCells({glm::dvec2(1, 1), {2, 1}, {2, 2}}, PhotoWrap::Repeat, PhotoWrap::Repeat, 8);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].cellS, 1);
    EXPECT_EQ(parts[0].cellT, 1);
    EXPECT_TRUE(splitAtCells({glm::dvec2(0, 0), {1e30, 0}, {0, 1e30}}, PhotoWrap::Repeat,
                             PhotoWrap::Repeat, 1000)
                    .empty());
}

TEST_F(AtlasModelTest, aDrawableWithoutATextureIsLeftAsItIs)
{
    ModelPhotos model;
    const osg::ref_ptr<osg::Geometry> square =
        texturedSquare(_photograph, osg::Texture::REPEAT, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    square->setStateSet(nullptr);
    model.model = square;
    collectPhotos(model, false);
    EXPECT_TRUE(model.photos.empty());
    EXPECT_EQ(move(model).drawables, 0u);
    EXPECT_EQ(square->getPrimitiveSet(0)->getMode(), GLenum(GL_QUADS));
}

TEST_F(AtlasModelTest, writtenModelsNameTheStoreAndAreReadByOsg)
{
    const std::string path = CapturedWall(8, 6, 80, 64).write(_folder.getPath().string());
    for (const char* name : {"atlas.osgb", "atlas.osgt", "atlas.obj"})
    {
        {
            ModelPhotos model = readModelPhotos(path);
            ASSERT_EQ(model.photos.size(), 4u);
            AtlasModelSettings settings;
            settings.store = "stores/wall.tiles";
            settings.overview = new osg::Image;
            settings.overview->allocateImage(8, 8, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
            EXPECT_EQ(move(model, settings).drawables, 4u);
            writeAtlasModel(model, _folder.file(name), AtlasModelViewer::Plain);
        }
        ModelPhotos again;
        again.model = osgDB::readRefNodeFile(_folder.file(name));
        ASSERT_TRUE(again.model) << name;
        collectPhotos(again, false);
        ASSERT_EQ(again.photos.size(), 1u) << name;
        EXPECT_EQ(again.photos[0].width, 8) << name;
        std::size_t triangles = 0;
        for (const PhotoSurface& surface : again.photos[0].surfaces)
            triangles += surface.coordinates.size() / 3;
        EXPECT_EQ(triangles, 8u * 6u * 2u) << name;
    }
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(_folder.file("atlas.osgb"));
    const osg::StateSet* state =
        node->asGroup()->getChild(0)->asGroup()->getChild(0)->getStateSet();
    ASSERT_TRUE(state);
    std::string store;
    EXPECT_TRUE(state->getTextureAttribute(0, osg::StateAttribute::TEXTURE)
                    ->getUserValue("osgPagedTexture.store", store));
    EXPECT_EQ(store, "stores/wall.tiles");
}

TEST_F(AtlasModelTest, aFormatThatCannotBeWrittenIsAnError)
{
    ModelPhotos model;
    model.model = new osg::Group;
    EXPECT_THROW(writeAtlasModel(model, _folder.file("model.nothing")), ModelError);
    EXPECT_THROW(readModelPhotos(_folder.file("absent.obj")), ModelError);
}

TEST(UsedPartsTest, partsHoldAllUsedPixelsAndLieOnBlocks)
{
    Pixels mask(100, 70, 1);
    EXPECT_TRUE(findUsedParts(mask).empty());
    mask.row(69)[0] = 255;  // Top left.
    mask.row(0)[99] = 255;  // Bottom right.
    mask.row(40)[50] = 255; // Row 29 from the top.
    const auto parts = findUsedParts(mask);
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(parts[0].x, 0);
    EXPECT_EQ(parts[0].width, 16);
    EXPECT_EQ(parts[1].x, 48);
    EXPECT_EQ(parts[1].y, 16);
    EXPECT_EQ(parts[2].x, 96);
    EXPECT_EQ(parts[2].y, 64);
    EXPECT_EQ(parts[2].width, 4);
    EXPECT_EQ(parts[2].height, 6);
}

TEST(UsedPartsTest, blocksHoldAllUsedPixelsAndNoOtherBlock)
{
    Pixels mask(200, 150, 1);
    EXPECT_TRUE(findUsedBlocks(mask).empty());
    for (int y = 0; y < mask.height; ++y) // a ring
        for (int x = 0; x < mask.width; ++x)
        {
            const double radius = std::hypot(x - 100.0, y - 75.0);
            mask.row(y)[x] = radius > 40.0 && radius < 70.0 ? 255 : 0;
        }
    const auto rects = findUsedBlocks(mask);
    EXPECT_LT(rects.size(), 25u) << "rows that are alike are one";
    const auto countIn = [&](const PixelRect& area)
    {
        int used = 0;
        for (std::int64_t y = area.y; y < std::min<std::int64_t>(area.y + area.height, 150); ++y)
            for (std::int64_t x = area.x; x < std::min<std::int64_t>(area.x + area.width, 200); ++x)
                used += mask.row(149 - int(y))[x] != 0;
        return used;
    };
    for (int top = 0; top < 150; top += 16)
        for (int left = 0; left < 200; left += 16)
        {
            const auto holders =
                std::count_if(rects.begin(), rects.end(),
                              [&](const PixelRect& rect)
                              {
                                  return left >= rect.x && left < rect.x + rect.width &&
                                         top >= rect.y && top < rect.y + rect.height;
                              });
            EXPECT_EQ(holders, countIn({left, top, 16, 16}) > 0 ? 1 : 0) << left << "," << top;
        }
}

TEST(UsedPartsTest, partsWhoseBoxesOverlapAreOne)
{
    Pixels mask(160, 160, 1);
    for (int i = 0; i < 160; ++i)
    {
        mask.row(159)[i] = 255; // An angle from the top row
        mask.row(i)[159] = 255; // and the right column,
    }
    mask.row(40)[40] = 255; // and a point inside of its box.
    const auto parts = findUsedParts(mask);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].width, 160);
    EXPECT_EQ(parts[0].height, 160);
}

} // namespace
