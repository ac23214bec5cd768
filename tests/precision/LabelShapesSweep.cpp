// SPDX-License-Identifier: MIT
#include <ShapeTruth.h>

#include <osgLabels/LabelScene.h>
#include <precision/Sweep.h>
#include <support/HeadlessViewer.h>

#include <cmath>
#include <ctime>
#include <map>
#include <stdexcept>
#include <tuple>

namespace
{

using precision::Outcome;

constexpr int PictureSize = 96;
const std::vector<double> Sizes = {2, 4, 8, 12, 16, 24, 32, 64, 128, 200};

struct Seen
{
    const char* name;
    double roll, tilt;
};
constexpr Seen Views[] = {
    {"head-on", 0.0, 0.0}, {"27 degrees", 27.0, 0.0}, {"80 degrees", 0.0, 80.0}};

double getCpuSeconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Keeps what the runs share: the context, the shapes with their labels, the truths.
class Workshop
{
public:
    Workshop()
    {
        if (!viewer.isValid())
            throw std::runtime_error(viewer.getError());
        viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
        for (const char* const name : ShapeTruth::Names)
        {
            _shapes.emplace(name, name);
            const osg::ref_ptr<osgLabels::LabelScene> scene = new osgLabels::LabelScene;
            scene->setSettingsText("keys=off,ink=#000000,plate=off,readable=0");
            scene->addChild(_shapes.at(name).getNode());
            _scenes[name] = scene;
        }
    }

    /// Small texts have few pixels: those of several pictures, each moved by a part of a pixel.
    Outcome draw(const std::string& shape, const Seen& seen, double pixelsPerEm)
    {
        const int pictures = pixelsPerEm < 16.0 ? 8 : 1;
        Outcome outcome;
        outcome.seconds = 0.0;
        double sum = 0.0;
        int count = 0;
        for (int i = 0; i < pictures; ++i)
        {
            ShapeView view;
            view.roll = seen.roll;
            view.tilt = seen.tilt;
            view.pixelsPerEm = pixelsPerEm;
            view.shift = {0.125 * i, std::fmod(0.375 * i, 1.0)};
            view.size = PictureSize;
            const auto camera = _shapes.at(shape).getCamera(view);
            const double start = getCpuSeconds();
            const auto picture =
                viewer.render(_scenes.at(shape), camera, PictureSize, PictureSize, 2);
            outcome.seconds += (getCpuSeconds() - start) / (2.0 * pictures);
            osg::ref_ptr<osg::Image>& truth = _truths[{shape, seen.name, pixelsPerEm, i}];
            if (!truth)
                truth = _shapes.at(shape).makeTruth(view);
            if (!picture)
                throw std::runtime_error("no picture");
            int pixels = 0;
            const double error = getShapeError(*picture, *truth, &pixels);
            sum += error * error * pixels;
            count += pixels;
        }
        if (!count)
            throw std::runtime_error("no pixel lies on a text as a whole");
        outcome.number = std::sqrt(sum / count);
        return outcome;
    }

    std::string getRenderer() { return viewer.getRenderer(); }

    support::HeadlessViewer viewer{support::HeadlessSettings{}};

private:
    std::map<std::string, ShapeTruth> _shapes;
    std::map<std::string, osg::ref_ptr<osgLabels::LabelScene>> _scenes;
    std::map<std::tuple<std::string, std::string, double, int>, osg::ref_ptr<osg::Image>> _truths;
};

precision::Sweep makeSweep()
{
    const auto shop = std::make_shared<Workshop>();
    precision::Sweep sweep;
    sweep.name = "label-shapes";
    sweep.title = "Labels on shapes in perspective, 2 to 200 pixels an em, 96x96, CPU time";
    sweep.errorName = "RMS error of coverage in percent, against 256 rays a pixel";
    sweep.renderer = shop->getRenderer();
    sweep.getError = [](const Outcome& outcome, const Outcome&) { return outcome.number; };
    for (const char* const shape : ShapeTruth::Names)
        for (const Seen& seen : Views)
            sweep.methods.push_back({std::string(shape) + ", " + seen.name, "px an em", Sizes,
                                     [shop, shape, seen](double size)
                                     { return shop->draw(shape, seen, size); }});
    return sweep;
}

const precision::Registration registration("label-shapes", makeSweep);

} // namespace
