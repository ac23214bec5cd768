// SPDX-License-Identifier: MIT
#include <osgLabels/MapFeedback.h>

#include <osg/GLExtensions>

#include <cmath>

namespace osgLabels
{

namespace
{

/// Frames that a state is late.
constexpr std::size_t lateness = 2;

constexpr int channels = 4;

} // namespace

MapFeedback::States MapFeedback::statesOf(const std::vector<float>& texels, std::size_t count)
{
    States states(count);
    for (std::size_t i = 0; i < count; ++i)
        states[i] = {std::lround(texels[channels * i]) == 0, texels[channels * i + 1]};
    return states;
}

void MapFeedback::start(osg::State& state, Keys keys, int rowLength, int rows)
{
    const auto* gl = state.get<osg::GLExtensions>();
    Way way;
    way.keys = std::move(keys);
    if (!_free.empty())
    {
        way.buffer = _free.back();
        _free.pop_back();
    }
    const auto bytes = unsigned(rowLength * rows * channels) * unsigned(sizeof(float));
    if (!way.buffer || way.buffer->getDataSize() < bytes)
    {
        way.buffer = new osg::PixelDataBufferObject;
        way.buffer->setDataSize(bytes);
    }
    way.buffer->bindBufferInWriteMode(state);
    glReadPixels(0, 0, rowLength, rows, GL_RGBA, GL_FLOAT, nullptr);
    way.buffer->unbindBuffer(state.getContextID());
    if (gl->glFenceSync)
        way.fence = gl->glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    _ways.push_back(std::move(way));
}

bool MapFeedback::take(osg::State& state, Keys& keys, States& states)
{
    if (_ways.size() < lateness)
        return false;
    const auto* gl = state.get<osg::GLExtensions>();
    Way& way = _ways.front();
    if (way.fence)
    {
        if (gl->glClientWaitSync(way.fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0) == GL_TIMEOUT_EXPIRED)
            return false;
        gl->glDeleteSync(way.fence);
    }
    std::vector<float> texels(channels * way.keys.size());
    // Not by the buffer's own functions, which allocate it anew.
    if (const osg::GLBufferObject* buffer = way.buffer->getGLBufferObject(state.getContextID()))
    {
        gl->glBindBuffer(GL_PIXEL_PACK_BUFFER_ARB, buffer->getGLObjectID());
        gl->glGetBufferSubData(GL_PIXEL_PACK_BUFFER_ARB, 0,
                               GLsizeiptr(texels.size() * sizeof(float)), texels.data());
        gl->glBindBuffer(GL_PIXEL_PACK_BUFFER_ARB, 0);
    }
    keys = std::move(way.keys);
    states = statesOf(texels, keys.size());
    _free.push_back(way.buffer);
    _ways.pop_front();
    return true;
}

MapFeedback::States MapFeedback::readNow(std::size_t count, int rowLength, int rows)
{
    std::vector<float> texels(std::size_t(channels * rowLength * rows));
    glReadPixels(0, 0, rowLength, rows, GL_RGBA, GL_FLOAT, texels.data());
    return statesOf(texels, count);
}

void MapFeedback::drop(osg::State& state)
{
    const auto* gl = state.get<osg::GLExtensions>();
    for (const Way& way : _ways)
        if (way.fence)
            gl->glDeleteSync(way.fence);
    _ways.clear();
}

} // namespace osgLabels
