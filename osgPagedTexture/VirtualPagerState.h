// SPDX-License-Identifier: MIT
// What VirtualPager holds. Its parts: choosing and holding pages (VirtualPagerHold.cpp), loading
// them (VirtualPagerLoad.cpp), going to another state of a store (VirtualPagerSwitch.cpp).
#pragma once

#include <osgPagedTexture/PageCache.h>
#include <osgPagedTexture/PageContext.h>
#include <osgPagedTexture/PageLoader.h>
#include <osgPagedTexture/PageSelection.h>
#include <osgPagedTexture/PageSlots.h>
#include <osgPagedTexture/StoreWatch.h>
#include <osgPagedTexture/VirtualPager.h>

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace osgPagedTexture
{

/// The state of a store that a texture goes to.
struct NextState
{
    StoreWatch::Change change;
    std::uint32_t generation = 0;
    std::unordered_set<PageKey> unchanged;            ///< Shown ones that are right already.
    std::unordered_map<PageKey, LoadedPage> gathered; ///< That have no slot yet.
};

/// A texture and its store.
struct PagerTexture
{
    std::string path;
    std::shared_ptr<const TileReader> store;
    TileGrid grid;
    int coarsest = 0;
    int finest = 0; ///< That may be shown.
    std::uint32_t generation = 1;
    std::uint32_t lastGeneration = 1;
    std::optional<NextState> next;
    std::optional<StoreWatch::Change> change; ///< That comes after that.
    bool isPaused = false;                    ///< What is read now may be of a later state.
    int namedTiles = 0;                       ///< Damages told since the last change.
};

class VirtualPager::State
{
public:
    explicit State(const VirtualPagerSettings& settings);

    std::uint32_t addTexture(const std::string& path);
    void removeTexture(std::uint32_t texture);
    void report(unsigned int view, const std::vector<PageNeed>& needs);
    void removeView(unsigned int view);
    void advance(unsigned int frame);
    PageUploads takeUploads(unsigned int context, std::uint64_t maxBytes);
    bool isAtRest() const;
    void invalidate(std::uint32_t texture, const PixelRect* region); ///< Without the mutex.
    void waitForLoads(double seconds) const;                         ///< The same.
    VirtualPagerStatistics getStatistics() const;
    std::vector<std::string> takeMessages();

    mutable std::mutex mutex; ///< Of all but what its own one guards: loader and watch.
    const VirtualPagerSettings settings;
    bool isFrozen = false;
    std::map<unsigned int, PageMemory> views;
    std::map<unsigned int, PageContext> contexts;
    PageFormat format;
    int border = 0;

    std::map<std::uint32_t, PagerTexture> textures;
    StoreWatch watch;

private:
    using Clock = std::chrono::steady_clock;
    struct Held
    {
        std::uint64_t serial = 0;
        ContentHash source;
    };
    struct Failure
    {
        bool mayPass = false;
        Clock::time_point when;
    };

    void dropIdleContexts();
    void takeChanges();
    void takeResults();
    void accept(PageResult result, PagerTexture& texture);
    void fail(const PageResult& result, PagerTexture& texture);
    void choose();
    void needHeld();
    void hold();
    bool holdOne(const PageNeed& need, PagerTexture& texture);
    void ask(const PageVersion& page, const std::shared_ptr<const TileReader>& store,
             const std::string& name, double priority, const ContentHash& known);
    void cancel(const std::function<bool(const PageVersion&)>& isGone);
    bool hasFailed(const PageVersion& page) const;
    bool isEverywhere(int slot) const;
    bool isExpected(int slot) const;
    void count(std::size_t missing);
    std::uint64_t queuedBytes() const;
    int place(const PageVersion& page, const LoadedPage& loaded, bool isShown, bool isRefresh);
    void deliver(int slot, const PageVersion& page, const LoadedPage& loaded, bool isShown,
                 bool isRefresh);
    void forget(const std::function<bool(const PageVersion&)>& isGone);

    /// How many pages of the next state can be taken.
    struct Room
    {
        int slots = 0;
        int inPlace = 0; ///< In the slots of the old ones, in the frame of the switch.
    };
    static bool isTouched(const NextState& next, const TileGrid& grid, const PageKey& page);
    int pagesInPlace() const;
    std::vector<PageNeed> pagesToGather(std::uint32_t id, const PagerTexture& texture) const;
    void gather(std::uint32_t id, PagerTexture& texture);
    bool gatherOne(PagerTexture& texture, const PageNeed& need, Room& room);
    void abandon(std::uint32_t id, PagerTexture& texture);
    void goOver(std::uint32_t id, PagerTexture& texture, const std::vector<PageNeed>& pages);
    std::vector<PageContext::Upload> replaceInPlace(PagerTexture& texture,
                                                    const std::vector<PageNeed>& pages);
    std::vector<PageContext::Carried> carryOver(std::uint32_t id, PagerTexture& texture);

    static constexpr std::uint64_t MinCachePages = 64; ///< What is loaded lasts until its upload.

    PageSlots _slots;
    std::vector<Held> _held; ///< By slot.
    std::uint64_t _lastSerial = 0;
    std::optional<PageCache> _cache; ///< From the first texture on.
    PageSelection _selection;
    std::map<unsigned int, std::uint64_t> _lastTaken;      ///< By context.
    std::unordered_map<PageVersion, std::uint64_t> _asked; ///< And when that was wanted last.
    std::unordered_map<PageVersion, Failure> _failed;
    std::vector<std::string> _messages;
    std::uint64_t _time = 0; ///< Counts calls of advance().
    unsigned int _frame = ~0u;
    bool _isChanged = false; ///< Reports or textures, since the last choice.
    std::size_t _ready = 0;  ///< Pages that wait for an upload, in this call.
    std::uint32_t _lastTexture = 0;
    VirtualPagerStatistics _statistics;
    Clock::time_point _unsharpSince;
    unsigned int _unsharpFrames = 0;
    bool _isUnsharp = false;
    PageLoader _loader; ///< Last: its threads end first.
};

} // namespace osgPagedTexture
