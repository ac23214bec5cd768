// SPDX-License-Identifier: MIT
#include <osgLabels/LabelCollector.h>

#include <osg/AutoTransform>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Switch>
#include <osgUtil/CullVisitor>

#include <gtest/gtest.h>

#include <random>

using namespace osgLabels;

namespace
{

LabelTable::Codes bytesOf(const std::string& text)
{
    return LabelTable::Codes(text.begin(), text.end());
}

osg::ref_ptr<osg::Geometry> makeQuad()
{
    return osg::createTexturedQuadGeometry(osg::Vec3(), osg::Vec3(1, 0, 0), osg::Vec3(0, 1, 0));
}

osg::ref_ptr<osg::MatrixTransform> under(const std::string& name, const osg::Matrixd& matrix,
                                         osg::Node* child)
{
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
    transform->setName(name);
    transform->addChild(child);
    return transform;
}

class LabelCollectorTest : public testing::Test
{
protected:
    std::shared_ptr<LabelTable> table = std::make_shared<LabelTable>();
    osg::ref_ptr<osg::Group> group = new osg::Group;
    LabelCollector collector;
    osg::Matrixd groupToEye =
        osg::Matrixd::rotate(0.7, osg::Vec3d(1, 2, 3)) * osg::Matrixd::translate(-1e5, 3e4, -2e5);

    LabelCollectorTest() : collector(table, source(), bytesOf) { group->setName("the model"); }

    static std::shared_ptr<const LabelSource> source()
    {
        std::string error;
        return LabelSource::create({}, error);
    }
    std::string inTable(std::uint32_t identifier) const
    {
        const auto codes = table->getCodes(identifier);
        return std::string(codes.begin(), codes.end());
    }
    /// The label's text of a Drawable under a matrix from the group.
    std::string textOf(const osg::Drawable& drawable, const osg::Matrixd& localToGroup = {})
    {
        const std::uint32_t object = LabelCollector::View(collector, *group, groupToEye)
                                         .find(drawable, localToGroup * groupToEye);
        return inTable(collector.getObject(object).identifier);
    }
};

} // namespace

TEST_F(LabelCollectorTest, drawablesOfANodeShareItsLabel)
{
    osg::ref_ptr<osg::Geometry> a = makeQuad(), b = makeQuad(), c = makeQuad(), none = makeQuad();
    osg::ref_ptr<osg::Group> vessel = new osg::Group;
    vessel->addChild(a);
    vessel->addChild(b);
    vessel->setName("V-1");
    c->setName("P-2");
    group->addChild(vessel);
    group->addChild(c);
    group->addChild(none);
    collector.collect(*group);
    EXPECT_EQ(collector.getIdentifiers(), (std::vector<std::uint32_t>{1, 2}));
    EXPECT_EQ(collector.takeNew(), (std::vector<std::uint32_t>{1, 2, 3}));
    EXPECT_TRUE(collector.takeNew().empty());
    EXPECT_EQ(collector.getObject(1).drawable, a.get());
    EXPECT_EQ(collector.getObject(1).identifier, collector.getObject(2).identifier);
    EXPECT_EQ(inTable(1), "V-1");
    EXPECT_EQ(inTable(2), "P-2");
    EXPECT_EQ(textOf(*none), ""); // the group's own name is no object's
    EXPECT_EQ(collector.getNodePath(*group, 1), (osg::NodePath{group.get(), vessel.get()}));
    EXPECT_EQ(collector.getNodePath(*group, 2), (osg::NodePath{group.get(), c.get()}));
    EXPECT_EQ(collector.getNodePath(*group, 3), osg::NodePath());
}

TEST_F(LabelCollectorTest, nothingIsWrittenIntoTheModel)
{
    osg::ref_ptr<osg::Geometry> quad = makeQuad();
    osg::ref_ptr<osg::MatrixTransform> pipe = under("pipe", {}, quad.get());
    group->addChild(pipe);
    collector.collect(*group);
    textOf(*quad);
    EXPECT_FALSE(pipe->getStateSet() || quad->getStateSet() || quad->getUserDataContainer() ||
                 quad->getCullCallback());
    EXPECT_EQ(quad->getNumParents(), 1u);
}

TEST_F(LabelCollectorTest, hiddenAndLaterChildrenGetLabels)
{
    osg::ref_ptr<osg::Geometry> hidden = makeQuad(), later = makeQuad();
    osg::ref_ptr<osg::Switch> off = new osg::Switch;
    off->addChild(under("hidden", {}, hidden.get()), false);
    group->addChild(off);
    collector.collect(*group);
    EXPECT_EQ(inTable(1), "hidden");
    off->addChild(under("later", {}, later.get()));
    EXPECT_EQ(textOf(*later), "later");
    EXPECT_EQ(textOf(*hidden), "hidden");
}

