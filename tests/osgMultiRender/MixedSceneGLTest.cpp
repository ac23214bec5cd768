// SPDX-License-Identifier: MIT
// A MixedScene shows the blend of the single pictures.
#include "osgMultiRender/MixedPictures.h"

#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <cstring>

using namespace osgMultiRender;

namespace
{

using MixedSceneGLTest = MixedPictures;

} // namespace

TEST_F(MixedSceneGLTest, twoRenderingsEqualTheBlendOfTheirPictures)
{
    add("phong", {0.0, 0.0, 1.0, 3.0});
    add("toon", {1.0, 3.0, Infinity, Infinity});
    setKeys({{-1.6, -1.0, 0.5}});
    expectTruth("mixedTwo");
    EXPECT_EQ(count("leaves.fixedFunction"), 0.0);
}

TEST_F(MixedSceneGLTest, eightRenderingsEqualTheBlendOfTheirPictures)
{
    const char* const names[] = {"phong",    "toon", "gooch",  "wood",
                                 "textured", "xray", "bricks", "wireframe"};
    for (std::size_t i = 0; i < std::size(names); ++i)
    {
        const double from = 0.6 * double(i);
        add(names[i], {from - 0.6, from, from, from + 0.6});
    }
    setKeys({{-1.6, -1.0, 0.5}, {1.0, 0.0, 0.0}, {2.0, 1.0, 1.0}}, KeyMode::Polyline);
    expectTruth("mixedEight");
}

TEST_F(MixedSceneGLTest, drawablesOfFewerRenderingsLookTheSame)
{
    add("phong", {0.0, 0.0, 1.0, 1.2});
    add("toon", {1.0, 1.2, 2.0, 3.0});
    add("gooch", {2.0, 3.0, Infinity, Infinity});
    setKeys({{-1.6, -1.0, 0.5}});
    _scene->setSettleFrames(0);
    _scene->setPruning(true);
    expectTruth("mixedPruned", 6);
    EXPECT_GT(count("mix.programs"), 1.0) << "none was made for fewer renderings";
}

TEST_F(MixedSceneGLTest, rulesDecideWhatIsMissingAndTooMuch)
{
    add("phong", {0.0, 0.0, 1.5, 3.0});
    add("toon", {0.5, 1.5, 2.5, 3.5});
    setKeys({{-1.6, -1.0, 0.5}});
    MixRules rules;
    expectTruth("mixedClamped", 1, rules);
    rules.excess = MixRules::Excess::Normalise;
    rules.background = {0.2, 0.4, 0.6, 1.0};
    expectTruth("mixedNormalised", 1, rules);
    rules.base = 0;
    expectTruth("mixedBase", 1, rules);
}

TEST_F(MixedSceneGLTest, keyPointsFarAwayAreAsExact)
{
    const osg::Vec3d far(1e7, -3e6, 2e6);
    osg::ref_ptr<osg::MatrixTransform> moved =
        new osg::MatrixTransform(osg::Matrixd::translate(far));
    add("phong", {0.0, 0.0, 1.0, 3.0});
    add("gooch", {1.0, 3.0, Infinity, Infinity});
    setKeys({{-1.6, -1.0, 0.5}});
    const osg::ref_ptr<osg::Image> near = osg::clone(draw().get(), osg::CopyOp::DEEP_COPY_ALL);
    _scene->removeChildren(0, 1);
    moved->addChild(_model);
    _scene->addChild(moved);
    _scene->setKeyPoints({osg::Vec3d(-1.6, -1.0, 0.5) + far});
    _camera.view = osg::Matrixd::translate(-far) * _camera.view;
    const osg::ref_ptr<osg::Image> picture = draw();
    const support::ImageDifference difference = support::difference(*picture, *near, 1.0 / 255.0);
    EXPECT_EQ(difference.pixelsOver, 0u) << difference.worst * 255.0;
}

TEST_F(MixedSceneGLTest, keyPointsMoveWithTheNodeThatTheyAreAttachedTo)
{
    osg::ref_ptr<osg::MatrixTransform> node =
        new osg::MatrixTransform(osg::Matrixd::translate(-1.6, -1.0, 0.5));
    add("phong", {0.0, 0.0, 1.0, 3.0});
    add("gooch", {1.0, 3.0, Infinity, Infinity});
    _scene->addChild(node);
    _scene->addChild(_model);
    setKeys({{-1.6, -1.0, 0.5}}); // the truth; the scene has it in the node
    _scene->setKeyPoints({osg::Vec3d()});
    _scene->setKeyNode(node);
    expectTruth("mixedAttached");
}

