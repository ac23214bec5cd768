// SPDX-License-Identifier: MIT
#include "RenderProcess.h"
#include "RenderScenes.h"

#include <support/CompareImage.h>
#include <support/InventorModels.h>

#include <nlohmann/json.hpp>

#include <cmath>

namespace
{

const osg::Vec4 Red(1.0f, 0.0f, 0.0f, 1.0f);
const osg::Vec4 Green(0.0f, 1.0f, 0.0f, 1.0f);

/// The square from 10 units in front; 160x120 pixels with a vertical angle of 40 degrees.
const std::string Front = "eye:0,-10,0;center:0,0,0;up:0,0,1;fov:40";

/// Pixels whose channel is above a half.
int countPixels(const osg::Image& image, int channel)
{
    int count = 0;
    for (int y = 0; y < image.t(); ++y)
    {
        for (int x = 0; x < image.s(); ++x)
            count += image.getColor(unsigned(x), unsigned(y))[channel] > 0.5f;
    }
    return count;
}

osg::Vec4 center(const osg::Image& image)
{
    return image.getColor(unsigned(image.s()) / 2, unsigned(image.t()) / 2);
}

/// Mean x of the pixels whose channel is above a half.
double meanX(const osg::Image& image, int channel)
{
    double sum = 0.0;
    for (int y = 0; y < image.t(); ++y)
    {
        for (int x = 0; x < image.s(); ++x)
            sum += image.getColor(unsigned(x), unsigned(y))[channel] > 0.5f ? x : 0;
    }
    return sum / std::max(1, countPixels(image, channel));
}

/// Half the side of the square in pixels, from `distance`, at 120 rows and `fov` degrees.
double halfSide(double distance, double fov)
{
    return 60.0 / (distance * std::tan(fov * 3.14159265358979 / 360.0));
}

} // namespace

class OsgRenderGLTest : public RenderProcess
{
protected:
    void SetUp() override { scenes::write(*scenes::square(Red), _folder.file("square.osgt")); }
};

TEST_F(OsgRenderGLTest, pictureIsOsgviewersFirstView)
{
    for (const char* name :
         {"engine.iv", "chess/king.iv", "chess/chessboard.iv", "robots/cylMan.iv"})
    {
        const std::string model = support::inventorModel(name);
        support::ChildProcess viewer;
        viewer.arguments = {"osgviewer", "-e", "egl", "--window", "0", "0", "160", "120", model};
        viewer.environment = {{"OSG_HEADLESS_CAPTURE", _folder.file("viewer.png")},
                              {"OSG_RUN_FRAME_COUNT", "2"},
                              {"OSG_LIBRARY_PATH", OSGKITS_LIBRARIES}};
        viewer.unset = {"DISPLAY"};
        ASSERT_EQ(viewer.run().exitCode, 0) << name;
        expectRenders({model, "-o", "render.png"});
        // The same device and commands: only the scene's time may differ.
        EXPECT_TRUE(
            support::CompareImage()(picture("render.png"), picture("viewer.png"), "osgrenderHome"));
    }
}

TEST_F(OsgRenderGLTest, osmesaGivesEglsPicture)
{
    const std::string model = support::inventorModel("engine.iv");
    expectRenders({model, "-o", "egl.png", "--backend", "egl"});
    expectRenders({model, "-o", "osmesa.png", "--backend", "osmesa", "--stats", "osmesa.json"});
    EXPECT_EQ(nlohmann::json::parse(read("osmesa.json")).at("backend"), "osmesa");
    EXPECT_TRUE(
        support::CompareImage()(picture("osmesa.png"), picture("egl.png"), "osgrenderOsmesa"));
    const support::ProcessResult result =
        run({model, "-o", "a.png", "--backend", "egl"}, {{"LD_PRELOAD", "libOSMesa.so.8"}});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.errors.find("unset LD_PRELOAD"), std::string::npos) << result.errors;
}

