// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/TileStore.h>

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace osgPagedTexture
{

/// Opens stores, looks again and again whether they have another content, and opens that: all that
/// reads happens in its thread, which starts with start(). Any thread.
class StoreWatch
{
public:
    /// A store's next state.
    struct Change
    {
        std::uint32_t id = 0;
        std::shared_ptr<const TileReader> store;
        bool isAll = true;
        std::vector<PixelRect> regions; ///< Unless isAll: where it may be another one.
    };

    /// 0 seconds: looks only when it is told to.
    explicit StoreWatch(double intervalSeconds);
    ~StoreWatch();
    StoreWatch(const StoreWatch&) = delete;
    StoreWatch& operator=(const StoreWatch&) = delete;

    /// Opens a store, in the caller's thread. Throws TileStoreError.
    std::shared_ptr<const TileReader> open(std::uint32_t id, const std::string& path);
    void close(std::uint32_t id);
    void start();

    /// Opens the store anew as soon as may be, whether or not its file has changed. Null: all of
    /// it.
    void lookNow(std::uint32_t id, const PixelRect* region);

    /// Stores that were opened anew, at most one change each; the next one comes after that.
    std::vector<Change> takeChanges();

    /// Whether a change that was asked for has not been taken yet: of a store, of any.
    bool isBusy(std::uint32_t id) const;
    bool isBusy() const;

    std::vector<std::string> takeMessages();

private:
    /// What tells, without reading it, that a file is not the one that was opened.
    struct Stamp
    {
        std::uint64_t file = 0;
        std::uint64_t bytes = 0;
        std::int64_t time = 0;
        bool isThere = false;
        bool operator==(const Stamp& other) const
        {
            return file == other.file && bytes == other.bytes && time == other.time &&
                   isThere == other.isThere;
        }
    };
    struct Wish
    {
        bool isAsked = false; ///< lookNow().
        bool isAll = false;
        std::vector<PixelRect> regions;
    };
    struct Store
    {
        std::string path;
        TileGrid grid;
        Stamp stamp;                  ///< Of the last look.
        std::uint64_t file = 0;       ///< That was opened last.
        std::uint64_t generation = 0; ///< Of it; 0 where the kind of store has none.
        Wish wish;
        bool isLookedAt = false; ///< Because of a wish.

        bool isAsked() const { return wish.isAsked || isLookedAt; }
        std::string trouble; ///< Was told.
    };
    static Stamp stampOf(const std::string& path);
    void run();
    void look(std::uint32_t id, std::unique_lock<std::mutex>& lock);
    void accept(std::uint32_t id, Store& store, const Wish& wish,
                std::shared_ptr<const TileReader> opened);
    bool hasChange(std::uint32_t id) const;
    void tell(Store& store, const std::string& trouble);

    const double _interval;
    mutable std::mutex _mutex;
    std::condition_variable _wake;
    std::map<std::uint32_t, Store> _stores;
    std::vector<Change> _changes;
    std::vector<std::string> _messages;
    bool _asked = false;
    bool _ends = false;
    std::thread _thread;
};

} // namespace osgPagedTexture
