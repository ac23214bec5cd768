// SPDX-License-Identifier: MIT
#include <osgPagedTexture/UploadQueue.h>

#include <osgPagedTexture/ContextPace.h>
#include <osgPagedTexture/ContextTextures.h>
#include <osgPagedTexture/ThreadClock.h>
#include <osgPagedTexture/UnpackScope.h>

#include <osg/GLExtensions>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

constexpr GLenum MaxTextureSize = 0x0D33;

} // namespace

UploadQueue::UploadQueue(unsigned int contextID) : _contextID(contextID) {}

UploadQueue::~UploadQueue()
{
    if (!isOpen())
        return;
    cancelBuild();
    std::vector<GLuint> textures = _plain.getNames();
    for (const auto& each : _textures)
        textures.push_back(each.second.name);
    for (const Texture& texture : _doomed)
        textures.push_back(texture.name);
    osg::get<ContextTextures>(_contextID)
        ->doom(textures, _buffer ? std::vector<GLuint>{_buffer} : std::vector<GLuint>());
}

void UploadQueue::push(UploadJob job)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _ordered.push_back(std::move(job));
}

void UploadQueue::evict(unsigned int texture)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _ordered.push_back({texture, UploadEvent::Gone, nullptr});
}

bool UploadQueue::isOpen() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _validity && *_validity;
}

ContextAbilities UploadQueue::getAbilities() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _abilities;
}

std::vector<UploadEvent> UploadQueue::takeEvents()
{
    std::lock_guard<std::mutex> lock(_mutex);
    return std::exchange(_events, {});
}

UploadStatistics UploadQueue::getStatistics() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    UploadStatistics statistics = _statistics;
    for (const UploadJob& job : _ordered)
    {
        ++statistics.waiting;
        statistics.waitingBytes += job.chain ? job.chain->bytes() : 0;
    }
    return statistics;
}

void UploadQueue::tell(const UploadEvent& event)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _events.push_back(event);
}

/// The context is a new one, or its names are void.
void UploadQueue::reset()
{
    for (const auto& each : _textures)
        tell({each.first});
    if (_build)
        tell({_build->job.texture});
    for (const std::deque<UploadJob>* jobs : {&_coarser, &_jobs})
        for (const UploadJob& job : *jobs)
            tell({job.texture});
    _textures.clear();
    _plain.forget();
    _buffer = 0;
    _coarser.clear();
    _previews.clear();
    _jobs.clear();
    _doomed.clear();
    _build.reset();
    _bytes = 0;
}

void UploadQueue::begin(osg::State& state)
{
    ContextTextures* names = state.get<ContextTextures>();
    if (!isOpen())
    {
        reset();
        _gl = state.get<osg::GLExtensions>();
        osg::setGLExtensionFuncPtr(
            _copyImage, "glCopyImageSubData", "glCopyImageSubDataEXT",
            _gl->glVersion >= 4.3f || osg::isGLExtensionSupported(_contextID, "GL_ARB_copy_image"));
        GLint side = 0;
        glGetIntegerv(MaxTextureSize, &side);
        std::lock_guard<std::mutex> lock(_mutex);
        _validity = names->getValidity();
        _abilities.known = true;
        _abilities.s3tc =
            osg::isGLExtensionSupported(_contextID, "GL_EXT_texture_compression_s3tc");
        _abilities.rgtc = _gl->isTextureCompressionRGTCSupported || _gl->glVersion >= 3.0f;
        _abilities.bptc =
            osg::isGLExtensionSupported(_contextID, "GL_ARB_texture_compression_bptc");
        _abilities.copies = _copyImage != nullptr;
        _abilities.maxSide = side;
    }
    names->flush();
}

/// What other threads have asked for since the last run: the newest order for a texture counts.
void UploadQueue::takeOrders()
{
    std::vector<UploadJob> ordered;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        ordered.swap(_ordered);
    }
    std::unordered_map<unsigned int, const UploadJob*> newest;
    for (const UploadJob& job : ordered)
        newest[job.texture] = &job;
    const auto isReplaced = [&](const UploadJob& job) { return newest.count(job.texture) > 0; };
    for (std::deque<UploadJob>* jobs : {&_coarser, &_previews, &_jobs})
    {
        for (UploadJob& job : *jobs)
            if (isReplaced(job))
                drop(job);
        jobs->erase(std::remove_if(jobs->begin(), jobs->end(), isReplaced), jobs->end());
    }
    if (_build && isReplaced(_build->job))
        cancelBuild();
    for (UploadJob& job : ordered)
        if (newest[job.texture] == &job)
            take(std::move(job));
        else
            drop(job);
}

