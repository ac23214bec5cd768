// SPDX-License-Identifier: MIT
#include <osgLabels/MapLabelFile.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <clocale>
#include <fstream>
#include <sstream>

using namespace osgLabels;

namespace
{

using Warnings = std::vector<std::string>;

std::vector<MapLabel> read(const std::string& content, Warnings& warnings)
{
    std::istringstream in(content);
    return readMapLabels(in, "city.csv", warnings);
}

/// Expects no warning.
std::vector<MapLabel> read(const std::string& content)
{
    Warnings warnings;
    std::vector<MapLabel> labels = read(content, warnings);
    EXPECT_EQ(warnings, Warnings());
    return labels;
}

/// Of a content with one wrong line, after which a right one is read.
std::string warningOf(const std::string& line)
{
    Warnings warnings;
    const std::vector<MapLabel> labels = read(line + "\n7,8,9,next\n", warnings);
    EXPECT_EQ(labels.size(), 1u) << line;
    EXPECT_EQ(warnings.size(), 1u) << line;
    return warnings.empty() ? "" : warnings[0];
}

} // namespace

TEST(MapLabelFileTest, allColumnsAreRead)
{
    const auto labels = read("1.5,-2e3,+0.25,Town Hall,10.5,plate,Building 17,more,and more\n"
                             "4,5,6,Park\n"
                             "4,5,6,,, ,\n");
    ASSERT_EQ(labels.size(), 3u);
    EXPECT_EQ(labels[0].anchor, osg::Vec3d(1.5, -2000.0, 0.25));
    EXPECT_EQ(labels[0].text, "Town Hall");
    EXPECT_EQ(labels[0].priority, 10.5);
    EXPECT_EQ(labels[0].style, "plate");
    EXPECT_EQ(labels[0].feature, "Building 17");
    EXPECT_EQ(labels[1].text, "Park");
    EXPECT_EQ(labels[1].priority, 0.0);
    EXPECT_EQ(labels[1].style + labels[1].feature, "");
    EXPECT_EQ(labels[2].text + labels[2].style, "");
}

TEST(MapLabelFileTest, coordinatesHaveTheDigitsOfADouble)
{
    EXPECT_EQ(read("10000000.123456789,0.1,4e-320,far").at(0).anchor,
              osg::Vec3d(10000000.123456789, 0.1, 4e-320));
}

TEST(MapLabelFileTest, aHeadingIsOptionalAndMayReorder)
{
    EXPECT_EQ(read("x,y,z,text,priority,style,feature\n1,2,3,a\n").size(), 1u);
    const auto labels = read("Feature, Text ,id,Z,y,X\nhouse,a,77,3,2,1\n");
    ASSERT_EQ(labels.size(), 1u);
    EXPECT_EQ(labels[0].anchor, osg::Vec3d(1.0, 2.0, 3.0));
    EXPECT_EQ(labels[0].text, "a");
    EXPECT_EQ(labels[0].feature, "house");
    EXPECT_EQ(labels[0].priority, 0.0);
}

TEST(MapLabelFileTest, bomQuotesAndLineEndsOfAnyKindAreRead)
{
    const auto labels = read("\xEF\xBB\xBF"
                             "x,y,z,text\r\n1,2,3,\"a, \"\"b\"\"\r\nc\"\r\n\r\n4,5,6,\xC3\xA4");
    ASSERT_EQ(labels.size(), 2u);
    EXPECT_EQ(labels[0].text, "a, \"b\"\r\nc");
    EXPECT_EQ(labels[1].text, "\xC3\xA4");
    EXPECT_EQ(read("1,2,3,a\r4,5,6,b\r").size(), 2u);
    EXPECT_EQ(read("").size(), 0u);
    EXPECT_EQ(read("\n\r\n").size(), 0u);
}

TEST(MapLabelFileTest, decimalPointsAreReadWhateverTheLocale)
{
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"})
    {
        std::setlocale(LC_ALL, name); // without effect where it is not installed
        EXPECT_EQ(read("1.5,2,3,a,0.5").at(0).anchor.x(), 1.5);
        EXPECT_EQ(read("1.5,2,3,a,0.5").at(0).priority, 0.5);
    }
    std::setlocale(LC_ALL, before.c_str());
}

