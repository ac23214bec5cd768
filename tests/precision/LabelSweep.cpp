// SPDX-License-Identifier: MIT
#include "LabelMethods.h"

#include <precision/Sweep.h>
#include <precision/SweepViewer.h>

#include <osg/Camera>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <stdexcept>

namespace
{

using precision::LabelMethod;
using precision::Outcome;

constexpr int PictureSize = 256;
/// Of the picture on top of itself in one frame: what a frame costs besides is small then.
constexpr int Copies = 16;
const std::vector<double> Sizes = {2, 4, 8, 12, 16, 24, 32, 64, 128, 200};

/// Of all threads of the program: a software renderer works in several, and others may be busy.
double getCpuSeconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

osg::ref_ptr<osg::Camera> makeCamera(osg::Node* node)
{
    const osg::ref_ptr<osg::Image> picture = new osg::Image;
    picture->allocateImage(PictureSize, PictureSize, 1, GL_RED, GL_FLOAT);
    const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setCullingMode(osg::CullSettings::NO_CULLING);
    camera->setViewport(0, 0, PictureSize, PictureSize);
    camera->setClearMask(0);
    camera->setRenderOrder(osg::Camera::PRE_RENDER);
    camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    picture->setInternalTextureFormat(GL_RGBA8); // as what labels are drawn to
    camera->attach(osg::Camera::COLOR_BUFFER, picture);
    camera->addChild(node);
    return camera;
}

/// Keeps what the runs of the sweep share: context, letters, pictures and their truths.
class Workshop
{
public:
    explicit Workshop(CoverageView view) : _view(std::move(view))
    {
        std::string error;
        const auto face = osgLabels::FontFace::openOrDefault("", error);
        if (!face)
            throw std::runtime_error(error);
        _glyphs = std::make_shared<osgLabels::GlyphSet>(face);
        _page = std::make_unique<CoveragePage>(_glyphs);
        _atlas = new osgLabels::GlyphAtlas(_glyphs);
        _atlas->update();
        methods = precision::makeLabelMethods(*_glyphs);
        methods.push_back({"coverage.glsl", {}, nullptr});
    }

    Outcome draw(const LabelMethod& method, double pixelsPerEm)
    {
        osg::Camera* const camera = getCamera(method, pixelsPerEm);
        osg::Image& picture = viewer.clear(*camera);
        const double start = getCpuSeconds();
        viewer.draw(*camera);
        Outcome outcome;
        outcome.seconds = (getCpuSeconds() - start) / Copies;
        outcome.number = getRmsPercent(picture, *getTruth(pixelsPerEm));
        return outcome;
    }

    precision::SweepViewer viewer;
    std::vector<LabelMethod> methods;

private:
    osg::Camera* getCamera(const LabelMethod& method, double pixelsPerEm)
    {
        osg::ref_ptr<osg::Camera>& camera = _cameras[{method.name, pixelsPerEm}];
        if (camera)
            return camera.get();
        CoverageView view = _view;
        view.pixelsPerEm = pixelsPerEm;
        osg::ref_ptr<osg::Node> node;
        if (method.images)
        {
            node = _page->makeNode(view, method.source, Copies);
            node->getStateSet()->setTextureAttribute(0, method.images);
            node->getStateSet()->addUniform(new osg::Uniform("images", 0));
        }
        else
            node = _page->makeNode(view, *_atlas, Copies);
        camera = makeCamera(node);
        return camera.get();
    }

    const osg::Image* getTruth(double pixelsPerEm)
    {
        osg::ref_ptr<osg::Image>& truth = _truths[pixelsPerEm];
        CoverageView view = _view;
        view.pixelsPerEm = pixelsPerEm;
        if (!truth)
            truth = _page->makeTruth(view, PictureSize);
        return truth.get();
    }

    CoverageView _view;
    std::shared_ptr<osgLabels::GlyphSet> _glyphs;
    std::unique_ptr<CoveragePage> _page;
    osg::ref_ptr<osgLabels::GlyphAtlas> _atlas;
    std::map<std::pair<std::string, double>, osg::ref_ptr<osg::Camera>> _cameras;
    std::map<double, osg::ref_ptr<osg::Image>> _truths;
};

precision::Sweep makeSweep(const CoverageView& view)
{
    const auto shop = std::make_shared<Workshop>(view);
    precision::Sweep sweep;
    sweep.name = view.name;
    sweep.title = "Letters of DejaVu Sans Mono seen " + view.name.substr(view.name.rfind('-') + 1) +
                  ", 2 to 200 pixels an em, 256x256, CPU time";
    sweep.errorName = "RMS error of coverage in percent, against 256 samples of the outlines";
    sweep.renderer = shop->viewer.getRenderer();
    sweep.getError = [](const Outcome& outcome, const Outcome&) { return outcome.number; };
    for (const LabelMethod& method : shop->methods)
        sweep.methods.push_back({method.name, "px an em", Sizes,
                                 [shop, method](double size) { return shop->draw(method, size); }});
    return sweep;
}

void enter(const std::string& name, double degrees, double squash,
           std::vector<precision::Registration>& registrations)
{
    CoverageView view;
    view.name = name;
    view.degrees = degrees;
    view.squash = squash;
    registrations.emplace_back(name, [view] { return makeSweep(view); });
}

std::vector<precision::Registration> registerAll()
{
    std::vector<precision::Registration> registrations;
    enter("label-coverage-frontal", 0.0, 1.0, registrations);
    enter("label-coverage-rotated", 27.0, 1.0, registrations);
    enter("label-coverage-squashed", 27.0, 4.0, registrations);
    // One over the cosine of 80 degrees.
    enter("label-coverage-grazing", 0.0, 5.759, registrations);
    return registrations;
}

const std::vector<precision::Registration> registrations = registerAll();

} // namespace
