// SPDX-License-Identifier: MIT
// Batches that come, change and go while their labels are shown.
#include "LabelPictures.h"

#include <osgLabels/LabelResources.h>
#include <osgLabels/PrimitiveBatch.h>

#include <support/NotifyCapture.h>

using namespace labelScene;
using osgLabels::LabelScene;
using osgLabels::PrimitiveBatch;

namespace
{

class LabelBatchesGL : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(viewer()); }

    support::NotifyCapture _notify;
};

/// A box of a third of the view; `column` from 0 to 2.
void addBox(PrimitiveBatch& batch, const std::string& name, int column)
{
    osgLabels::Primitive box;
    box.shape = osgLabels::Shape::Box;
    box.size = osg::Vec3(0.35f, 0.2f, 0.3f);
    box.position = osg::Vec3d(0.8 * (column - 1), 0.2, 0.0);
    box.color = osg::Vec4ub(230, 200, 170, 255);
    box.name = name;
    batch.add(box);
}

osg::ref_ptr<PrimitiveBatch> batchOf(const std::vector<std::string>& names, int firstColumn = 0)
{
    osg::ref_ptr<PrimitiveBatch> batch = new PrimitiveBatch;
    batch->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    for (const std::string& name : names)
        addBox(*batch, name, firstColumn++);
    batch->build();
    return batch;
}

LabelScene::Picked pickedAt(LabelScene& scene, int column)
{
    scene.pick(0.6 * (column - 1), 0.0);
    render(scene, fromFront(), Width, Height, 1);
    return scene.takePicked().value_or(LabelScene::Picked{0, "no answer", ""});
}

} // namespace

TEST_F(LabelBatchesGL, aBatchThatIsBuiltAnewHasItsLabels)
{
    const auto batch = batchOf({"ONE", "TWO"});
    const auto scene = labelled(batch);
    ASSERT_TRUE(render(*scene));
    addBox(*batch, "THREE", 2);
    batch->build();
    const Picture actual = render(*scene, fromFront(), Width, Height, 1);
    const Picture expected = render(*labelled(batchOf({"ONE", "TWO", "THREE"})));
    EXPECT_TRUE(areEqual(actual, expected, "labelBatches.anew"));
    EXPECT_EQ(pickedAt(*scene, 0).text, "ONE");
    EXPECT_EQ(pickedAt(*scene, 2).text, "THREE");
}

TEST_F(LabelBatchesGL, aBatchThatComesLaterHasItsLabels)
{
    const auto scene = labelled(batchOf({"ONE", "TWO"}));
    ASSERT_TRUE(render(*scene));
    scene->addChild(box("BOX", {-0.8f, 0, 0.7f}, {0.3f, 0.2f, 0.2f})); // takes a number too
    ASSERT_TRUE(render(*scene));
    scene->addChild(batchOf({"THREE"}, 2));
    ASSERT_TRUE(render(*scene));
    EXPECT_EQ(pickedAt(*scene, 0).text, "ONE");
    EXPECT_EQ(pickedAt(*scene, 1).text, "TWO");
    EXPECT_EQ(pickedAt(*scene, 2).text, "THREE");
    scene->pick(-0.6, 0.7);
    render(*scene, fromFront(), Width, Height, 1);
    EXPECT_EQ(scene->takePicked()->text, "BOX");
}

TEST_F(LabelBatchesGL, buildingAThousandTimesTakesNoMoreRoom)
{
    const auto batch = batchOf({"ONE", "TWO", "THREE"});
    const auto scene = labelled(batch);
    ASSERT_TRUE(render(*scene));
    for (int i = 0; i < 20; ++i)
    {
        batch->build();
        render(*scene, fromFront(), Width, Height, 1);
    }
    const auto resources = scene->getResources();
    const std::uint32_t records = resources->records.getEnd();
    const std::uint32_t identifiers = resources->shared->identifiers.getEnd();
    for (int i = 0; i < 1000; ++i)
    {
        batch->build();
        render(*scene, fromFront(), 8, 8, 1);
    }
    EXPECT_EQ(resources->records.getEnd(), records);
    EXPECT_EQ(resources->shared->identifiers.getEnd(), identifiers);
    EXPECT_EQ(countOf(*scene, "labels.count"), 3.0);
}

TEST_F(LabelBatchesGL, aBatchMayBeBuiltAnewWhileTheFrameBeforeIsDrawn)
{
    support::HeadlessSettings settings{Width, Height};
    settings.threading = osgViewer::ViewerBase::DrawThreadPerContext;
    support::HeadlessViewer threaded(settings);
    OSGKITS_NEED_GL(threaded);
    threaded.getViewer().setLightingMode(osg::View::NO_LIGHT);
    const auto batch = batchOf({"ONE", "TWO"});
    const auto scene = labelled(batch);
    ASSERT_TRUE(threaded.render(scene, fromFront(), Width, Height, 1));
    for (int i = 0; i < 60; ++i)
    {
        batch->clear();
        for (int column = 0; column < 3; ++column)
            addBox(*batch, i % 2 ? "ODD" : "EVEN " + std::to_string(column), column);
        batch->build();
        threaded.getViewer().frame();
    }
    const Picture actual = threaded.render(scene, fromFront(), Width, Height, 2);
    const Picture expected = render(*labelled(batchOf({"ODD", "ODD", "ODD"})));
    EXPECT_TRUE(areAlike(actual, expected, "labelBatches.threads"));
}

TEST_F(LabelBatchesGL, twoScenesMayShowOneBatch)
{
    const auto batch = batchOf({"ONE", "", "THREE"});
    const auto first = labelled(batch), second = labelled(batch, "match=THREE");
    const Picture expected = render(*first);
    ASSERT_TRUE(render(*second));
    EXPECT_TRUE(areEqual(render(*first), expected, "labelBatches.shared"));
    EXPECT_EQ(pickedAt(*first, 0).text, "ONE");
    EXPECT_EQ(pickedAt(*first, 1).identifier, 0u);
    EXPECT_EQ(pickedAt(*second, 0).identifier, 0u);
    EXPECT_EQ(pickedAt(*second, 2).text, "THREE");
}

TEST_F(LabelBatchesGL, changedTextsAreSaid)
{
    const auto scene = labelled(batchOf({"ONE", "TWO"}));
    ASSERT_TRUE(render(*scene));
    const std::uint32_t identifier = pickedAt(*scene, 1).identifier;
    ASSERT_TRUE(scene->setText(identifier, "34 bar"));
    EXPECT_EQ(scene->getText(identifier), "34 bar");
    EXPECT_EQ(pickedAt(*scene, 1).text, "34 bar");
    EXPECT_FALSE(scene->setText(77, "nothing"));
}

TEST_F(LabelBatchesGL, identifiersAreFoundAmongManyStretches)
{
    // Every other object has a text: the most stretches that there can be.
    constexpr unsigned int pairs = 100000;
    osg::ref_ptr<PrimitiveBatch> batch = new PrimitiveBatch;
    for (unsigned int i = 0; i < pairs; ++i)
    {
        addBox(*batch, "T" + std::to_string(i), 0);
        addBox(*batch, "", 0);
    }
    batch->build();
    const auto scene = labelled(batch);
    render(*scene, fromFront(), 8, 8, 1);
    const auto resources = scene->getResources();
    // Each by itself through half of 200,000 objects would take minutes.
    for (std::uint32_t identifier = 1; identifier <= pairs; ++identifier)
    {
        const auto found = resources->batches.find(identifier);
        ASSERT_TRUE(found.batch);
        ASSERT_EQ(batch->getObjectName(found.object).front(), 'T');
    }
}
