// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PhotoSurface.h>
#include <osgPagedTexture/Pixels.h>

#include <osg/GraphicsContext>

#include <memory>
#include <stdexcept>

namespace osgPagedTexture
{

/// A mask can't be drawn; one line.
class OSGPAGEDTEXTURE_EXPORT MaskError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

struct MaskSettings
{
    /// Every pixel that a triangle touches, to 1/256 of a pixel; else those whose middle it covers.
    bool conservative = false;
    int margin = 0;       ///< Pixels that masks grow by on all sides, 0 to 65536.
    int largestPiece = 0; ///< Side of what is drawn at once; 0: what the context can.
};

struct PhotoMask
{
    Pixels pixels;           ///< Of the photograph's size, one channel: 255 used, 0 not.
    double usedShare = 0.0;  ///< Of all pixels.
    std::size_t skipped = 0; ///< Triangles with numbers that aren't finite.
    std::size_t whole = 0;   ///< Triangles that have a whole repeat, or more than MostWrapCells.
};

/// Draws which pixels of a photograph a model shows: its triangles, seen by an orthographic camera
/// over their texture coordinates, looked at once a photograph; beyond the largest viewport in
/// pieces. Requires OpenGL 3.3.
class OSGPAGEDTEXTURE_EXPORT MaskRenderer
{
public:
    /// Takes the context over and realizes it where it is not: nobody else may draw in it. Throws
    /// MaskError.
    explicit MaskRenderer(osg::GraphicsContext& context);
    ~MaskRenderer();
    MaskRenderer(const MaskRenderer&) = delete;
    MaskRenderer& operator=(const MaskRenderer&) = delete;

    /// In the thread that made this object. Throws MaskError.
    PhotoMask render(const Photo& photo, const MaskSettings& settings = {});

private:
    struct State;
    std::unique_ptr<State> _state;
};

/// A context without a window, from the windowing system that is loaded, else from osgdb_egl.
/// Throws MaskError.
OSGPAGEDTEXTURE_EXPORT osg::ref_ptr<osg::GraphicsContext> makeOffscreenContext();

} // namespace osgPagedTexture
