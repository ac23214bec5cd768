// SPDX-License-Identifier: MIT
#pragma once

#include "MapTruth.h"

#include <osgLabels/LabelScene.h>
#include <osgLabels/MapLabel.h>
#include <osgLabels/MapLabels.h>
#include <osgLabels/RectangleGrid.h>

#include <city/City.h>

#include <osg/Image>

/// Map labels over the generated town, as they are drawn and as they should be.
namespace cityPictures
{

using Picture = osg::ref_ptr<osg::Image>;

constexpr int Width = 640, Height = 480;

/// Of this process.
support::HeadlessViewer& viewer();

/// Of the viewer's context, as GL names it.
std::string getRenderer();

/// The town of 500 buildings with its middle there.
City makeTown(double origin = 0.0);

/// At a second of the recorded path over it, 0 to 40.
support::CameraSpec cameraAt(double seconds);

/// The same view of a town that is elsewhere.
support::CameraSpec moved(const support::CameraSpec& camera, double origin);

/// A label that is in view.
struct InView
{
    osgLabels::MapLabel label;
    double depth = 0.0;         ///< Of its anchor, from the eye along the view.
    osgLabels::Rectangle space; ///< Pixels, all that it is drawn in, and a little more.
};

/// Those whose anchors are in view.
std::vector<InView> labelsInView(const std::vector<osgLabels::MapLabel>& labels,
                                 const support::CameraSpec& camera);

/// As many as find room without overlap; which ones depends on the seed.
std::vector<InView> chooseSpread(const std::vector<osgLabels::MapLabel>& labels,
                                 const support::CameraSpec& camera, unsigned int seed);

/// A LabelScene with plates of pure red, over the node, which may be null, and the labels.
osg::ref_ptr<osgLabels::LabelScene> makeScene(osg::Node* node, const std::vector<InView>& labels,
                                              const std::string& settings = std::string());

Picture render(osg::Node& node, const support::CameraSpec& camera, unsigned int frames = 1);

/// A pixel of a label's plate.
struct PlatePixel
{
    int x = 0, y = 0;
    std::size_t label = 0; ///< Of those in view.
};

/// All pixels that labels that do not overlap cover in full.
std::vector<PlatePixel> platePixels(const std::vector<InView>& labels,
                                    const support::CameraSpec& camera);

/// What a picture shows of a label where `bare` is one without labels: pure red is shown in full,
/// what is bare is hidden, all else is faded.
mapTruth::Effect effectIn(const osg::Image& picture, const osg::Image& bare, const PlatePixel& at);

} // namespace cityPictures
