// SPDX-License-Identifier: MIT
// Features inside of features that all have labels, and views of several projections.
#include "MapPictures.h"

#include <osg/Camera>

#include <algorithm>

using namespace mapScene;

namespace
{

class MapNested : public MapTest
{
};

/// Edges of plates are mixed with what is behind them.
constexpr int Edges = 12;

/// From box to box.
float gapOf(int levels)
{
    return std::min(0.15f, 2.0f / float(levels));
}

/// Thin boxes one behind the other, from the eye on, each in the feature of the one behind: "1" is
/// the outermost and the last one, before the wall, which is of no feature, and the label.
osg::ref_ptr<osg::Group> nested(int levels)
{
    osg::ref_ptr<osg::Group> top = new osg::Group;
    top->addChild(box("wall", {0, 0.5f, 0}, {0.3f, 0.05f, 0.3f}, {0.2f, 0.3f, 0.6f, 1}));
    osg::Group* around = top;
    for (int i = 1; i <= levels; ++i)
    {
        osg::ref_ptr<osg::Group> feature = new osg::Group;
        feature->setName(std::to_string(i));
        const float shade = 0.4f + 0.5f * float(i) / float(levels);
        feature->addChild(box("", {0, 0.3f - gapOf(levels) * float(i), 0},
                              {0.7f, gapOf(levels) / 3.0f, 0.2f}, {shade, 0.7f, shade, 1}));
        around->addChild(feature);
        around = feature;
    }
    return top;
}

/// Labels of all levels, of which that of `shown` is there and the others beside. One of no feature
/// is there too, behind all, so that all features take part.
osg::ref_ptr<osgLabels::LabelScene> labels(int levels, int shown, const osg::Vec3d& at,
                                           const std::string& settings = "")
{
    std::vector<osg::ref_ptr<osg::Node>> nodes{nested(levels),
                                               label("mm", at + osg::Vec3d(0, 0.01, 0))};
    for (int i = 1; i <= levels; ++i)
        nodes.push_back(label("mm", i == shown ? at : osg::Vec3d(0, 0.9, i % 2 ? 1.1 : -1.1),
                              std::to_string(i)));
    return scene(nodes, settings);
}

int redInTheMiddle(osgLabels::LabelScene& scene)
{
    const Picture picture = render(scene);
    int count = 0;
    for (int y = labelScene::Height / 4; y < 3 * labelScene::Height / 4; ++y)
        for (int x = 0; x < labelScene::Width; ++x)
        {
            const osg::Vec4 color = picture->getColor(unsigned(x), unsigned(y));
            count += color.r() > 0.9f && color.g() < 0.1f && color.b() < 0.1f;
        }
    return count;
}

} // namespace

TEST_F(MapNested, whatStandsBehindSeveralFeaturesThatAreTheLabelsOwnHidesIt)
{
    const osg::Vec3d behind(0, 0.9, 0), beside(0.55, 0.9, 0);
    const int whole = redPixels(*render(*scene({label("mm", beside)})));
    for (const int levels : {1, 2, 3, 5, 7, 9})
        for (int own = 1; own <= levels; ++own)
        {
            const std::string what = std::to_string(own) + " of " + std::to_string(levels);
            EXPECT_EQ(redInTheMiddle(*labels(levels, own, behind)), 0) << what;
            // Where there is no wall only those around are foreign, which are farther than it.
            EXPECT_NEAR(redInTheMiddle(*labels(levels, own, beside)), own == 1 ? whole : 0, Edges)
                << what;
        }
}

TEST_F(MapNested, layersAreDrawnForTheDepthsThatLabelsInViewNeed)
{
    // Each box of each level, and the wall.
    const auto needs = [](int levels, int inView)
    {
        std::vector<osg::ref_ptr<osg::Node>> nodes{nested(levels), label("mm", {0, 0.9, 0})};
        for (int i = 1; i <= levels; ++i)
            nodes.push_back(label("mm", {0, i == inView ? 0.9 : -99.0, 0}, std::to_string(i)));
        const auto top = scene(nodes);
        render(*top);
        return countOf(*top, "map.occluders.second");
    };
    EXPECT_EQ(needs(1, 1), 2.0);
    EXPECT_EQ(needs(3, 3), 4.0) << "nothing lies in it";
    EXPECT_EQ(needs(3, 1), 2 * 4.0);
    EXPECT_EQ(needs(3, 2), 2 * 4.0);
}

