// SPDX-License-Identifier: MIT
#include <precision/ImageError.h>
#include <precision/SpotScene.h>
#include <precision/Sweep.h>

#include <support/HeadlessViewer.h>

#include <osg/GraphicsContext>
#include <osgViewer/Viewer>

#include <chrono>
#include <map>
#include <memory>
#include <stdexcept>

namespace
{

using precision::Lighting;
using precision::Outcome;

constexpr int PictureSize = 256;
constexpr int ReferenceFactor = 16;
// The floor of the pictures that light each pixel: it needs no more.
constexpr int CoarseFloor = 8;

std::unique_ptr<support::HeadlessViewer> makeViewer(int size)
{
    support::HeadlessSettings settings;
    settings.width = settings.height = size;
    auto viewer = std::make_unique<support::HeadlessViewer>(settings);
    if (!viewer->isValid())
    {
        throw std::runtime_error(viewer->getError());
    }
    viewer->getViewer().setLightingMode(osg::View::NO_LIGHT);
    return viewer;
}

/// Draws the scene factor times larger than the picture and averages; only the drawing is timed,
/// since on a GPU the averaging is next to nothing. A frame of the CPU's time is a frame of
/// llvmpipe's: reading back waits for it. Of 8 bits a channel: an RMS error of 0.29/255 of a
/// picture with one sample a pixel is rounding.
Outcome draw(support::HeadlessViewer& viewer, osg::Node* scene, int factor)
{
    const auto camera =
        support::CameraSpec::perspective(osg::Vec3d(0.0, -4.5, 3.0), osg::Vec3d(0.0, 0.1, 0.1),
                                         osg::Vec3d(0.0, 0.0, 1.0), 40.0, 1.0, 1.0, 20.0);
    const auto start = std::chrono::steady_clock::now();
    const osg::ref_ptr<osg::Image> large =
        viewer.render(scene, camera, factor * PictureSize, factor * PictureSize);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (!large)
    {
        throw std::runtime_error("nothing was drawn");
    }
    Outcome outcome;
    outcome.picture = precision::boxFilter(*large, factor);
    outcome.seconds = elapsed.count();
    return outcome;
}

/// Keeps what the runs of the sweep share.
struct Workshop
{
    explicit Workshop(int largestFactor) : viewer(makeViewer(largestFactor * PictureSize)) {}

    osg::Node* getScene(Lighting lighting, int floorCells)
    {
        osg::ref_ptr<osg::Group>& scene = scenes[{lighting, floorCells}];
        if (!scene)
        {
            scene = precision::makeLitScene(lighting);
            scene->addChild(precision::makeSpotScene(floorCells));
        }
        return scene.get();
    }

    std::unique_ptr<support::HeadlessViewer> viewer;
    std::map<std::pair<Lighting, int>, osg::ref_ptr<osg::Group>> scenes;
};

std::string getRenderer(support::HeadlessViewer& viewer)
{
    osgViewer::Viewer::Contexts contexts;
    viewer.getViewer().getContexts(contexts);
    if (contexts.empty() || !contexts.front()->makeCurrent())
    {
        return "unknown renderer";
    }
    const auto* const name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string renderer = name ? name : "unknown renderer";
    contexts.front()->releaseContext();
    return renderer;
}

precision::Method makeGouraud(const std::shared_ptr<Workshop>& shop, const std::string& name,
                              std::vector<double> cells)
{
    return {
        name, "floor cells a side", std::move(cells), [shop](double value) {
            return draw(*shop->viewer,
                        shop->getScene(Lighting::FixedFunction, static_cast<int>(value)), 1);
        }};
}

precision::Method makePerPixel(const std::shared_ptr<Workshop>& shop, const std::string& name,
                               std::vector<double> factors)
{
    return {name, "samples a side", std::move(factors),
            [shop](double value)
            {
                return draw(*shop->viewer, shop->getScene(Lighting::PerPixel, CoarseFloor),
                            static_cast<int>(value));
            }};
}

precision::Sweep makeLightingSweep()
{
    const auto shop = std::make_shared<Workshop>(8);
    precision::Sweep sweep;
    sweep.name = "lighting";
    sweep.title = "Spot light on a floor and a sphere, 256x256";
    sweep.errorName =
        "RMS error of the pixels, 1 is white, against per-pixel lighting with 16x16 samples";
    sweep.renderer = getRenderer(*shop->viewer);
    sweep.makeReference = []
    {
        Workshop large(ReferenceFactor);
        return draw(*large.viewer, large.getScene(Lighting::PerPixel, CoarseFloor),
                    ReferenceFactor);
    };
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
