// SPDX-License-Identifier: MIT
#include "VolumePictures.h"

#include <support/NotifyCapture.h>
#include <support/WindowViews.h>

#include <algorithm>
#include <array>

using namespace volumeScene;
using osgShadowVolume::ShadowedScene;
using support::CameraSpec;
using Picture = osg::ref_ptr<osg::Image>;

// Views, windows and targets of all kinds show what a window of the same size at its origin shows.

namespace
{

class ShadowViews : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(floorScene::viewer()); }

    support::NotifyCapture _notify;
};

struct Rectangle
{
    int x, y, width, height;
};

CameraSpec from(const osg::Vec3d& eye, const Rectangle& viewport)
{
    return CameraSpec::perspective(eye, {0, 0, 0.5}, {0, 0, 1}, 40.0,
                                   double(viewport.width) / viewport.height, 1.0, 40.0);
}

/// A viewport elsewhere rounds coordinates otherwise: pixels whose centre lies within 1/256 pixel
/// of an edge may differ, which is seldom more than one in a thousand.
testing::AssertionResult areAlike(const osg::Image* actual, const osg::Image* expected,
                                  const std::string& name)
{
    keep(actual, name);
    return support::CompareImage{1.0 / 255.0, 0.001, 1.0}(actual, expected, name);
}

const Rectangle LeftView{10, 20, 128, 96}, RightView{150, 60, 100, 180};
const osg::Vec3d LeftEye(0, -9, 7), RightEye(5, -6, 6);

} // namespace

TEST_F(ShadowViews, twoViewsInOneWindowEachHaveTheirOwnShadows)
{
    const auto scene = twoBoxes();
    const auto view = [](const osg::Vec3d& eye, const Rectangle& at)
    { return support::WindowView{from(eye, at), at.x, at.y, at.width, at.height, {}}; };
    const support::WindowViews views(*scene, 260, 250,
                                     {view(LeftEye, LeftView), view(RightEye, RightView)});
    EXPECT_EQ(scene->getPlans().size(), 2u);
    const auto alone = twoBoxes();
    const Picture left = render(*alone, from(LeftEye, LeftView), LeftView.width, LeftView.height);
    const Picture right =
        render(*alone, from(RightEye, RightView), RightView.width, RightView.height);
    EXPECT_TRUE(areAlike(views.getPicture(0), left, "views.left"));
    EXPECT_TRUE(areAlike(views.getPicture(1), right, "views.right"));
    ASSERT_TRUE(left && right);
    EXPECT_GT(darkShare(*left), 0.005) << "without a shadow nothing is shown";
    EXPECT_GT(darkShare(*right), 0.005);
}

TEST_F(ShadowViews, slaveCamerasShowPartsOfOnePicture)
{
    // Two halves of a wide picture, as two projectors show it.
    const auto scene = twoBoxes();
    const Rectangle all{0, 0, 240, 120};
    const CameraSpec spec = from(LeftEye, all);
    const Picture joined = support::drawHalves(*scene, spec, all.width, all.height);
    const auto alone = twoBoxes();
    const Picture whole = render(*alone, spec, all.width, all.height);
    ASSERT_TRUE(whole && joined);
    EXPECT_TRUE(areAlike(joined, whole, "views.slaves"));
}