TEST_F(LabelCollectorTest, instancesOfADrawableHaveLabelsOfTheirOwn)
{
    // Many on a lattice, turned about themselves, and one pair in one place but turned.
    osg::ref_ptr<osg::Geometry> shared = makeQuad();
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(shared);
    std::vector<osg::Matrixd> matrices;
    for (int x = 0; x < 10; ++x)
        for (int y = 0; y < 10; ++y)
            for (int turn = 0; turn < 4; ++turn)
                matrices.push_back(osg::Matrixd::rotate(turn * osg::PI_2, osg::Vec3d(0, 0, 1)) *
                                   osg::Matrixd::translate(1e5 + x, y, 0.5 * x));
    for (std::size_t i = 0; i < matrices.size(); ++i)
        group->addChild(under("I" + std::to_string(i), matrices[i], geode.get()));
    collector.collect(*group);
    EXPECT_EQ(collector.getIdentifiers().size(), matrices.size());
    for (std::size_t i = 0; i < matrices.size(); ++i)
        ASSERT_EQ(textOf(*shared, matrices[i]), "I" + std::to_string(i));
    const std::uint32_t last = collector.getIdentifiers().back();
    EXPECT_EQ(collector.getNodePath(*group, last).back()->getName(), inTable(last));
}

TEST_F(LabelCollectorTest, instancesThatMoveKeepTheirLabels)
{
    osg::ref_ptr<osg::Geometry> shared = makeQuad();
    osg::ref_ptr<osg::MatrixTransform> a = under("A", {}, shared.get());
    osg::ref_ptr<osg::MatrixTransform> b =
        under("B", osg::Matrixd::translate(5, 0, 0), shared.get());
    group->addChild(a);
    group->addChild(b);
    EXPECT_EQ(textOf(*shared, a->getMatrix()), "A");
    a->setMatrix(osg::Matrixd::translate(5.5, 0, 0)); // nearer to where B was
    b->setMatrix(osg::Matrixd::translate(0.25, 0, 0));
    EXPECT_EQ(textOf(*shared, a->getMatrix()), "A");
    EXPECT_EQ(textOf(*shared, b->getMatrix()), "B");
}

TEST_F(LabelCollectorTest, whatIsGoneIsSweptAndItsNumbersAreFree)
{
    osg::observer_ptr<osg::Geometry> observed;
    {
        osg::ref_ptr<osg::Geometry> quad = makeQuad();
        observed = quad;
        group->addChild(under("gone", {}, quad.get()));
        group->addChild(under("stays", {}, makeQuad().get()));
        collector.collect(*group);
        collector.sweep(*group, 100);
        EXPECT_EQ(collector.getIdentifiers().size(), 2u);
        group->removeChild(0, 1);
    }
    collector.sweep(*group, 100);
    EXPECT_FALSE(observed.valid());
    EXPECT_EQ(inTable(1), "");
    EXPECT_EQ(collector.getIdentifiers(), (std::vector<std::uint32_t>{2}));
    EXPECT_EQ(collector.getText(1), "");
    EXPECT_FALSE(collector.setText(1, "x"));
    osg::ref_ptr<osg::Geometry> next = makeQuad();
    group->addChild(under("next", {}, next.get()));
    EXPECT_EQ(textOf(*next), "next");
    EXPECT_EQ(collector.getIdentifiers(), (std::vector<std::uint32_t>{1, 2}));
}

TEST_F(LabelCollectorTest, aDrawableThatGetsASecondParentBecomesTwoObjects)
{
    osg::ref_ptr<osg::Geometry> quad = makeQuad();
    group->addChild(under("first", {}, quad.get()));
    EXPECT_EQ(textOf(*quad), "first");
    const auto moved = osg::Matrixd::translate(3, 0, 0);
    group->addChild(under("second", moved, quad.get()));
    collector.sweep(*group, 100);
    EXPECT_EQ(textOf(*quad), "first");
    EXPECT_EQ(textOf(*quad, moved), "second");
}

TEST_F(LabelCollectorTest, setTextChangesTheLabelOfAllItsDrawables)
{
    osg::ref_ptr<osg::Group> vessel = new osg::Group;
    osg::ref_ptr<osg::Geometry> a = makeQuad(), b = makeQuad();
    vessel->setName("V-1");
    vessel->addChild(a);
    vessel->addChild(b);
    group->addChild(vessel);
    collector.collect(*group);
    EXPECT_TRUE(collector.setText(1, "21 C"));
    EXPECT_EQ(textOf(*a), "21 C");
    EXPECT_EQ(textOf(*b), "21 C");
    EXPECT_EQ(collector.getText(1), "21 C");
    collector.clear();
    EXPECT_EQ(textOf(*a), "V-1");
}

