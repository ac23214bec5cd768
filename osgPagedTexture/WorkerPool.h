// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace osgPagedTexture
{

/// Threads that run jobs, the highest priority first, equal ones in the order they came. No thread
/// exists before the first job. Any thread may call it.
class OSGPAGEDTEXTURE_EXPORT WorkerPool
{
public:
    using JobId = std::uint64_t;
    /// `cancelled` becomes true where the job is no longer wanted: it should end soon then.
    using Job = std::function<void(const std::atomic<bool>& cancelled)>;

    /// 0 threads: one less than the machine has, at least one.
    explicit WorkerPool(unsigned int threads = 0);

    /// Drops the jobs that wait, cancels those that run and waits for their end.
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    /// Adds a job, which must not throw. Ids start at 1 and are never used twice.
    JobId submit(double priority, Job job);

    /// Adds a job that no thread takes before `delaySeconds` have passed.
    JobId submitLater(double delaySeconds, double priority, Job job);

    /// Changes the priority of a job that waits; else does nothing.
    void setPriority(JobId id, double priority);

    /// Removes a job that waits and returns true; tells one that runs and returns false.
    bool cancel(JobId id);

    std::size_t getWaitingCount() const;
    unsigned int getThreadCount() const; ///< That exist now.

private:
    using Clock = std::chrono::steady_clock;
    struct Waiting
    {
        double priority;
        Job job;
        Clock::time_point due; ///< Already in the past for most.
    };
    /// Highest priority first, then the oldest.
    using Order = std::set<std::pair<double, JobId>>;
    void run();
    void wakeDueJobs(Clock::time_point now);
    void startThreads();
    bool takeJob(std::unique_lock<std::mutex>& lock, JobId& id, Job& job);

    const unsigned int _threadCount;
    mutable std::mutex _mutex;
    std::condition_variable _changed;
    std::map<JobId, Waiting> _waiting;
    Order _order;                                       ///< {-priority, id} of those that are due.
    std::set<std::pair<Clock::time_point, JobId>> _due; ///< Of the others.
    std::map<JobId, std::shared_ptr<std::atomic<bool>>> _running;
    std::vector<std::thread> _threads;
    JobId _lastId = 0;
    bool _stopping = false;
};

} // namespace osgPagedTexture
