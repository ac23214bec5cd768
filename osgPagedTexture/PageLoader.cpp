// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PageLoader.h>

#include <algorithm>
#include <chrono>
#include <iterator>

namespace osgPagedTexture
{

namespace
{

std::string nameOfPage(const PageRequest& request)
{
    const PageKey& page = request.page.page;
    return "'" + request.name + "': tile " + std::to_string(page.x) + ", " +
           std::to_string(page.y) + " of level " + std::to_string(page.level);
}

ContentHash sourceOf(const TileData& tile)
{
    switch (tile.kind)
    {
    case TileData::Kind::None:
        return hashText("nothing");
    case TileData::Kind::Uniform:
        return hashText("uniform " + std::string(tile.color.begin(), tile.color.end()));
    default:
        return hashText(tile.bytes);
    }
}

PageResult load(const PageRequest& request, std::uint64_t& bytesRead)
{
    PageResult result;
    result.page = request.page;
    try
    {
        const TileKey key = request.page.page.tile();
        const TileData tile = request.store->read(key);
        bytesRead = tile.bytes.size();
        result.loaded.source = sourceOf(tile);
        if (result.loaded.source == request.known)
        {
            result.state = PageResult::State::Unchanged;
            return result;
        }
        result.loaded.texels = std::make_shared<const PageTexels>(makePage(
            tile, request.store->getSettings().grid, key, request.format, nameOfPage(request)));
        result.state = PageResult::State::Loaded;
    }
    catch (const TileStoreError& error)
    {
        result.error = error.what();
        result.mayPass = error.getKind() == TileStoreError::Kind::Unreadable;
    }
    catch (const std::exception& error)
    {
        result.error = "osgPagedTexture::VirtualPager: " + nameOfPage(request) +
                       " cannot be read: " + error.what();
    }
    return result;
}

} // namespace

PageLoader::PageLoader(unsigned int threads) : _pool(threads) {}

PageLoader::~PageLoader()
{
    _pool.stop();
}

void PageLoader::request(const PageRequest& request)
{
    const JobPriority priority{request.page.page.level, request.priority};
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto known = _jobs.find(request.page);
    if (known != _jobs.end())
    {
        _pool.setPriority(known->second, priority);
        return;
    }
    if (_results.capacity() <= _jobs.size()) // a worker finds room, whatever memory is left
    {
        _results.reserve(2 * _jobs.size() + 16);
    }
    _jobs[request.page] = 0;
    try
    {
        _jobs[request.page] =
            _pool.submit(priority, [this, request](const std::atomic<bool>& cancelled)
                         { run(request, cancelled); });
    }
    catch (...) // nobody would ever end it
    {
        _jobs.erase(request.page);
        throw;
    }
    ++_statistics.requests;
}

void PageLoader::run(const PageRequest& request, const std::atomic<bool>& cancelled)
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    std::uint64_t bytesRead = 0;
    PageResult result = load(request, bytesRead);

    const std::lock_guard<std::mutex> lock(_mutex);
    _statistics.bytesRead += bytesRead;
    _statistics.busySeconds += std::chrono::duration<double>(Clock::now() - start).count();
    if (cancelled)
    {
        return;
    }
    switch (result.state)
    {
    case PageResult::State::Loaded:
        ++_statistics.loaded;
        break;
    case PageResult::State::Unchanged:
        ++_statistics.unchanged;
        break;
    case PageResult::State::Failed:
        ++_statistics.failed;
        break;
    }
    _results.push_back(std::move(result));
    _finished.notify_all();
}

bool PageLoader::isRequested(const PageVersion& page) const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return _jobs.count(page) != 0;
}

void PageLoader::cancel(const PageVersion& page)
{
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _jobs.find(page);
    if (found == _jobs.end())
    {
        return;
    }
    _pool.cancel(found->second);
    _jobs.erase(found);
    for (auto result = _results.begin(); result != _results.end(); ++result)
    {
        if (result->page == page)
        {
            _results.erase(result);
            break;
        }
    }
    ++_statistics.cancelled;
    _finished.notify_all();
}

std::vector<PageResult> PageLoader::poll(std::size_t count)
{
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto end = _results.begin() + std::ptrdiff_t(std::min(count, _results.size()));
    std::vector<PageResult> taken(std::make_move_iterator(_results.begin()),
                                  std::make_move_iterator(end));
    _results.erase(_results.begin(), end);
    for (const PageResult& result : taken)
    {
        _jobs.erase(result.page);
    }
    return taken;
}

void PageLoader::wait(double seconds) const
{
    std::unique_lock<std::mutex> lock(_mutex);
    _finished.wait_for(lock, std::chrono::duration<double>(seconds),
                       [&] { return !_results.empty() || _jobs.empty(); });
}

PageLoader::Statistics PageLoader::getStatistics() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    Statistics statistics = _statistics;
    statistics.waiting = _jobs.size();
    return statistics;
}

} // namespace osgPagedTexture
