// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Vec3>
#include <osg/Vec4>

#include <string>
#include <vector>

namespace osgLabels
{

/// Which way text stands on a surface that has no way up on the screen of its own.
enum class LabelUp
{
    Z,
    Y,
    X,
    Screen ///< Up is where it is on the screen.
};

/// How the text of a group of labels looks.
struct LabelStyle
{
    static constexpr unsigned int MaxStyles = 16;
    static constexpr float MaxOutline = 0.125f; ///< em

    osg::Vec4 ink{0.0f, 0.0f, 0.0f, 0.0f}; ///< Alpha 0: black or white, whichever shows.
    /// Alpha < 0: a black or white plate where the ink would have less contrast than 4.5 to 1 to
    /// the surface; 0: none.
    osg::Vec4 plate{0.0f, 0.0f, 0.0f, -1.0f};
    osg::Vec3 outline{0.0f, 0.0f, 0.0f};
    float outlineWidth = 0.0f; ///< em; 0: none.
};

/// What says how far away a map label is when something else may hide it.
enum class MapDepth
{
    Anchor,
    Back ///< Just before the back of its own feature, pixel by pixel; else its anchor.
};

/// Of what of a map label it is asked whether something hides it.
enum class MapTest
{
    Pixel,  ///< Each pixel.
    Anchor, ///< Its anchor, for all of it.
    Share   ///< All of it, by the share that is visible.
};

/// What becomes of the pixels of a map label that something else stands before. Of several
/// things the first action of these counts.
enum class MapAction : unsigned int
{
    Hide,
    Outline, ///< The edges of its letters are left.
    Recolor, ///< Letters take LabelSettings::mapColor.
    Fade,    ///< Drawn with LabelSettings::mapFade of its opacity.
    Ignore   ///< As if nothing stood there.
};
constexpr unsigned int NumMapActions = 4; ///< Those that change something.

enum class SurfaceLabels
{
    Auto, ///< Where no map is given.
    On,
    Off
};

/// All knobs of a LabelScene; see its setters.
struct LabelSettings
{
    static constexpr double MapPadX = 0.3;  ///< em of a plate beside the text,
    static constexpr double MapPadY = 0.08; ///< above and below it.

    std::string source = "name";
    std::string match;
    std::string font;
    bool proportional = false;
    float size = 0.5f;
    float gap = 2.0f;
    float readable = 4.0f;
    LabelUp up = LabelUp::Z;
    int texCoord = -1;
    bool chunk = false;
    bool keys = true;
    SurfaceLabels surface = SurfaceLabels::Auto;
    // Of map labels.
    std::string map = "off"; ///< "off", "values" or a file.
    float mapSize = 14.0f;   ///< Pixels an em.
    float mapWorld = 0.0f;   ///< Units an em; 0: mapSize counts.
    float mapOffset = 0.0f;  ///< Units towards the eye.
    MapDepth mapDepth = MapDepth::Anchor;
    MapAction mapAction = MapAction::Hide;
    std::string mapClass; ///< See MapClasses; mapAction for what it does not name.
    MapTest mapTest = MapTest::Pixel;
    float mapLeader = 0.0f; ///< Pixels.
    float mapFade = 0.25f;  ///< Opacity.
    osg::Vec4 mapColor{128.0f / 255.0f, 128.0f / 255.0f, 128.0f / 255.0f, 1.0f};
    bool declutter = true;
    std::vector<LabelStyle> styles{1};
};

} // namespace osgLabels
