// SPDX-License-Identifier: MIT
// Renderings of images on the frame, in a second pass.
#include "osgMultiRender/ImageOperations.h"
#include "osgMultiRender/MixedPictures.h"

#include <osgMultiRender/MixOptions.h>

#include <osg/Camera>
#include <osg/ColorMask>
#include <osg/DisplaySettings>

using namespace osgMultiRender;

namespace
{

using Operation = osg::Vec4 (*)(const osg::Image&, int, int);

osg::Vec4 luminanceAt(const osg::Image& image, int x, int y)
{
    return grey(luminance(at(image, x, y)));
}

osg::Vec4 sepiaAt(const osg::Image& image, int x, int y)
{
    return sepia(at(image, x, y));
}

osg::ref_ptr<osg::Image> applied(const osg::Image& image, Operation operation)
{
    osg::ref_ptr<osg::Image> result = new osg::Image;
    result->allocateImage(image.s(), image.t(), 1, GL_RGBA, GL_FLOAT);
    for (int y = 0; y < image.t(); ++y)
        for (int x = 0; x < image.s(); ++x)
            result->setColor(operation(image, x, y), unsigned(x), unsigned(y));
    return result;
}

class MixedFrameGLTest : public MixedPictures
{
protected:
    osg::ref_ptr<osg::Image> drawOther(osg::Node* node)
    {
        return osg::clone(_viewer.renderFloat(node, _camera, Size, Size).get(),
                          osg::CopyOp::DEEP_COPY_ALL);
    }

    void addOfFrame(const std::string& name, const MixRange& range, Operation operation)
    {
        add(name, range);
        _operations.push_back(operation);
    }

    /// `plain` is the picture that the pass gets.
    void expectMixOf(const osg::Image& plain, const osg::Image& picture, const std::string& name)
    {
        MixTruth truth(_viewer, _model, _camera, Size);
        for (const Operation operation : _operations)
            truth.addPicture(applied(plain, operation));
        support::writeImage(picture, name);
        const MixTruth::Difference difference =
            truth.compare(picture, _points, MixWeights(_ranges, {}));
        std::cout << name << ": " << difference.covered << " pixels, " << difference.mixed
                  << " mixed, worst " << difference.worst * 255.0 << "/255\n";
        EXPECT_GT(difference.covered, Size * Size / 8);
        EXPECT_GT(difference.mixed, difference.covered / 20);
        EXPECT_EQ(difference.over, 0);
        // Where nothing was drawn what has an infinite range counts: the last one.
        const osg::ref_ptr<osg::Image> last = applied(plain, _operations.back());
        int background = 0;
        double worst = 0.0;
        for (int y = 0; y < Size; ++y)
            for (int x = 0; x < Size; ++x)
                if (!truth.hasSurface(x, y))
                {
                    ++background;
                    const osg::Vec4 off = last->getColor(unsigned(x), unsigned(y)) -
                                          picture.getColor(unsigned(x), unsigned(y));
                    for (int i = 0; i < 3; ++i)
                        worst = std::max(worst, double(std::abs(off[i])));
                }
        EXPECT_GT(background, 100);
        EXPECT_LE(worst, 1.0 / 255.0);
    }

    void addThree()
    {
        addOfFrame("luminance", {0.0, 0.0, 1.0, 2.5}, luminanceAt);
        addOfFrame("sobel", {1.0, 2.5, 3.0, 4.0}, sobel);
        addOfFrame("sepia", {3.0, 4.0, Infinity, Infinity}, sepiaAt);
        setKeys({{-1.6, -1.0, 0.5}});
    }

    std::vector<Operation> _operations;
};

} // namespace