TEST_F(OsgRenderGLTest, eyeCenterAndFovPlaceTheSquare)
{
    expectRenders({"square.osgt", "-o", "a.png", "--camera", Front});
    const double side = 2.0 * halfSide(10.0, 40.0);
    // A row and a column of pixels may be lost or won at each edge.
    EXPECT_NEAR(countPixels(*picture("a.png"), 0), side * side, 2.0 * side);
    expectRenders({"square.osgt", "-o", "b.png", "--camera", "eye:3,-10,0;center:3,0,0;fov:40"});
    EXPECT_NEAR(meanX(*picture("b.png"), 0), 79.5 - 3.0 * side / 2.0, 1.0);
}

TEST_F(OsgRenderGLTest, homeCanBeTurnedLiftedAndZoomed)
{
    expectRenders({"square.osgt", "-o", "home.png"});
    expectRenders({"square.osgt", "-o", "zoom.png", "--camera", "home;zoom:1.5"});
    expectRenders({"square.osgt", "-o", "turn.png", "--camera", "home;turn:60"});
    expectRenders({"square.osgt", "-o", "lift.png", "--camera", "home;lift:60"});
    const double home = countPixels(*picture("home.png"), 0);
    ASSERT_GT(home, 500.0);
    EXPECT_NEAR(countPixels(*picture("zoom.png"), 0) / home, 2.25, 0.1);
    // Cosine of 60 degrees; perspective adds some percent.
    EXPECT_NEAR(countPixels(*picture("turn.png"), 0) / home, 0.5, 0.05);
    EXPECT_NEAR(countPixels(*picture("lift.png"), 0) / home, 0.5, 0.05);
}

TEST_F(OsgRenderGLTest, cameraOfTheStatisticsGivesTheSamePicture)
{
    const std::string model = support::inventorModel("engine.iv");
    expectRenders({model, "-o", "a.png", "--camera", "home;turn:30;lift:20", "--stats", "a.json"});
    const std::string camera = nlohmann::json::parse(read("a.json")).at("camera");
    // Six digits of the eye move an edge by less than a pixel, so some pixels at edges differ.
    expectRenders(
        {model, "--reference", "a.png", "--camera", camera, "--tolerance", "2/255,0.2%,1"});
}

TEST_F(OsgRenderGLTest, malformedCamerasAreNamed)
{
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "neither home nor key:value"},           {"house", "neither home nor key:value"},
        {"eye:1,2", "eye takes three numbers"},       {"eye:1,2,x", "eye takes three numbers"},
        {"eye:1,2,nan", "eye takes three numbers"},   {"eye:1,2,3;eye:1,2,3", "given twice"},
        {"center:1,2,3", "either home or eye"},       {"home;eye:1,2,3", "home chooses eye"},
        {"eye:1,2,3;zoom:2", "go with home"},         {"eye:1,2,3;fov:0", "fov takes degrees"},
        {"eye:1,2,3;fov:180", "fov takes degrees"},   {"eye:1,2,3;up:0,0,0", "up has length 0"},
        {"eye:1,2,3;center:1,2,3", "the same point"}, {"eye:0,0,9;center:0,0,0", "up points along"},
        {"home;lift:90", "lift takes degrees"},       {"home;zoom:0", "zoom takes a factor"},
        {"home;roll:3", "unknown part 'roll'"}};
    for (const auto& [camera, text] : cases)
        expectFails({"square.osgt", "-o", "a.png", "--camera", camera}, 2, text);
    expectFails({"square.osgt", "-o", "a.png", "--camera", "eye:0,0,9"}, 1, "give center:x,y,z");
    EXPECT_FALSE(exists("a.png"));
}

TEST_F(OsgRenderGLTest, wrongSwitchesAreNamed)
{
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--frobnicate"}, "unknown switch '--frobnicate'"},
        {{"--size", "12"}, "'12' is not WIDTHxHEIGHT"},
        {{"--size", "0x12"}, "not a size"},
        {{"--size", "12x1e9"}, "not a size"},
        {{"--samples", "many"}, "--samples: 'many'"},
        {{"--frames", "0"}, "--frames: '0'"},
        {{"--time", "soon"}, "--time: 'soon'"},
        {{"--backend", "glx"}, "--backend: 'glx'"},
        {{"--tolerance", "1,2"}, "--tolerance '1,2'"},
        {{"--tolerance", "1/0,1,1"}, "--tolerance '1/0,1,1'"},
        {{"-o", "b"}, "no extension"},
        {{"-o", "b.unknown"}, "no plugin writes '.unknown'"},
        {{"-o", "b%s.png"}, "a frame number is written"},
        {{"-o", "b%d%d.png"}, "two frame numbers"},
        {{"--float"}, "can't hold float pixels"},
        {{"-D", "novalue"}, "not NAME=value"},
        {{"--html", "x.html"}, "--html goes with @script"},
        {{"--stats"}, "--stats needs a value"}};
    for (const auto& [words, text] : cases)
    {
        std::vector<std::string> all = {"square.osgt", "-o", "a.png"};
        all.insert(all.end(), words.begin(), words.end());
        expectFails(all, 2, text);
    }
    expectFails({"square.osgt"}, 2, "nothing to do");
    expectFails({"-o", "a.png"}, 2, "no model given");
    EXPECT_FALSE(exists("a.png"));
}

