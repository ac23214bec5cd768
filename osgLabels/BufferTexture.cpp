// SPDX-License-Identifier: MIT
#include <osgLabels/BufferTexture.h>

#include <osgLabels/UnpackState.h>

#include <osg/ContextData>
#include <osg/GLExtensions>
#include <osg/GLObjects>
#include <osg/State>

#include <algorithm>

namespace osgLabels
{

namespace
{

constexpr GLenum textureBuffer = 0x8C2A, texture2DArray = 0x8C1A, maxTextureBufferSize = 0x8C2B,
                 copyReadBuffer = 0x8F36, copyWriteBuffer = 0x8F37;

/// 2^32 bits of texts in words: more is never asked for.
constexpr GLint neededTexels = 1 << 27;

constexpr std::size_t pageTexels = std::size_t(BufferTexture::PageSize) * BufferTexture::PageSize;

/// Deletes buffers when their context is current.
class BufferDeleter : public osg::GLObjectManager
{
public:
    explicit BufferDeleter(unsigned int contextID)
        : osg::GLObjectManager("osgLabels::BufferDeleter", contextID)
    {
    }
    void deleteGLObject(GLuint id) override
    {
        osg::get<osg::GLExtensions>(_contextID)->glDeleteBuffers(1, &id);
    }
};

GLenum internalFormatOf(unsigned int words)
{
    return words == 4 ? GL_RGBA32UI_EXT : words == 2 ? GL_RG32UI : GL_R32UI;
}

GLenum formatOf(unsigned int words)
{
    return words == 4 ? GL_RGBA_INTEGER_EXT : words == 2 ? GL_RG_INTEGER : GL_RED_INTEGER_EXT;
}

} // namespace

BufferTexture::BufferTexture(unsigned int contextID, unsigned int wordsPerTexel, bool isPaged)
    : ContentTexture(internalFormatOf(wordsPerTexel), NEAREST), _contextID(contextID),
      _wordsPerTexel(wordsPerTexel), _isPaged(isPaged)
{
}

BufferTexture::BufferTexture(const BufferTexture& other, const osg::CopyOp& copyop)
    : osgMultiRender::ContentTexture(other, copyop), _contextID(other._contextID),
      _wordsPerTexel(other._wordsPerTexel), _isPaged(other._isPaged)
{
}

BufferTexture::~BufferTexture()
{
    if (_buffer)
        osg::get<BufferDeleter>(_contextID)->scheduleGLObjectForDeletion(_buffer);
}

bool BufferTexture::needsPages(osg::State& state)
{
    (void)state;
    GLint texels = 0;
    glGetIntegerv(maxTextureBufferSize, &texels);
    return texels < neededTexels;
}

GLenum BufferTexture::getTextureTarget() const
{
    return _isPaged ? texture2DArray : textureBuffer;
}

void BufferTexture::apply(osg::State& state) const
{
    if (TextureObject* object = getTextureObject(state.getContextID()))
        object->bind();
    else
        glBindTexture(getTextureTarget(), 0);
}

void BufferTexture::bind(osg::State& state) const
{
    state.setActiveTextureUnit(0);
    apply(state);
    state.haveAppliedTextureAttribute(0, this);
}

bool BufferTexture::resize(osg::State& state, std::size_t bytes)
{
    if (bytes <= _capacity && getTextureObject(_contextID))
        return true;
    // Little in reserve: the table is large, and copying it on the GPU is cheap.
    const std::size_t page = 1 << 12;
    std::size_t capacity = _capacity ? bytes + bytes / 32 : bytes;
    capacity = std::max(page, (capacity + page - 1) / page * page);
    if (!_isPaged)
        return resizeBuffer(state, capacity);
    resizePages(state, capacity);
    return false;
}

bool BufferTexture::resizeBuffer(osg::State& state, std::size_t bytes)
{
    const auto* gl = state.get<osg::GLExtensions>();
    GLuint buffer = 0;
    gl->glGenBuffers(1, &buffer);
    gl->glBindBuffer(copyWriteBuffer, buffer);
    gl->glBufferData(copyWriteBuffer, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_DRAW);
    bool isKept = false;
    void(GL_APIENTRY * copy)(GLenum, GLenum, GLintptr, GLintptr, GLsizeiptr) = nullptr;
    if (_buffer && osg::setGLExtensionFuncPtr(copy, "glCopyBufferSubData"))
    {
        gl->glBindBuffer(copyReadBuffer, _buffer);
        copy(copyReadBuffer, copyWriteBuffer, 0, 0, static_cast<GLsizeiptr>(_capacity));
        gl->glBindBuffer(copyReadBuffer, 0);
        isKept = true;
    }
    gl->glBindBuffer(copyWriteBuffer, 0);
    if (_buffer)
        gl->glDeleteBuffers(1, &_buffer);
    _buffer = buffer;
    _capacity = bytes;
    if (!getTextureObject(_contextID))
        generateAndAssignTextureObject(_contextID, textureBuffer);
    bind(state);
    gl->glTexBuffer(textureBuffer, internalFormatOf(_wordsPerTexel), _buffer);
    getTextureObject(_contextID)->setAllocated(true);
    return isKept;
}

void BufferTexture::resizePages(osg::State& state, std::size_t bytes)
{
    const auto* gl = state.get<osg::GLExtensions>();
    const std::size_t texels = (bytes / 4 + _wordsPerTexel - 1) / _wordsPerTexel;
    const int layers = static_cast<int>((texels + pageTexels - 1) / pageTexels);
    // Less than a page needs no whole one.
    const int rows = layers > 1 ? PageSize : static_cast<int>((texels + PageSize - 1) / PageSize);
    // One texture object for its life: osg::State would not bind another one in its place.
    if (!getTextureObject(_contextID))
        generateAndAssignTextureObject(_contextID, texture2DArray);
    bind(state);
    applyTexParameters(texture2DArray, state);
    const UnpackState unpack(*gl); // without a buffer that the null would be a place in
    gl->glTexImage3D(texture2DArray, 0, static_cast<GLint>(internalFormatOf(_wordsPerTexel)),
                     PageSize, rows, layers, 0, formatOf(_wordsPerTexel), GL_UNSIGNED_INT, nullptr);
    getTextureObject(_contextID)->setAllocated(true);
    _capacity = std::size_t(PageSize) * rows * layers * _wordsPerTexel * 4;
}

void BufferTexture::write(osg::State& state, std::size_t offset, const void* data,
                          std::size_t bytes)
{
    const auto* gl = state.get<osg::GLExtensions>();
    if (_isPaged)
    {
        bind(state);
        writePages(state, offset, data, bytes);
        return;
    }
    gl->glBindBuffer(copyWriteBuffer, _buffer);
    gl->glBufferSubData(copyWriteBuffer, static_cast<GLintptr>(offset),
                        static_cast<GLsizeiptr>(bytes), data);
    gl->glBindBuffer(copyWriteBuffer, 0);
}

void BufferTexture::writePages(const osg::State& state, std::size_t offset, const void* data,
                               std::size_t bytes) const
{
    const auto* gl = state.get<osg::GLExtensions>();
    const UnpackState unpack(*gl);
    const std::size_t texelBytes = std::size_t(_wordsPerTexel) * 4;
    const auto* from = static_cast<const unsigned char*>(data);
    const auto size = static_cast<std::size_t>(PageSize);
    std::size_t at = offset / texelBytes;
    for (std::size_t left = bytes / texelBytes; left;)
    {
        const std::size_t x = at % size, y = at / size % size, layer = at / pageTexels;
        // A piece of a row, or as many whole rows as the page has.
        const std::size_t rows = x ? 1 : std::min(size - y, std::max<std::size_t>(1, left / size));
        const std::size_t width = std::min(left, size - x);
        gl->glTexSubImage3D(texture2DArray, 0, static_cast<GLint>(x), static_cast<GLint>(y),
                            static_cast<GLint>(layer), static_cast<GLsizei>(width),
                            static_cast<GLsizei>(rows), 1, formatOf(_wordsPerTexel),
                            GL_UNSIGNED_INT, from);
        const std::size_t count = width * rows;
        at += count;
        left -= count;
        from += count * texelBytes;
    }
}

void BufferTexture::releaseGLObjects(osg::State* state) const
{
    if (state && state->getContextID() != _contextID)
        return;
    if (_buffer)
        osg::get<BufferDeleter>(_contextID)->scheduleGLObjectForDeletion(_buffer);
    _buffer = 0;
    _capacity = 0;
    osg::Texture::releaseGLObjects(state);
}

} // namespace osgLabels
