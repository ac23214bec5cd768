// SPDX-License-Identifier: MIT
#include <osgPagedTexture/StoreWatch.h>

#include <osgMultiRender/AllCores.h>

#include <osgPagedTexture/TileFolders.h>
#include <osgPagedTexture/TilePack.h>

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

namespace osgPagedTexture
{

namespace fs = std::filesystem;

namespace
{

/// The file that tells whether a store is there: a folder's description, or the store itself.
std::string mainFileOf(const std::string& path)
{
    std::error_code error;
    return fs::is_directory(path, error) ? path + "/tiles.json" : path;
}

/// A folder of tiles has nothing where a file is missing, but not where all of them are.
class FolderStore : public TileReader
{
public:
    FolderStore(std::unique_ptr<TileReader> reader, std::string mainFile)
        : _reader(std::move(reader)), _mainFile(std::move(mainFile))
    {
    }
    const TileStoreSettings& getSettings() const override { return _reader->getSettings(); }
    TileData read(const TileKey& key) const override
    {
        TileData tile = _reader->read(key);
        std::error_code error;
        if (tile.kind == TileData::Kind::None && !fs::exists(_mainFile, error))
        {
            throw TileStoreError(TileStoreError::Kind::Unreadable,
                                 "osgPagedTexture::TileStore: '" + _mainFile +
                                     "' is gone; put the store back");
        }
        return tile;
    }

private:
    const std::unique_ptr<TileReader> _reader;
    const std::string _mainFile;
};

std::shared_ptr<const TileReader> openStore(const std::string& path)
{
    std::unique_ptr<TileReader> reader = openTileStore(path);
    if (dynamic_cast<const TilePackReader*>(reader.get()))
    {
        return reader;
    }
    return std::make_shared<FolderStore>(std::move(reader), mainFileOf(path));
}

std::uint64_t generationOf(const TileReader& reader)
{
    const auto* pack = dynamic_cast<const TilePackReader*>(&reader);
    return pack ? pack->getInfo().generation : 0;
}

} // namespace

StoreWatch::StoreWatch(double intervalSeconds) : _interval(intervalSeconds) {}

StoreWatch::~StoreWatch()
{
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _ends = true;
    }
    _wake.notify_all();
    if (_thread.joinable())
    {
        _thread.join();
    }
}

StoreWatch::Stamp StoreWatch::stampOf(const std::string& path)
{
    struct stat status
    {
    };
    Stamp stamp;
    if (::stat(mainFileOf(path).c_str(), &status) == 0)
    {
        stamp.isThere = true;
        stamp.file = status.st_ino;
        stamp.bytes = std::uint64_t(status.st_size);
        stamp.time = status.st_mtim.tv_sec * std::int64_t(1000000000) + status.st_mtim.tv_nsec;
    }
    return stamp;
}

std::shared_ptr<const TileReader> StoreWatch::open(std::uint32_t id, const std::string& path)
{
    Store store;
    store.path = path;
    store.stamp = stampOf(path); // before it is read: what changes later is seen
    store.file = store.stamp.file;
    std::shared_ptr<const TileReader> reader = openStore(path);
    store.grid = reader->getSettings().grid;
    store.generation = generationOf(*reader);
    const std::lock_guard<std::mutex> lock(_mutex);
    _stores[id] = std::move(store);
    return reader;
}

void StoreWatch::close(std::uint32_t id)
{
    const std::lock_guard<std::mutex> lock(_mutex);
    _stores.erase(id);
    _changes.erase(std::remove_if(_changes.begin(), _changes.end(),
                                  [&](const Change& change) { return change.id == id; }),
                   _changes.end());
}

void StoreWatch::start()
{
    const std::lock_guard<std::mutex> lock(_mutex);
    if (!_thread.joinable())
    {
        _thread = std::thread(
            [this]
            {
                osgMultiRender::useAllCores();
                run();
            });
    }
}

void StoreWatch::lookNow(std::uint32_t id, const PixelRect* region)
{
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto store = _stores.find(id);
    if (store == _stores.end())
    {
        return;
    }
    Wish& wish = store->second.wish;
    wish.isAsked = _asked = true;
    if (region)
    {
        wish.regions.push_back(*region);
    }
    else
    {
        wish.isAll = true;
    }
    _wake.notify_all();
}

