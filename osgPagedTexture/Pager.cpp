// SPDX-License-Identifier: MIT
#include <osgPagedTexture/Pager.h>

#include <osgPagedTexture/ChainRecipes.h>
#include <osgPagedTexture/ThreadClock.h>

#include <osg/Notify>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <tuple>

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

unsigned int Pager::add(const PagedImage& image)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto [found, isNew] =
        _byFile.insert({{image.file, image.isNormalMap}, unsigned(_entries.size())});
    if (!isNew)
    {
        Entry& entry = _entries[found->second];
        ++entry.users;
        entry.image.anisotropy = std::max(entry.image.anisotropy, image.anisotropy);
        entry.image.lodBias = std::min(entry.image.lodBias, image.lodBias);
        return found->second;
    }
    _entries.emplace_back();
    _entries.back().image = image;
    _entries.back().state->translucent = image.translucent;
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
    _byFile.erase({entry.image.file, entry.image.isNormalMap});
    cancel(texture);
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
    // What views of this frame see is the next one's need.
    for (Entry& entry : _entries)
        entry.pixels = entry.soonPixels = 0.0;
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
    plan();
    _changing = 0;
    for (unsigned int i = 0; i < _entries.size(); ++i)
        moveTo(i);
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
        if (!entry.bytes)
            setFormat(entry);
    return true;
}

void Pager::setFormat(Entry& entry)
{
    const PagedImage& image = entry.image;
    entry.format = formatFor(image.channels, image.translucent, image.isNormalMap,
                             _settings.compression, _abilities);
    std::vector<std::uint64_t>& bytes = _sizes[{image.width, image.height, entry.format}];
    if (bytes.empty())
        for (int level = 0; level < levelCount(image.width, image.height); ++level)
            bytes.push_back(chainBytes(entry.format, image.width, image.height, level));
    entry.bytes = &bytes;
    entry.finest = 0;
    while (levelSide(std::max(image.width, image.height), entry.finest) > _abilities.maxSide)
        ++entry.finest;
}

/// Files with new content. What is shown of them stays until the new texture is complete.
void Pager::takeChanges()
{
    if (!_watch)
        return;
    for (const std::string& file : _watch->takeChanged())
        for (unsigned int i = 0; i < _entries.size(); ++i)
            if (_entries[i].users > 0 && _entries[i].image.file == file)
                readAgain(i);
}

void Pager::readAgain(unsigned int texture)
{
    Entry& entry = _entries[texture];
    try
    {
        const ImageInfo info = readImageInfo(entry.image.file);
        entry.image.width = info.width;
        entry.image.height = info.height;
        entry.image.channels = info.channels;
        entry.image.translucent = info.translucent;
    }
    catch (const ImageError& error)
    {
        OSG_WARN << "osgPagedTexture: " << error.what() << "; what is there of it stays"
                 << std::endl;
        return;
    }
    cancel(texture);
    setFormat(entry);
    entry.state->failed = false;
    entry.state->translucent = entry.image.translucent;
    entry.isOld = true;
    for (auto& each : _contexts)
        each.second.resident[texture] = UploadEvent::Gone;
}

