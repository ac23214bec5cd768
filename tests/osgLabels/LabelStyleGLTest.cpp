// SPDX-License-Identifier: MIT
// Which look the labels of groups, tables and single objects have.
#include "LabelPictures.h"

#include <osgLabels/LabelResources.h>
#include <osgLabels/PrimitiveBatch.h>

#include <support/NotifyCapture.h>
#include <support/TemporaryFolder.h>

#include <osg/ValueObject>

#include <fstream>
#include <thread>

using namespace labelScene;
using osgLabels::LabelScene;

namespace
{

constexpr char Styles[] = "ink=#000000,plate=off,styles='hot:ink=#ff0000,plate=off;"
                          "cold:ink=#0000ff,plate=off'";
const osg::Vec4 Black(0, 0, 0, 1), Red(1, 0, 0, 1), Blue(0, 0, 1, 1);

class LabelStyles : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(viewer()); }

    support::NotifyCapture _notify;
};

/// Places of the boards, by their left lower corners.
constexpr float Left = -1.25f, Right = 0.05f, Upper = 0.05f, Lower = -0.85f;

osg::ref_ptr<osg::Geode> board(const std::string& name, float x, float z)
{
    const auto geode =
        named(name, rectangle({x, 0, z}, {1.2f, 0, 0}, {0, 0, 0.8f}, {0.9f, 0.9f, 0.8f, 1}));
    geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    return geode;
}

/// Share of the pixels of a board that are nearly of a colour.
double shareOf(const osg::Image& picture, float x, float z, const osg::Vec4& color)
{
    const auto column = [](float at) { return int((at + 4.0f / 3.0f) * Height / 2.0f); };
    const auto row = [](float at) { return int((at + 1.0f) * Height / 2.0f); };
    int count = 0, all = 0;
    for (int j = row(z); j < row(z + 0.8f); ++j)
        for (int i = column(x); i < column(x + 1.2f); ++i, ++all)
        {
            const osg::Vec4 difference = picture.getColor(unsigned(i), unsigned(j)) - color;
            count += osg::Vec3(difference.x(), difference.y(), difference.z()).length() < 0.2f;
        }
    return double(count) / all;
}

/// Which of the three inks a board has; "none" or "several".
std::string inkOf(const osg::Image& picture, float x, float z)
{
    std::string ink = "none";
    const std::pair<const char*, osg::Vec4> inks[] = {
        {"black", Black}, {"red", Red}, {"blue", Blue}};
    for (const auto& [name, color] : inks)
        if (shareOf(picture, x, z, color) > 0.02)
            ink = ink == "none" ? name : "several";
    return ink;
}

std::uint32_t identifierOf(const LabelScene& scene, const std::string& text)
{
    for (std::uint32_t i = 1; i < 10; ++i)
        if (scene.getText(i) == text)
            return i;
    return 0;
}

} // namespace

TEST_F(LabelStyles, aGroupsUserValueStylesAllInItButWhatHasOneOfItsOwn)
{
    osg::ref_ptr<osg::Group> root = new osg::Group, hot = new osg::Group;
    hot->setUserValue("labelStyle", std::string("hot"));
    hot->addChild(board("A1", Left, Upper));
    const auto cold = board("B2", Right, Upper);
    cold->setUserValue("labelStyle", std::string("cold"));
    hot->addChild(cold);
    root->addChild(hot);
    root->addChild(board("C3", Left, Lower));
    const auto scene = labelled(root, Styles);
    const Picture picture = render(*scene);
    keep(picture, "labelStyle.group");
    EXPECT_EQ(inkOf(*picture, Left, Upper), "red");
    EXPECT_EQ(inkOf(*picture, Right, Upper), "blue");
    EXPECT_EQ(inkOf(*picture, Left, Lower), "black");
    EXPECT_EQ(_notify.takeWarnings(), support::NotifyCapture::Lines());
}