void StoreWatch::run()
{
    std::unique_lock<std::mutex> lock(_mutex);
    while (!_ends)
    {
        const auto isWoken = [this] { return _ends || _asked; };
        if (_interval > 0.0)
        {
            _wake.wait_for(lock, std::chrono::duration<double>(_interval), isWoken);
        }
        else
        {
            _wake.wait(lock, isWoken);
        }
        const bool onlyAsked = std::exchange(_asked, false);
        std::vector<std::uint32_t> ids;
        for (const auto& [id, store] : _stores)
        {
            if (store.wish.isAsked || !onlyAsked)
            {
                ids.push_back(id);
            }
        }
        for (const std::uint32_t id : ids)
        {
            if (!_ends)
            {
                look(id, lock);
            }
        }
    }
}

/// The lock is open while files are read.
void StoreWatch::look(std::uint32_t id, std::unique_lock<std::mutex>& lock)
{
    const auto before = _stores.find(id);
    if (before == _stores.end() || hasChange(id))
    {
        return;
    }
    const std::string path = before->second.path;
    const Stamp last = before->second.stamp;
    // Who asks from now on wants to be looked for again.
    const Wish wish = std::exchange(before->second.wish, {});
    before->second.isLookedAt = wish.isAsked;
    lock.unlock();
    const Stamp stamp = stampOf(path);
    std::shared_ptr<const TileReader> opened;
    std::string trouble;
    if (wish.isAsked || !(stamp == last))
    {
        try
        {
            opened = openStore(path);
        }
        catch (const std::exception& error)
        {
            trouble = error.what();
        }
    }
    lock.lock();
    const auto found = _stores.find(id);
    if (found == _stores.end())
    {
        return;
    }
    found->second.isLookedAt = false;
    found->second.stamp = stamp;
    if (!trouble.empty())
    {
        tell(found->second, trouble);
    }
    else if (opened)
    {
        accept(id, found->second, wish, std::move(opened));
    }
}

void StoreWatch::accept(std::uint32_t id, Store& store, const Wish& wish,
                        std::shared_ptr<const TileReader> opened)
{
    const std::uint64_t generation = generationOf(*opened);
    const bool isOther = store.stamp.file != store.file || generation != store.generation;
    if (!wish.isAsked && !isOther && generation != 0)
    {
        return; // a writer is at work, nothing is committed yet
    }
    if (opened->getSettings().grid != store.grid)
    {
        tell(store, "osgPagedTexture::VirtualPager: '" + store.path +
                        "' has another size now; load the model again to see it");
        return;
    }
    // Who asked for a region knows of one commit, not of others that came with it.
    const bool isOneStep = store.stamp.file == store.file && generation <= store.generation + 1;
    store.trouble.clear();
    store.file = store.stamp.file;
    store.generation = generation;
    Change change;
    change.id = id;
    change.store = std::move(opened);
    change.isAll = wish.isAll || !wish.isAsked || !isOneStep;
    change.regions = wish.regions;
    _changes.push_back(std::move(change));
}

bool StoreWatch::hasChange(std::uint32_t id) const
{
    return std::any_of(_changes.begin(), _changes.end(),
                       [&](const Change& change) { return change.id == id; });
}

void StoreWatch::tell(Store& store, const std::string& trouble)
{
    if (store.trouble != trouble)
    {
        store.trouble = trouble;
        _messages.push_back(trouble + " (what is shown stays)");
    }
}

std::vector<StoreWatch::Change> StoreWatch::takeChanges()
{
    const std::lock_guard<std::mutex> lock(_mutex);
    for (const Change& change : _changes)
    {
        _asked = _asked || _stores.at(change.id).wish.isAsked; // it had to wait for this
    }
    if (_asked)
    {
        _wake.notify_all();
    }
    return std::exchange(_changes, {});
}

bool StoreWatch::isBusy(std::uint32_t id) const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto store = _stores.find(id);
    return hasChange(id) || (store != _stores.end() && store->second.isAsked());
}

bool StoreWatch::isBusy() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return !_changes.empty() || std::any_of(_stores.begin(), _stores.end(),
                                            [](const auto& each) { return each.second.isAsked(); });
}

std::vector<std::string> StoreWatch::takeMessages()
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return std::exchange(_messages, {});
}

} // namespace osgPagedTexture
