// SPDX-License-Identifier: MIT
#include <precision/ImageError.h>
#include <precision/SpotScene.h>
#include <precision/Sweep.h>
#include <precision/SweepViewer.h>

#include <osg/Camera>

#include <chrono>
#include <map>
#include <memory>
#include <tuple>

namespace
{

using precision::Lighting;
using precision::Outcome;

constexpr int PictureSize = 256;
constexpr int ReferenceFactor = 16;
// The floor of the pictures that light each pixel: it needs no more.
constexpr int CoarseFloor = 8;

/// Draws the scene into a float picture that is factor times larger than the sweep's.
osg::ref_ptr<osg::Camera> makeCamera(osg::Node* scene, int factor)
{
    const int size = factor * PictureSize;
    osg::ref_ptr<osg::Image> picture = new osg::Image;
    picture->allocateImage(size, size, 1, GL_RGBA, GL_FLOAT);
    picture->setInternalTextureFormat(GL_RGBA32F_ARB);

    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setViewMatrixAsLookAt(osg::Vec3d(0.0, -4.5, 3.0), osg::Vec3d(0.0, 0.1, 0.1),
                                  osg::Vec3d(0.0, 0.0, 1.0));
    camera->setProjectionMatrixAsPerspective(40.0, 1.0, 1.0, 20.0);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setViewport(0, 0, size, size);
    camera->setClearColor(osg::Vec4(0.1f, 0.1f, 0.15f, 1.0f));
    camera->setRenderOrder(osg::Camera::PRE_RENDER);
    camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    camera->attach(osg::Camera::COLOR_BUFFER, picture);
    camera->attach(osg::Camera::DEPTH_BUFFER, GL_DEPTH_COMPONENT24);
    camera->addChild(scene);
    return camera;
}

/// Keeps what the runs of the sweep share: the context, and the scenes with their pictures.
class Workshop
{
public:
    /// Draws and averages; only the drawing is timed, with the transfer of the picture, since on a
    /// GPU the averaging is next to nothing.
    Outcome draw(Lighting lighting, int floorCells, int factor)
    {
        osg::Camera* const camera = getCamera(lighting, floorCells, factor);
        osg::Image& picture = viewer.clear(*camera);
        const auto start = std::chrono::steady_clock::now();
        viewer.draw(*camera);
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        Outcome outcome;
        outcome.picture = precision::boxFilter(picture, factor);
        outcome.seconds = elapsed.count();
        return outcome;
    }

    precision::SweepViewer viewer;

private:
    osg::Camera* getCamera(Lighting lighting, int floorCells, int factor)
    {
        osg::ref_ptr<osg::Camera>& camera = _cameras[{lighting, floorCells, factor}];
        if (!camera)
        {
            const osg::ref_ptr<osg::Group> scene = precision::makeLitScene(lighting);
            scene->addChild(precision::makeSpotScene(floorCells));
            camera = makeCamera(scene, factor);
        }
        return camera.get();
    }

    std::map<std::tuple<Lighting, int, int>, osg::ref_ptr<osg::Camera>> _cameras;
};

precision::Method makeGouraud(const std::shared_ptr<Workshop>& shop, const std::string& name,
                              std::vector<double> cells)
{
    return {name, "floor cells a side", std::move(cells), [shop](double value) {
                return shop->draw(Lighting::FixedFunction, static_cast<int>(value), 1);
            }};
}

precision::Method makePerPixel(const std::shared_ptr<Workshop>& shop, const std::string& name,
                               std::vector<double> factors)
{
    return {name, "samples a side", std::move(factors), [shop](double value) {
                return shop->draw(Lighting::PerPixel, CoarseFloor, static_cast<int>(value));
            }};
}

precision::Sweep makeLightingSweep()
{
    const auto shop = std::make_shared<Workshop>();
    precision::Sweep sweep;
    sweep.name = "lighting";
    sweep.title = "Spot light on a floor and a sphere, 256x256";
    sweep.errorName =
        "RMS error of the pixels, 1 is white, against per-pixel lighting with 16x16 samples";
    sweep.renderer = shop->viewer.getRenderer();
    // A shop of its own: its picture takes 256 MiB, which the sweep needs no more.
    sweep.makeReference = []
    { return Workshop().draw(Lighting::PerPixel, CoarseFloor, ReferenceFactor); };
    sweep.getError = [](const Outcome& outcome, const Outcome& reference)
    { return precision::getImageError(*outcome.picture, *reference.picture).rms; };
    sweep.methods = {makeGouraud(shop, "Gouraud", {CoarseFloor}),
                     makeGouraud(shop, "tessellated Gouraud", {16, 32, 64, 128, 256, 512}),
                     makePerPixel(shop, "per-pixel", {1}),
                     makePerPixel(shop, "supersampled per-pixel", {2, 3, 4, 6, 8})};
    return sweep;
}

const precision::Registration registration("lighting", makeLightingSweep);

} // namespace