void Pager::takeEvents()
{
    for (auto& each : _contexts)
        for (const UploadEvent& event : each.second.queue->takeEvents())
        {
            each.second.queued[event.texture] = None;
            if (event.isRefused)
                _entries[event.texture].finest =
                    std::min(event.level + 1, int(_entries[event.texture].bytes->size()) - 1);
            else
            {
                each.second.resident[event.texture] = event.level;
                _entries[event.texture].isOld = false;
            }
        }
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
    while (backlog() <= _settings.cpuBytes() / 4)
    {
        const std::vector<ChainResult> results = _loader->poll(1);
        if (results.empty())
            break;
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
        entry.state->failed = true;
    else
        entry.finest = there;
}

void Pager::pushToAll(unsigned int texture, const std::shared_ptr<const MipChain>& chain)
{
    const int target = _entries[texture].target;
    if (target < 0)
        return;
    const int level = std::max(target, chain->firstLevel);
    for (auto& each : _contexts)
    {
        Context& context = each.second;
        const int there = context.resident[texture];
        const bool isUseful =
            there == UploadEvent::Gone || (there > target ? level < there : there < target);
        if (!isUseful || (there < target && there != UploadEvent::Gone && level != target))
            continue;
        context.queued[texture] = level;
        context.queue->push({texture, level, chain});
    }
}

void Pager::plan()
{
    _wishes.resize(_entries.size());
    for (std::size_t i = 0; i < _entries.size(); ++i)
    {
        Entry& entry = _entries[i];
        ResidencyWish& wish = _wishes[i];
        wish = {};
        if (entry.users == 0 || entry.state->failed || !entry.bytes)
            continue;
        const TexelTexture texture{entry.image.width, entry.image.height, entry.image.anisotropy,
                                   entry.image.lodBias};
        // Levels count from the finest one that may be there.
        const auto wanted = [&](double pixels)
        {
            return pixels > 0.0 ? std::max(0.0, neededLevel(texture, pixels) - entry.finest)
                                : ResidencyWish::None;
        };
        wish.bytes = entry.bytes->data() + entry.finest;
        wish.levels = int(entry.bytes->size()) - entry.finest;
        entry.need = wanted(entry.pixels);
        wish.need = entry.need;
        wish.soon = wanted(entry.soonPixels);
        const int there = coarsest(unsigned(i));
        wish.resident = there == UploadEvent::Gone ? -1 : std::max(0, there - entry.finest);
        wish.lastUsed = entry.lastUsed;
    }
    _plan = planResidency(_wishes, _settings.gpuBytes());
    for (std::size_t i = 0; i < _entries.size(); ++i)
        _entries[i].target = _plan.first[i] < 0 ? -1 : _plan.first[i] + _entries[i].finest;
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

double Pager::priority(const Entry& entry, int there) const
{
    const int levels = int(entry.bytes->size());
    const double gap = (there == UploadEvent::Gone ? levels : there) - entry.target;
    const double pixels = std::max(entry.pixels, entry.soonPixels);
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
    if (entry.users == 0 || entry.state->failed)
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
}

void Pager::ask(unsigned int texture)
{
    Entry& entry = _entries[texture];
    const int there = coarsest(texture);
    // A request a level coarser is let through: what comes of it helps, and nothing is decoded in
    // vain where the need grows with each frame.
    if (entry.request && entry.requested >= entry.target && entry.requested <= entry.target + 1)
    {
        _loader->setPriority(entry.request, priority(entry, there));
        return;
    }
    cancel(texture);
    const std::string key = formatName(entry.format) + (entry.image.isNormalMap ? "n" : "c") +
                            std::to_string(int(_settings.quality));
    std::shared_ptr<const ChainRecipe>& recipe = _recipes[key];
    if (!recipe)
        recipe = recipeFor(entry.format, entry.image.isNormalMap, _settings.quality);
    ChainRequest request;
    request.file = entry.image.file;
    request.recipe = recipe;
    request.firstLevel = entry.target;
    request.priority = priority(entry, there);
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
        if (!isDone && entry.users > 0 && !entry.state->failed)
            return false;
    }
    return true;
}

bool Pager::isAtRest() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _entries.empty() || (_abilities.known && _changing == 0 && _requests.empty());
}

std::shared_ptr<UploadQueue> Pager::getQueue(unsigned int contextID)
{
    std::lock_guard<std::mutex> lock(_queueMutex);
    std::shared_ptr<UploadQueue>& queue = _queues[contextID];
    if (!queue)
        queue = std::make_shared<UploadQueue>(contextID);
    return queue;
}

std::shared_ptr<const PagedState> Pager::getState(unsigned int texture) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _entries[texture].state;
}

Pager::Shown Pager::getShown(unsigned int texture, const PagedState& paged, osg::State& state)
{
    const std::shared_ptr<UploadQueue> queue = getQueue(state.getContextID());
    queue->begin(state);
    const UploadQueue::Texture* found = queue->find(texture);
    if (paged.failed && !found)
        return {queue->faultName(state)};
    if (_showsLevels)
        return {queue->plainName(
            state, found ? LevelColors[std::min(found->level, LevelColorCount - 1)] : 0x000000FF)};
    if (found)
        return {found->name, found->format};
    return {queue->plainName(state, paged.translucent ? Translucent : Opaque)};
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
        result.failed += entry.state->failed ? 1 : 0;
        result.wholeBytes += entry.bytes ? (*entry.bytes)[0] : 0;
    }
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
                             entry.state->failed, entry.image.width, entry.image.height});
    }
    return lines;
}

} // namespace osgPagedTexture
