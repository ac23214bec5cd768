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
        float anchorX, anchorY, distance;
        float age; ///< Seconds since it came; negative: it is not shown.
        std::uint32_t text, ownFirst;
        std::uint32_t ownLast; ///< From bit NextShift on the layer that is behind them.
        /// In the lowest bits the number of the style, then these, then from bit 8 on the index of
        /// its state in the last frame plus 1.
        std::uint32_t style;
    };
    enum Bits : std::uint32_t
    {
        Gone = 1u << 6 ///< It only keeps its state.
    };
    static constexpr int NextShift = 27;

    MapQuads(unsigned int contextID, const Layout&) : osg::Referenced(true), _contextID(contextID)
    {
    }

    Layout getLayout() const { return {}; }
    /// Uploads labels, and the numbers of those that are drawn in their order.
    void set(osg::State& state, const std::vector<Words>& labels,
             const std::vector<std::uint32_t>& order);
    /// Texel of the order's first number; four lie in each.
    unsigned int getOrderAt() const { return _orderAt; }
    void draw(osg::RenderInfo& renderInfo) const { draw(renderInfo, *_quad); }
    /// A point for each label, drawn or not.
    void drawPoints(osg::RenderInfo& renderInfo) const { draw(renderInfo, *_point); }
    const osg::StateAttribute* getTexture() const { return _labels.get(); }
    std::size_t getBytes() const { return _labels ? _labels->getBytes() : 0; }

protected:
    ~MapQuads() override;

private:
    static void draw(osg::RenderInfo& renderInfo, const osg::Geometry& shape);

    const unsigned int _contextID;
    osg::ref_ptr<BufferTexture> _labels;
    unsigned int _orderAt = 0;
    osg::ref_ptr<osg::Geometry> _quad, _point;
};

} // namespace osgLabels
