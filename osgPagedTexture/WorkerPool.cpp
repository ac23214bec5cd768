// SPDX-License-Identifier: MIT
#include <osgPagedTexture/WorkerPool.h>

#include <algorithm>
#include <exception>
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
        _waiting.clear();
        _ready.clear();
        _delayed.clear();
        for (auto& [id, cancelled] : _running)
        {
            *cancelled = true;
        }
        threads.swap(_threads);
    }
    _changed.notify_all();
    for (std::thread& thread : threads)
    {
        thread.join();
    }
}

WorkerPool::Rank WorkerPool::rankOf(const Waiting& waiting, JobId id)
{
    return {-waiting.priority.rank, -waiting.priority.value, id};
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
        Waiting waiting{priority, std::move(job), {}, delaySeconds > 0.0};
        if (waiting.delayed)
        {
            waiting.due = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                             std::chrono::duration<double>(delaySeconds));
            _delayed.insert({waiting.due, id});
        }
        else
        {
            _ready.insert(rankOf(waiting, id));
        }
        _waiting.emplace(id, std::move(waiting));
        addThread();
    }
    _changed.notify_one();
    return id;
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
        _threads.emplace_back([this] { run(); });
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
    const auto found = _waiting.find(id);
    if (found == _waiting.end())
    {
        return;
    }
    const bool ready = _ready.erase(rankOf(found->second, id)) > 0;
    found->second.priority = priority;
    if (ready)
    {
        _ready.insert(rankOf(found->second, id));
    }
}

bool WorkerPool::cancel(JobId id)
{
    Job dropped; // destroyed after the lock: what it holds may call back
    const std::lock_guard<std::mutex> lock(_mutex);
    if (const auto found = _waiting.find(id); found != _waiting.end())
    {
        _ready.erase(rankOf(found->second, id));
        _delayed.erase({found->second.due, id});
        dropped = std::move(found->second.job);
        _waiting.erase(found);
        return true;
    }
    if (const auto found = _running.find(id); found != _running.end())
    {
        *found->second = true;
    }
    return false;
}

std::size_t WorkerPool::getWaitingCount() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return _waiting.size();
}

std::size_t WorkerPool::getThreadCount() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return _threads.size();
}

void WorkerPool::moveDueJobs()
{
    const auto now = Clock::now();
    while (!_delayed.empty() && _delayed.begin()->first <= now)
    {
        const JobId id = _delayed.begin()->second;
        _delayed.erase(_delayed.begin());
        _ready.insert(rankOf(_waiting.at(id), id));
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
        const auto found = _waiting.find(id);
        Job job = std::move(found->second.job);
        _waiting.erase(found);
        const auto cancelled = std::make_shared<std::atomic<bool>>(false);
        _running[id] = cancelled;
        lock.unlock();
        job(*cancelled);
        job = nullptr; // what it holds goes without the lock
        lock.lock();
        _running.erase(id);
    }
}

} // namespace osgPagedTexture
