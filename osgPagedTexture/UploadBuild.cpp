// SPDX-License-Identifier: MIT
// How a texture comes into being: its memory, then its rows, then its place.
#include <osgPagedTexture/UploadQueue.h>

#include <osgPagedTexture/ContextTextures.h>
#include <osgPagedTexture/GlFormat.h>
#include <osgPagedTexture/ThreadClock.h>
#include <osgPagedTexture/UnpackScope.h>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

constexpr GLenum StreamDraw = 0x88E0;

int blockRows(BlockFormat format, int height)
{
    return isBlocked(format) ? (height + 3) / 4 : height;
}

} // namespace

/// Does what is next. Returns false where that is nothing, or has to wait for another frame.
bool UploadQueue::step(const Share& share)
{
    if (!_doomed.empty())
        return deleteOne(share);
    if (!_build && _coarser.empty() && _jobs.empty()) // there are no previews without jobs
        return false;
    if (!_build && !start(share.limits.bytes))
        return true;
    if (!_build->texture.name)
        return makeMemory(share);
    if (fill(share.piece))
        finish();
    return true;
}

/// Takes the next job. Returns false where it does not fit: what the texture replaces does not
/// count, since that goes when the new one is complete.
bool UploadQueue::start(std::uint64_t limit)
{
    std::deque<UploadJob>& jobs = !_coarser.empty()    ? _coarser
                                  : !_previews.empty() ? _previews
                                                       : _jobs;
    auto build = std::make_unique<Build>();
    build->isPreview = &jobs == &_previews;
    build->job = std::move(jobs.front());
    jobs.pop_front();
    const UploadJob& job = build->job;
    const Texture* before = find(job.texture);
    TextureSize& size = build->texture.size;
    size = job.chain ? TextureSize{job.chain->format, job.chain->width, job.chain->height,
                                   std::max(job.level, job.chain->firstLevel)}
                     : before->size;
    if (!job.chain)
        size.level = job.level;
    else if (_bytes + size.bytes() - (before ? before->size.bytes() : 0) > limit)
    {
        if (!build->isPreview) // its whole says so
            tell({job.texture, before ? before->size.level : UploadEvent::Gone});
        drop(build->job);
        return false;
    }
    build->level = size.level;
    _bytes += size.bytes();
    _build = std::move(build);
    std::lock_guard<std::mutex> lock(_mutex);
    _statistics.peakBytes = std::max(_statistics.peakBytes, _bytes);
    return true;
}

/// Returns false while a StorageThread makes it, or where the next frame has more time for it.
bool UploadQueue::makeMemory(const Share& share)
{
    Texture& texture = _build->texture;
    StorageThread* thread = nullptr;
    const auto findThread = [&]
    {
        return (thread = osg::get<ContextTextures>(_contextID)->getStorageThread()) &&
               thread->isUsable();
    };
    const double cost = _costToMake.of(texture.size.bytes());
    if (_build->ticket && findThread())
    {
        const auto made = thread->take(_build->ticket);
        if (!made)
            return false;
        texture.name = made->name;
        _costToMake.learn(texture.size.bytes(), made->milliseconds);
        std::lock_guard<std::mutex> lock(_mutex);
        ++_statistics.madeAside;
    }
    else if (cost > 0.5 * share.limits.milliseconds && findThread())
    {
        _build->ticket = thread->order(texture.size);
        return false;
    }
    else if (cost > share.left && !share.isFirst)
        return false;
    else
    {
        const double start = threadMilliseconds();
        texture.name = makeStorage(*_gl, texture.size);
        _costToMake.learn(texture.size.bytes(), threadMilliseconds() - start);
    }
    _build->ticket = 0;
    if (!texture.name)
        refuse();
    return true;
}

