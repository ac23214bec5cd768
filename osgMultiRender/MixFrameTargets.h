// SPDX-License-Identifier: MIT
// Where the frame is copied to before a mix of it is drawn. Not installed.
#pragma once

#include <osgMultiRender/Framebuffer.h>
#include <osgMultiRender/TargetTexture.h>

#include <osg/Geometry>
#include <osg/StateSet>

namespace osgMultiRender
{

/// Colours and depths of one view, and the triangle that is drawn with them.
class MixFrameTargets : public osg::Referenced
{
public:
    struct Layout
    {
        int width = 0, height = 0;
        GLenum colorFormat = 0, depthFormat = 0;
        bool operator==(const Layout& other) const
        {
            return width == other.width && height == other.height &&
                   colorFormat == other.colorFormat && depthFormat == other.depthFormat;
        }
    };

    /// Like the depth buffer that is drawn into: only equal formats are copied.
    static GLenum depthFormatOf();

    /// The unit of the sampler of depths; the colours have that of a model's own texture.
    static constexpr unsigned int DepthUnit = 12;

    MixFrameTargets(unsigned int contextID, const Layout& layout);

    const Layout& getLayout() const { return _layout; }
    std::size_t getBytes() const { return _color->getBytes() + _depth->getBytes(); }
    /// Copies the part of the framebuffer that is drawn into, samples resolved. Empty, or why not.
    std::string copy(osg::State& state, int x, int y);
    /// Covers the viewport, where the modelview matrix is the inverse projection.
    const osg::Geometry& getTriangle() const { return *_triangle; }
    osg::StateSet& getStateSet() { return *_stateSet; }

protected:
    ~MixFrameTargets() override = default;

private:
    Layout _layout;
    Framebuffer _framebuffer;
    osg::ref_ptr<TargetTexture> _color, _depth;
    osg::ref_ptr<osg::Geometry> _triangle;
    osg::ref_ptr<osg::StateSet> _stateSet;
};

} // namespace osgMultiRender
