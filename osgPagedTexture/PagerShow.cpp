// SPDX-License-Identifier: MIT
// The pager in the draw thread.
#include <osgPagedTexture/Pager.h>

#include <osg/Notify>

#include <algorithm>
#include <chrono>
#include <thread>

namespace osgPagedTexture
{

namespace
{

constexpr double WaitSeconds = 120.0; ///< Of one frame for textures that never come.

constexpr std::uint32_t Opaque = 0x808080FF, Translucent = 0x80808000;

/// For each resident level: white is the finest.
constexpr std::uint32_t LevelColors[] = {0xFFFFFFFF, 0x40C040FF, 0x80D020FF, 0xE0E020FF,
                                         0xF0A020FF, 0xF06020FF, 0xE02020FF, 0xA02080FF,
                                         0x6030C0FF, 0x3050E0FF, 0x2080A0FF, 0x404040FF};
constexpr int LevelColorCount = int(sizeof LevelColors / sizeof *LevelColors);

} // namespace

/// Of what has been reported, right after it was planned.
bool Pager::isAtRestIn(unsigned int contextID) const
{
    const auto found = _contexts.find(contextID);
    if (_entries.empty())
        return true;
    if (!_abilities.known || found == _contexts.end())
        return false;
    const Context& context = found->second;
    for (std::size_t i = 0; i < _entries.size(); ++i)
    {
        const Entry& entry = _entries[i];
        const bool isDone = context.resident[i] == entry.target && context.queued[i] == None;
        if (!isDone && entry.users > 0 && !entry.failed)
            return false;
    }
    return true;
}

std::shared_ptr<UploadQueue> Pager::getQueue(unsigned int contextID)
{
    std::lock_guard<std::mutex> lock(_queueMutex);
    std::shared_ptr<UploadQueue>& queue = _queues[contextID];
    if (!queue)
        queue = std::make_shared<UploadQueue>(contextID);
    return queue;
}

Pager::Shown Pager::getShown(unsigned int texture, const PagedState& paged, osg::State& state)
{
    const std::shared_ptr<UploadQueue> queue = getQueue(state.getContextID());
    queue->begin(state);
    const UploadQueue::Texture* found = queue->find(texture);
    if (paged.failed && !found)
        return {queue->getPlain().faultName(state)};
    if (_showsLevels)
        return {queue->getPlain().nameOf(
            state,
            found ? LevelColors[std::min(found->size.level, LevelColorCount - 1)] : 0x000000FF)};
    if (found)
        return {found->name, found->size.format};
    return {queue->getPlain().nameOf(state, paged.translucent ? Translucent : Opaque)};
}

bool Pager::upload(osg::State& state)
{
    const std::shared_ptr<UploadQueue> queue = getQueue(state.getContextID());
    const PagedSettings settings = getSettings();
    queue->begin(state);
    if (settings.freeze)
        return false;
    const bool goesOn = queue->run(state, {settings.uploadMilliseconds, settings.gpuBytes()});
    const UploadStatistics statistics = queue->getStatistics();
    std::lock_guard<std::mutex> lock(_mutex);
    _times.add(statistics.lastMilliseconds);
    _bytes.add(double(statistics.lastUploaded));
    return goesOn;
}

void Pager::waitForAll(osg::State& state, unsigned int frame)
{
    const std::shared_ptr<UploadQueue> queue = getQueue(state.getContextID());
    queue->begin(state);
    {
        std::lock_guard<std::mutex> lock(_mutex);
        // Objects are compiled before the first cull, too, when nothing is known to be in view.
        if (_waited == frame || _reported != frame || _settings.freeze)
            return;
        _waited = frame;
    }
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(WaitSeconds);
    while (std::chrono::steady_clock::now() < end)
    {
        {
            std::lock_guard<std::mutex> lock(_mutex);
            advanceLocked();
            if (isAtRestIn(state.getContextID()))
                return;
        }
        if (!queue->run(state, {1e9, getSettings().gpuBytes()}))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    OSG_WARN << "osgPagedTexture: textures did not come within " << WaitSeconds
             << " seconds; this frame is drawn without" << std::endl;
}

} // namespace osgPagedTexture
