// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Node>

#include <cstdint>
#include <string>
#include <vector>

namespace osgrender
{

/// A pixel of the picture, counted from its lower left corner.
struct PickPoint
{
    int x = 0, y = 0;
};

/// What is labelled there.
struct PickResult
{
    PickPoint point;
    std::uint32_t identifier = 0; ///< 0: nothing.
    std::string text, path;       ///< As osgLabels::LabelScene::Picked has them.
};

/// Reads "x,y". Returns false and fills `error` on anything else.
bool parsePick(const std::string& text, PickPoint& point, std::string& error);

/// Asks all LabelScenes of the model for the frame that is drawn next, of `width` x `height`
/// pixels. Returns false and fills `error` where there is none, or this osgrender has no osgLabels.
bool askLabels(osg::Node& model, const PickPoint& point, int width, int height, std::string& error);

/// Their answers when the frame is drawn: each object that was found, or one that says nothing was.
std::vector<PickResult> takeAnswers(osg::Node& model, const PickPoint& point);

/// One line a result.
std::string pickText(const std::vector<PickResult>& results);

} // namespace osgrender