/// GL has no memory for it.
void UploadQueue::refuse()
{
    const UploadJob job = _build->job;
    const int level = _build->texture.size.level;
    const bool isPreview = _build->isPreview;
    cancelBuild();
    if (isPreview)
        return; // Its whole is refused, too, or is there soon.
    if (job.chain)
        tell({job.texture, level, true});
    else
        evictNow(job.texture);
}

void UploadQueue::cancelBuild()
{
    if (!_build)
        return;
    if (_build->ticket)
        osg::get<ContextTextures>(_contextID)->getStorageThread()->cancel(_build->ticket);
    if (_build->texture.name)
        doom(_build->texture);
    else
        _bytes -= _build->texture.size.bytes();
    drop(_build->job);
    _build.reset();
}

/// About `piece` bytes. Returns whether the texture is complete.
bool UploadQueue::fill(std::uint64_t piece)
{
    const TextureSize& size = _build->texture.size;
    glBindTexture(GL_TEXTURE_2D, _build->texture.name);
    std::uint64_t done = 0;
    for (; _build->level < size.level + size.levels(); ++_build->level, _build->row = 0)
    {
        const int width = levelSide(size.width, _build->level);
        const int height = levelSide(size.height, _build->level);
        const std::uint64_t rowBytes = levelBytes(size.format, width, 1);
        const int left = blockRows(size.format, height) - _build->row;
        const int rows = int(std::clamp<std::uint64_t>((piece - std::min(piece, done)) / rowBytes,
                                                       done ? 0 : 1, std::uint64_t(left)));
        if (rows == 0)
            return false;
        if (_build->job.chain)
            uploadRows(rows);
        else
            copyRows(rows);
        done += rowBytes * rows;
        _build->row += rows;
        if (rows < left)
            return false;
    }
    return true;
}

void UploadQueue::uploadRows(int rows)
{
    const TextureSize& size = _build->texture.size;
    const MipChain& chain = *_build->job.chain;
    const GlFormat format = glFormatOf(size.format);
    const int width = levelSide(size.width, _build->level);
    const int height = levelSide(size.height, _build->level);
    const std::size_t rowBytes = std::size_t(levelBytes(size.format, width, 1));
    const int tall = isBlocked(size.format) ? 4 : 1;
    const int y = _build->row * tall;
    const int h = std::min(rows * tall, height - y);
    const GLsizei bytes = GLsizei(rowBytes * rows);
    const std::uint8_t* from = chain.levels[std::size_t(_build->level - chain.firstLevel)].data();
    _gl->glBufferData(UnpackScope::Buffer, bytes, from + rowBytes * _build->row, StreamDraw);
    if (isBlocked(size.format))
        _gl->glCompressedTexSubImage2D(GL_TEXTURE_2D, _build->level - size.level, 0, y, width, h,
                                       format.internal, bytes, nullptr);
    else
        glTexSubImage2D(GL_TEXTURE_2D, _build->level - size.level, 0, y, width, h, format.layout,
                        GL_UNSIGNED_BYTE, nullptr);
    _uploaded += std::uint64_t(bytes);
}

/// From the texture that is there, which is finer.
void UploadQueue::copyRows(int rows)
{
    const Texture& to = _build->texture;
    const Texture& from = *find(_build->job.texture);
    const int tall = isBlocked(to.size.format) ? 4 : 1;
    const int y = _build->row * tall;
    const int h = std::min(rows * tall, levelSide(to.size.height, _build->level) - y);
    _copyImage(from.name, GL_TEXTURE_2D, _build->level - from.size.level, 0, y, 0, to.name,
               GL_TEXTURE_2D, _build->level - to.size.level, 0, y, 0,
               levelSide(to.size.width, _build->level), h, 1);
}

void UploadQueue::finish()
{
    Texture& place = _textures[_build->job.texture];
    doom(place);
    place = _build->texture;
    tell({_build->job.texture, place.size.level, false, _build->isPreview});
    drop(_build->job);
    _build.reset();
}

} // namespace osgPagedTexture
