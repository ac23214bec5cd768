// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/MaskTriangles.h>
#include <osgPagedTexture/Pixels.h>

#include <osg/GLExtensions>

#include <memory>
#include <vector>

namespace osgPagedTexture
{

/// A rectangle of a mask on the GPU: a framebuffer of one byte a pixel, and triangles that wait for
/// being drawn. Its context is current whenever it is used.
class MaskPiece
{
public:
    /// `left` and `bottom` in pixels of the photograph. Throws MaskError.
    MaskPiece(const osg::GLExtensions& gl, int left, int bottom, int width, int height);
    ~MaskPiece();
    MaskPiece(const MaskPiece&) = delete;
    MaskPiece& operator=(const MaskPiece&) = delete;

    /// The largest side that the current context draws.
    static int getLargestSide();

    void add(const PixelTriangle& triangle);
    /// Draws what waits. `size` is the location of the uniform that is told the piece's size.
    void flush(GLint size);
    bool isFull() const { return _waiting.size() >= MostWaiting; }
    void read(Pixels& mask) const;

private:
    static constexpr std::size_t MostWaiting = std::size_t(6) << 17; ///< 2^17 triangles.

    void push(const glm::dvec2& corner);

    const osg::GLExtensions& _gl;
    const int _left, _bottom, _width, _height;
    GLuint _framebuffer = 0, _pixels = 0, _vertices = 0;
    std::vector<float> _waiting; ///< x and y from the piece's middle.
};

/// All pieces of a mask.
class MaskPieces
{
public:
    MaskPieces(const osg::GLExtensions& gl, int width, int height, int largestSide, GLint size);

    /// Hands a triangle to each piece that it reaches, or comes as near as `reach` pixels to.
    void add(const PixelTriangle& triangle, double reach);
    void read(Pixels& mask);

private:
    const int _width, _height, _side, _columns, _rows;
    const GLint _size;
    std::vector<std::unique_ptr<MaskPiece>> _pieces;
};

} // namespace osgPagedTexture