TEST_F(OsgRenderGLTest, helpListsAllSwitches)
{
    const support::ProcessResult result = run({"--help"});
    EXPECT_EQ(result.exitCode, 0);
    for (const char* name : {"-o FILE",        "--size",
                             "--samples",      "--float",
                             "--title",        "--camera home",
                             "--camera eye",   "--camera-path",
                             "--speed",        "--frames",
                             "--time",         "--frame-time",
                             "--paging-limit", "--stats",
                             "--timing",       "--list-plan",
                             "--reference",    "--tolerance",
                             "--difference",   "--backend",
                             "@FILE",          "-D NAME=VALUE",
                             "--html",         "--clear-color",
                             "--list-keys",    "-O <option_string>"})
        EXPECT_NE(result.output.find(name), std::string::npos) << name;
}

TEST_F(OsgRenderGLTest, keysOfTheViewerAreListed)
{
    const support::ProcessResult result = run({"--list-keys"});
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_NE(result.output.find("D  Shadows: volumes, maps, none\n"), std::string::npos);
    EXPECT_NE(result.output.find("P  Prints what was drawn for each light, and why\n"),
              std::string::npos);
}

TEST_F(OsgRenderGLTest, whatCantBeReadOrWrittenFails)
{
    _folder.write("broken.iv", "#Inventor V2.1 ascii\nSeparator { Cube { width");
    expectFails({"nowhere.iv", "-o", "a.png"}, 1, "'nowhere.iv' can't be read: it is not there");
    expectFails({"broken.iv", "-o", "a.png"}, 1, "'broken.iv' can't be read");
    expectFails({"square.osgt", "nowhere.iv", "-o", "a.png"}, 1, "'nowhere.iv' can't be read");
    expectFails({"square.osgt.nosuchkit", "-o", "a.png"}, 1, "no plugin reads '.nosuchkit'");
    expectFails({"square.osgt", "-o", "/proc/no/a.png"}, 1, "can't make the folder '/proc/no'");
    expectFails({"square.osgt", "-o", "a.png", "--stats", "/proc/no.json"}, 1, "can't write");
    expectFails({"square.osgt", "-o", "a.png", "--camera-path", "no.path"}, 1, "is not there");
    _folder.write("bad.path", "0 0 0 0 0 0 0 1\n1 nonsense\n");
    expectFails({"square.osgt", "-o", "a.png", "--camera-path", "bad.path"}, 1, "line 2");
}

TEST_F(OsgRenderGLTest, noContextIsAFailureAndNoPicture)
{
    expectFails({"square.osgt", "-o", "a.png", "--size", "40000x40000"}, 1, "no egl context");
    EXPECT_FALSE(exists("a.png"));
}

