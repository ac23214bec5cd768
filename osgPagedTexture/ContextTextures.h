// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/StorageThread.h>

#include <osg/ContextData>
#include <osg/GLObjects>

#include <atomic>
#include <memory>
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

    /// True until all names of the context become void; then there is a new one.
    std::shared_ptr<const std::atomic<bool>> getValidity() const { return _validity; }

    /// In the draw thread.
    void flush();

    /// For what takes too long in a frame: in the draw thread, until the names become void. Null
    /// where no other context can share textures with this one.
    StorageThread* getStorageThread();

    void flushDeletedGLObjects(double, double&) override { flush(); }
    void flushAllDeletedGLObjects() override { flush(); }
    void deleteAllGLObjects() override;
    void discardAllGLObjects() override;

protected:
    ~ContextTextures() override;

private:
    void invalidate();

    std::mutex _mutex;
    std::vector<GLuint> _textures;
    std::vector<GLuint> _buffers;
    std::shared_ptr<std::atomic<bool>> _validity = std::make_shared<std::atomic<bool>>(true);
    std::unique_ptr<StorageThread> _storage;
    bool _hasTriedStorage = false;
};

} // namespace osgPagedTexture
