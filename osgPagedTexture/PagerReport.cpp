// SPDX-License-Identifier: MIT
// What the pager tells of itself.
#include <osgPagedTexture/Pager.h>

#include <algorithm>

namespace osgPagedTexture
{

FrameTimes Pager::getUploadTimes() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _times;
}

FrameTimes Pager::getUploadBytes() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _bytes;
}

PagerStatistics Pager::getStatistics() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    PagerStatistics result;
    for (std::size_t i = 0; i < _entries.size(); ++i)
    {
        const Entry& entry = _entries[i];
        if (entry.users == 0)
            continue;
        ++result.textures;
        result.inView += entry.need >= 0.0 ? 1 : 0;
        result.resident += coarsest(unsigned(i)) != UploadEvent::Gone ? 1 : 0;
        result.failed += entry.failed ? 1 : 0;
        result.wholeBytes += entry.bytes ? (*entry.bytes)[0] : 0;
        if (entry.need < 0.0 || entry.failed)
            continue;
        const auto texels = [&](int level) {
            return double(levelSide(entry.image.width, level)) *
                   levelSide(entry.image.height, level);
        };
        const double needed = texels(int(entry.need) + entry.finest);
        const int there = coarsest(unsigned(i));
        result.neededTexels += needed;
        result.missingTexels +=
            std::max(0.0, needed - (there == UploadEvent::Gone ? 0.0 : texels(there)));
    }
    result.considered = _active.size();
    result.changing = _changing;
    result.isWhole = _plan.isWhole;
    result.bias = _plan.bias;
    result.plannedBytes = _plan.bytes;
    result.planMilliseconds = _planMilliseconds;
    for (const auto& each : _contexts)
    {
        const UploadStatistics one = each.second.queue->getStatistics();
        if (one.bytes >= result.upload.bytes)
            result.upload = one;
    }
    if (_loader)
        result.loader = _loader->getStatistics();
    return result;
}

std::vector<Pager::Line> Pager::getLines() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    std::vector<Line> lines;
    for (std::size_t i = 0; i < _entries.size(); ++i)
    {
        const Entry& entry = _entries[i];
        if (entry.users > 0)
            lines.push_back({entry.image.file, coarsest(unsigned(i)), entry.target, entry.need,
                             entry.failed, entry.image.width, entry.image.height, entry.image.use,
                             entry.format});
    }
    return lines;
}

} // namespace osgPagedTexture