TEST_F(OsgRenderGLTest, emptyModelRendersTheBackgroundAndWarns)
{
    _folder.write("empty.iv", "#Inventor V2.1 ascii\nSeparator {}\n");
    const support::ProcessResult result =
        run({"empty.iv", "-o", "a.png", "--clear-color", "0,1,0", "--stats", "a.json"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_NE(result.errors.find("holds nothing to draw"), std::string::npos) << result.errors;
    EXPECT_EQ(countPixels(*picture("a.png"), 1), 160 * 120);
    const nlohmann::json stats = nlohmann::json::parse(read("a.json"));
    EXPECT_EQ(stats["warnings"], 1);
    EXPECT_EQ(stats["coverage"], 0.0);
}

TEST_F(OsgRenderGLTest, osgviewersSwitchesWork)
{
    expectRenders({"square.osgt", "-o", "window.png", "--window", "10", "10", "64", "48"});
    EXPECT_EQ(picture("window.png")->s(), 64);
    EXPECT_EQ(picture("window.png")->t(), 48);
    expectRenders({"square.osgt", "-o", "egl.jpg", "-e", "egl", "-e", "osgt", "-O", "a=b",
                   "--screen", "0", "--stencil"});
    EXPECT_GT(countPixels(*picture("egl.jpg"), 0), 500);
    expectRenders({"square.osgt.2,1,2.scale", "-o", "scaled.png", "--camera", Front});
    expectRenders({"square.osgt", "-o", "plain.png", "--camera", Front});
    const double ratio =
        double(countPixels(*picture("scaled.png"), 0)) / countPixels(*picture("plain.png"), 0);
    EXPECT_NEAR(ratio, 4.0, 0.3);
    _folder.write("go.path", "0 0 -10 0 0.7071067811865475 0 0 0.7071067811865476\n"
                             "2 2 -10 0 0.7071067811865475 0 0 0.7071067811865476\n");
    expectRenders({"square.osgt", "-o", "path.png", "-p", "go.path"});
    EXPECT_GT(countPixels(*picture("path.png"), 0), 100);
}

TEST_F(OsgRenderGLTest, samplesSmoothEdges)
{
    const std::vector<std::string> words = {"square.osgt", "--camera",
                                            "eye:0,-10,0;center:0,0,0;up:1,0,3;fov:40", "-o"};
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"0", "egl"}, {"4", "egl"}, {"0", "osmesa"}, {"4", "osmesa"}};
    for (const auto& [samples, backend] : cases)
    {
        std::vector<std::string> all = words;
        all.insert(all.end(), {samples + ".png", "--clear-color", "0,0,0", "--samples", samples,
                               "--backend", backend});
        expectRenders(all);
        int between = 0;
        const osg::ref_ptr<osg::Image> image = picture(samples + ".png");
        for (unsigned y = 0; y < 120; ++y)
        {
            for (unsigned x = 0; x < 160; ++x)
            {
                const float red = image->getColor(x, y).r();
                between += red > 0.01f && red < 0.99f;
            }
        }
        EXPECT_EQ(between > 0, samples == "4") << backend << " " << samples;
    }
}

TEST_F(OsgRenderGLTest, framesAreNumberedAndTheSameInEachRun)
{
    scenes::write(*scenes::movingSquare(Red), _folder.file("moving.osgt"));
    const std::vector<std::string> words = {
        "moving.osgt", "--camera", Front, "--frames", "3", "--time", "1", "--frame-time", "0.5"};
    for (const std::string run : {"a", "b"})
    {
        std::vector<std::string> all = words;
        all.insert(all.end(), {"-o", run + "%02d.png", "-o", run + "last.png"});
        expectRenders(all);
    }
    const double step = 0.5 * halfSide(10.0, 40.0);
    for (int i = 0; i < 3; ++i)
    {
        const std::string number = "0" + std::to_string(i) + ".png";
        // The path's clock starts with the first frame.
        EXPECT_NEAR(meanX(*picture("a" + number), 0), 79.5 + i * step, 1.0);
        EXPECT_EQ(read("a" + number), read("b" + number));
    }
    EXPECT_EQ(read("alast.png"), read("a02.png"));
    EXPECT_FALSE(exists("a03.png"));
}

TEST_F(OsgRenderGLTest, cameraPathMovesTheCamera)
{
    _folder.write("go.path", "5 0 -10 0 0.7071067811865475 0 0 0.7071067811865476\n"
                             "7 2 -10 0 0.7071067811865475 0 0 0.7071067811865476\n");
    expectRenders({"square.osgt", "--camera-path", "go.path", "--frames", "3", "--frame-time",
                   "0.5", "--speed", "2", "-o", "%d.png"});
    const double first = meanX(*picture("0.png"), 0);
    const double second = meanX(*picture("1.png"), 0);
    const double third = meanX(*picture("2.png"), 0);
    EXPECT_NEAR(first, 79.5, 1.0);
    EXPECT_LT(second, first - 5.0);
    EXPECT_NEAR(third - second, second - first, 2.0);
}

