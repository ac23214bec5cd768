// SPDX-License-Identifier: MIT
// What the pager asks of the workers and orders of the contexts, and what comes of it.
#include <osgPagedTexture/Pager.h>

#include <osgPagedTexture/ChainRecipes.h>

#include <osg/Notify>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

/// Files with new content. What is shown of them stays until the new texture is complete.
void Pager::takeChanges()
{
    if (!_watch)
        return;
    for (const ChangedFile& changed : _watch->takeChanged())
    {
        if (!changed.error.empty())
            OSG_WARN << "osgPagedTexture: " << changed.error << "; what is there of it stays"
                     << std::endl;
        for (unsigned int i = 0; changed.error.empty() && i < _entries.size(); ++i)
            if (_entries[i].users > 0 && _entries[i].image.file == changed.file)
                loadAgain(i, changed.info);
    }
}

void Pager::setFailed(Entry& entry, bool failed)
{
    entry.failed = entry.state->failed = failed;
}

void Pager::loadAgain(unsigned int texture, const ImageInfo& info)
{
    Entry& entry = _entries[texture];
    entry.image.width = info.width;
    entry.image.height = info.height;
    entry.image.channels = info.channels;
    entry.image.translucent = info.translucent;
    cancel(texture);
    setFailed(entry, false);
    setFormat(entry);
    stir(texture);
    entry.state->translucent = entry.image.translucent;
    entry.isOld = true;
    for (auto& each : _contexts)
        each.second.resident[texture] = UploadEvent::Gone;
}

/// Chains wait for their upload in memory that the workers have not: a quarter of all.
std::uint64_t Pager::backlog() const
{
    std::uint64_t bytes = 0;
    for (const auto& each : _contexts)
        bytes = std::max(bytes, each.second.queue->getStatistics().waitingBytes);
    return bytes;
}

void Pager::takeResults()
{
    if (!_loader)
        return;
    std::uint64_t waiting = backlog();
    for (int i = 0; i < MostTaken && waiting <= _settings.cpuBytes() / 4; ++i)
    {
        const std::vector<ChainResult> results = _loader->poll(1);
        if (results.empty())
            break;
        waiting += results.front().chain ? results.front().chain->bytes() : 0;
        accept(results.front());
    }
    for (const std::string& message : _loader->takeMessages())
        OSG_WARN << "osgPagedTexture: " << message << std::endl;
}

void Pager::accept(const ChainResult& result)
{
    const auto found = _requests.find(result.id);
    if (found == _requests.end())
        return;
    const std::vector<unsigned int> textures = found->second;
    if (result.state != ChainResult::State::Preview)
        _requests.erase(found);
    for (const unsigned int texture : textures)
        give(result, texture);
}

void Pager::give(const ChainResult& result, unsigned int texture)
{
    Entry& entry = _entries[texture];
    stir(texture);
    if (result.state != ChainResult::State::Preview)
    {
        entry.request = 0;
        entry.requested = None;
    }
    if (result.state != ChainResult::State::Failed)
    {
        pushToAll(texture, result.chain);
        return;
    }
    // What is there already stays.
    const int there = coarsest(texture);
    if (there == UploadEvent::Gone)
        setFailed(entry, true);
    else
        entry.finest = there;
    countWhole(entry);
}

void Pager::pushToAll(unsigned int texture, const std::shared_ptr<const MipChain>& chain)
{
    const int target = _entries[texture].target;
    if (target < 0)
        return;
    const int level = std::max(target, chain->firstLevel);
    int preview = level;
    while (levelSide(std::max(chain->width, chain->height), preview) > int(_settings.previewSide))
        ++preview;
    for (auto& each : _contexts)
    {
        Context& context = each.second;
        const int there = context.resident[texture];
        const bool isUseful =
            there == UploadEvent::Gone || (there > target ? level < there : there < target);
        if (!isUseful || (there < target && there != UploadEvent::Gone && level != target))
            continue;
        context.queued[texture] = level;
        context.queue->push({texture, level, chain, preview});
    }
}

double Pager::priority(const Entry& entry, int there) const
{
    const int levels = int(entry.bytes->size());
    const double gap = (there == UploadEvent::Gone ? levels : there) - entry.target;
    const double pixels = std::max({entry.pixels, entry.soonPixels, entry.soonBefore});
    const double size = std::isfinite(pixels) ? std::log2(1.0 + pixels) : 64.0;
    return (entry.pixels > 0.0 ? 1000.0 : 0.0) + 10.0 * gap + size;
}

