// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ContextTextures.h>

#include <osg/GLExtensions>

namespace osgPagedTexture
{

ContextTextures::ContextTextures(unsigned int contextID)
    : osg::GraphicsObjectManager("osgPagedTexture::ContextTextures", contextID)
{
}

ContextTextures::~ContextTextures()
{
    *_validity = false;
}

void ContextTextures::doom(std::vector<GLuint> textures, std::vector<GLuint> buffers)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _textures.insert(_textures.end(), textures.begin(), textures.end());
    _buffers.insert(_buffers.end(), buffers.begin(), buffers.end());
}

void ContextTextures::flush()
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_textures.empty())
        glDeleteTextures(GLsizei(_textures.size()), _textures.data());
    if (osg::GLExtensions* gl = osg::GLExtensions::Get(_contextID, true); !_buffers.empty() && gl)
        gl->glDeleteBuffers(GLsizei(_buffers.size()), _buffers.data());
    _textures.clear();
    _buffers.clear();
}

StorageThread* ContextTextures::getStorageThread()
{
    if (!_hasTriedStorage)
        if (std::unique_ptr<SharedContext> context = SharedContext::create())
            _storage = std::make_unique<StorageThread>(std::move(context),
                                                       osg::GLExtensions::Get(_contextID, true));
    _hasTriedStorage = true;
    return _storage.get();
}

void ContextTextures::deleteAllGLObjects()
{
    flush();
    invalidate();
}

void ContextTextures::discardAllGLObjects()
{
    std::lock_guard<std::mutex> lock(_mutex);
    _textures.clear();
    _buffers.clear();
    invalidate();
}

void ContextTextures::invalidate()
{
    _storage.reset();
    _hasTriedStorage = false;
    *_validity = false;
    _validity = std::make_shared<std::atomic<bool>>(true);
}

} // namespace osgPagedTexture
