// SPDX-License-Identifier: MIT
// One merged program against one by hand and against passes that the framebuffer adds up.
#include "osgMultiRender/MixTruth.h"
#include "osgMultiRender/RenderingScenes.h"

#include <precision/MixMethods.h>
#include <precision/Sweep.h>

#include <osg/Camera>
#include <osg/MatrixTransform>

#include <cmath>
#include <ctime>
#include <map>
#include <memory>
#include <stdexcept>

namespace
{

using precision::MixMethod;
using precision::MixTask;
using precision::Outcome;

constexpr int PictureSize = 384;
/// A MixedScene makes one program a frame for those drawables that need fewer renderings or have
/// other lights.
constexpr int SettlingFrames = 60;

/// Of all threads of the program: a software renderer works in several, and others may be busy.
double getCpuSeconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Nine sample models around the middle, for drawables that lie within one rendering's ring.
osg::ref_ptr<osg::Node> makeModel(osg::Image& image)
{
    const osg::ref_ptr<osg::Group> sample = makeSampleModel(image)->asGroup();
    const osg::ref_ptr<osg::Node> shapes = sample->getChild(0);
    sample->removeChildren(0, 1);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
        {
            const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(
                osg::Matrixd::scale(0.5, 0.5, 0.5) * osg::Matrixd::translate(3.0 * x, 2.6 * y, 0));
            place->addChild(shapes);
            sample->addChild(place);
        }
    sample->getOrCreateStateSet()->setMode(GL_NORMALIZE, osg::StateAttribute::ON);
    sample->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    return sample;
}

/// A camera with a picture of its own.
struct Picture
{
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    osg::ref_ptr<osg::Image> image = new osg::Image;

    Picture(const support::CameraSpec& spec, bool isFloat)
    {
        image->allocateImage(PictureSize, PictureSize, 1, GL_RGBA,
                             isFloat ? GL_FLOAT : GL_UNSIGNED_BYTE);
        image->setInternalTextureFormat(isFloat ? GL_RGBA32F_ARB : GL_RGBA8);
        camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
        camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        camera->setViewMatrix(spec.view);
        camera->setProjectionMatrix(spec.projection);
        camera->setViewport(0, 0, PictureSize, PictureSize);
        camera->setClearColor({0, 0, 0, 0});
        camera->setRenderOrder(osg::Camera::PRE_RENDER);
        camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
        camera->attach(osg::Camera::COLOR_BUFFER, image);
    }
};

osg::ref_ptr<osg::Image> toFloat(const osg::Image& picture)
{
    const osg::ref_ptr<osg::Image> result = new osg::Image;
    result->allocateImage(picture.s(), picture.t(), 1, GL_RGBA, GL_FLOAT);
    for (int y = 0; y < picture.t(); ++y)
        for (int x = 0; x < picture.s(); ++x)
            result->setColor(picture.getColor(x, y), x, y);
    return result;
}

class Workshop
{
public:
    Workshop()
    {
        if (!_viewer.isValid())
            throw std::runtime_error(_viewer.getError());
        _viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    }

    Outcome draw(MixMethod method, bool isFloat, std::size_t count)
    {
        const auto key = std::make_pair(std::make_pair(int(method), isFloat), count);
        std::unique_ptr<Picture>& picture = _pictures[key];
        Outcome outcome;
        if (!picture)
        {
            picture = std::make_unique<Picture>(_camera, isFloat);
            picture->camera->addChild(
                precision::makeMixNode(method, MixTask(count), _model, _camera.view, PictureSize));
            _viewer.render(picture->camera, _camera, 1, 1,
                           method == MixMethod::Pruning ? SettlingFrames : 1);
            _errors[key] = getError(count, *picture->image);
        }
        const double start = getCpuSeconds();
        _viewer.render(picture->camera, _camera, 1, 1);
        outcome.seconds = getCpuSeconds() - start;
        outcome.number = _errors[key];
        return outcome;
    }

    std::string getRenderer() { return _viewer.getRenderer(); }

private:
    static support::HeadlessSettings makeSettings()
    {
        support::HeadlessSettings settings;
        settings.width = settings.height = PictureSize;
        return settings;
    }

    /// Root of the mean square over all covered pixels and channels, in steps of 8 bits.
    double getError(std::size_t count, const osg::Image& picture)
    {
        const MixTask task(count);
        std::unique_ptr<MixTruth>& truth = _truths[count];
        if (!truth)
        {
            truth = std::make_unique<MixTruth>(_viewer, _model, _camera, PictureSize);
            for (const osgMultiRender::Rendering& rendering : task.renderings)
                truth->add(
                    makeRenderingState(*osgMultiRender::findBuiltInRendering(rendering.name)));
        }
        const MixTruth::Difference difference =
            truth->compare(*toFloat(picture), task.points, task.weights);
        if (difference.covered < PictureSize * PictureSize / 8)
            throw std::runtime_error("the model covers too little of the picture");
        return 255.0 * difference.rms;
    }

    support::HeadlessViewer _viewer{makeSettings()};
    osg::ref_ptr<osg::Image> _texture = makeSampleImage(64);
    osg::ref_ptr<osg::Node> _model = makeModel(*_texture);
    support::CameraSpec _camera = support::CameraSpec::perspective(
        {2.5, -8.0, 5.5}, {0.0, 0.0, -0.4}, {0, 0, 1}, 50.0, 1.0, 1.0, 40.0);
    std::map<std::size_t, std::unique_ptr<MixTruth>> _truths;
    using Key = std::pair<std::pair<int, bool>, std::size_t>;
    std::map<Key, std::unique_ptr<Picture>> _pictures;
    std::map<Key, double> _errors;
};

precision::Sweep makeSweep()
{
    const auto shop = std::make_shared<Workshop>();
    precision::Sweep sweep;
    sweep.name = "mix-time";
    sweep.title = "One to eight renderings mixed near a polyline, 384x384, CPU time";
    sweep.errorName = "RMS from the blend in double precision, in 1/255";
    sweep.renderer = shop->getRenderer();
    sweep.getError = [](const Outcome& outcome, const Outcome&) { return outcome.number; };
    const auto add = [&](const std::string& name, MixMethod method, bool isFloat)
    {
        sweep.methods.push_back(
            {name, "renderings", {1, 2, 3, 4, 5, 6, 7, 8}, [shop, method, isFloat](double count) {
                 return shop->draw(method, isFloat, static_cast<std::size_t>(count));
             }});
    };
    add("merged program", MixMethod::Merged, false);
    add("merged by hand", MixMethod::ByHand, false);
    add("passes to 8 bits", MixMethod::Passes, false);
    add("passes to floats", MixMethod::Passes, true);
    add("MixedScene", MixMethod::Scene, false);
    add("MixedScene that leaves out", MixMethod::Pruning, false);
    return sweep;
}

const precision::Registration registration("mix-time", makeSweep);

} // namespace