TEST_F(LabelCollectorTest, whatIsNotUnderTheGroupHasNoLabel)
{
    osg::ref_ptr<osg::Geometry> stranger = makeQuad();
    stranger->setName("stranger");
    EXPECT_EQ(textOf(*stranger), "");
    EXPECT_EQ(collector.getObjectCount(), 1u);
}

TEST_F(LabelCollectorTest, leavesOfACullTraversalAreFound)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    osg::ref_ptr<osg::Geometry> shared = makeQuad();
    for (int i = 0; i < 300; ++i)
    {
        const osg::Matrixd inner =
            osg::Matrixd::rotate(any(random), osg::Vec3d(any(random), any(random), 1)) *
            osg::Matrixd::scale(2, 2, 2) * osg::Matrixd::translate(any(random), 0, any(random));
        osg::ref_ptr<osg::MatrixTransform> pipe =
            under("pipe " + std::to_string(i), inner, shared.get());
        group->addChild(under("", osg::Matrixd::translate(1e6 * any(random), i, 1e6), pipe.get()));
    }
    collector.collect(*group);

    osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    osg::ref_ptr<osgUtil::StateGraph> graph = new osgUtil::StateGraph;
    osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
    visitor->setStateGraph(graph);
    visitor->setRenderStage(stage);
    visitor->setCullingMode(osg::CullSettings::NO_CULLING);
    visitor->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    visitor->pushViewport(new osg::Viewport(0, 0, 100, 100));
    visitor->pushProjectionMatrix(new osg::RefMatrix);
    visitor->pushModelViewMatrix(new osg::RefMatrix(groupToEye), osg::Transform::RELATIVE_RF);
    group->accept(*visitor);

    std::vector<std::string> texts;
    LabelCollector::View view(collector, *group, groupToEye);
    std::vector<std::uint32_t> objects;
    const std::function<void(osgUtil::StateGraph&)> visit = [&](osgUtil::StateGraph& at)
    {
        for (const auto& leaf : at._leaves)
            objects.push_back(view.find(*leaf->getDrawable(), *leaf->_modelview));
        for (const auto& [stateSet, child] : at._children)
            visit(*child);
    };
    visit(*graph);
    ASSERT_EQ(objects.size(), 300u);
    for (std::size_t i = 0; i < objects.size(); ++i)
        EXPECT_EQ(objects[i], objects[0] + i); // leaves and objects are in the order of traversal
}

TEST_F(LabelCollectorTest, scalesThatNoObjectHasAnyMoreAreForgotten)
{
    osg::ref_ptr<osg::Geometry> stays = makeQuad();
    group->addChild(under("stays", osg::Matrixd::scale(2, 1, 1), stays.get()));
    collector.collect(*group);
    const auto scaleOf = [&](const osg::Drawable& drawable)
    {
        for (std::uint32_t object = 1; object < collector.getObjectCount(); ++object)
            if (const auto found = collector.getObject(object); found.drawable == &drawable)
                return std::make_pair(found.scale, collector.getScale(found));
        return std::make_pair(0u, std::shared_ptr<const osg::Matrixd>());
    };
    const auto [first, kept] = scaleOf(*stays);
    ASSERT_TRUE(kept);
    std::shared_ptr<const osg::Matrixd> before;
    for (int i = 0; i < 1000; ++i)
    {
        osg::ref_ptr<osg::Geometry> quad = makeQuad();
        const double factor = 3.0 + 0.01 * i;
        group->addChild(under("guest", osg::Matrixd::scale(factor, 1, 1), quad.get()));
        textOf(*quad, osg::Matrixd::scale(factor, 1, 1)); // finds what is new
        const auto [number, scale] = scaleOf(*quad);
        ASSERT_TRUE(scale) << i;
        ASSERT_NEAR((*scale)(0, 0) / (*scale)(1, 1), factor, 1e-9) << i;
        ASSERT_LE(number, 3u) << "numbers are given again";
        if (before)
        {
            ASSERT_LT((*before)(0, 0), (*scale)(0, 0)) << "what a frame has taken stays as it was";
        }
        before = scale;
        group->removeChild(1);
        collector.sweep(*group, 10);
    }
    EXPECT_EQ(scaleOf(*stays), std::make_pair(first, kept));
}
