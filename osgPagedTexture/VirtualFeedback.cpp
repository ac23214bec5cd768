// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualFeedback.h>

#include <osg/FrameBufferObject>
#include <osg/GLExtensions>

#include <algorithm>
#include <unordered_map>

namespace osgPagedTexture
{

namespace
{

constexpr int channels = 4;
/// Pictures that are under way at once: a GPU that is farther behind gets no more to do.
constexpr std::size_t mostWays = 3;
/// Frames after which a picture has surely come, where GL can't say it.
constexpr unsigned int surelyThere = 3;

/// Neighbours mostly need the same page: only the first of a run is looked up.
std::vector<PageNeed> needsOf(const std::vector<std::uint16_t>& texels)
{
    std::unordered_map<PageKey, std::uint32_t> pixels;
    std::uint32_t* count = nullptr;
    for (std::size_t i = 0; i + channels <= texels.size(); i += channels)
    {
        const std::uint16_t* texel = texels.data() + i;
        if (i == 0 || !std::equal(texel, texel + channels, texel - channels))
            count = texel[0] == 0
                        ? nullptr
                        : &pixels[{std::uint32_t(texel[0] - 1), texel[1], texel[2], texel[3]}];
        if (count)
            ++*count;
    }
    std::vector<PageNeed> needs;
    for (const auto& [page, number] : pixels)
        needs.push_back({page, number});
    std::sort(needs.begin(), needs.end(),
              [](const PageNeed& a, const PageNeed& b) { return a.page < b.page; });
    return needs;
}

} // namespace

VirtualFeedback::VirtualFeedback(unsigned int contextID)
    : _contextID(contextID), _framebuffer(contextID)
{
}

void VirtualFeedback::makeTargets(int width, int height)
{
    using osgMultiRender::TargetTexture;
    _pages = new TargetTexture(GL_RGBA16, width, height, 0, 1);
    _depth = new TargetTexture(GL_DEPTH_COMPONENT24, width, height, 0, 1);
    _width = width;
    _height = height;
}

void VirtualFeedback::bind(osg::State& state, int width, int height)
{
    if (width != _width || height != _height)
        makeTargets(width, height);
    // Made before the framebuffer is bound: their first use binds textures.
    _framebuffer.bind(state, 1);
    _pages->attach(state, GL_COLOR_ATTACHMENT0_EXT, 0);
    _depth->attach(state, GL_DEPTH_ATTACHMENT_EXT, 0);
    glReadBuffer(GL_COLOR_ATTACHMENT0_EXT);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClearDepth(1.0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

bool VirtualFeedback::start(osg::State& state)
{
    if (_ways.size() >= mostWays)
        return false;
    const auto* gl = state.get<osg::GLExtensions>();
    Way way;
    way.width = _width;
    way.height = _height;
    if (!_free.empty())
    {
        way.buffer = _free.back();
        _free.pop_back();
    }
    const auto bytes = unsigned(_width * _height * channels) * unsigned(sizeof(std::uint16_t));
    if (!way.buffer || way.buffer->getDataSize() != bytes)
    {
        way.buffer = new osg::PixelDataBufferObject;
        way.buffer->setDataSize(bytes);
    }
    way.buffer->bindBufferInWriteMode(state);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glReadPixels(0, 0, _width, _height, GL_RGBA, GL_UNSIGNED_SHORT, nullptr);
    way.buffer->unbindBuffer(_contextID);
    if (gl->glFenceSync)
        way.fence = gl->glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    _ways.push_back(std::move(way));
    return true;
}

bool VirtualFeedback::take(osg::State& state, std::vector<PageNeed>& needs)
{
    if (_ways.empty())
        return false;
    const auto* gl = state.get<osg::GLExtensions>();
    Way& way = _ways.front();
    if (!way.fence && way.age++ < surelyThere)
        return false;
    if (way.fence &&
        gl->glClientWaitSync(way.fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0) == GL_TIMEOUT_EXPIRED)
        return false;
    if (way.fence)
        gl->glDeleteSync(way.fence);
    std::vector<std::uint16_t> texels(std::size_t(way.width) * std::size_t(way.height) * channels);
    // Not by the buffer's own functions, which allocate it anew.
    if (const osg::GLBufferObject* buffer = way.buffer->getGLBufferObject(_contextID))
    {
        gl->glBindBuffer(GL_PIXEL_PACK_BUFFER_ARB, buffer->getGLObjectID());
        gl->glGetBufferSubData(GL_PIXEL_PACK_BUFFER_ARB, 0,
                               GLsizeiptr(texels.size() * sizeof(std::uint16_t)), texels.data());
        gl->glBindBuffer(GL_PIXEL_PACK_BUFFER_ARB, 0);
    }
    _free.push_back(way.buffer);
    _ways.pop_front();
    needs = needsOf(texels);
    return true;
}

std::vector<PageNeed> VirtualFeedback::readNow() const
{
    std::vector<std::uint16_t> texels(std::size_t(_width) * std::size_t(_height) * channels);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glReadPixels(0, 0, _width, _height, GL_RGBA, GL_UNSIGNED_SHORT, texels.data());
    return needsOf(texels);
}

void VirtualFeedback::releaseGLObjects(osg::State* state)
{
    // Fences go with their context.
    _ways.clear();
    _free.clear();
    _framebuffer.releaseGLObjects(state);
    _pages = _depth = nullptr;
    _width = _height = 0;
}

} // namespace osgPagedTexture
