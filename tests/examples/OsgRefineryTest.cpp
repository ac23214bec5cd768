// SPDX-License-Identifier: MIT
#include <osgLabels/PrimitiveBatch.h>

#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <osg/ComputeBoundsVisitor>
#include <osg/Geode>
#include <osg/NodeVisitor>
#include <osgDB/ReadFile>
#include <osgText/Text>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace
{

/// Names of all groups, and how many texts there are.
class Names : public osg::NodeVisitor
{
public:
    Names() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Group& group) override
    {
        if (!group.getName().empty())
            names.insert(group.getName());
        traverse(group);
    }
    void apply(osg::Drawable& drawable) override
    {
        texts += dynamic_cast<osgText::Text*>(&drawable) != nullptr;
        textures += drawable.getStateSet() &&
                    drawable.getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE);
    }
    std::multiset<std::string> names;
    unsigned int texts = 0, textures = 0;
};

std::string contentOf(const std::string& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

class OsgRefineryTest : public testing::Test
{
protected:
    support::ProcessResult run(std::vector<std::string> words) const
    {
        support::ChildProcess process;
        process.arguments = {OSGKITS_OSGREFINERY};
        process.arguments.insert(process.arguments.end(), words.begin(), words.end());
        process.environment = {{"OSG_LIBRARY_PATH", OSGKITS_LIBRARIES}};
        process.unset = {"DISPLAY"};
        return process.run();
    }

    /// The path of the file that was written.
    std::string made(const std::string& name, std::vector<std::string> words) const
    {
        words.push_back(_folder.file(name));
        const support::ProcessResult result = run(words);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return words.back();
    }

    osg::ref_ptr<osgLabels::PrimitiveBatch> batch(const std::vector<std::string>& words) const
    {
        osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(made("batch.osgb", words));
        return dynamic_cast<osgLabels::PrimitiveBatch*>(node.get());
    }

    support::TemporaryFolder _folder;
};

} // namespace

