// SPDX-License-Identifier: MIT
#pragma once

#include "CoverageTruth.h"

#include <osgLabels/ObjectRecord.h>
#include <osgLabels/Placement.h>

#include <support/HeadlessViewer.h>

#include <osg/Geode>
#include <osg/Image>

#include <array>
#include <memory>
#include <string>

/// How a label on a shape is seen: by a perspective camera that looks at the text's middle.
struct ShapeView
{
    double roll = 0.0;         ///< Degrees about the line of sight.
    double tilt = 0.0;         ///< Degrees from the surface's normal, about the text's upright.
    double pixelsPerEm = 16.0; ///< At the text's middle, across the tilt.
    glm::dvec2 shift{0.0};     ///< Of the camera, in pixels at the text's middle.
    int size = 96;             ///< Of the picture, in pixels a side.
};

/// A white box, cylinder, sphere or cone with a text, and what a picture of it has to show: rays
/// through 256 points of a pixel meet the exact shape, and its point the outlines of the letters.
class ShapeTruth
{
public:
    static constexpr std::array<const char*, 4> Names = {"box", "cylinder", "sphere", "cone"};

    /// One of Names.
    explicit ShapeTruth(const std::string& name);

    /// The shape as it is drawn, named by the text; black letters come from a LabelScene over it.
    osg::Node* getNode() const { return _node; }

    support::CameraSpec getCamera(const ShapeView& view) const;

    /// One channel of floats: the share of ink of pixels that lie on a text as a whole, else NaN.
    osg::ref_ptr<osg::Image> makeTruth(const ShapeView& view) const;

private:
    struct Hit
    {
        glm::dvec3 point{0.0}, normal{0.0};
        bool isHit = false;
    };
    struct Eye;

    Hit meet(const glm::dvec3& eye, const glm::dvec3& ray) const;
    osgLabels::LabelPlace getPlace(const Eye& eye, const Hit& hit, const glm::dvec3& ray) const;
    Eye getEye(const ShapeView& view) const;
    void findText();

    osg::ref_ptr<osg::Geode> _node;
    std::shared_ptr<osgLabels::GlyphSet> _glyphs;
    std::vector<std::uint32_t> _codes;
    std::unique_ptr<CoverageTruth> _truth;
    osgLabels::ObjectRecord _record;
    float _width = 0.0f;                                ///< Of the text, in em.
    glm::dvec3 _middle{0.0}, _normal{0.0}, _along{0.0}; ///< Of the text.
    double _em = 1.0;                                   ///< In the scene's lengths.
};

/// Root of the mean square difference of the picture's ink (1 - red) from the truth, in percent,
/// over the pixels that the truth has; -1 without any.
double getShapeError(const osg::Image& picture, const osg::Image& truth, int* pixels = nullptr);