TEST_F(MixedSceneGLTest, aTransparentMixEqualsTheBlendOverWhatLiesBehind)
{
    _model = makeImageQuad(*_image); // one layer, so that only the background is behind
    add("textured", {0.0, 0.0, 0.2, 0.5});
    add("sepia", {0.4, 0.5, 0.6, 0.9});
    setKeys({{0.0, 0.0, 0.0}, {0.2, 0.0, 0.0}}, KeyMode::Polyline);
    _scene->setTransparent(true);
    MixTruth truth(_viewer, _model, _camera, Size);
    for (const std::string& rendering : _names)
        truth.add(makeRenderingState(*findBuiltInRendering(rendering)));
    const osg::ref_ptr<osg::Image> picture = draw();
    ASSERT_TRUE(picture);
    support::writeImage(*picture, "mixedTransparentTwo");
    const osg::Vec4 clear = support::HeadlessSettings().clearColor;
    const glm::dvec4 behind(clear.r(), clear.g(), clear.b(), clear.a());
    const MixWeights weights(_ranges);
    const MixTruth::Difference difference = truth.compare(*picture, _points, weights, &behind);
    std::cout << "mixedTransparentTwo: " << difference.covered << " pixels, worst "
              << difference.worst * 255.0 << "/255\n";
    EXPECT_GT(difference.covered, 3000);
    EXPECT_EQ(difference.over, 0);
    EXPECT_GT(truth.compare(*picture, _points, weights).over, 1000) << "nothing shows through";
}

TEST_F(MixedSceneGLTest, whereATransparentMixIsEmptyLaterSurfacesAreSeen)
{
    _model = makeImageQuad(*_image);
    add("textured", {0.0, 0.0, 0.2, 0.8});
    setKeys({{0.0, 0.0, 0.0}});
    const osg::ref_ptr<osg::Image> opaque = osg::clone(draw().get(), osg::CopyOp::DEEP_COPY_ALL);
    _scene->setTransparent(true);
    const osg::ref_ptr<osg::Geometry> floor =
        osg::createTexturedQuadGeometry({-9, -9, -3}, {18, 0, 0}, {0, 18, 0});
    const osg::ref_ptr<osg::Vec4Array> red = new osg::Vec4Array(1, new osg::Vec4(1, 0, 0, 1));
    floor->setColorArray(red, osg::Array::BIND_OVERALL);
    floor->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    floor->getStateSet()->setRenderBinDetails(20, "RenderBin"); // after the mix
    const osg::ref_ptr<osg::Group> both = new osg::Group;
    both->addChild(_scene);
    both->addChild(floor);
    const osg::ref_ptr<osg::Image> picture = _viewer.renderFloat(both, _camera, Size, Size, 1);
    ASSERT_TRUE(picture);
    const osg::Vec4 clear = support::HeadlessSettings().clearColor;
    int empty = 0, seen = 0;
    for (unsigned int y = 0; y < unsigned(Size); ++y)
        for (unsigned int x = 0; x < unsigned(Size); ++x)
            if (opaque->getColor(x, y) != clear && opaque->getColor(x, y).a() == 0.0f)
            {
                ++empty;
                seen += picture->getColor(x, y).r() == 1.0f;
            }
    EXPECT_GT(empty, 100);
    EXPECT_EQ(seen, empty);
}

TEST_F(MixedSceneGLTest, whatIsMissingShowsWhatLiesBehindWhereItIsTransparent)
{
    _model = makeImageQuad(*_image); // one layer, so that only the background is behind
    add("textured", {0.0, 0.0, 0.2, 0.8});
    setKeys({{0.0, 0.0, 0.0}});
    const osg::ref_ptr<osg::Image> opaque = osg::clone(draw().get(), osg::CopyOp::DEEP_COPY_ALL);
    _scene->setTransparent(true);
    const osg::ref_ptr<osg::Image> picture = draw();
    support::writeImage(*picture, "mixedTransparent");
    const osg::Vec4 behind = support::HeadlessSettings().clearColor;
    int through = 0, mixed = 0;
    double worst = 0.0;
    for (unsigned int y = 0; y < unsigned(Size); ++y)
        for (unsigned int x = 0; x < unsigned(Size); ++x)
        {
            const osg::Vec4 over = opaque->getColor(x, y), seen = picture->getColor(x, y);
            const bool isQuad = over != behind;
            through += isQuad && over.a() == 0.0f;
            mixed += isQuad && over.a() > 0.0f && over.a() < 1.0f;
            for (int i = 0; i < 3; ++i)
                worst = std::max(worst,
                                 double(std::abs(seen[i] - over[i] -
                                                 (isQuad ? 1.0f - over.a() : 0.0f) * behind[i])));
        }
    EXPECT_GT(through, 100);
    EXPECT_GT(mixed, 100);
    EXPECT_LE(worst, 1.0 / 255.0);
    _scene->setTransparent(false);
    const osg::ref_ptr<osg::Image> again = draw();
    EXPECT_EQ(std::memcmp(again->data(), opaque->data(), opaque->getTotalSizeInBytes()), 0);
}