TEST_F(MixedFrameGLTest, renderingsOfTheFrameEqualTheBlendOfTheirPictures)
{
    addThree();
    const osg::ref_ptr<osg::Image> plain = drawOther(_model);
    _scene->setInput(MixInput::Frame);
    support::NotifyCapture capture;
    const osg::ref_ptr<osg::Image> picture = draw();
    EXPECT_EQ(capture.takeWarnings(), support::NotifyCapture::Lines());
    expectMixOf(*plain, *picture, "mixedFrame");
    const std::vector<Plan> plans = _scene->getPlans();
    ASSERT_EQ(plans.size(), 1u);
    EXPECT_EQ(plans[0].entries.at(0).decision, PlanEntry::Decision::Drawn);
    // RGBA32F and at most 4 bytes of depth a pixel.
    EXPECT_EQ(plans[0].counts.at("mix.frameBytes"), Size * Size * 20.0);
    draw(3);
    EXPECT_EQ(_scene->getPlans()[0].counts.at("mix.programs.linked"), 1.0);
}

TEST_F(MixedFrameGLTest, insideOfAnotherKitTheFrameIsTheKits)
{
    addThree();
    const osg::ref_ptr<MixedScene> outer = new MixedScene;
    outer->addRendering(importNamed("gooch"));
    outer->addChild(_model);
    const osg::ref_ptr<osg::Image> plain = drawOther(outer);
    outer->removeChildren(0, 1);
    _scene->setInput(MixInput::Frame);
    _scene->addChild(_model);
    outer->addChild(_scene);
    expectMixOf(*plain, *drawOther(outer), "mixedFrameNested");
    // The other way round as well.
    outer->removeChildren(0, 1);
    _scene->removeChildren(0, 1);
    outer->addChild(_model);
    _scene->addChild(outer);
    expectMixOf(*plain, *drawOther(_scene), "mixedFrameAround");
}

TEST_F(MixedFrameGLTest, eachViewHasItsOwnPartOfTheFrame)
{
    addOfFrame("luminance", MixRange(), luminanceAt);
    const osg::ref_ptr<osg::Group> views = new osg::Group;
    for (const int x : {0, Size / 2})
    {
        const osg::ref_ptr<osg::Camera> view = new osg::Camera;
        view->setReferenceFrame(osg::Transform::RELATIVE_RF);
        view->setRenderOrder(osg::Camera::POST_RENDER, x);
        view->setClearColor({0.1f, 0.5f, 0.3f, 1.0f});
        view->setViewport(x, Size / 4, Size / 2, Size / 2);
        view->addChild(_scene);
        views->addChild(view);
    }
    _scene->addChild(_model);
    _scene->setPruning(false);
    const osg::ref_ptr<MixedScene> withRendering = _scene;
    // As it is without: a mix of nothing shows surfaces as they are.
    withRendering->setInput(MixInput::Frame);
    const osg::ref_ptr<osg::Image> picture = drawOther(views);
    withRendering->removeRendering(0);
    const osg::ref_ptr<osg::Image> plain = drawOther(views);
    support::writeImage(*picture, "mixedFrameViews");
    const osg::ref_ptr<osg::Image> grey = applied(*plain, luminanceAt);
    int colored = 0, wrong = 0;
    for (int y = 0; y < Size; ++y)
        for (int x = 0; x < Size; ++x)
        {
            const bool isView = y >= Size / 4 && y < 3 * Size / 4;
            const osg::Vec4 before = plain->getColor(unsigned(x), unsigned(y));
            const osg::Vec4 expected = isView ? grey->getColor(unsigned(x), unsigned(y)) : before;
            const osg::Vec4 off = picture->getColor(unsigned(x), unsigned(y)) - expected;
            wrong += osg::Vec3(off.x(), off.y(), off.z()).length() > 2.0f / 255.0f;
            colored += isView && std::abs(before.r() - before.b()) > 0.05f;
        }
    EXPECT_GT(colored, Size * Size / 8);
    EXPECT_EQ(wrong, 0);
}

