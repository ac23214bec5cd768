// SPDX-License-Identifier: MIT
#pragma once

#include "CoverageTruth.h"

#include <osgLabels/GlyphAtlas.h>

#include <osg/Image>
#include <osg/Node>

#include <string>
#include <vector>

/// How the page's plane is seen in an orthographic view: turned, then squashed.
struct CoverageView
{
    std::string name;
    double degrees = 0.0;
    double squash = 1.0;
    double axis = 0.0;         ///< Degrees from the text to what is squashed.
    double pixelsPerEm = 16.0; ///< Across the squashed direction.
    glm::dvec2 shift{0.0};     ///< Of the camera, in pixels.

    glm::mat2 getFootprint() const; ///< em a pixel.
};

/// A plane full of lines of text, 1.25 em apart, that a picture of any size is filled with.
class CoveragePage
{
public:
    explicit CoveragePage(const std::shared_ptr<osgLabels::GlyphSet>& glyphs,
                          const std::string& text = getDefaultText());

    static std::string getDefaultText();

    /// What the truth says of a square picture: one channel of floats, row 0 at the bottom.
    osg::ref_ptr<osg::Image> makeTruth(const CoverageView& view, int size) const;

    /// A triangle over the whole picture, drawn `copies` times. `source` is GLSL that defines
    /// `float shade(osgLabels_Text text, vec2 place, mat2 footprint)`.
    osg::ref_ptr<osg::Node> makeNode(const CoverageView& view, const std::string& source,
                                     int copies = 1) const;

    /// As makeNode() with coverage.glsl.
    osg::ref_ptr<osg::Node> makeNode(const CoverageView& view, const osgLabels::GlyphAtlas& atlas,
                                     int copies = 1) const;

    /// The place on its line, and the line's letters, at a point of the picture in pixels.
    glm::vec2 getPlace(const CoverageView& view, const glm::dvec2& pixel, int& line) const;
    std::vector<std::uint32_t> getLine(int line) const;

    const CoverageTruth& getTruth() const { return _truth; }

private:
    std::shared_ptr<osgLabels::GlyphSet> _glyphs;
    std::vector<std::uint32_t> _codes;
    CoverageTruth _truth;
};

/// Root of the mean square of the difference of first channels, in percent.
double getRmsPercent(const osg::Image& actual, const osg::Image& expected);