TEST_F(OsgRenderGLTest, pagedTilesAreWaitedFor)
{
    scenes::write(*scenes::square(Green), _folder.file("tile.osgt"));
    scenes::write(*scenes::pagedSquare(Red, "tile.osgt"), _folder.file("paged.osgt"));
    expectRenders({"paged.osgt", "--camera", Front, "-o", "a.png"});
    EXPECT_EQ(center(*picture("a.png")), Green);
}

TEST_F(OsgRenderGLTest, floatPicturesKeepValuesAboveOne)
{
    scenes::write(*scenes::glowingSquare(osg::Vec3(3.0f, 0.5f, 0.25f)), _folder.file("glow.osgt"));
    const osg::Vec3 expected(3.0f, 0.5f, 0.25f);
    for (const std::string samples : {"0", "4"})
    {
        expectRenders({"glow.osgt", "-o", "a.exr", "-o", "a.hdr", "-o", "a.tif", "-o", "a.tif",
                       "--samples", samples, "--camera", Front});
        expectRenders(
            {"glow.osgt", "-o", "float.tif", "--float", "--samples", samples, "--camera", Front});
        for (const char* name : {"a.exr", "float.tif"})
        {
            const osg::Vec4 color = center(*picture(name));
            for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(color[i], expected[i], 1e-3) << name << " " << samples;
        }
        EXPECT_EQ(center(*picture("a.tif")).r(), 1.0f);
        EXPECT_EQ(picture("a.tif")->getDataType(), GLenum(GL_UNSIGNED_BYTE));
        // 160x120 in the header, row by row: OSG's own writer swaps them.
        EXPECT_NE(read("a.hdr").find("-Y 120 +X 160"), std::string::npos);
    }
}

TEST_F(OsgRenderGLTest, floatAndBytePicturesAreTheSameBelowOne)
{
    const std::string model = support::inventorModel("engine.iv");
    expectRenders({model, "-o", "a.png"});
    expectRenders({model, "-o", "b.exr", "-o", "b.png"});
    // Half a step of 8 bits on each side.
    EXPECT_TRUE((support::CompareImage{1.0 / 255.0, 0.0, 1.0 / 255.0}(
        picture("b.png"), picture("a.png"), "osgrenderFloat")));
}

TEST_F(OsgRenderGLTest, referenceIsComparedAndTheDifferenceWritten)
{
    scenes::write(*scenes::square(Green), _folder.file("other.osgt"));
    expectRenders({"square.osgt", "--camera", Front, "-o", "ref.png"});
    expectRenders({"square.osgt", "--camera", Front, "--reference", "ref.png"});
    EXPECT_FALSE(exists("ref.difference.png"));
    const std::vector<std::string> other = {"other.osgt", "--camera", Front, "--reference",
                                            "ref.png"};
    expectFails(other, 1, "differs from 'ref.png'");
    EXPECT_EQ(center(*picture("ref.difference.png")), osg::Vec4(1.0f, 1.0f, 0.0f, 1.0f));
    std::vector<std::string> loose = other;
    loose.insert(loose.end(), {"--tolerance", "0.1,50%,1", "--difference", "d/loose.png"});
    expectRenders(loose);
    EXPECT_TRUE(exists("d/loose.png"));
    loose[6] = "0.1,5%,1";
    expectFails(loose, 1, "allowed 5 %");
    expectFails({"square.osgt", "--reference", "ref.png", "--size", "32x32"}, 1,
                "the picture 32x32");
    expectFails({"square.osgt", "--reference", "no.png"}, 1, "reference 'no.png' can't be read");
}