TEST_F(LabelStyles, aTablesColumnSaysTheStyleOfNodesAndOfABatchsObjects)
{
    const support::TemporaryFolder folder;
    const std::string table = folder.file("tags.csv");
    std::ofstream(table) << "name,text,style\nA1,AAA,cold\nB2,BBB,\nC3,CCC,hot\nD4,DDD,\n";
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(board("A1", Left, Upper));
    root->addChild(board("B2", Right, Upper));
    osg::ref_ptr<osgLabels::PrimitiveBatch> batch = new osgLabels::PrimitiveBatch;
    for (const auto& [name, x] : {std::pair("C3", Left), std::pair("D4", Right)})
    {
        osgLabels::Primitive box;
        box.position = osg::Vec3d(x + 0.6, 0.1, Lower + 0.4);
        box.size = osg::Vec3(0.6f, 0.1f, 0.4f);
        box.name = name;
        batch->add(box);
    }
    batch->build();
    batch->setUserValue("labelStyle", std::string("cold"));
    batch->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    root->addChild(batch);
    const auto scene = labelled(root, std::string(Styles) + ",text='" + table + "'");
    const Picture picture = render(*scene);
    keep(picture, "labelStyle.table");
    EXPECT_EQ(inkOf(*picture, Left, Upper), "blue");
    EXPECT_EQ(inkOf(*picture, Right, Upper), "black");
    EXPECT_EQ(inkOf(*picture, Left, Lower), "red") << "the table's word";
    EXPECT_EQ(inkOf(*picture, Right, Lower), "blue") << "the batch's user value";
}

TEST_F(LabelStyles, styleAndTextChangeFromAnotherThreadWhileShown)
{
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(board("A1", Left, Upper));
    root->addChild(board("B2", Right, Upper));
    const auto scene = labelled(root, Styles);
    EXPECT_FALSE(scene->setStyle(1, "hot")) << "nothing is collected before the first frame";
    render(*scene);
    const std::uint32_t first = identifierOf(*scene, "A1");
    ASSERT_NE(first, 0u);
    EXPECT_EQ(scene->getStyle(first), "default");
    std::thread([&] { EXPECT_TRUE(scene->setStyle(first, "hot") && scene->setText(first, "HOT")); })
        .join();
    const Picture hot = render(*scene);
    keep(hot, "labelStyle.runtime");
    EXPECT_EQ(inkOf(*hot, Left, Upper), "red");
    EXPECT_EQ(inkOf(*hot, Right, Upper), "black");
    EXPECT_EQ(scene->getStyle(first), "hot");
    EXPECT_TRUE(scene->setStyle(first, "default"));
    EXPECT_EQ(inkOf(*render(*scene), Left, Upper), "black");
    EXPECT_FALSE(scene->setStyle(1000, "hot"));
    EXPECT_EQ(_notify.takeWarnings(), support::NotifyCapture::Lines());
}

TEST_F(LabelStyles, anUnknownStyleIsNamedOnceAndTheDefaultCounts)
{
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->setUserValue("labelStyle", std::string("warm"));
    root->addChild(board("A1", Left, Upper));
    root->addChild(board("B2", Right, Upper));
    const auto scene = labelled(root, Styles);
    EXPECT_EQ(inkOf(*render(*scene), Left, Upper), "black");
    EXPECT_FALSE(scene->setStyle(identifierOf(*scene, "A1"), "warm"));
    EXPECT_EQ(_notify.takeWarnings(), support::NotifyCapture::Lines(
                                          {"osgLabels::LabelScene: there is no style 'warm'; there "
                                           "are hot, cold"}));
    const auto plain = labelled(root);
    render(*plain);
    EXPECT_EQ(_notify.takeWarnings(),
              support::NotifyCapture::Lines({"osgLabels::LabelScene: there is no style 'warm'; "
                                             "define it: styles='warm:ink=#ff0000'"}));
}
