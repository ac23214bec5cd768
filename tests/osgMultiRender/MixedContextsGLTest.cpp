// SPDX-License-Identifier: MIT
// One MixedScene in two windows, each with a context of its own.
#include "osgMultiRender/MixedPictures.h"

#include <osgViewer/CompositeViewer>

#include <cmath>
#include <mutex>
#include <set>

using namespace osgMultiRender;

namespace
{

using Colors = std::set<int>;

/// The grey values of each frame that a camera has drawn.
class Capture : public osg::Camera::DrawCallback
{
public:
    void operator()(osg::RenderInfo& renderInfo) const override
    {
        const osg::Viewport& v = *renderInfo.getCurrentCamera()->getViewport();
        const osg::ref_ptr<osg::Image> image = new osg::Image;
        image->readPixels(0, 0, int(v.width()), int(v.height()), GL_RGBA, GL_UNSIGNED_BYTE);
        Colors colors;
        for (unsigned int i = 0; i < image->getTotalSizeInBytes(); i += 4)
            if (image->data()[i + 2] == image->data()[i]) // the clear colour is blue
                colors.insert(image->data()[i]);
        const unsigned int frame = renderInfo.getState()->getFrameStamp()->getFrameNumber();
        std::lock_guard<std::mutex> lock(mutex);
        frames[frame] = colors;
    }

    mutable std::mutex mutex;
    mutable std::map<unsigned int, Colors> frames;
};

class MixedContextsGLTest
    : public MixedPictures,
      public testing::WithParamInterface<osgViewer::ViewerBase::ThreadingModel>
{
protected:
    osg::ref_ptr<Capture> addView(osgViewer::CompositeViewer& viewer)
    {
        osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
        traits->width = traits->height = Pixels;
        traits->depth = 24;
        traits->alpha = 8;
        traits->doubleBuffer = true;
        const osg::ref_ptr<osg::GraphicsContext> window =
            osg::GraphicsContext::createGraphicsContext(traits);
        EXPECT_TRUE(window);
        const osg::ref_ptr<osgViewer::View> view = new osgViewer::View;
        osg::Camera& camera = *view->getCamera();
        camera.setGraphicsContext(window);
        camera.setViewport(0, 0, Pixels, Pixels);
        camera.setDrawBuffer(GL_BACK);
        camera.setReadBuffer(GL_BACK);
        camera.setClearColor({0.0f, 0.0f, 1.0f, 1.0f});
        camera.setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
        camera.setViewMatrix(_camera.view);
        camera.setProjectionMatrix(_camera.projection);
        const osg::ref_ptr<Capture> capture = new Capture;
        camera.setFinalDrawCallback(capture);
        view->setSceneData(_scene);
        viewer.addView(view);
        return capture;
    }

    static constexpr int Pixels = 128;
};

} // namespace

TEST_P(MixedContextsGLTest, eachFrameShowsTheValuesThatItWasGiven)
{
    Rendering gray;
    gray.name = "gray";
    gray.shaders.push_back({GlslStage::Fragment,
                            "uniform float level;\nvoid main()\n{\n    gl_FragColor = "
                            "vec4(vec3(level), 1.0);\n}\n",
                            "gray.frag"});
    gray.uniforms.push_back({"level", "float", 1, {0.0}, 0.0, 1.0});
    const unsigned int number = _scene->addRendering(gray);
    // The same text, other values: never shown, since no key point is there.
    _scene->setUniform(_scene->addRendering(gray, {50.0, 60.0, 70.0, 80.0}), "level", {1.0});
    _scene->addChild(_model);
    osgViewer::CompositeViewer viewer;
    viewer.setThreadingModel(GetParam());
    viewer.setReleaseContextAtEndOfFrameHint(false);
    const osg::ref_ptr<Capture> captures[] = {addView(viewer), addView(viewer)};
    viewer.setKeyEventSetsDone(0);
    viewer.realize();
    constexpr int Frames = 120;
    for (int i = 0; i < Frames; ++i)
    {
        viewer.advance(0.02 * i);
        viewer.eventTraversal();
        const int level = int(viewer.getFrameStamp()->getFrameNumber() * 37 % 200);
        _scene->setUniform(number, "level", {level / 255.0});
        viewer.updateTraversal();
        viewer.renderingTraversals();
    }
    viewer.stopThreading();
    for (const osg::ref_ptr<Capture>& capture : captures)
    {
        ASSERT_GE(int(capture->frames.size()), Frames - 1);
        for (const auto& [frame, colors] : capture->frames)
            EXPECT_EQ(colors, Colors{int(frame * 37 % 200)}) << "frame " << frame;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Threading, MixedContextsGLTest,
    testing::Values(osgViewer::ViewerBase::SingleThreaded,
                    osgViewer::ViewerBase::CullDrawThreadPerContext,
                    osgViewer::ViewerBase::DrawThreadPerContext,
                    osgViewer::ViewerBase::CullThreadPerCameraDrawThreadPerContext));
