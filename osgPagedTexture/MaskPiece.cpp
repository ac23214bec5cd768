// SPDX-License-Identifier: MIT
#include <osgPagedTexture/MaskPiece.h>

#include <osgPagedTexture/PhotoMask.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

MaskPiece::MaskPiece(const osg::GLExtensions& gl, int left, int bottom, int width, int height)
    : _gl(gl), _left(left), _bottom(bottom), _width(width), _height(height)
{
    while (glGetError() != GL_NO_ERROR)
    {
    }
    _gl.glGenFramebuffers(1, &_framebuffer);
    _gl.glGenRenderbuffers(1, &_pixels);
    _gl.glGenBuffers(1, &_vertices);
    _gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, _framebuffer);
    _gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, _pixels);
    _gl.glRenderbufferStorage(GL_RENDERBUFFER_EXT, GL_R8, width, height);
    _gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_RENDERBUFFER_EXT,
                                  _pixels);
    if (_gl.glCheckFramebufferStatus(GL_FRAMEBUFFER_EXT) != GL_FRAMEBUFFER_COMPLETE_EXT ||
        glGetError() != GL_NO_ERROR)
    {
        throw MaskError("no memory on the GPU for " + std::to_string(width) + " x " +
                        std::to_string(height) + " pixels of a mask; ask for smaller pieces");
    }
    glDisable(GL_DITHER);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
}

MaskPiece::~MaskPiece()
{
    _gl.glDeleteBuffers(1, &_vertices);
    _gl.glDeleteRenderbuffers(1, &_pixels);
    _gl.glDeleteFramebuffers(1, &_framebuffer);
}

int MaskPiece::getLargestSide()
{
    constexpr GLenum LargestRenderbuffer = 0x84E8;
    GLint viewport[2] = {0, 0}, buffer = 0;
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    glGetIntegerv(LargestRenderbuffer, &buffer);
    return std::max(1, std::min({viewport[0], viewport[1], buffer}));
}

void MaskPiece::push(const glm::dvec2& corner)
{
    _waiting.push_back(float(corner.x));
    _waiting.push_back(float(corner.y));
}

void MaskPiece::add(const PixelTriangle& triangle)
{
    const glm::dvec2 middle(_left + 0.5 * _width, _bottom + 0.5 * _height);
    const double far = 2.0 * std::max(_width, _height);
    bool isNear = true;
    PixelTriangle moved;
    for (int i = 0; i < 3; ++i)
    {
        moved[i] = triangle[i] - middle;
        isNear = isNear && std::abs(moved[i].x) <= far && std::abs(moved[i].y) <= far;
    }
    if (isNear)
    {
        for (const glm::dvec2& corner : moved)
            push(corner);
        return;
    }
    // Floats are too coarse far away: what is left to the driver lies near the piece.
    std::vector<glm::dvec2> polygon(moved.begin(), moved.end());
    for (int axis = 0; axis < 2; ++axis)
    {
        clipPolygon(polygon, axis, -far, 1.0);
        clipPolygon(polygon, axis, far, -1.0);
    }
    for (std::size_t i = 2; i < polygon.size(); ++i)
    {
        push(polygon[0]);
        push(polygon[i - 1]);
        push(polygon[i]);
    }
}

void MaskPiece::flush(GLint size)
{
    if (_waiting.empty())
        return;
    _gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, _framebuffer);
    glViewport(0, 0, _width, _height);
    _gl.glUniform2f(size, float(_width), float(_height));
    _gl.glBindBuffer(GL_ARRAY_BUFFER_ARB, _vertices);
    _gl.glBufferData(GL_ARRAY_BUFFER_ARB, GLsizeiptr(_waiting.size() * sizeof(float)),
                     _waiting.data(), GL_STREAM_DRAW_ARB);
    _gl.glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    _gl.glEnableVertexAttribArray(0);
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(_waiting.size() / 2));
    _gl.glDisableVertexAttribArray(0);
    _gl.glBindBuffer(GL_ARRAY_BUFFER_ARB, 0);
    _waiting.clear();
}

void MaskPiece::read(Pixels& mask) const
{
    _gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, _framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ROW_LENGTH, mask.width);
    glReadPixels(0, 0, _width, _height, GL_RED, GL_UNSIGNED_BYTE, mask.row(_bottom) + _left);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        throw MaskError("OpenGL could not draw a mask: error " + std::to_string(error) +
                        "; ask for smaller pieces");
}

MaskPieces::MaskPieces(const osg::GLExtensions& gl, int width, int height, int largestSide,
                       GLint size)
    : _width(width), _height(height), _side(largestSide),
      _columns((width + largestSide - 1) / largestSide),
      _rows((height + largestSide - 1) / largestSide), _size(size)
{
    for (int y = 0; y < _rows; ++y)
        for (int x = 0; x < _columns; ++x)
            _pieces.push_back(std::make_unique<MaskPiece>(gl, x * _side, y * _side,
                                                          std::min(_side, width - x * _side),
                                                          std::min(_side, height - y * _side)));
}

void MaskPieces::add(const PixelTriangle& triangle, double reach)
{
    const glm::dvec2 low = glm::min(glm::min(triangle[0], triangle[1]), triangle[2]) - reach;
    const glm::dvec2 high = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]) + reach;
    if (!(high.x >= 0.0 && high.y >= 0.0 && low.x <= _width && low.y <= _height))
        return;
    const auto pieceOf = [&](double pixel, int pieces)
    { return int(std::clamp(pixel / _side, 0.0, pieces - 1.0)); };
    for (int y = pieceOf(low.y, _rows); y <= pieceOf(high.y, _rows); ++y)
    {
        for (int x = pieceOf(low.x, _columns); x <= pieceOf(high.x, _columns); ++x)
        {
            MaskPiece& piece = *_pieces[std::size_t(y) * std::size_t(_columns) + std::size_t(x)];
            piece.add(triangle);
            if (piece.isFull())
                piece.flush(_size);
        }
    }
}

void MaskPieces::read(Pixels& mask)
{
    for (const std::unique_ptr<MaskPiece>& piece : _pieces)
    {
        piece->flush(_size);
        piece->read(mask);
    }
}

} // namespace osgPagedTexture