TEST_F(MixedFrameGLTest, aPictureOfSomeColorsAloneOrOfInterlacedEyesIsKept)
{
    addThree();
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(_model);
    root->getOrCreateStateSet()->setAttribute(new osg::ColorMask(true, false, false, true));
    const osg::ref_ptr<osg::Image> plain = drawOther(root);
    root->removeChildren(0, 1);
    _scene->addChild(_model);
    _scene->setInput(MixInput::Frame);
    root->addChild(_scene);
    const osg::ref_ptr<osg::Image> masked = drawOther(root);
    EXPECT_EQ(support::difference(*masked, *plain, 0.0).worst, 0.0);
    std::vector<Plan> plans = _scene->getPlans();
    ASSERT_EQ(plans.size(), 1u);
    EXPECT_EQ(plans[0].entries.at(0).decision, PlanEntry::Decision::Dropped);
    EXPECT_NE(plans[0].entries.at(0).reason.find("some colours alone"), std::string::npos);

    root->getStateSet()->removeAttribute(osg::StateAttribute::COLORMASK);
    const osg::ref_ptr<osg::DisplaySettings> settings = new osg::DisplaySettings;
    settings->setStereo(true);
    settings->setStereoMode(osg::DisplaySettings::HORIZONTAL_INTERLACE);
    _viewer.getViewer().getCamera()->setDisplaySettings(settings);
    drawOther(root);
    _viewer.getViewer().getCamera()->setDisplaySettings(nullptr);
    plans = _scene->getPlans();
    EXPECT_NE(plans.back().entries.at(0).reason.find("share the picture's pixels"),
              std::string::npos);
}

TEST_F(MixedFrameGLTest, plansOfViewsThatAreGoneAreForgotten)
{
    addThree();
    _scene->setInput(MixInput::Frame);
    _scene->addChild(_model);
    for (int i = 0; i < 5; ++i)
    {
        const osg::ref_ptr<osg::Camera> picture = new osg::Camera;
        picture->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
        picture->setRenderOrder(osg::Camera::POST_RENDER);
        picture->setViewMatrix(_camera.view);
        picture->setProjectionMatrix(_camera.projection);
        picture->addChild(_scene);
        drawOther(picture);
    }
    draw(2);
    EXPECT_LE(_scene->getPlans().size(), 2u) << "the view and the picture before it";
}

TEST_F(MixedFrameGLTest, theSettingIsReadAndWritten)
{
    std::string error;
    EXPECT_TRUE(setMixOptions(*_scene, {{"renderings", "sepia"}, {"input", "frame"}}, error));
    EXPECT_EQ(_scene->getInput(), MixInput::Frame);
    const osg::ref_ptr<MixedScene> other = new MixedScene;
    other->setMixText(_scene->getMixText());
    EXPECT_EQ(other->getInput(), MixInput::Frame);
}

TEST(MixedFrameSamplesGLTest, severalSamplesAPixelBecomeOne)
{
    support::HeadlessSettings settings;
    settings.width = settings.height = 128;
    settings.samples = 4;
    support::HeadlessViewer viewer(settings);
    OSGKITS_NEED_GL(viewer);
    const osg::ref_ptr<osg::Image> texture = makeSampleImage(64);
    const osg::ref_ptr<MixedScene> scene = new MixedScene;
    scene->addChild(makeSampleModel(*texture));
    const support::CameraSpec camera = support::CameraSpec::overview(*scene, 1.0);
    scene->setInput(MixInput::Frame);
    const osg::ref_ptr<osg::Image> plain =
        osg::clone(viewer.render(scene, camera, 128, 128).get(), osg::CopyOp::DEEP_COPY_ALL);
    scene->addRendering(importNamed("sepia"));
    const osg::ref_ptr<osg::Image> picture = viewer.render(scene, camera, 128, 128);
    support::writeImage(*picture, "mixedFrameSamples");
    support::writeImage(*plain, "mixedFrameSamplesPlain");
    const osg::ref_ptr<osg::Image> expected = applied(*plain, sepiaAt);
    double worst = 0.0;
    for (unsigned int y = 0; y < 128; ++y)
        for (unsigned int x = 0; x < 128; ++x)
            for (int i = 0; i < 3; ++i)
                worst = std::max(worst, std::abs(double(expected->getColor(x, y)[i]) -
                                                 picture->getColor(x, y)[i]));
    // Two roundings to 8 bits.
    EXPECT_LE(worst, 2.0 / 255.0);
    ASSERT_FALSE(scene->getPlans().empty());
    EXPECT_NE(scene->getPlans()[0].entries.at(0).reason.find("4 samples"), std::string::npos)
        << scene->getPlans()[0].entries.at(0).reason;
}
