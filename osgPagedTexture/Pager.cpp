// SPDX-License-Identifier: MIT
#include <osgPagedTexture/Pager.h>

#include <osgPagedTexture/ChainRecipes.h>
#include <osgPagedTexture/ThreadClock.h>

#include <algorithm>

namespace osgPagedTexture
{

Pager::Pager(const PagedSettings& settings)
    : _showsLevels(settings.show == PagedShow::Levels), _waits(settings.wait), _settings(settings)
{
}

Pager::~Pager() = default;

void Pager::setSettings(const PagedSettings& settings)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _settings = settings;
    _showsLevels = settings.show == PagedShow::Levels;
    _waits = settings.wait;
}

PagedSettings Pager::getSettings() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _settings;
}

void Pager::findOnePixel(Entry& entry)
{
    const PagedImage& image = entry.image;
    entry.onePixel = levelOnOnePixel({image.width, image.height, image.anisotropy, image.lodBias});
}

unsigned int Pager::add(const PagedImage& image)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto [found, isNew] =
        _byFile.insert({{image.file, image.use}, unsigned(_entries.size())});
    if (!isNew)
    {
        Entry& entry = _entries[found->second];
        ++entry.users;
        entry.image.anisotropy = std::max(entry.image.anisotropy, image.anisotropy);
        entry.image.lodBias = std::min(entry.image.lodBias, image.lodBias);
        findOnePixel(entry);
        return found->second;
    }
    _entries.emplace_back();
    _entries.back().image = image;
    _entries.back().state->translucent = image.translucent;
    _hasNew = true;
    for (auto& each : _contexts)
    {
        each.second.resident.push_back(UploadEvent::Gone);
        each.second.queued.push_back(None);
    }
    return found->second;
}

void Pager::remove(unsigned int texture)
{
    std::lock_guard<std::mutex> lock(_mutex);
    Entry& entry = _entries[texture];
    if (--entry.users > 0)
        return;
    _byFile.erase({entry.image.file, entry.image.use});
    cancel(texture);
    countWhole(entry);
    stir(texture);
    if (entry.isWatched)
        _watch->remove(entry.image.file);
    for (auto& each : _contexts)
        each.second.queue->evict(texture);
}

void Pager::report(const std::vector<PagedDemand>& demands, unsigned int frame)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _reported = frame;
    for (const PagedDemand& demand : demands)
    {
        Entry& entry = _entries[demand.texture];
        entry.pixels = std::max(entry.pixels, demand.pixels);
        entry.soonPixels = std::max(entry.soonPixels, demand.soonPixels);
        wake(demand.texture);
        if (demand.pixels > 0.0)
            entry.lastUsed = frame;
    }
}

void Pager::advance(unsigned int frame)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (frame == _frame)
        return;
    _frame = frame;
    advanceLocked();
    rest();
}

void Pager::advanceLocked()
{
    meetContexts();
    if (_entries.empty() || !learnAbilities())
        return;
    const double start = threadMilliseconds();
    takeEvents();
    takeResults();
    takeChanges();
    if (_settings.freeze)
        return;
    meetAwake();
    plan();
    carryOut();
    _planMilliseconds = threadMilliseconds() - start;
}

/// Those that are closed have nothing any more, and nothing is loaded for them.
void Pager::meetContexts()
{
    std::lock_guard<std::mutex> lock(_queueMutex);
    for (const auto& each : _queues)
    {
        if (!each.second->isOpen())
        {
            _contexts.erase(each.first);
            continue;
        }
        Context& context = _contexts[each.first];
        if (context.queue)
            continue;
        context.queue = each.second;
        context.resident.assign(_entries.size(), UploadEvent::Gone);
        context.queued.assign(_entries.size(), None);
        for (Entry& entry : _entries)
            entry.isCalm = false;
    }
}

/// Waits for the first context; what all of them can do counts.
bool Pager::learnAbilities()
{
    if (_contexts.empty())
        return false;
    ContextAbilities all;
    for (const auto& each : _contexts)
    {
        const ContextAbilities one = each.second.queue->getAbilities();
        if (!one.known)
            return _abilities.known;
        if (!all.known)
            all = one;
        all.s3tc = all.s3tc && one.s3tc;
        all.rgtc = all.rgtc && one.rgtc;
        all.bptc = all.bptc && one.bptc;
        all.copies = all.copies && one.copies;
        all.maxSide = std::min(all.maxSide, one.maxSide);
    }
    _abilities = all;
    for (Entry& entry : _entries)
    {
        if (!_hasNew)
            break;
        if (!entry.bytes)
            setFormat(entry);
    }
    _hasNew = false;
    return true;
}

void Pager::setFormat(Entry& entry)
{
    const PagedImage& image = entry.image;
    entry.format =
        formatFor(image.channels, image.translucent, image.use, _settings.compression, _abilities);
    std::vector<std::uint64_t>& bytes = _sizes[{image.width, image.height, entry.format}];
    if (bytes.empty())
        for (int level = 0; level < levelCount(image.width, image.height); ++level)
            bytes.push_back(chainBytes(entry.format, image.width, image.height, level));
    entry.bytes = &bytes;
    findOnePixel(entry);
    entry.finest = 0;
    while (levelSide(std::max(image.width, image.height), entry.finest) > _abilities.maxSide)
        ++entry.finest;
    countWhole(entry);
}

void Pager::takeEvents()
{
    for (auto& each : _contexts)
        for (const UploadEvent& event : each.second.queue->takeEvents())
        {
            stir(event.texture);
            if (!event.isPreview)
                each.second.queued[event.texture] = None;
            if (event.isRefused)
            {
                _entries[event.texture].finest =
                    std::min(event.level + 1, int(_entries[event.texture].bytes->size()) - 1);
                countWhole(_entries[event.texture]);
            }
            else
            {
                each.second.resident[event.texture] = event.level;
                _entries[event.texture].isOld = false;
            }
        }
}

/// The finest level that all contexts have; Gone where one has nothing.
int Pager::coarsest(unsigned int texture) const
{
    int level = 0;
    for (const auto& each : _contexts)
    {
        if (each.second.resident[texture] == UploadEvent::Gone)
            return UploadEvent::Gone;
        level = std::max(level, each.second.resident[texture]);
    }
    return _contexts.empty() ? UploadEvent::Gone : level;
}

bool Pager::isAtRest() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _entries.empty() || (_abilities.known && _changing == 0 && _requests.empty());
}

std::shared_ptr<const PagedState> Pager::getState(unsigned int texture) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _entries[texture].state;
}

} // namespace osgPagedTexture
