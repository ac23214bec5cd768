// SPDX-License-Identifier: MIT
// Map labels in files, and tables of them that the pseudo-loader is told.
#include <support/NotifyCapture.h>
#include <support/TemporaryFolder.h>

#include <osgLabels/LabelScene.h>
#include <osgLabels/MapLabels.h>

#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

using osgLabels::MapLabel;
using osgLabels::MapLabels;

namespace
{

class MapLabelsFiles : public testing::Test
{
protected:
    support::NotifyCapture _notify;
    support::TemporaryFolder _folder;
};

const char* const Cube = "#Inventor V2.1 ascii\nDEF house Separator { Cube {} }\n";

std::string readError(const std::string& file)
{
    return osgDB::Registry::instance()->readNode(file, nullptr).message();
}

} // namespace

TEST_F(MapLabelsFiles, eachFormatKeepsAllOfALabel)
{
    const std::vector<MapLabel> labels = {
        {{1.0 / 3.0, -1e7 - 0.125, 3e-9}, "Capitol \"Building\"\nGrüße", 0.1, "big", "capitol 1"},
        {{0, 0, 0}, "", -2, "", ""},
        {{4, 5, 6}, "text with spaces, and {brackets}", 1e300, "a b", ""}};
    for (const std::string extension : {"osgt", "osgb", "osgx", "osg"})
    {
        osg::ref_ptr<osgLabels::LabelScene> scene = new osgLabels::LabelScene;
        scene->setSettingsText("mapsize=20,mapclass='tree:fade,house:hide'");
        osg::ref_ptr<MapLabels> node = new MapLabels(labels);
        node->setName("map");
        scene->addChild(node);
        const std::string file = _folder.file("labels." + extension);
        ASSERT_TRUE(osgDB::writeNodeFile(*scene, file)) << extension;
        const osg::ref_ptr<osg::Node> read = osgDB::readRefNodeFile(file);
        ASSERT_TRUE(read && read->asGroup()) << extension;
        auto* copy = dynamic_cast<MapLabels*>(read->asGroup()->getChild(0));
        ASSERT_TRUE(copy) << extension;
        EXPECT_EQ(copy->getName(), "map");
        ASSERT_EQ(copy->getLabels().size(), labels.size()) << extension;
        for (std::size_t i = 0; i < labels.size(); ++i)
        {
            const MapLabel& actual = copy->getLabels()[i];
            EXPECT_EQ(actual.anchor, labels[i].anchor) << extension;
            EXPECT_EQ(actual.text, labels[i].text) << extension;
            EXPECT_EQ(actual.priority, labels[i].priority) << extension;
            EXPECT_EQ(actual.style, labels[i].style) << extension;
            EXPECT_EQ(actual.feature, labels[i].feature) << extension;
        }
        auto* readScene = dynamic_cast<osgLabels::LabelScene*>(read.get());
        ASSERT_TRUE(readScene);
        EXPECT_EQ(readScene->getSettings().mapClass, "tree:fade,house:hide");
    }
}

TEST_F(MapLabelsFiles, filesThatEndTooEarlyAreRefused)
{
    osg::ref_ptr<MapLabels> node =
        new MapLabels({{{1, 2, 3}, "a text", 1, "", ""}, {{1, 2, 3}, "another text", 1, "", ""}});
    const std::string whole = _folder.file("whole.osgb");
    ASSERT_TRUE(osgDB::writeNodeFile(*node, whole));
    std::ifstream in(whole, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const std::size_t text = bytes.find("another");
    ASSERT_NE(text, std::string::npos);
    EXPECT_FALSE(osgDB::readRefNodeFile(_folder.write("cut.osgb", bytes.substr(0, text - 20))));
    EXPECT_NE(_notify.takeWarnings().size(), 0u);
}

TEST_F(MapLabelsFiles, tablesLieBesideTheModel)
{
    const std::string model = _folder.write("town.iv", Cube);
    const std::string table = _folder.write("labels.csv", "x,y,z,text\n1,2,3,House\n");
    const osg::ref_ptr<osg::Node> read = osgDB::readRefNodeFile(model + ".(map=labels.csv).labels");
    auto* scene = dynamic_cast<osgLabels::LabelScene*>(read.get());
    ASSERT_TRUE(scene) << readError(model + ".(map=labels.csv).labels");
    EXPECT_EQ(scene->getSettings().map, table);
    EXPECT_EQ(_notify.takeWarnings(), support::NotifyCapture::Lines());
}

TEST_F(MapLabelsFiles, aTableThatIsMissingIsOneClearError)
{
    const std::string model = _folder.write("town.iv", Cube);
    const std::string error = readError(model + ".(map=nowhere.csv).labels");
    EXPECT_NE(error.find("map=nowhere.csv': there is no such file, neither beside the model in '"),
              std::string::npos)
        << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
}
