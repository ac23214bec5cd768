// SPDX-License-Identifier: MIT
#pragma once

#include "LabelPictures.h"

#include <string>

/// Pictures of scenes at the limits, as floats, and what holds of the text in each of them.
namespace labelScene
{

/// A board of 2.4 x 1 that faces the camera of fromFront().
osg::ref_ptr<osg::Geode> board(const std::string& text);

/// A cylinder around the x axis: from `left`, of that length.
osg::ref_ptr<osg::Geode> pipe(const std::string& name, double left, double length, float radius);

/// Looks at a place from a direction; near and far keep what lies between 1/100 and 100 times that.
support::CameraSpec lookFrom(const osg::Vec3d& eye, const osg::Vec3d& center, double distance);

/// As floats; one that is no number is a failure.
Picture renderNumbers(osg::Node& node, const std::string& name,
                      const support::CameraSpec& camera = fromFront());

/// A model without its labels and with them, in black.
struct InkPictures
{
    Picture without, with; ///< Null where one can't be drawn.

    /// Share of the pixels that show the model; NaN, of which no comparison holds, without
    /// pictures.
    double modelShare() const;

    /// Share of the pixels that the labels change; NaN without pictures.
    double inkShare() const;
};

/// Draws both. Expected of each model is that no program fails, that no pixel beside the model
/// changes, and that none gets lighter.
InkPictures drawInk(osg::Node* model, const std::string& name,
                    const support::CameraSpec& camera = fromFront(),
                    const std::string& settings = Plain);

} // namespace labelScene
