// SPDX-License-Identifier: MIT
#include <osgLabels/MapLabelFile.h>

#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <osg/ComputeBoundsVisitor>
#include <osg/NodeVisitor>
#include <osg/Transform>
#include <osg/TriangleFunctor>
#include <osg/ValueObject>
#include <osgDB/ReadFile>

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

namespace
{

/// Edges from one corner to another, by place: how often each way.
struct Edges
{
    std::map<std::pair<osg::Vec3, osg::Vec3>, int> count;

    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c)
    {
        ++count[{a, b}];
        ++count[{b, c}];
        ++count[{c, a}];
    }
    bool areClosed() const
    {
        for (const auto& [edge, times] : count)
        {
            const auto back = count.find({edge.second, edge.first});
            if (back == count.end() || back->second != times)
                return false;
        }
        return !count.empty();
    }
};

/// Named nodes by class, and whether their drawables are closed.
class Collector : public osg::NodeVisitor
{
public:
    Collector() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Node& node) override
    {
        const std::string before = _class;
        node.getUserValue("labelClass", _class);
        if (!node.getName().empty())
        {
            nodes[node.getName()] = &node;
            _closed = &closed[_class][node.getName()];
        }
        traverse(node);
        _class = before;
    }
    void apply(osg::Drawable& drawable) override
    {
        osg::TriangleFunctor<Edges> edges;
        drawable.accept(edges);
        *_closed = edges.areClosed();
        osg::BoundingBox box = drawable.getBoundingBox();
        volume[drawable.getParent(0)] = box;
    }

    std::map<std::string, osg::Node*> nodes;
    std::map<std::string, std::map<std::string, bool>> closed;
    std::map<osg::Node*, osg::BoundingBox> volume;

private:
    std::string _class;
    bool* _closed = nullptr;
};

std::string contentOf(const std::string& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

class OsgCityTest : public testing::Test
{
protected:
    support::ProcessResult run(std::vector<std::string> words) const
    {
        support::ChildProcess process;
        process.arguments = {OSGKITS_OSGCITY};
        process.arguments.insert(process.arguments.end(), words.begin(), words.end());
        process.unset = {"DISPLAY"};
        return process.run();
    }

    /// The path of the file that was written.
    std::string made(const std::string& name, std::vector<std::string> words = {}) const
    {
        words.push_back(folder.file(name));
        const support::ProcessResult result = run(words);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return words.back();
    }

    osg::ref_ptr<osg::Node> city(const std::vector<std::string>& words = {}) const
    {
        return osgDB::readRefNodeFile(made("city.osgb", words));
    }

    std::vector<osgLabels::MapLabel> labels(const std::string& file) const
    {
        std::ifstream in(file);
        std::vector<std::string> warnings;
        auto result = osgLabels::readMapLabels(in, file, warnings);
        EXPECT_TRUE(warnings.empty());
        return result;
    }

    support::TemporaryFolder folder;
};

} // namespace

TEST_F(OsgCityTest, makesAsManyBuildingsAndTreesAsAskedForEachWithItsName)
{
    for (const unsigned int count : {0u, 1u, 60u, 500u})
    {
        const auto node =
            city({"--buildings", std::to_string(count), "--trees", std::to_string(2 * count)});
        ASSERT_TRUE(node);
        Collector found;
        node->accept(found);
        EXPECT_EQ(found.closed["building"].size(), count + 1); // and the group
        EXPECT_EQ(found.closed["tree"].size(), 2 * count + 1);
        EXPECT_EQ(found.nodes.count("Town Hall"), count ? 1u : 0u);
        EXPECT_EQ(found.nodes.count("Building " + std::to_string(count - 1)), count > 1 ? 1u : 0u);
        EXPECT_EQ(found.nodes.count("tree-0"), count ? 1u : 0u);
        EXPECT_EQ(found.closed["terrain"].count("Terrain"), 1u);
        EXPECT_EQ(found.closed["street"].count("Main Street"), count ? 1u : 0u);
    }
}