namespace
{

/// A camera that renders the scene into an image, which `image` is set to.
osg::ref_ptr<osg::Group> toTexture(ShadowedScene& scene, osg::Camera::RenderTargetImplementation to,
                                   int size, unsigned int samples, Picture& image)
{
    const osg::ref_ptr<osg::Camera> camera =
        support::makeTargetCamera(&scene, fromFront(), size, size);
    camera->setRenderTargetImplementation(to, to);
    image = new osg::Image;
    image->allocateImage(size, size, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    camera->attach(osg::Camera::COLOR_BUFFER, image, samples, samples);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(camera);
    return root;
}

} // namespace

TEST_F(ShadowViews, camerasThatRenderToTexturesShowTheSame)
{
    // The framebuffer object has no stencil. A viewer of its own: the context of the pixel buffer
    // goes with it.
    support::HeadlessViewer viewer({floorScene::Width, floorScene::Height});
    OSGKITS_NEED_GL(viewer);
    viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    const auto scene = twoBoxes();
    const auto look = [&](osg::Node& node)
    { return viewer.render(&node, fromFront(), floorScene::Width, floorScene::Height, 2); };
    const Picture expected = look(*scene);
    for (const auto target : {osg::Camera::FRAME_BUFFER_OBJECT, osg::Camera::PIXEL_BUFFER})
    {
        Picture actual;
        const auto root = toTexture(*scene, target, floorScene::Width, 0, actual);
        ASSERT_TRUE(look(*root));
        EXPECT_TRUE(areAlike(actual, expected, "views.target" + std::to_string(target)));
    }
}

namespace
{

/// The least and largest of a channel in a block of a picture.
std::array<int, 2> rangeOf(const osg::Image& image, int x0, int y0, int x1, int y1, int channel)
{
    std::array<int, 2> range{255, 0};
    for (int y = std::max(0, y0); y < std::min(image.t(), y1); ++y)
        for (int x = std::max(0, x0); x < std::min(image.s(), x1); ++x)
        {
            const int value = image.data(x, y)[channel];
            range = {std::min(range[0], value), std::max(range[1], value)};
        }
    return range;
}

} // namespace

namespace
{

constexpr int SmoothSize = 128, Larger = 8;

/// Compares a picture with samples with one that is eight times as large: each pixel lies between
/// what is seen in it, and near its mean.
void expectAveraged(const osg::Image& actual, const osg::Image& truth)
{
    int fringes = 0, between = 0, far = 0;
    for (int y = 0; y < SmoothSize; ++y)
        for (int x = 0; x < SmoothSize; ++x)
            for (int channel = 0; channel < 3; ++channel)
            {
                const int value = actual.data(x, y)[channel];
                const auto own = rangeOf(truth, Larger * x, Larger * y, Larger * (x + 1),
                                         Larger * (y + 1), channel);
                // A step of rounding each way; lit surfaces vary within a pixel.
                fringes += value < own[0] - 2 || value > own[1] + 2;
                between += value > own[0] + 8 && value < own[1] - 8;
                double mean = 0.0;
                for (int j = 0; j < Larger; ++j)
                    for (int i = 0; i < Larger; ++i)
                        mean += truth.data(Larger * x + i, Larger * y + j)[channel];
                mean /= Larger * Larger;
                // Four samples see up to 3/8 more or less of what a straight edge cuts off, and
                // twice that where the edge of a shadow meets that of an object.
                far += std::abs(value - mean) > 0.4 * (own[1] - own[0]) + 2;
            }
    EXPECT_EQ(fringes, 0);
    EXPECT_LE(far, 12) << "of corners";
    EXPECT_GT(between, 300) << "no edge is smooth";
}

} // namespace

TEST_F(ShadowViews, samplesAreAveragedAtTheEdgesOfShadowsAndObjects)
{
    support::HeadlessViewer fine({SmoothSize * Larger, SmoothSize * Larger});
    OSGKITS_NEED_GL(fine);
    fine.getViewer().setLightingMode(osg::View::NO_LIGHT);
    const auto scene = twoBoxes();
    const Picture truth =
        fine.render(scene, fromFront(), SmoothSize * Larger, SmoothSize * Larger, 2);
    Picture texture;
    const auto root = toTexture(*scene, osg::Camera::FRAME_BUFFER_OBJECT, SmoothSize, 4, texture);
    ASSERT_TRUE(render(*root, fromFront()));
    floorScene::viewer().getViewer().setSceneData(nullptr);
    support::HeadlessSettings settings{SmoothSize, SmoothSize};
    settings.samples = 4;
    support::HeadlessViewer smooth(settings);
    OSGKITS_NEED_GL(smooth);
    smooth.getViewer().setLightingMode(osg::View::NO_LIGHT);
    const Picture window = smooth.render(scene, fromFront(), SmoothSize, SmoothSize, 2);
    ASSERT_TRUE(truth && texture && window);
    keep(texture, "views.samples.texture");
    keep(window, "views.samples.window");
    {
        SCOPED_TRACE("into a texture");
        expectAveraged(*texture, *truth);
    }
    {
        SCOPED_TRACE("into a window");
        expectAveraged(*window, *truth);
    }
}

TEST_F(ShadowViews, severalScenesAreEachRight)
{
    // Two side by side, each with its own lights, as in pictures of one alone.
    const auto build = [](float x)
    {
        const auto place = moved({x, 0, 0}, nullptr);
        const auto scene = shadowed();
        scene->setLightScope(ShadowedScene::LightScope::MODES);
        scene->getOrCreateStateSet()->setMode(x < 0 ? GL_LIGHT0 : GL_LIGHT1,
                                              osg::StateAttribute::ON);
        const auto inner = moved({x, 0, 0}, nullptr);
        inner->addChild(floorScene::rectangle({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}));
        inner->addChild(moved({0, 0, 1}, box({}, 1)));
        inner->addChild(floorScene::lightSource(x < 0 ? 0 : 1, osg::Vec4(x, 1, 2, 0)));
        scene->addChild(inner);
        return scene;
    };
    const auto left = build(-2), right = build(2);
    osg::ref_ptr<osg::Group> both = new osg::Group;
    both->addChild(left);
    both->addChild(right);
    const Picture together = render(*both, fromFront());
    const Picture leftAlone = render(*left, fromFront()), rightAlone = render(*right, fromFront());
    ASSERT_TRUE(together && leftAlone && rightAlone);
    const Picture joined = new osg::Image(*leftAlone, osg::CopyOp::DEEP_COPY_ALL);
    for (int y = 0; y < joined->t(); ++y)
        std::copy_n(rightAlone->data(joined->s() / 2, y), 4 * joined->s() / 2,
                    joined->data(joined->s() / 2, y));
    EXPECT_TRUE(areEqual(together, joined, "views.siblings"));
}

TEST_F(ShadowViews, oneSceneUnderTwoParentsIsShadowedInBoth)
{
    // One is scaled and turned: a shadow is where it is for the one alone.
    const auto scene = shadowed();
    scene->addChild(floorScene::rectangle({-1.5f, -1.5f, 0}, {3, 0, 0}, {0, 3, 0}));
    scene->addChild(moved({0, 0, 1}, box({}, 0.7f)));
    const osg::Matrix places[] = {osg::Matrix::translate(-2.3, 0, 0),
                                  osg::Matrix::rotate(0.4, 0, 0, 1) *
                                      osg::Matrix::scale(1.1, 1.1, 1.1) *
                                      osg::Matrix::translate(2.3, 0, 0)};
    const auto place = [&](std::initializer_list<int> which)
    {
        // The light lies beside them: inside, there would be two.
        osg::ref_ptr<osg::Group> group = new osg::Group;
        for (int i : which)
        {
            osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(places[i]);
            transform->addChild(scene);
            group->addChild(transform);
        }
        group->addChild(floorScene::lightSource(0, osg::Vec4(1, 0.5f, 2, 0)));
        return group;
    };
    const osg::ref_ptr<osg::Group> left = place({0}), right = place({1}), both = place({0, 1});
    const Picture leftAlone = render(*left, fromFront()), rightAlone = render(*right, fromFront());
    const Picture together = render(*both, fromFront());
    ASSERT_TRUE(together && leftAlone && rightAlone);
    const Picture joined = new osg::Image(*leftAlone, osg::CopyOp::DEEP_COPY_ALL);
    for (int y = 0; y < joined->t(); ++y)
        std::copy_n(rightAlone->data(joined->s() / 2, y), 4 * joined->s() / 2,
                    joined->data(joined->s() / 2, y));
    EXPECT_TRUE(areEqual(together, joined, "views.twoParents"));
    EXPECT_GT(darkShare(*leftAlone), 0.005);
    EXPECT_GT(darkShare(*rightAlone), 0.005);
}

TEST_F(ShadowViews, insideAnotherGroupTheOuterOneDraws)
{
    const auto inner = twoBoxes();
    const Picture expected = render(*inner, fromFront());
    const auto around = shadowed();
    around->addChild(inner);
    EXPECT_TRUE(areEqual(render(*around, fromFront()), expected, "views.nestedShadowed"));
    // A group without shadows around it draws none.
    osg::ref_ptr<osgShadowVolume::LitScene> lit = new osgShadowVolume::LitScene;
    lit->setLightScope(ShadowedScene::LightScope::ALL);
    lit->addChild(inner);
    const Picture unshadowed = render(*lit, fromFront());
    inner->setShadows(osgShadowVolume::Shadows::OFF);
    EXPECT_TRUE(areEqual(unshadowed, render(*inner, fromFront()), "views.nestedLit"));
}

TEST_F(ShadowViews, closedWindowsAndNewSizesChangeNothing)
{
    const auto scene = twoBoxes();
    const Picture expected = render(*scene, fromFront());
    for (int i = 0; i < 3; ++i)
    {
        support::HeadlessViewer other({floorScene::Width, floorScene::Height});
        OSGKITS_NEED_GL(other);
        other.getViewer().setLightingMode(osg::View::NO_LIGHT);
        EXPECT_TRUE(
            areEqual(other.render(scene, fromFront(), floorScene::Width, floorScene::Height, 2),
                     expected, "views.another"));
    }
    EXPECT_TRUE(areEqual(render(*scene, fromFront()), expected, "views.after"));
    scene->releaseGLObjects(
        floorScene::viewer().getViewer().getCamera()->getGraphicsContext()->getState());
    EXPECT_TRUE(areEqual(render(*scene, fromFront()), expected, "views.released"));
    scene->releaseGLObjects();
    EXPECT_TRUE(areEqual(render(*scene, fromFront()), expected, "views.releasedAll"));
    for (const auto& [width, height] : {std::pair(200, 100), std::pair(64, 256), std::pair(1, 1),
                                        std::pair(256, 17), std::pair(256, 256)})
    {
        const Picture resized = render(*scene, fromFront(), width, height);
        const auto fresh = twoBoxes();
        EXPECT_TRUE(areEqual(resized, render(*fresh, fromFront(), width, height), "views.resized"));
    }
}
