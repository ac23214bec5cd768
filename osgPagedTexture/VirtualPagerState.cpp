// SPDX-License-Identifier: MIT
// Textures, views and contexts come and go.
#include <osgPagedTexture/VirtualPagerState.h>

#include <algorithm>
#include <thread>
#include <utility>

namespace osgPagedTexture
{

namespace
{

constexpr int MaxPageSide = 4096;
constexpr std::uint64_t IdleContextFrames = 240;

[[noreturn]] void refuse(const std::string& path, const std::string& cause)
{
    throw TileStoreError(TileStoreError::Kind::Refused,
                         "osgPagedTexture::VirtualPager: '" + path + "' " + cause);
}

int finestLevel(const TileGrid& grid, int maxSide)
{
    int level = 0;
    while (level + 1 < pageLevels(grid) &&
           std::max(grid.getColumns(level), grid.getRows(level)) > maxSide)
    {
        ++level;
    }
    return level;
}

} // namespace

VirtualPager::State::State(const VirtualPagerSettings& newSettings)
    : settings(newSettings), watch(newSettings.watchSeconds), _slots(newSettings.slots),
      _held(std::size_t(_slots.getCount())), _loader(newSettings.threads)
{
    format.format = settings.format;
    format.quality = settings.quality;
    format.background = settings.background;
}

std::uint32_t VirtualPager::State::addTexture(const std::string& path)
{
    PagerTexture texture;
    texture.path = path;
    const std::uint32_t id = _lastTexture;
    texture.store = watch.open(id, path);
    texture.grid = texture.store->getSettings().grid;
    const int side = pageSideOf(texture.grid, settings.format);
    if (side > MaxPageSide)
    {
        watch.close(id);
        refuse(path, "has tiles of " + std::to_string(side) + " pixels; build it with tiles of " +
                         std::to_string(MaxPageSide) + " at most");
    }
    if (_cache && (side != format.side || texture.grid.getBorder() != border))
    {
        watch.close(id);
        refuse(path, "has tiles of another side or border than the stores before; build it alike");
    }
    texture.coarsest = pageLevels(texture.grid) - 1;
    texture.finest = finestLevel(texture.grid, settings.maxTableSide);
    if (!_cache)
    {
        format.side = side;
        border = texture.grid.getBorder();
        _cache.emplace(std::max(settings.cacheBytes, MinCachePages * format.bytes()));
    }
    for (auto& [context, each] : contexts)
    {
        each.addTexture(id, texture.grid, texture.finest);
    }
    textures.emplace(id, std::move(texture));
    ++_lastTexture;
    _isChanged = true;
    return id;
}

void VirtualPager::State::removeTexture(std::uint32_t id)
{
    if (textures.erase(id) == 0)
    {
        return;
    }
    watch.close(id);
    const auto isOfIt = [&](const PageVersion& page) { return page.page.texture == id; };
    cancel(isOfIt);
    forget(isOfIt);
    for (auto& [context, each] : contexts)
    {
        each.removeTexture(id);
    }
    _isChanged = true;
}

void VirtualPager::State::report(unsigned int view, const std::vector<PageNeed>& needs)
{
    watch.start();
    std::vector<PageNeed> known;
    known.reserve(needs.size());
    for (PageNeed need : needs)
    {
        const auto texture = textures.find(need.page.texture);
        if (texture == textures.end() || need.page.x < 0 || need.page.y < 0)
        {
            continue;
        }
        const int level = std::clamp(need.page.level, 0, 30);
        const int held = std::clamp(level, texture->second.finest, texture->second.coarsest);
        need.page.level = level;
        need.page = need.page.ancestor(std::max(held - level, 0));
        need.page.level = held;
        if (held < level)
        {
            need.page.x = need.page.y = 0; // the only page that a coarser level could have
        }
        if (need.page.x < texture->second.grid.getColumns(held) &&
            need.page.y < texture->second.grid.getRows(held))
        {
            known.push_back(need);
        }
    }
    views.emplace(view, PageMemory(std::max(settings.rememberReports, 1))).first->second.add(known);
    _isChanged = true;
}

PageUploads VirtualPager::State::takeUploads(unsigned int context, std::uint64_t maxBytes)
{
    const auto [place, isNew] = contexts.emplace(context, PageContext(_slots.getCount()));
    if (isNew)
    {
        for (const auto& [id, texture] : textures)
        {
            place->second.addTexture(id, texture.grid, texture.finest);
        }
        _isChanged = true;
    }
    _lastTaken[context] = _time;
    PageUploads uploads = place->second.take(maxBytes);
    _statistics.uploadedPages += uploads.pages.size();
    _statistics.uploadedBytes += uploads.bytes;
    return uploads;
}

/// A window that is not drawn must not hold up the others.
void VirtualPager::State::dropIdleContexts()
{
    for (auto context = contexts.begin(); context != contexts.end();)
    {
        const bool isIdle = _lastTaken[context->first] + IdleContextFrames < _time;
        if (isIdle)
        {
            _lastTaken.erase(context->first);
        }
        context = isIdle ? contexts.erase(context) : std::next(context);
    }
}

bool VirtualPager::State::isAtRest() const
{
    const auto isIdle = [](const auto& context) { return context.second.isIdle(); };
    const auto isStill = [](const auto& texture)
    { return !texture.second.next && !texture.second.change; };
    return (isFrozen || !_isChanged) && _statistics.missingPages == 0 &&
           std::all_of(contexts.begin(), contexts.end(), isIdle) &&
           std::all_of(textures.begin(), textures.end(), isStill) && !watch.isBusy();
}

void VirtualPager::State::invalidate(std::uint32_t texture, const PixelRect* region)
{
    watch.start();
    watch.lookNow(texture, region);
}

void VirtualPager::State::removeView(unsigned int view)
{
    views.erase(view);
    _isChanged = true;
}

void VirtualPager::State::waitForLoads(double seconds) const
{
    _loader.wait(watch.isBusy() ? std::min(seconds, 0.005) : seconds);
    if (watch.isBusy())
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

VirtualPagerStatistics VirtualPager::State::getStatistics() const
{
    VirtualPagerStatistics statistics = _statistics;
    const PageLoader::Statistics loading = _loader.getStatistics();
    statistics.slots = _slots.getCount();
    statistics.usedSlots = _slots.getUsedCount();
    statistics.bias = _selection.getBias();
    statistics.neededPages = _selection.getUnbiasedCount();
    statistics.chosenPages = _selection.getPages().size();
    statistics.loadingPages = loading.waiting;
    statistics.failedPages = _failed.size();
    statistics.loadedPages = loading.loaded;
    statistics.bytesRead = loading.bytesRead;
    statistics.workerSeconds = loading.busySeconds;
    statistics.cacheMisses = loading.requests;
    if (_cache)
    {
        statistics.cacheHits = _cache->getStatistics().hits;
        statistics.cacheBytes = _cache->getStatistics().bytes;
    }
    statistics.isSwitching =
        std::any_of(textures.begin(), textures.end(),
                    [](const auto& each) { return each.second.next.has_value(); });
    return statistics;
}

std::vector<std::string> VirtualPager::State::takeMessages()
{
    std::vector<std::string> messages = std::exchange(_messages, {});
    for (std::string& message : watch.takeMessages())
    {
        messages.push_back(std::move(message));
    }
    return messages;
}

} // namespace osgPagedTexture
