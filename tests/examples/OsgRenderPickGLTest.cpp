// SPDX-License-Identifier: MIT
#include "RenderProcess.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace
{

// Two named boxes side by side, from the front: one left, one right of the middle.
constexpr char Boxes[] = R"(#Inventor V2.1 ascii
Separator {
  DEF LEFT Separator { Translation { translation -2 0 0 } Cube { width 3 height 2 depth 1 } }
  DEF RIGHT Separator { Translation { translation 2 0 0 } Cube { width 3 height 2 depth 1 } }
}
)";

const std::string Front = "eye:0,-8,0;center:0,0,0;fov:40";

} // namespace

class OsgRenderPickGLTest : public RenderProcess
{
protected:
    void SetUp() override { _folder.write("boxes.iv", Boxes); }
};

TEST_F(OsgRenderPickGLTest, objectsAtPixelsArePrintedWithTextAndNodes)
{
    const support::ProcessResult result =
        run({"boxes.iv.labels", "--camera", Front, "--pick", "40,60", "--pick", "120,60", "--pick",
             "80,60", "--pick", "159,119"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.errors, "");
    std::istringstream lines(result.output);
    std::string left, right, gap, corner, more;
    std::getline(lines, left);
    std::getline(lines, right);
    std::getline(lines, gap);
    std::getline(lines, corner);
    EXPECT_FALSE(std::getline(lines, more)) << result.output;
    EXPECT_EQ(left.substr(0, 20), "pick 40,60: 1 'LEFT'") << result.output;
    EXPECT_NE(left.find("/LEFT"), std::string::npos) << left;
    EXPECT_EQ(right.substr(0, 22), "pick 120,60: 2 'RIGHT'") << result.output;
    EXPECT_NE(right.find("/RIGHT"), std::string::npos) << right;
    EXPECT_EQ(gap, "pick 80,60: nothing labelled");
    EXPECT_EQ(corner, "pick 159,119: nothing labelled");
}

TEST_F(OsgRenderPickGLTest, pixelsCountFromTheLowerLeftCornerWithAnyTarget)
{
    // From below the middle of the left box's lower half: its edge lies between the two pixels.
    for (const char* samples : {"0", "4"})
    {
        const support::ProcessResult result =
            run({"boxes.iv.labels", "--camera", "eye:-2,-8,-1;center:-2,0,-1;fov:40", "--samples",
                 samples, "-o", "a.png", "--pick", "80,66", "--pick", "80,50"});
        EXPECT_EQ(result.errors, "");
        EXPECT_NE(result.output.find("pick 80,66: 1 'LEFT'"), std::string::npos) << result.output;
        EXPECT_NE(result.output.find("pick 80,50: nothing"), std::string::npos) << result.output;
        EXPECT_TRUE(exists("a.png"));
    }
}

TEST_F(OsgRenderPickGLTest, aSceneThatDrawsNoLabelsAnswersNothing)
{
    const support::ProcessResult result =
        run({"boxes.iv.(match=UP).labels", "--camera", Front, "--pick", "40,60"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.errors, "");
    EXPECT_EQ(result.output, "pick 40,60: nothing labelled\n");
}

TEST_F(OsgRenderPickGLTest, statisticsHaveWhatWasPickedAndTheMemoryOfLabels)
{
    expectRenders({"boxes.iv.labels", "--camera", Front, "--stats", "s.json", "--timing", "0"});
    const support::ProcessResult result =
        run({"boxes.iv.labels", "--camera", Front, "--pick", "40,60", "--stats", "s.json",
             "--timing", "1", "--list-plan"});
    EXPECT_EQ(result.errors, "");
    const nlohmann::json json = nlohmann::json::parse(read("s.json"));
    const nlohmann::json pick = json.at("picks").at(0);
    EXPECT_EQ(pick.at("point"), nlohmann::json({40, 60}));
    EXPECT_EQ(pick.at("identifier"), 1);
    EXPECT_EQ(pick.at("text"), "LEFT");
    const nlohmann::json counts = json.at("plans").at(0).at("counts");
    EXPECT_EQ(counts.at("labels.count"), 2);
    for (const char* part : {"texts", "rows", "records", "glyphs", "targets"})
    {
        const std::string name = std::string("labels.bytes.") + part;
        EXPECT_GT(counts.at(name).get<double>(), 0.0) << name;
        EXPECT_NE(result.output.find("  " + name + " = "), std::string::npos) << result.output;
    }
    // Three records of 48 bytes, the first is none.
    EXPECT_NE(result.output.find("labels.bytes.records = 144 bytes\n"), std::string::npos)
        << result.output;
    EXPECT_NE(result.output.find("iB\n"), std::string::npos) << result.output;
}

TEST_F(OsgRenderPickGLTest, whatCannotBePickedIsAnError)
{
    expectFails({"boxes.iv.labels", "--pick", "160,0"}, 2,
                "--pick: 160,0 is outside of a picture of 160x120");
    expectFails({"boxes.iv.labels", "--pick", "middle"}, 2,
                "--pick: 'middle' is not a pixel X,Y from the lower left corner, like 400,300");
    expectFails({"boxes.iv.labels", "--pick", "-1,3"}, 2, "is not a pixel");
    expectFails({"boxes.iv", "--pick", "10,10"}, 1, "--pick needs labels: 'model.iv.labels'");
}

TEST_F(OsgRenderPickGLTest, keysAndSwitchesAreListed)
{
    const support::ProcessResult keys = run({"--list-keys"});
    EXPECT_EQ(keys.exitCode, 0);
    EXPECT_NE(keys.output.find("L  Labels, shown or not\n"), std::string::npos) << keys.output;
    EXPECT_NE(keys.output.find("I  Prints identifier"), std::string::npos) << keys.output;
    EXPECT_NE(run({"--help"}).output.find("--pick X,Y"), std::string::npos);
}
