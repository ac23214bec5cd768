// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ContentHash.h>
#include <osgPagedTexture/PageTexels.h>
#include <osgPagedTexture/VirtualPages.h>
#include <osgPagedTexture/WorkerPool.h>

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace osgPagedTexture
{

/// A page and what it is made of.
struct LoadedPage
{
    std::shared_ptr<const PageTexels> texels;
    ContentHash source; ///< Of the tile's bytes: equal ones make equal texels.
};

struct PageRequest
{
    PageVersion page;
    std::shared_ptr<const TileReader> store;
    std::string name; ///< Of the store, for messages.
    PageFormat format;
    double priority = 0.0; ///< The higher the sooner, of pages of the same level; coarser ones
                           ///< always go first.
    ContentHash known; ///< What the asker has: where the tile is still that, no texels are made.
};

struct PageResult
{
    enum class State
    {
        Loaded,
        Unchanged, ///< The tile is PageRequest::known; there are no texels.
        Failed     ///< Damaged or not to be read: `error` says it in one line.
    };
    PageVersion page;
    State state = State::Failed;
    LoadedPage loaded;
    std::string error;
    bool mayPass = false; ///< Of Failed: the disk failed, another try may help.
};

/// Reads pages in the background: tile, decoding, encoding. All calls return at once; results are
/// taken by poll(). No thread exists before the first request. Any thread.
class OSGPAGEDTEXTURE_EXPORT PageLoader
{
public:
    struct Statistics
    {
        std::uint64_t requests = 0;
        std::uint64_t loaded = 0;
        std::uint64_t unchanged = 0;
        std::uint64_t cancelled = 0;
        std::uint64_t failed = 0;
        std::uint64_t bytesRead = 0; ///< Of encoded tiles.
        double busySeconds = 0.0;    ///< Of all workers together.
        std::size_t waiting = 0;     ///< Requests whose results have not been taken.
    };

    /// 0 threads: one less than the machine has.
    explicit PageLoader(unsigned int threads = 0);
    ~PageLoader();

    /// Asks for a page, or gives the one that is asked for already another priority.
    void request(const PageRequest& request);

    bool isRequested(const PageVersion& page) const;
    void cancel(const PageVersion& page);

    /// Takes the results that are there, at most `count`.
    std::vector<PageResult> poll(std::size_t count = SIZE_MAX);

    /// Waits until poll() has something, nothing is asked for any more, or the time is over.
    void wait(double seconds) const;

    Statistics getStatistics() const;

private:
    void run(const PageRequest& request, const std::atomic<bool>& cancelled);

    mutable std::mutex _mutex;
    mutable std::condition_variable _finished;
    std::unordered_map<PageVersion, WorkerPool::JobId> _jobs;
    std::vector<PageResult> _results;
    Statistics _statistics;
    WorkerPool _pool; ///< Last: its threads end first.
};

} // namespace osgPagedTexture
