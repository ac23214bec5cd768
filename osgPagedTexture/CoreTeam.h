// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace osgPagedTexture
{

/// Threads that share the parts of a piece of work, the caller's among them.
class OSGPAGEDTEXTURE_EXPORT CoreTeam
{
public:
    /// `member` is 0 to getSize() - 1: what belongs to it no other thread uses meanwhile.
    using Work = std::function<void(std::size_t part, unsigned int member)>;

    /// 0: as many as the machine has cores; fewer where the system has no more threads to give.
    explicit CoreTeam(unsigned int size = 0);
    ~CoreTeam();
    CoreTeam(const CoreTeam&) = delete;
    CoreTeam& operator=(const CoreTeam&) = delete;

    unsigned int getSize() const { return static_cast<unsigned int>(_threads.size()) + 1; }

    /// Does the parts 0 to count - 1, begun in this order, and returns when all are done. Rethrows
    /// the exception of the first part that has one; the parts after it may be left out.
    void run(std::size_t count, const Work& work);

private:
    void help(unsigned int member);
    void takeParts(unsigned int member, std::unique_lock<std::mutex>& lock);

    std::mutex _mutex;
    std::condition_variable _begun, _ended;
    const Work* _work = nullptr;
    std::size_t _next = 0, _count = 0, _busy = 0;
    std::size_t _failedPart = 0;
    std::exception_ptr _failure;
    bool _stopping = false;
    std::vector<std::thread> _threads;
};

} // namespace osgPagedTexture