TEST_F(OsgRenderGLTest, statisticsHaveAllKeysAndSaneValues)
{
    const std::string model = support::inventorModel("simple/texture.iv");
    expectRenders({model, "--stats", "new/a.json", "--timing", "20", "--samples", "4"});
    const nlohmann::json stats = nlohmann::json::parse(read("new/a.json"));
    EXPECT_EQ(stats.at("model"), model);
    EXPECT_EQ(stats.at("backend"), "egl");
    EXPECT_FALSE(stats.at("renderer").at("name").get<std::string>().empty());
    EXPECT_EQ(stats.at("size"), (std::vector<int>{160, 120}));
    EXPECT_EQ(stats.at("samples"), 4);
    for (const char* name : {"frameMs", "cullMs", "drawMs"})
    {
        const nlohmann::json& times = stats.at(name);
        EXPECT_EQ(times.at("count"), 20) << name;
        EXPECT_GT(times.at("min"), 0.0) << name;
        EXPECT_LE(times.at("min"), times.at("median")) << name;
        EXPECT_LE(times.at("median"), times.at("p99")) << name;
    }
    EXPECT_TRUE(stats.contains("gpuMs"));
    EXPECT_EQ(stats.at("passes"), 1.0);
    EXPECT_GE(stats.at("drawCalls"), 1.0);
    EXPECT_GE(stats.at("triangles"), 1.0);
    // 4x2 texels of three bytes, and two smaller levels of 6 and 1 byte as OSG counts them.
    EXPECT_EQ(stats.at("textureBytes"), 31.0);
    EXPECT_EQ(stats.at("programs").at("compiled"), 0.0);
    EXPECT_EQ(stats.at("programs").at("reused"), 0.0);
    EXPECT_EQ(stats.at("glErrors"), 0);
    EXPECT_EQ(stats.at("warnings"), 0);
    EXPECT_TRUE(stats.at("plans").is_array());
    EXPECT_GT(stats.at("coverage"), 0.01);
    EXPECT_GT(stats.at("firstFrameMs"), 0.0);
    EXPECT_GT(stats.at("loadMs"), 0.0);
}

TEST_F(OsgRenderGLTest, kitsPlansAndProgramsAreReported)
{
    const std::string model = support::inventorModel("engine.iv");
    expectRenders({model, "--stats", "plain.json", "--timing", "0"});
    expectRenders({model + ".(shadows=off,lighting=pixel).shadowvolume", "--stats", "kit.json",
                   "--timing", "0"});
    const nlohmann::json plain = nlohmann::json::parse(read("plain.json"));
    const nlohmann::json kit = nlohmann::json::parse(read("kit.json"));
    ASSERT_EQ(kit.at("plans").size(), 1u);
    EXPECT_EQ(kit.at("plans")[0].at("kit"), "osgShadowVolume::ShadowedScene");
    EXPECT_FALSE(kit.at("plans")[0].at("entries").empty());
    EXPECT_GE(kit.at("programs").at("compiled"), 1.0);
    // One pass draws each leaf once, as without the kit.
    EXPECT_EQ(kit.at("drawCalls"), plain.at("drawCalls"));
    EXPECT_EQ(kit.at("triangles"), plain.at("triangles"));
}

TEST_F(OsgRenderGLTest, openGlErrorsAndWarningsAreCounted)
{
    scenes::write(*scenes::squareWithLight(20), _folder.file("light.osgt"));
    const support::ProcessResult result = run({"light.osgt", "--stats", "a.json", "--timing", "0"});
    EXPECT_EQ(result.exitCode, 0);
    const nlohmann::json stats = nlohmann::json::parse(read("a.json"));
    EXPECT_GE(stats.at("glErrors"), 1);
    EXPECT_EQ(stats.at("warnings"), stats.at("glErrors"));
    EXPECT_NE(result.errors.find("OpenGL error 0x500"), std::string::npos) << result.errors;
}

TEST_F(OsgRenderGLTest, threadingModelsGiveTheSamePicture)
{
    const std::string model = support::inventorModel("engine.iv");
    expectRenders({model, "-o", "one.png"});
    for (const char* threading : {"--DrawThreadPerContext", "--CullDrawThreadPerContext",
                                  "--CullThreadPerCameraDrawThreadPerContext"})
    {
        expectRenders({model, "-o", "many.png", threading});
        EXPECT_EQ(read("many.png"), read("one.png")) << threading;
    }
}

TEST_F(OsgRenderGLTest, listPlanTellsWhatWasDrawn)
{
    const support::ProcessResult result = run({"square.osgt", "--list-plan"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_NE(result.output.find("1 draw calls"), std::string::npos) << result.output;
    EXPECT_NE(result.output.find("drawn"), std::string::npos) << result.output;
}