TEST_F(OsgRefineryTest, makesAsManyObjectsAsAskedForEachWithItsOwnTag)
{
    for (unsigned int objects : {1u, 1000u, 20000u})
    {
        const auto refinery = batch({"--objects", std::to_string(objects)});
        ASSERT_TRUE(refinery);
        EXPECT_EQ(refinery->getNumObjects(), objects);
        std::set<std::string> names;
        std::set<osgLabels::Shape> shapes;
        unsigned int grounds = 0;
        for (unsigned int i = 0; i < refinery->getNumObjects(); ++i)
        {
            const std::string name = refinery->getObjectName(i);
            grounds += name.empty();
            if (!name.empty())
                names.insert(name);
            shapes.insert(refinery->getPrimitive(i).shape);
        }
        EXPECT_EQ(names.size() + grounds, objects);
        EXPECT_LE(grounds, 2 + objects / 700); // the site and the plots
        if (objects > 1000)
        {
            // Box, cylinder, sphere, dish, frustum, pyramid, torus, quad.
            EXPECT_EQ(shapes.size(), 8u);
            const std::regex tags[] = {std::regex(R"(P-\d{4,5}[AB])"), std::regex(R"(V-\d{4,5})"),
                                       std::regex(R"(TK-\d{4,5})"),
                                       std::regex(R"(\d+"-[A-Z]+\d?-\d{4,5}-[A-C]\d[A-E].*)")};
            for (const std::regex& tag : tags)
            {
                EXPECT_TRUE(std::any_of(names.begin(), names.end(),
                                        [&](const std::string& name)
                                        { return std::regex_match(name, tag); }));
            }
        }
    }
}

TEST_F(OsgRefineryTest, aSeedGivesOneFile)
{
    const std::string a = contentOf(made("a.iv", {"--objects", "700", "--seed", "5"}));
    const std::string b = contentOf(made("b.iv", {"--objects", "700", "--seed", "5"}));
    const std::string c = contentOf(made("c.iv", {"--objects", "700", "--seed", "6"}));
    EXPECT_EQ(a, b);
    EXPECT_NE(a, c);
}

TEST_F(OsgRefineryTest, inventorFilesNameEachObject)
{
    const std::string file = made("plant.iv", {"--objects", "1500"});
    const std::regex definition(R"(DEF (\S+) Separator)");
    const std::string text = contentOf(file);
    unsigned int objects = 0;
    for (std::sregex_iterator i(text.begin(), text.end(), definition), end; i != end; ++i)
    {
        const std::string name = (*i)[1];
        EXPECT_TRUE(std::isalpha(static_cast<unsigned char>(name[0])) || name[0] == '_') << name;
        EXPECT_EQ(name.find_first_of("\"'+.\\{}"), std::string::npos) << name;
        ++objects;
    }
    EXPECT_GE(objects, 1495u); // the ground has no name
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
    ASSERT_TRUE(node);
    Names names;
    node->accept(names);
    EXPECT_GE(names.names.size(), objects);
    // What objects share has no name that would be taken for theirs.
    for (const std::string& name : names.names)
        EXPECT_NE(text.find("DEF " + name + " Separator"), std::string::npos) << name;
}

TEST_F(OsgRefineryTest, inventorFilesHoldTheSameAsTheBatch)
{
    const osg::ref_ptr<osg::Node> inventor =
        osgDB::readRefNodeFile(made("plant.iv", {"--objects", "1200"}));
    const auto refinery = batch({"--objects", "1200"});
    ASSERT_TRUE(inventor && refinery);
    osg::ComputeBoundsVisitor boxes[2];
    inventor->accept(boxes[0]);
    refinery->accept(boxes[1]);
    const osg::BoundingBox a = boxes[0].getBoundingBox(), b = boxes[1].getBoundingBox();
    for (int axis = 0; axis < 3; ++axis)
    {
        // Circles have other numbers of sides.
        EXPECT_NEAR(a._min[axis], b._min[axis], 0.1);
        EXPECT_NEAR(a._max[axis], b._max[axis], 0.1);
    }
}

TEST_F(OsgRefineryTest, drawablesHaveNamesAndWhatLabelsThem)
{
    for (const char* labels : {"text", "texture"})
    {
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(
            made("plant.osgb", {"--objects", "300", "--as", "drawables", "--labels", labels}));
        ASSERT_TRUE(node);
        Names names;
        node->accept(names);
        EXPECT_EQ(names.names.size(), 298u); // the ground has none
        EXPECT_EQ(names.texts, std::string(labels) == "text" ? 300u : 0u);
        EXPECT_EQ(names.textures, std::string(labels) == "texture" ? 300u : 0u);
    }
}

TEST_F(OsgRefineryTest, quadsAreQuads)
{
    const auto quads = batch({"--quads", "--objects", "10000"});
    ASSERT_TRUE(quads);
    ASSERT_EQ(quads->getNumObjects(), 10000u);
    for (unsigned int i = 0; i < 10000; ++i)
        ASSERT_EQ(quads->getPrimitive(i).shape, osgLabels::Shape::Quad);
}

TEST_F(OsgRefineryTest, wrongSwitchesAreNamed)
{
    const auto errorOf = [this](const std::vector<std::string>& words)
    {
        const support::ProcessResult result = run(words);
        EXPECT_EQ(result.exitCode, 1);
        return result.errors;
    };
    EXPECT_EQ(errorOf({}), "osgrefinery: FILE is required; see --help\n");
    EXPECT_EQ(
        errorOf({"--objects", "-3", "x.osgb"}),
        "osgrefinery: --objects: needs a whole number from 0 to 2000000, not '-3'; see --help\n");
    EXPECT_EQ(errorOf({"--objects", "400000", "x.iv"}),
              "osgrefinery: 400000 objects are too many one by one; at most 300000, or --as batch "
              "in a .osgb\n");
    EXPECT_EQ(errorOf({"--as", "cubes", "x.osgb"}),
              "osgrefinery: --as: needs one of batch|drawables, not 'cubes'; see --help\n");
    EXPECT_NE(errorOf({"--objects", "10", "/no/such/folder/x.iv"}).find("cannot write"),
              std::string::npos);
}
