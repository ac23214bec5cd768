// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <tuple>
#include <vector>

namespace osgPagedTexture
{

/// The higher rank goes first, then the higher value.
struct JobPriority
{
    int rank = 0;
    double value = 0.0;
};

/// Threads that run jobs, the highest priority first, equal ones in the order they came. No thread
/// exists before the first job. Any thread may call it.
class OSGPAGEDTEXTURE_EXPORT WorkerPool
{
public:
    using JobId = std::uint64_t;
    /// `cancelled` becomes true where the job is no longer wanted: it should end soon then. Must
    /// not throw.
    using Job = std::function<void(const std::atomic<bool>& cancelled)>;

    /// 0 threads: one less than the machine has, at least one.
    explicit WorkerPool(unsigned int threads = 0);

    /// Drops the jobs that wait, cancels those that run and waits for their end.
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    /// Adds a job that no thread takes before `delaySeconds` have passed. Ids start at 1 and are
    /// never used twice. Throws std::system_error or std::bad_alloc where not even one thread can
    /// be made.
    JobId submit(JobPriority priority, Job job, double delaySeconds = 0.0);

    /// Changes the priority of a job that waits; else does nothing.
    void setPriority(JobId id, JobPriority priority);

    /// Removes a job that waits and returns true; tells one that runs and returns false.
    bool cancel(JobId id);

    /// Ends as the destructor does; jobs that come later are dropped.
    void stop();

    std::size_t getWaitingCount() const;
    std::size_t getThreadCount() const; ///< That exist now.

private:
    using Clock = std::chrono::steady_clock;
    /// A job that waits or runs. Threads make nothing anew: there may be no memory for it.
    struct Entry
    {
        JobPriority priority;
        Job job;               ///< Empty while it runs.
        Clock::time_point due; ///< The past for jobs without delay.
        bool delayed = false;
        bool running = false;
        std::atomic<bool> cancelled{false};
    };
    using Rank = std::tuple<int, double, JobId>; ///< Smallest first.
    using Due = std::pair<Clock::time_point, JobId>;

    static Rank rankOf(const Entry& entry, JobId id);
    void enter(JobId id, Entry& entry, double delaySeconds);
    void addThread();
    void run();
    void moveDueJobs();
    void waitForJob(std::unique_lock<std::mutex>& lock);

    const std::size_t _threadCount;
    mutable std::mutex _mutex;
    std::condition_variable _changed;
    std::map<JobId, Entry> _jobs;
    std::size_t _running = 0; ///< Of _jobs.
    std::set<Rank> _ready;
    std::set<Due> _delayed;
    std::vector<std::thread> _threads;
    JobId _lastId = 0;
    bool _stopping = false;
};

} // namespace osgPagedTexture
