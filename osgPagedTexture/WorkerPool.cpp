// SPDX-License-Identifier: MIT
#include <osgPagedTexture/WorkerPool.h>

#include <osgMultiRender/AllCores.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <new>
#include <utility>

namespace osgPagedTexture
{

WorkerPool::WorkerPool(unsigned int threads)
    : _threadCount(threads ? threads : std::max(2u, std::thread::hardware_concurrency()) - 1)
{
}

WorkerPool::~WorkerPool()
{
    stop();
}

void WorkerPool::stop()
{
    std::vector<std::thread> threads;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _stopping = true;
        _ready.clear();
        _delayed.clear();
        for (auto at = _jobs.begin(); at != _jobs.end();)
        {
            at->second.cancelled = true;
            at = at->second.running ? std::next(at) : _jobs.erase(at);
        }
        threads.swap(_threads);
    }
    _changed.notify_all();
    for (std::thread& thread : threads)
    {
        thread.join();
    }
}

WorkerPool::Rank WorkerPool::rankOf(const Entry& entry, JobId id)
{
    return {-entry.priority.rank, -entry.priority.value, id};
}

WorkerPool::JobId WorkerPool::submit(JobPriority priority, Job job, double delaySeconds)
{
    JobId id;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        id = ++_lastId;
        if (_stopping)
        {
            return id;
        }
        Entry& entry = _jobs[id];
        entry.priority = priority;
        entry.job = std::move(job);
        try
        {
            enter(id, entry, delaySeconds);
            addThread();
        }
        catch (...) // nobody would ever take it
        {
            _ready.erase(rankOf(entry, id));
            _delayed.erase({entry.due, id});
            _jobs.erase(id);
            throw;
        }
    }
    _changed.notify_one();
    return id;
}

void WorkerPool::enter(JobId id, Entry& entry, double delaySeconds)
{
    entry.delayed = delaySeconds > 0.0;
    if (!entry.delayed)
    {
        _ready.insert(rankOf(entry, id));
        return;
    }
    entry.due = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(delaySeconds));
    _delayed.insert({entry.due, id});
}

/// Where the system has no thread to give, those that are there do the work.
void WorkerPool::addThread()
{
    if (_threads.size() == _threadCount)
    {
        return;
    }
    try
    {
        _threads.emplace_back(
            [this]
            {
                osgMultiRender::useAllCores();
                run();
            });
    }
    catch (const std::exception&) // of memory or of threads
    {
        if (_threads.empty())
        {
            throw;
        }
    }
}

void WorkerPool::setPriority(JobId id, JobPriority priority)
{
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _jobs.find(id);
    if (found == _jobs.end() || found->second.running)
    {
        return;
    }
    auto place = _ready.extract(rankOf(found->second, id));
    found->second.priority = priority;
    if (place)
    {
        place.value() = rankOf(found->second, id);
        _ready.insert(std::move(place));
    }
}

bool WorkerPool::cancel(JobId id)
{
    Job dropped; // destroyed after the lock: what it holds may call back
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _jobs.find(id);
    if (found == _jobs.end())
    {
        return false;
    }
    if (found->second.running)
    {
        found->second.cancelled = true;
        return false;
    }
    _ready.erase(rankOf(found->second, id));
    _delayed.erase({found->second.due, id});
    dropped = std::move(found->second.job);
    _jobs.erase(found);
    return true;
}

std::size_t WorkerPool::getWaitingCount() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return _jobs.size() - _running;
}

std::size_t WorkerPool::getThreadCount() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return _threads.size();
}

/// Those for which there is no memory are due still.
void WorkerPool::moveDueJobs()
{
    const auto now = Clock::now();
    try
    {
        while (!_delayed.empty() && _delayed.begin()->first <= now)
        {
            const JobId id = _delayed.begin()->second;
            _ready.insert(rankOf(_jobs.at(id), id));
            _delayed.erase(_delayed.begin());
        }
    }
    catch (const std::bad_alloc&)
    {
    }
}

void WorkerPool::waitForJob(std::unique_lock<std::mutex>& lock)
{
    for (moveDueJobs(); !_stopping && _ready.empty(); moveDueJobs())
    {
        if (_delayed.empty())
        {
            _changed.wait(lock);
        }
        else
        {
            const auto due = _delayed.begin()->first; // a copy: the set may change meanwhile
            _changed.wait_until(lock, due);
        }
    }
}

void WorkerPool::run()
{
    std::unique_lock<std::mutex> lock(_mutex);
    for (waitForJob(lock); !_stopping; waitForJob(lock))
    {
        const JobId id = std::get<JobId>(*_ready.begin());
        _ready.erase(_ready.begin());
        Entry& entry = _jobs.at(id);
        Job job = std::move(entry.job);
        entry.running = true;
        ++_running;
        lock.unlock();
        job(entry.cancelled);
        job = nullptr; // what it holds goes without the lock
        lock.lock();
        --_running;
        _jobs.erase(id);
    }
}

} // namespace osgPagedTexture
