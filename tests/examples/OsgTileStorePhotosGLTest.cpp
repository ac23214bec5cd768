// SPDX-License-Identifier: MIT
#include "../osgPagedTexture/CapturedWall.h"
#include "TileStoreRun.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/PictureFile.h>

#include <support/TemporaryFolder.h>

#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
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
        words.push_back("--json");
        const auto result = ::run(words);
        EXPECT_EQ(result.exitCode, exitCode) << result.output << result.errors;
        return json::parse(result.output, nullptr, false);
    }

    /// Of a run that fails with one line.
    static std::string errorsOf(const std::vector<std::string>& words)
    {
        const auto result = ::run(words);
        EXPECT_EQ(result.exitCode, 1) << result.output << result.errors;
        EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
        return result.errors;
    }

    /// Writes the model again with its photographs inside, and removes their files.
    std::string writeInside(const std::string& name) const
    {
        CapturedWall(20, 16, 200, 160).write(_folder.getPath().string());
        const osg::ref_ptr<osg::Node> wall = osgDB::readRefNodeFile(_model);
        const osg::ref_ptr<osgDB::Options> options =
            new osgDB::Options("WriteImageHint=IncludeData");
        EXPECT_TRUE(wall && osgDB::writeNodeFile(*wall, _folder.file(name), options));
        for (int camera = 1; camera <= CapturedWall::Cameras; ++camera)
            std::filesystem::remove(_folder.file("camera" + std::to_string(camera) + ".png"));
        return _folder.file(name);
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

TEST_F(OsgTileStorePhotosGLTest, whatTheModelDoesNotShowCanBeFlat)
{
    const auto build = [&](const std::string& name, const std::vector<std::string>& options)
    {
        const std::string layout = _folder.file(name + ".layout.json");
        std::vector<std::string> words{"layout", _model, layout, "--margin", "2"};
        words.insert(words.end(), options.begin(), options.end());
        run(words);
        return run({"build", layout, "--store", _folder.file(name + ".tiles"), "--format", "png"})
            .at("tileBytes")
            .get<double>();
    };
    const double whole = build("whole", {}), tight = build("tight", {"--tight"});
    EXPECT_LT(build("flat", {"--flat"}), 0.8 * whole);
    EXPECT_LT(build("both", {"--flat", "--tight"}), tight);
    const std::string output = _folder.file("flat.osgb");
    const json moved = run(
        {"atlas", _model, _folder.file("flat.layout.json"), _folder.file("flat.tiles"), output});
    EXPECT_EQ(moved.at("writtenTriangles"), 20 * 16 * 2);
    EXPECT_TRUE(moved.at("left").empty());
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

// Masks and neighbours need no more than the model; the rest edits files, or reads them again.
TEST_F(OsgTileStorePhotosGLTest, picturesInsideOfAModelWorkOrAnErrorSaysWhatToDo)
{
    for (const std::string name : {"inside.osgb", "inside.ive"})
    {
        SCOPED_TRACE(name);
        const std::string inside = writeInside(name);
        EXPECT_EQ(run({"mask", inside}).at("masks").size(), 4u);
        EXPECT_EQ(readImageInfo(_folder.file("masks/photograph4.png")).width, 200);
        const json all = run({"neighbours", inside}).at("photographs");
        ASSERT_EQ(all.size(), 4u);
        EXPECT_EQ(all[0].at("neighbours").size(), 2u);
        const std::string picture = all[0].at("file");
        EXPECT_NE(picture.find("camera1.png"), std::string::npos) << picture;
        EXPECT_EQ(run({"neighbours", inside, picture}).at("photographs").size(), 1u);

        const std::string layout = _folder.file("inside.layout.json");
        for (const std::vector<std::string>& words : {std::vector<std::string>{"blend", inside},
                                                      {"reference", inside, picture},
                                                      {"layout", inside, layout},
                                                      {"layout", inside, layout, "--tight"}})
        {
            const std::string line = errorsOf(words);
            EXPECT_NE(line.find("camera1.png' and 3 more are pictures inside of the model"),
                      std::string::npos)
                << line;
            EXPECT_NE(line.find("osgconv " + inside), std::string::npos) << line;
        }
        EXPECT_NE(errorsOf({"build", inside}).find("make a layout first: osgtilestore layout"),
                  std::string::npos);
        EXPECT_FALSE(std::filesystem::exists(layout));
    }
}

TEST_F(OsgTileStorePhotosGLTest, whatTheErrorSaysMakesFilesOfPicturesInside)
{
    support::ChildProcess process;
    process.arguments = {"osgconv", writeInside("inside.ive"), "unpacked.osgb", "-O",
                         "WriteImageHint=WriteOut"};
    process.folder = _folder.getPath().string();
    ASSERT_EQ(process.run().exitCode, 0);
    const json done = run({"blend", _folder.file("unpacked.osgb")});
    EXPECT_LT(done.at("meanStepAfter").get<double>(),
              0.3 * done.at("meanStepBefore").get<double>());
}

TEST_F(OsgTileStorePhotosGLTest, aFileOfAnotherSizeIsNotThePictureInside)
{
    const std::string inside = writeInside("inside.osgb");
    for (int camera = 1; camera <= CapturedWall::Cameras; ++camera)
        writePictureFile(_folder.file("camera" + std::to_string(camera) + ".png"), Pixels(7, 5, 3));
    EXPECT_NE(errorsOf({"blend", inside}).find("inside of the model"), std::string::npos);
    EXPECT_EQ(run({"mask", inside}).at("masks")[0].at("width"), 200);
}

TEST_F(OsgTileStorePhotosGLTest, aModelThatIsNotThereIsOneLineOfError)
{
    for (const char* command : {"mask", "neighbours", "blend"})
        run({command, _folder.file("absent.obj")}, 1);
}

} // namespace
