// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/BufferTexture.h>

#include <osg/Geometry>

#include <array>
#include <vector>

namespace osgLabels
{

/// The quads of one view's map labels, in one graphics context.
class MapQuads : public osg::Referenced
{
public:
    struct Layout
    {
        bool operator==(const Layout&) const { return true; }
    };
    /// As mapLabel.vert reads a label.
    struct Words
    {
        float x, y, em, width; ///< Middle of the text in pixels; em in pixels.
        float anchorX, anchorY, distance, opacity;
        std::uint32_t text, ownFirst, ownLast, style;
    };

    MapQuads(unsigned int contextID, const Layout&) : osg::Referenced(true), _contextID(contextID)
    {
    }

    Layout getLayout() const { return {}; }
    /// Uploads labels, in the order in which they are drawn.
    void set(osg::State& state, const std::vector<Words>& labels);
    void draw(osg::RenderInfo& renderInfo) const { draw(renderInfo, *_quad); }
    /// A point each.
    void drawPoints(osg::RenderInfo& renderInfo) const { draw(renderInfo, *_point); }
    const osg::StateAttribute* getTexture() const { return _labels.get(); }
    std::size_t getBytes() const { return _labels ? _labels->getBytes() : 0; }

protected:
    ~MapQuads() override;

private:
    static void draw(osg::RenderInfo& renderInfo, const osg::Geometry& shape);

    const unsigned int _contextID;
    osg::ref_ptr<BufferTexture> _labels;
    osg::ref_ptr<osg::Geometry> _quad, _point;
};

} // namespace osgLabels
