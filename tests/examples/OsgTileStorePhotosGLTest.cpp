// SPDX-License-Identifier: MIT
#include "../osgPagedTexture/CapturedWall.h"

#include <osgPagedTexture/ImageFile.h>

#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace
{

using namespace osgPagedTexture;
using nlohmann::json;

/// The subcommands that start from a model, on a wall of four photographs.
class OsgTileStorePhotosGLTest : public testing::Test
{
protected:
    void SetUp() override
    {
        _model = CapturedWall(20, 16, 200, 160).write(_folder.getPath().string());
    }

    /// Runs it with --json and returns what it printed.
    static json run(std::vector<std::string> words, int exitCode = 0)
    {
        support::ChildProcess process;
        process.arguments = {OSGKITS_OSGTILESTORE};
        words.push_back("--json");
        process.arguments.insert(process.arguments.end(), words.begin(), words.end());
        const auto result = process.run();
        EXPECT_EQ(result.exitCode, exitCode) << result.output << result.errors;
        return json::parse(result.output, nullptr, false);
    }

    support::TemporaryFolder _folder;
    std::string _model;
};

TEST_F(OsgTileStorePhotosGLTest, masksLieBesideTheModelAndHaveThePhotographsSize)
{
    const json masks = run({"mask", _model}).at("masks");
    ASSERT_EQ(masks.size(), 4u);
    EXPECT_EQ(masks[0].at("mask"), _folder.file("masks/camera1.png"));
    const ImageInfo info = readImageInfo(_folder.file("masks/camera1.png"));
    EXPECT_EQ(info.width, 200);
    EXPECT_EQ(info.height, 160);
    const double share = masks[0].at("usedShare");
    EXPECT_GT(share, 0.2);
    EXPECT_LT(share, 0.6);
    const json wider = run({"mask", _model, "--conservative", "--margin", "3"}).at("masks");
    EXPECT_GT(wider[0].at("usedShare").get<double>(), share);
}

TEST_F(OsgTileStorePhotosGLTest, aTightLayoutBecomesAStoreAndAModel)
{
    const std::string layout = _folder.file("tight.layout.json");
    const json laid = run({"layout", _model, layout, "--tight", "--margin", "4"});
    EXPECT_LT(laid.at("placedPixels").get<double>(),
              0.7 * laid.at("photographPixels").get<double>());
    const std::string store = _folder.file("wall.tiles");
    run({"build", layout, "--store", store});
    const std::string output = _folder.file("atlas.osgb");
    const json moved = run({"atlas", _model, layout, store, output});
    EXPECT_EQ(moved.at("drawables"), 4);
    EXPECT_EQ(moved.at("store"), "wall.tiles");
    EXPECT_EQ(moved.at("writtenTriangles"), 20 * 16 * 2);
    EXPECT_TRUE(moved.at("left").empty());
    EXPECT_TRUE(std::filesystem::exists(output));
}

TEST_F(OsgTileStorePhotosGLTest, neighboursHaveTheLengthsOfTheirSeams)
{
    const json one = run({"neighbours", _model, "camera2"}).at("photographs");
    ASSERT_EQ(one.size(), 1u);
    ASSERT_EQ(one[0].at("neighbours").size(), 2u);
    EXPECT_GT(one[0].at("neighbours")[0].at("seamLength").get<double>(), 2.0);
    run({"neighbours", _model, "nobody"}, 2);
}

TEST_F(OsgTileStorePhotosGLTest, aReferenceHasThePhotographAndItsNeighboursAsLayers)
{
    const json made = run({"reference", _model, "camera1"}).at("references");
    ASSERT_EQ(made.size(), 1u);
    EXPECT_EQ(made[0].at("camera"), "perspective");
    ASSERT_EQ(made[0].at("layers").size(), 3u);
    for (const json& layer : made[0].at("layers"))
        EXPECT_EQ(readImageInfo(layer.at("file")).width, 200);
    EXPECT_TRUE(std::filesystem::exists(_folder.file("reference/camera1.tif")));
}

TEST_F(OsgTileStorePhotosGLTest, blendedCopiesHaveSmallerStepsAndTheOriginalsStay)
{
    const Pixels before = readImageFile(_folder.file("camera1.png")).pixels;
    const json done = run({"blend", _model});
    EXPECT_LT(done.at("meanStepAfter").get<double>(),
              0.3 * done.at("meanStepBefore").get<double>());
    EXPECT_EQ(readImageFile(_folder.file("camera1.png")).pixels.bytes, before.bytes);
    EXPECT_NE(readImageFile(_folder.file("blended/camera1.png")).pixels.bytes, before.bytes);
}

TEST_F(OsgTileStorePhotosGLTest, aModelThatIsNotThereIsOneLineOfError)
{
    for (const char* command : {"mask", "neighbours", "blend"})
        run({command, _folder.file("absent.obj")}, 1);
}

} // namespace
