// SPDX-License-Identifier: MIT
#include "CityPictures.h"

#include <osgLabels/Declutter.h>

#include <osg/AnimationPath>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <stdexcept>

namespace cityPictures
{

namespace
{

constexpr double Fovy = 50.0, Aspect = double(Width) / Height, Near = 1.0, Far = 3000.0;

osg::Vec4ub pixelOf(const osg::Image& picture, const PlatePixel& at)
{
    const unsigned char* const p =
        picture.data(static_cast<unsigned int>(at.x), static_cast<unsigned int>(at.y));
    return {p[0], p[1], p[2], 255};
}

bool isRed(const osg::Vec4ub& color)
{
    return color == osg::Vec4ub(255, 0, 0, 255);
}

} // namespace

support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer theViewer({Width, Height});
    return theViewer;
}

std::string getRenderer()
{
    osgViewer::Viewer::Contexts contexts;
    viewer().getViewer().getContexts(contexts);
    if (contexts.empty() || !contexts.front()->makeCurrent())
        return "unknown renderer";
    const auto* const name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    // The context stays current, as the viewer leaves it after a frame.
    return name ? name : "unknown renderer";
}

City makeTown(double origin)
{
    CitySettings settings;
    settings.origin = origin;
    return makeCity(settings);
}

support::CameraSpec cameraAt(double seconds)
{
    static const osg::ref_ptr<osg::AnimationPath> path = []
    {
        std::ifstream in(OSGKITS_CITY_PATH);
        osg::ref_ptr<osg::AnimationPath> read = new osg::AnimationPath;
        read->read(in);
        if (read->empty())
            throw std::runtime_error("no path in " OSGKITS_CITY_PATH);
        return read;
    }();
    osg::AnimationPath::ControlPoint point;
    path->getInterpolatedControlPoint(seconds, point);
    osg::Matrixd toWorld;
    point.getMatrix(toWorld);
    return {osg::Matrixd::inverse(toWorld), osg::Matrixd::perspective(Fovy, Aspect, Near, Far)};
}

support::CameraSpec moved(const support::CameraSpec& camera, double origin)
{
    return {osg::Matrixd::translate(-origin, -origin, 0.0) * camera.view, camera.projection};
}

std::vector<InView> labelsInView(const std::vector<osgLabels::MapLabel>& labels,
                                 const support::CameraSpec& camera)
{
    std::vector<InView> result;
    for (const osgLabels::MapLabel& label : labels)
    {
        const osg::Vec3d eye = label.anchor * camera.view, ndc = eye * camera.projection;
        if (eye.z() > -Near || std::abs(ndc.x()) > 1.0 || std::abs(ndc.y()) > 1.0)
            continue;
        const double x = (0.5 + 0.5 * ndc.x()) * Width, y = (0.5 + 0.5 * ndc.y()) * Height;
        // Letters are up to 0.7 em wide, an em is 14 pixels.
        const double halfWidth = 14.0 * (0.35 * double(label.text.size()) + 0.6), halfHeight = 14.0;
        result.push_back({label,
                          -eye.z(),
                          {{float(x - halfWidth), float(y - halfHeight)},
                           {float(x + halfWidth), float(y + halfHeight)}}});
    }
    return result;
}

std::vector<InView> chooseSpread(const std::vector<osgLabels::MapLabel>& labels,
                                 const support::CameraSpec& camera, unsigned int seed)
{
    std::vector<InView> all = labelsInView(labels, camera);
    std::mt19937 engine(seed);
    std::vector<osgLabels::DeclutterLabel> rectangles;
    for (std::size_t i = 0; i < all.size(); ++i)
        rectangles.push_back({all[i].space, double(engine()), i});
    osgLabels::Declutter declutter;
    const auto& shown = declutter.update(rectangles, {float(Width), float(Height)}, 0.0);
    std::vector<InView> result;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (shown[i])
            result.push_back(std::move(all[i]));
    return result;
}

osg::ref_ptr<osgLabels::LabelScene> makeScene(osg::Node* node, const std::vector<InView>& labels,
                                              const std::string& settings)
{
    osg::ref_ptr<osgLabels::LabelScene> scene = new osgLabels::LabelScene;
    scene->setSettingsText("keys=off,surface=off,ink=#ff0000,plate=#ff0000" +
                           (settings.empty() ? "" : "," + settings));
    if (node)
        scene->addChild(node);
    std::vector<osgLabels::MapLabel> all;
    for (const InView& label : labels)
        all.push_back(label.label);
    scene->addChild(new osgLabels::MapLabels(std::move(all)));
    return scene;
}

Picture render(osg::Node& node, const support::CameraSpec& camera, unsigned int frames)
{
    return viewer().render(&node, camera, Width, Height, frames);
}

std::vector<PlatePixel> platePixels(const std::vector<InView>& labels,
                                    const support::CameraSpec& camera)
{
    const Picture picture = render(*makeScene(nullptr, labels, "declutter=off"), camera);
    std::vector<PlatePixel> result;
    for (std::size_t i = 0; picture && i < labels.size(); ++i)
    {
        const osgLabels::Rectangle& space = labels[i].space;
        for (int y = std::max(0, int(space.low.y)); y < std::min(float(Height), space.high.y); ++y)
            for (int x = std::max(0, int(space.low.x)); x < std::min(float(Width), space.high.x);
                 ++x)
                if (const PlatePixel pixel{x, y, i}; isRed(pixelOf(*picture, pixel)))
                    result.push_back(pixel);
    }
    return result;
}

mapTruth::Effect effectIn(const osg::Image& picture, const osg::Image& bare, const PlatePixel& at)
{
    const osg::Vec4ub color = pixelOf(picture, at);
    if (isRed(color))
        return mapTruth::Effect::None;
    return color == pixelOf(bare, at) ? mapTruth::Effect::Hide : mapTruth::Effect::Fade;
}

} // namespace cityPictures
