// SPDX-License-Identifier: MIT
#pragma once

#include <osg/ContextData>
#include <osg/GLObjects>

#include <mutex>
#include <vector>

namespace osgPagedTexture
{

/// GL names of a context that are to be deleted, and whether those before are still any good: OSG
/// tells it when the context goes.
class ContextTextures : public osg::GraphicsObjectManager
{
public:
    explicit ContextTextures(unsigned int contextID);

    /// Any thread; they go with the next frame.
    void doom(std::vector<GLuint> textures, std::vector<GLuint> buffers);

    /// Changes when all names of the context have become void.
    unsigned int getGeneration() const { return _generation; }

    /// In the draw thread.
    void flush();

    void flushDeletedGLObjects(double, double&) override { flush(); }
    void flushAllDeletedGLObjects() override { flush(); }
    void deleteAllGLObjects() override;
    void discardAllGLObjects() override;

private:
    std::mutex _mutex;
    std::vector<GLuint> _textures;
    std::vector<GLuint> _buffers;
    unsigned int _generation = 0;
};

} // namespace osgPagedTexture
