// SPDX-License-Identifier: MIT
#include <osgPagedTexture/CoreTeam.h>

#include <osgMultiRender/AllCores.h>

#include <algorithm>
#include <utility>

namespace osgPagedTexture
{

CoreTeam::CoreTeam(unsigned int size)
{
    const unsigned int members =
        size > 0 ? size : std::max(1u, std::thread::hardware_concurrency());
    try
    {
        for (unsigned int member = 1; member < members; ++member)
        {
            _threads.emplace_back(
                [this, member]()
                {
                    osgMultiRender::useAllCores();
                    help(member);
                });
        }
    }
    catch (const std::exception&) // of memory or of threads: those that are there do the work
    {
    }
}

CoreTeam::~CoreTeam()
{
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _stopping = true;
    }
    _begun.notify_all();
    for (std::thread& thread : _threads)
    {
        thread.join();
    }
}

void CoreTeam::takeParts(unsigned int member, std::unique_lock<std::mutex>& lock)
{
    while (_next < _count)
    {
        const std::size_t part = _next++;
        ++_busy;
        lock.unlock();
        std::exception_ptr failure;
        try
        {
            (*_work)(part, member);
        }
        catch (...)
        {
            failure = std::current_exception();
        }
        lock.lock();
        --_busy;
        if (failure && (!_failure || part < _failedPart))
        {
            _failure = failure;
            _failedPart = part;
            _count = std::min(_count, _next);
        }
    }
}

void CoreTeam::help(unsigned int member)
{
    std::unique_lock<std::mutex> lock(_mutex);
    while (!_stopping)
    {
        takeParts(member, lock);
        if (_busy == 0)
        {
            _ended.notify_one();
        }
        _begun.wait(lock, [this]() { return _stopping || _next < _count; });
    }
}

void CoreTeam::run(std::size_t count, const Work& work)
{
    std::unique_lock<std::mutex> lock(_mutex);
    _work = &work;
    _next = 0;
    _count = count;
    _failure = nullptr;
    if (count > 1)
    {
        _begun.notify_all();
    }
    takeParts(0, lock);
    _ended.wait(lock, [this]() { return _busy == 0; });
    _work = nullptr;
    if (_failure)
    {
        std::rethrow_exception(std::exchange(_failure, nullptr));
    }
}

} // namespace osgPagedTexture
