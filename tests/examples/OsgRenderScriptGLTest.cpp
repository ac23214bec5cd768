// SPDX-License-Identifier: MIT
#include "RenderProcess.h"
#include "RenderScenes.h"

class OsgRenderScriptGLTest : public RenderProcess
{
protected:
    void SetUp() override
    {
        scenes::write(*scenes::square(osg::Vec4(1.0f, 0.0f, 0.0f, 1.0f)), _folder.file("a b.osgt"));
        scenes::write(*scenes::square(osg::Vec4(1.0f, 0.0f, 0.0f, 1.0f)), _folder.file("a.osgt"));
    }

    static bool has(const std::string& text, const std::string& part)
    {
        return text.find(part) != std::string::npos;
    }
};

TEST_F(OsgRenderScriptGLTest, goesOnAfterFailedLinesAndEndsWithATable)
{
    _folder.write("s.txt", "# all kinds of failure\n"
                           "a.osgt -o 1.png\n"
                           "nowhere.osgt -o 2.png\n"
                           "a.osgt -o 3.png --frobnicate\n"
                           "\n"
                           "a.osgt -o 'open.png\n"
                           "${OSGKITS_UNKNOWN}.osgt -o 4.png\n"
                           "a.osgt -o 5.png --backend osmesa\n"
                           "@s.txt\n"
                           "a.osgt -o 6.png # the last one\n");
    const support::ProcessResult result = run({"@s.txt"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_TRUE(exists("1.png"));
    EXPECT_TRUE(exists("6.png"));
    EXPECT_TRUE(has(result.errors, "6 of 8 renders failed")) << result.errors;
    EXPECT_TRUE(has(result.errors, "s.txt:3  model 'nowhere.osgt' can't be read")) << result.errors;
    EXPECT_TRUE(has(result.errors, "s.txt:4  unknown switch '--frobnicate'")) << result.errors;
    EXPECT_TRUE(has(result.errors, "s.txt:6  the quote ' is not closed")) << result.errors;
    EXPECT_TRUE(has(result.errors, "s.txt:7  ${OSGKITS_UNKNOWN} is neither")) << result.errors;
    EXPECT_TRUE(has(result.errors, "s.txt:8  --backend")) << result.errors;
    EXPECT_TRUE(has(result.errors, "[8/8]")) << result.errors;
    EXPECT_TRUE(has(result.output, "8 renders, 6 failed")) << result.output;
}

TEST_F(OsgRenderScriptGLTest, namesQuotesAndJoinedLinesAreUnderstood)
{
    _folder.write("s.txt", "'a b.osgt' \\\n  -o ${DIR}/${NAME}.png --size 32x16\n"
                           "\"a b.osgt\" -o '${DIR}.png'\n"
                           "a\\ b.osgt -o x#y.png\n");
    const support::ProcessResult result =
        run({"@s.txt", "-D", "NAME=given"}, {{"DIR", "folder"}, {"NAME", "environment"}});
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    ASSERT_TRUE(exists("folder/given.png"));
    EXPECT_EQ(picture("folder/given.png")->s(), 32);
    EXPECT_TRUE(exists("${DIR}.png"));
    EXPECT_TRUE(exists("x#y.png"));
}

TEST_F(OsgRenderScriptGLTest, linesDoNotSeeEachOthersSettings)
{
    _folder.write("s.txt", "a.osgt -o 1.png --clear-color 0,0,1 --samples 4 -O x --size 20x10\n"
                           "a.osgt -o 2.png --stats 2.json\n");
    expectFails({"@s.txt"}, 0, "[2/2]");
    expectRenders({"a.osgt", "-o", "alone.png"});
    EXPECT_EQ(read("2.png"), read("alone.png"));
    EXPECT_TRUE(has(read("2.json"), "\"samples\": 0"));
}

TEST_F(OsgRenderScriptGLTest, pageShowsEachRenderAndItsFailure)
{
    _folder.write("s.txt",
                  "a.osgt -o page/1.png --title 'One & <only>'\nnowhere.iv -o page/2.png\n");
    EXPECT_EQ(run({"@s.txt", "--html", "page/index.html"}).exitCode, 1);
    const std::string page = read("page/index.html");
    EXPECT_TRUE(has(page, "<img loading=\"lazy\" src=\"1.png\"")) << page;
    EXPECT_TRUE(has(page, "One &amp; &lt;only&gt;"));
    EXPECT_TRUE(has(page, "median "));
    EXPECT_TRUE(has(page, "1 draw calls"));
    EXPECT_TRUE(has(page, "nowhere.iv&#39; can't be read") ||
                has(page, "'nowhere.iv' can't be read"));
    EXPECT_FALSE(has(page, "2.png\""));
}

TEST_F(OsgRenderScriptGLTest, scriptsThatCantBeReadOrAreEmptyFail)
{
    _folder.write("empty.txt", "# nothing\n\n");
    expectFails({"@no.txt"}, 1, "script 'no.txt' can't be read");
    expectFails({"@."}, 1, "script '.'");
    expectFails({"@empty.txt"}, 1, "holds no render");
}