void Pager::cancel(unsigned int texture)
{
    Entry& entry = _entries[texture];
    if (!entry.request)
        return;
    _loader->cancel(entry.request);
    std::vector<unsigned int>& textures = _requests[entry.request];
    textures.erase(std::remove(textures.begin(), textures.end(), texture), textures.end());
    if (textures.empty())
        _requests.erase(entry.request);
    entry.request = 0;
    entry.requested = None;
}

/// Orders what a context can do without a chain. Returns whether it needs one.
bool Pager::orderIn(Context& context, unsigned int texture, int target)
{
    const int there = context.resident[texture];
    const int next = context.queued[texture];
    const auto order = [&](int level)
    {
        if (level == UploadEvent::Gone)
            context.queue->evict(texture);
        else
            context.queue->push({texture, level, nullptr});
        context.queued[texture] = level;
    };
    const bool hasOld = _entries[texture].isOld && next == None;
    if ((next == None ? there : next) == target && !hasOld)
        return false;
    if (target == UploadEvent::Gone)
    {
        order(UploadEvent::Gone);
        return false;
    }
    const bool isTooFine = there != UploadEvent::Gone && there < target;
    if (there == target || (isTooFine && _abilities.copies))
    {
        order(target);
        return false;
    }
    // On its way, but finer than it may be by now.
    if (next != None && next != UploadEvent::Gone && next < target && !isTooFine)
        order(there);
    return true;
}

/// Brings one texture nearer to its target.
void Pager::moveTo(unsigned int texture)
{
    Entry& entry = _entries[texture];
    if (entry.users == 0 || entry.failed)
        return;
    bool needsChain = false, isChanging = false;
    for (auto& each : _contexts)
    {
        needsChain = orderIn(each.second, texture, entry.target) || needsChain;
        isChanging = isChanging || each.second.resident[texture] != entry.target ||
                     each.second.queued[texture] != None;
    }
    _changing += isChanging ? 1 : 0;
    if (needsChain)
        ask(texture);
    else
        cancel(texture);
    entry.isCalm = !isChanging && !needsChain;
}

void Pager::ask(unsigned int texture)
{
    Entry& entry = _entries[texture];
    const int there = coarsest(texture);
    // A request a level coarser is let through: what comes of it helps, and nothing is decoded in
    // vain where the need grows with each frame.
    const double urgency = priority(entry, there);
    if (entry.request && entry.requested >= entry.target && entry.requested <= entry.target + 1)
    {
        // A level is worth 10, and each change takes the loader's lock.
        if (std::abs(urgency - entry.urgency) <= 1.0)
            return;
        entry.urgency = urgency;
        _loader->setPriority(entry.request, urgency);
        return;
    }
    // The others' turn comes with the next frames.
    if (++_asked > MostAsked)
        return;
    cancel(texture);
    entry.urgency = urgency;
    const std::string key = formatName(entry.format) + "." + std::to_string(int(entry.image.use)) +
                            "." + std::to_string(int(_settings.quality));
    std::shared_ptr<const ChainRecipe>& recipe = _recipes[key];
    if (!recipe)
        recipe = recipeFor(entry.format, entry.image.use, _settings.quality);
    ChainRequest request;
    request.file = entry.image.file;
    request.recipe = recipe;
    request.firstLevel = entry.target;
    request.priority = urgency;
    request.previewSide = there == UploadEvent::Gone ? int(_settings.previewSide) : 0;
    entry.request = loader().request(request);
    entry.requested = entry.target;
    _requests[entry.request].push_back(texture);
    if (_settings.reload && !entry.isWatched)
    {
        if (!_watch)
            _watch = std::make_unique<FileWatch>();
        _watch->add(entry.image.file);
        entry.isWatched = true;
    }
}

ChainLoader& Pager::loader()
{
    if (!_loader)
    {
        ChainLoaderSettings settings;
        settings.threads = _settings.threads;
        settings.cacheFolder = cacheFolder(_settings.cache);
        settings.cacheBytes = std::uint64_t(_settings.cacheMegabytes * 1048576.0);
        settings.memoryBytes = _settings.cpuBytes() - _settings.cpuBytes() / 4;
        settings.showDegraded = _settings.degraded;
        _loader = std::make_unique<ChainLoader>(settings);
    }
    return *_loader;
}

} // namespace osgPagedTexture
