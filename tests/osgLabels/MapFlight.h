// SPDX-License-Identifier: MIT
#pragma once

#include "CityPictures.h"

#include <map>
#include <vector>

/// Which labels of the town come and go while a camera follows the recorded path.
///
/// Each label's text is a bar code of its own, so that a picture says which labels it shows.
class MapFlight
{
public:
    /// Settings of the LabelScene. Without a past all frames have one simulation time, so that
    /// each stands for itself.
    MapFlight(const City& town, const std::string& settings, bool hasPast);

    struct Flips
    {
        unsigned int frames = 0;
        double shown = 0.0;     ///< Labels, mean over the frames.
        unsigned int count = 0; ///< Changes between shown and hidden of labels that stay in view.
        unsigned int most = 0;  ///< Of one label within a second.
        double perLabelAndSecond = 0.0; ///< Of labels in view.
    };
    /// From a second of the path on, at a multiple of its speed.
    Flips fly(double from, double seconds, double speed);

    /// The camera rests where it is, for so many frames: how many pictures differ from the first.
    unsigned int rest(unsigned int frames);

    static constexpr double FrameTime = 1.0 / 10.0;

private:
    cityPictures::Picture draw(const support::CameraSpec& camera);
    bool isShown(const osg::Image& picture, const cityPictures::InView& label) const;

    std::vector<osgLabels::MapLabel> _labels;
    osg::ref_ptr<osgLabels::LabelScene> _scene;
    support::CameraSpec _camera;
    bool _hasPast;
    double _time = 0.0;
};
