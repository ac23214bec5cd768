// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/PageTable.h>
#include <osgPagedTexture/PageTexels.h>
#include <osgPagedTexture/VirtualPages.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

struct VirtualPagerSettings
{
    int slots = 1024;                      ///< Pages that the physical texture has room for.
    BlockFormat format = BlockFormat::BC1; ///< Of the physical texture: RGBA8, BC1, BC3 or BC7.
    EncodeQuality quality = EncodeQuality::Normal;
    TileColor background{255, 255, 255, 255};            ///< Where a store has nothing.
    std::uint64_t cacheBytes = std::uint64_t(256) << 20; ///< Of pages in memory.
    unsigned int threads = 0;  ///< Workers; 0: one less than the machine has.
    int rememberReports = 8;   ///< For how many of a view's reports a page counts as needed.
    double watchSeconds = 1.0; ///< Between two looks at the stores' files; 0: none.
    /// Uploads that wait at most, before further ones are decided on: what comes later may matter
    /// more.
    std::uint64_t queueBytes = std::uint64_t(4) << 20;
    /// Of pages that are replaced in their own slots when a texture goes to another state of its
    /// store; all in one frame. More than these are coarser for some frames.
    std::uint64_t switchBytes = std::uint64_t(8) << 20;
    int maxTableSide = 2048; ///< Entries; levels with more pages in a row are not shown.
};

/// A page's way into the physical texture.
struct PageUpload
{
    int slot = 0;
    PageKey page;
    std::shared_ptr<const PageTexels> texels;
    bool isRefresh = false; ///< It shows another state of what was there: no fading in.
};

/// Entries of a page table to be replaced.
struct TablePatch
{
    std::uint32_t texture = 0;
    /// Null where it is that of the patch before. Where it is set, the table has these sides from
    /// now on, and the patch is all of it.
    std::shared_ptr<const PageTableLayout> layout;
    TableRect rect;
    std::vector<std::uint32_t> entries; ///< By rows.
};

/// What a context does before it draws: all of it, in any order.
struct PageUploads
{
    std::vector<PageUpload> pages;
    std::vector<TablePatch> tables;
    std::uint64_t bytes = 0; ///< Of the pages.
    bool isComplete = true;  ///< Nothing is left for another call.
};

struct VirtualPagerStatistics
{
    int slots = 0;
    int usedSlots = 0;
    int bias = 0;                 ///< Levels by which all is coarser, as not all fits.
    std::size_t neededPages = 0;  ///< Asked for by the views, with the coarser ones above them.
    std::size_t chosenPages = 0;  ///< Of these, what is to be held.
    std::size_t missingPages = 0; ///< Of the chosen ones, not yet there in some context.
    std::size_t loadingPages = 0; ///< With the workers.
    std::size_t failedPages = 0;  ///< Damaged or not to be read, now.
    std::uint64_t uploadedPages = 0;
    std::uint64_t uploadedBytes = 0;
    std::uint64_t loadedPages = 0; ///< Made by the workers.
    std::uint64_t bytesRead = 0;   ///< Of encoded tiles.
    double workerSeconds = 0.0;
    std::uint64_t cacheHits = 0;
    std::uint64_t cacheMisses = 0;
    std::uint64_t cacheBytes = 0;
    std::uint64_t switches = 0;   ///< Of textures to another state of their store.
    bool isSwitching = false;     ///< Pages of another state are gathered.
    double secondsUntilSharp = 0; ///< Of the last time that pages were missing, until none was.
    unsigned int framesUntilSharp = 0;
};

/// Decides which pages of virtual textures are in a physical texture, loads them and says what is
/// to be uploaded. Knows no graphics library.
///
/// Each frame: views report() what they ask for; advance() once; each context takes and applies
/// takeUploads() before it draws. After that, in each context, a page table names a slot only
/// where the slot has that page. Contexts have a physical texture each, all with the same pages.
///
/// A texture shows one state of its store at a time. invalidate(), or a store whose file has
/// changed, makes it gather the pages in view in their new state, unseen, in other slots, and then
/// go to the new state at once; until then no further pages of the old state are loaded. Where
/// slots do not suffice, pages are replaced in their slots in that same frame, the coarsest first,
/// and those beyond VirtualPagerSettings::switchBytes are coarser until they have been uploaded.
///
/// A page that cannot be read leaves the coarser one in its place and is named once by
/// takeMessages(); it is tried again when its store has changed, or after some seconds where the
/// disk failed.
///
/// Any thread, all calls return at once unless they say otherwise. No thread exists before the
/// first report.
class OSGPAGEDTEXTURE_EXPORT VirtualPager
{
public:
    explicit VirtualPager(const VirtualPagerSettings& settings);
    ~VirtualPager();
    VirtualPager(const VirtualPager&) = delete;
    VirtualPager& operator=(const VirtualPager&) = delete;

    const VirtualPagerSettings& getSettings() const;

    /// Opens a store and returns the texture's number, counted from 0 and never used twice. All
    /// stores of a pager have the same tiles' side and border. Throws TileStoreError.
    std::uint32_t addTexture(const std::string& storePath);
    void removeTexture(std::uint32_t texture);

    /// Of a texture's store.
    TileGrid getGrid(std::uint32_t texture) const;

    /// Texels of a slot's side; 0 before the first texture.
    int getPageSide() const;
    std::uint64_t getPageBytes() const;

    /// Contexts are numbered by the caller. A context that is unknown or comes back after
    /// removeContext() has nothing and gets all.
    void removeContext(unsigned int context);

    /// What a view has asked for in a feedback picture; it holds until the view's next report.
    /// Pages that are none of their texture, or finer than its finest, count as the nearest one
    /// that is; others are ignored.
    void report(unsigned int view, const std::vector<PageNeed>& needs);
    void removeView(unsigned int view);

    /// Chooses, asks the workers, takes what they have. Does nothing in a frame that it has seen.
    void advance(unsigned int frame);

    /// What the context has to do now: uploads of at most `maxBytes`, but at least one page where
    /// `maxBytes` is not 0; and more where a texture goes to another state.
    PageUploads takeUploads(unsigned int context, std::uint64_t maxBytes);

    /// Whether all that was reported is there in all contexts, or will not come.
    bool isAtRest() const;

    /// While frozen, what is there stays: reports change nothing.
    void setFrozen(bool frozen);

    /// Reads a texture's pages again: those that show any of these pixels of level 0, counted from
    /// the top left corner, or all.
    void invalidate(std::uint32_t texture);
    void invalidate(std::uint32_t texture, const PixelRect& pixels);

    /// Waits until the workers have something to take, or the time is over.
    void waitForLoads(double seconds) const;

    VirtualPagerStatistics getStatistics() const;

    /// Lines for the user, each once: tiles and stores that cannot be read, stores that changed.
    std::vector<std::string> takeMessages();

private:
    class State;
    std::unique_ptr<State> _state;
};

} // namespace osgPagedTexture