TEST(MapLabelFileTest, wrongLinesAreLeftOutEachWithFileLineAndCause)
{
    EXPECT_EQ(warningOf("1,2"), "city.csv:1: a label needs 4 columns, x, y, z and text, this line "
                                "has 2; quote a text that has a comma: \"a,b\"");
    EXPECT_EQ(warningOf("1;2;3;a"), "city.csv:1: a label needs 4 columns, x, y, z and text, this "
                                    "line has 1; separate them by a comma");
    EXPECT_EQ(warningOf("\n1,two,3,a"), "city.csv:2: y is 'two', which is no number");
    EXPECT_EQ(warningOf("1,\"2,5\",3,a"),
              "city.csv:1: y is '2,5', which is no number; write a decimal point");
    EXPECT_EQ(warningOf("1,2,,a"), "city.csv:1: z is '', which is no number");
    EXPECT_EQ(warningOf("1,2,+-3,a"), "city.csv:1: z is '+-3', which is no number");
    EXPECT_EQ(warningOf("0x10,2,3,a"), "city.csv:1: x is '0x10', which is no number");
    EXPECT_EQ(warningOf("nan,2,3,a"), "city.csv:1: x is 'nan'; it must be finite");
    EXPECT_EQ(warningOf("1,-inf,3,a"), "city.csv:1: y is '-inf'; it must be finite");
    EXPECT_EQ(warningOf("1,2,1e999,a"),
              "city.csv:1: z is '1e999', beyond what a double holds; scale it");
    EXPECT_EQ(warningOf("1,2,3,a,high"), "city.csv:1: priority is 'high', which is no number");
    EXPECT_EQ(warningOf("1,2,3,a,NaN"), "city.csv:1: priority is 'NaN'; it must be finite");
    EXPECT_EQ(warningOf("1,2,3,\"a\"b\""),
              "city.csv:1: a quote inside of a field; double it, and quote the field: \"say "
              "\"\"so\"\"\"");
    EXPECT_EQ(warningOf("1,\"two\nlines\",3,a"),
              "city.csv:1: y is 'two lines', which is no number");
    EXPECT_EQ(warningOf("1," + std::string(10000, 'a') + ",3,a"),
              "city.csv:1: y is '" + std::string(60, 'a') + "...', which is no number");
    EXPECT_EQ(warningOf("lon,lat,height,name"), "city.csv:1: x is 'lon', which is no number");
}

TEST(MapLabelFileTest, aQuoteThatIsNeverClosedLosesWhatFollowsOnly)
{
    Warnings warnings;
    EXPECT_EQ(read("1,2,3,a\n4,5,6,\"b\n7,8,9,c\n", warnings).size(), 1u);
    EXPECT_EQ(warnings, Warnings{"city.csv:2: a quote is opened and never closed; close it"});
}

TEST(MapLabelFileTest, manyWrongLinesAreCounted)
{
    std::string content;
    for (int i = 0; i < 1000; ++i)
        content += "x\n";
    Warnings warnings{"of somebody else"};
    EXPECT_TRUE(read(content, warnings).empty());
    ASSERT_EQ(warnings.size(), 22u);
    EXPECT_EQ(warnings.back(), "city.csv: 980 more lines are wrong");
}

TEST(MapLabelFileTest, whatIsNoTextFileIsNamed)
{
    Warnings warnings;
    EXPECT_TRUE(read(std::string("\xff\xfe"
                                 "1\0,\0",
                                 6),
                     warnings)
                    .empty());
    support::TemporaryFolder folder;
    std::ifstream missing(folder.file("no.csv")), directory(folder.file(""));
    readMapLabels(missing, "no.csv", warnings);
    readMapLabels(directory, "folder", warnings);
    EXPECT_EQ(warnings, (Warnings{"city.csv: is UTF-16; save it as UTF-8",
                                  "no.csv: cannot be read; does it exist?",
                                  "folder: cannot be read; does it exist?"}));
}

TEST(MapLabelFileTest, anyBytesAreReadWithoutACrash)
{
    std::uint32_t state = 1;
    for (int file = 0; file < 300; ++file)
    {
        std::string content;
        for (int i = 0; i < 400; ++i)
        {
            state = state * 1664525u + 1013904223u;
            content += (state >> 31) ? "\",\n\r1.e-"[(state >> 20) % 8] : char(state >> 24);
        }
        Warnings warnings;
        read(content, warnings);
    }
}