TEST_F(OsgCityTest, buildingsAreClosedAndConsistentlyWoundAndTheGroundIsOpen)
{
    const auto node = city();
    ASSERT_TRUE(node);
    Collector found;
    node->accept(found);
    for (const auto& [name, closed] : found.closed["building"])
        EXPECT_TRUE(closed || name == "Buildings") << name;
    for (const char* open : {"terrain", "street"})
        for (const auto& [name, closed] : found.closed[open])
            EXPECT_FALSE(closed) << name;
    int bodies = 0, crosses = 0;
    for (const auto& [name, closed] : found.closed["tree"])
        ++(closed ? bodies : crosses);
    EXPECT_GT(bodies, 500);
    EXPECT_GT(crosses, 100);
}

TEST_F(OsgCityTest, labelsAreAnchoredAtTheTopsOfTheBuildingsThatTheyName)
{
    for (const char* origin : {"0", "1e7"})
    {
        const std::string table = folder.file("city.csv");
        const auto node = city({"--origin", origin, "--labels", table});
        ASSERT_TRUE(node);
        Collector found;
        node->accept(found);
        const auto all = labels(table);
        ASSERT_EQ(all.size(), 500u);
        EXPECT_EQ(all[0].text, "Town Hall");
        for (const osgLabels::MapLabel& label : all)
        {
            ASSERT_EQ(found.nodes.count(label.feature), 1u) << label.feature;
            osg::Node* const building = found.nodes[label.feature];
            const osg::Matrixd toWorld =
                osg::computeLocalToWorld(building->getParentalNodePaths().at(0));
            const osg::BoundingBox box = found.volume[building->asGroup()->getChild(0)];
            const osg::Vec3d top = osg::Vec3d(box.center().x(), box.center().y(), box.zMax());
            EXPECT_LT((label.anchor - top * toWorld).length(), 1e-4);
            EXPECT_FALSE(label.text.empty());
        }
    }
}

TEST_F(OsgCityTest, farFromTheOriginOnlyTheOutermostMatrixIsLarge)
{
    const auto near = city(), far = city({"--origin", "1e7"});
    ASSERT_TRUE(near && far);
    osg::ComputeBoundsVisitor boxes[2];
    for (const auto& [node, box] : {std::pair(near, &boxes[0]), {far, &boxes[1]}})
        for (unsigned int i = 0; i < node->asGroup()->getNumChildren(); ++i)
            node->asGroup()->getChild(i)->accept(*box);
    EXPECT_EQ(boxes[0].getBoundingBox()._min, boxes[1].getBoundingBox()._min);
    EXPECT_EQ(boxes[0].getBoundingBox()._max, boxes[1].getBoundingBox()._max);
}

TEST_F(OsgCityTest, aSeedGivesOneFile)
{
    const auto textOf = [&](const char* seed) {
        return contentOf(made("city.osgt", {"--buildings", "40", "--seed", seed}));
    };
    EXPECT_EQ(textOf("5"), textOf("5"));
    EXPECT_NE(textOf("5"), textOf("6"));
}

TEST_F(OsgCityTest, wrongSwitchesAreNamed)
{
    const auto errorOf = [this](const std::vector<std::string>& words)
    {
        const support::ProcessResult result = run(words);
        EXPECT_EQ(result.exitCode, 1);
        return result.errors;
    };
    EXPECT_EQ(errorOf({}), "osgcity: FILE is required; see --help\n");
    EXPECT_EQ(errorOf({"--buildings", "-3", "x.osgb"}),
              "osgcity: --buildings: needs a whole number from 0 to 20000, not '-3'; see --help\n");
    EXPECT_EQ(errorOf({"--trees", "many", "x.osgb"}),
              "osgcity: --trees: needs a whole number from 0 to 100000, not 'many'; see --help\n");
    EXPECT_EQ(errorOf({"--origin", "nan", "x.osgb"}),
              "osgcity: --origin: needs a number from -1e+09 to 1e+09, not 'nan'; see --help\n");
    EXPECT_EQ(errorOf({"--towers", "3", "x.osgb"}),
              "osgcity: unknown option '--towers'; see --help\n");
    EXPECT_EQ(errorOf({"a.osgb", "b.osgb"}),
              "osgcity: 'b.osgb' is one argument too many; see --help\n");
    EXPECT_NE(errorOf({"/no/such/folder/x.osgb"}).find("cannot write"), std::string::npos);
    EXPECT_NE(
        errorOf({"--labels", "/no/such/x.csv", folder.file("x.osgb")}).find("'/no/such/x.csv'"),
        std::string::npos);
    EXPECT_NE(run({"--help"}).output.find("--buildings N"), std::string::npos);
}