void UploadQueue::take(UploadJob job)
{
    const Texture* there = find(job.texture);
    if (job.level == UploadEvent::Gone)
        evictNow(job.texture);
    else if (job.chain)
    {
        if (!there && job.preview > std::max(job.level, job.chain->firstLevel))
            _previews.push_back({job.texture, job.preview, job.chain});
        _jobs.push_back(std::move(job));
    }
    else if (there && there->size.level < job.level && _copyImage)
        _coarser.push_back(job);
    else
        tell({job.texture, there ? there->size.level : UploadEvent::Gone});
}

void UploadQueue::evictNow(unsigned int texture)
{
    const auto found = _textures.find(texture);
    if (found != _textures.end())
    {
        doom(found->second);
        _textures.erase(found);
    }
    tell({texture});
}

/// The memory of a large chain is given back in milliseconds, too.
void UploadQueue::drop(UploadJob& job)
{
    if (!job.chain || job.chain->bytes() < ByteCost::Small)
        return;
    if (StorageThread* thread = osg::get<ContextTextures>(_contextID)->getStorageThread())
        thread->drop(std::move(job.chain));
}

/// A frame has time for some of them: the memory of a large one is given back in milliseconds.
void UploadQueue::doom(const Texture& texture)
{
    if (texture.name)
        _doomed.push_back(texture);
}

/// Returns false where the next frame has more time for it.
bool UploadQueue::deleteOne(const Share& share)
{
    const Texture& texture = _doomed.front();
    const std::uint64_t bytes = texture.size.bytes();
    if (_costToDelete.of(bytes) > share.left && !share.isFirst)
        return false;
    const double start = threadMilliseconds();
    glDeleteTextures(1, &texture.name);
    _costToDelete.learn(bytes, threadMilliseconds() - start);
    _bytes -= bytes;
    _doomed.pop_front();
    return true;
}

bool UploadQueue::run(osg::State& state, const UploadLimits& limits)
{
    begin(state);
    const UnpackScope scope(state);
    const std::uint64_t uploaded = _uploaded;
    UploadPace& pace = ContextPace::of(state).begin(state, limits.milliseconds);
    const double spent = pace.getSpent();
    double start = threadMilliseconds();
    takeOrders();
    if (!_buffer)
        _gl->glGenBuffers(1, &_buffer);
    _gl->glBindBuffer(UnpackScope::Buffer, _buffer);
    bool goesOn = true;
    for (int steps = 0; goesOn; ++steps)
    {
        const std::uint64_t had = _uploaded;
        const Share share{limits, pace.piece(), limits.milliseconds - pace.getSpent(), steps == 0};
        goesOn = (share.left > 0.0 || steps == 0) && share.piece > 0 && step(share);
        const double now = threadMilliseconds();
        pace.took(_uploaded - had, now - start); // No bytes: says nothing about the rate.
        start = now;
    }
    publish(uploaded, pace.getSpent() - spent);
    std::lock_guard<std::mutex> lock(_mutex);
    return _statistics.waiting > 0 || !_ordered.empty();
}

void UploadQueue::publish(std::uint64_t uploadedBefore, double milliseconds)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _statistics.bytes = _bytes;
    _statistics.uploaded = _uploaded;
    _statistics.lastUploaded = _uploaded - uploadedBefore;
    _statistics.lastMilliseconds = milliseconds;
    _statistics.waiting =
        _coarser.size() + _previews.size() + _jobs.size() + _doomed.size() + (_build ? 1 : 0);
    _statistics.waitingBytes = _build && _build->job.chain ? _build->job.chain->bytes() : 0;
    for (const UploadJob& job : _jobs)
        _statistics.waitingBytes += job.chain->bytes();
}

const UploadQueue::Texture* UploadQueue::find(unsigned int texture) const
{
    const auto found = _textures.find(texture);
    return found == _textures.end() ? nullptr : &found->second;
}

} // namespace osgPagedTexture