TEST_F(MapNested, thirtyDepthsHaveALayerEachAndDeeperOnesShareTheLastAsThePlanSays)
{
    // Behind the box of the feature around its own, and before that of the next one around.
    const auto between = [](int levels, int own)
    {
        const double y = 0.3 - gapOf(levels) * (own - 1.5);
        const auto top = labels(levels, own, {0, y, 0});
        const int red = redInTheMiddle(*top);
        return std::pair(red, countOf(*top, "map.depths.sharing"));
    };
    for (const int own : {2, 7, 16, 29, 30})
    {
        EXPECT_EQ(between(31, own), std::pair(0, 0.0)) << own;
        EXPECT_EQ(between(33, own), std::pair(0, 2.0)) << own;
    }
    for (const int own : {31, 32})
        EXPECT_GT(between(33, own).first, 0) << "what shares a layer is shown rather than hidden";
}

TEST_F(MapNested, picksAgreeWithWhatIsSeen)
{
    for (const double x : {0.0, 0.55})
    {
        const auto top = labels(3, 1, {x, 0.9, 0});
        render(*top);
        const auto pixel = pixelOf({x, 0.9, 0});
        top->pick(2.0 * pixel.x() / labelScene::Width - 1.0,
                  2.0 * pixel.y() / labelScene::Height - 1.0);
        render(*top, labelScene::fromFront(), labelScene::Width, labelScene::Height, 1);
        const auto picked = top->takePicked();
        ASSERT_TRUE(picked);
        EXPECT_EQ(picked->identifier != 0, x > 0.0);
    }
}

TEST_F(MapNested, parallelAndPerspectiveLabelsInOnePassHideByDepth)
{
    // A camera in the scene that sees it in parallel, in the same pixels.
    const auto inParallel = [](const std::vector<osg::ref_ptr<osg::Node>>& nodes)
    {
        const support::CameraSpec spec = labelScene::parallel();
        osg::ref_ptr<osg::Camera> camera = new osg::Camera;
        camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
        camera->setViewMatrix(spec.view);
        camera->setProjectionMatrix(spec.projection);
        camera->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
        camera->setRenderOrder(osg::Camera::NESTED_RENDER);
        for (const osg::ref_ptr<osg::Node>& node : nodes)
            camera->addChild(node);
        return camera;
    };
    const auto before = box("before", {-0.5f, -1, 0}, {0.3f, 0.2f, 0.3f}, {0.4f, 0.5f, 0.9f, 1});
    const auto beforeRight = box("right", {0.5f, -1, 0}, {0.3f, 0.2f, 0.3f}, {0.9f, 0.9f, 0.4f, 1});
    const osg::Vec3d left(-0.5, 0, 0), right(0.5, 0, 0);
    const auto pixels = [&](const osg::Vec3d& perspective, const osg::Vec3d& parallel)
    {
        const auto top = scene(
            {before, label("mm", perspective), inParallel({beforeRight, label("mm", parallel)})});
        const Picture picture = render(*top);
        keep(picture, "map-mixed-projections");
        return std::pair(redPixels(*picture, 0, labelScene::Width / 2),
                         redPixels(*picture, labelScene::Width / 2, labelScene::Width));
    };
    const int whole = redPixels(*render(*scene({label("mm", {0, 0, 0.8})})));
    const auto hidden = pixels(left, right);
    EXPECT_EQ(hidden.first, 0) << "by perspective, before it";
    EXPECT_EQ(hidden.second, 0) << "by parallel rays, before it";
    // Depths in the window are those by which surfaces of both hide each other: a perspective view
    // has most of them near the far plane.
    const auto surface = [&](bool isParallel)
    {
        const float x = isParallel ? -0.55f : 0.45f;
        const auto mark = sheet("", {x, 0, -0.05f}, {0.1f, 0, 0}, {0, 0, 0.1f}, {1, 0, 0, 1});
        const auto top = isParallel ? scene({before, inParallel({beforeRight, mark})})
                                    : scene({before, mark, inParallel({beforeRight})});
        return redPixels(*render(*top)) > 0;
    };
    const auto crossed = pixels(right, left);
    EXPECT_TRUE(surface(true));
    EXPECT_FALSE(surface(false));
    EXPECT_NEAR(crossed.first, whole, Edges);
    EXPECT_EQ(crossed.second, 0);
    const auto inFront = pixels({-0.5, -2, 0}, {0.5, -2, 0});
    EXPECT_NEAR(inFront.first, whole, Edges);
    EXPECT_NEAR(inFront.second, whole, Edges);
}
