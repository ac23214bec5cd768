// SPDX-License-Identifier: MIT
#include <osgPagedTexture/StorageThread.h>

#include <osgMultiRender/AllCores.h>

#include <osgPagedTexture/ThreadClock.h>

#include <algorithm>
#include <utility>

namespace osgPagedTexture
{

StorageThread::StorageThread(std::unique_ptr<SharedContext> context,
                             osg::ref_ptr<osg::GLExtensions> gl)
    : _context(std::move(context)), _gl(std::move(gl)), _thread(
                                                            [this]
                                                            {
                                                                osgMultiRender::useAllCores();
                                                                work();
                                                            })
{
}

StorageThread::~StorageThread()
{
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _ends = true;
    }
    _changed.notify_all();
    _thread.join();
}

bool StorageThread::isUsable() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _isUsable;
}

StorageThread::Ticket StorageThread::order(const TextureSize& size)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const Ticket ticket = ++_last;
    if (_isUsable)
        _orders.push_back({ticket, size});
    else
        _results[ticket];
    _changed.notify_all();
    return ticket;
}

std::optional<StorageThread::Result> StorageThread::take(Ticket ticket)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _results.find(ticket);
    if (found == _results.end())
        return std::nullopt;
    const Result result = found->second;
    _results.erase(found);
    return result;
}

void StorageThread::cancel(Ticket ticket)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _orders.erase(std::remove_if(_orders.begin(), _orders.end(),
                                 [ticket](const Order& order) { return order.ticket == ticket; }),
                  _orders.end());
    _isMakingUnwanted = _isMakingUnwanted || _making == ticket;
    const auto found = _results.find(ticket);
    if (found == _results.end())
        return;
    _unwanted.push_back(found->second.name);
    _results.erase(found);
    _changed.notify_all();
}

void StorageThread::drop(std::shared_ptr<const void> memory)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_isUsable)
        return;
    _dropped.push_back(std::move(memory));
    _changed.notify_all();
}

/// Nobody waits for the lock meanwhile.
void StorageThread::giveBack(std::unique_lock<std::mutex>& lock)
{
    const std::vector<GLuint> unwanted = std::exchange(_unwanted, {});
    std::vector<std::shared_ptr<const void>> dropped = std::exchange(_dropped, {});
    lock.unlock();
    if (!unwanted.empty())
        glDeleteTextures(GLsizei(unwanted.size()), unwanted.data());
    dropped.clear();
    lock.lock();
}

void StorageThread::work()
{
    const bool isCurrent = _context->makeCurrent();
    std::unique_lock<std::mutex> lock(_mutex);
    _isUsable = isCurrent;
    for (; !_isUsable && !_orders.empty(); _orders.pop_front())
        _results[_orders.front().ticket];
    if (!_isUsable)
        _dropped.clear();
    while (_isUsable && !_ends)
    {
        if (!_unwanted.empty() || !_dropped.empty())
        {
            giveBack(lock);
            continue;
        }
        if (_orders.empty())
        {
            _changed.wait(lock);
            continue;
        }
        const Order order = _orders.front();
        _orders.pop_front();
        make(order, lock);
    }
    for (const auto& each : _results)
        _unwanted.push_back(each.second.name);
    if (isCurrent)
    {
        glDeleteTextures(GLsizei(_unwanted.size()), _unwanted.data());
        _context->release();
    }
}

void StorageThread::make(const Order& order, std::unique_lock<std::mutex>& lock)
{
    _making = order.ticket;
    _isMakingUnwanted = false;
    lock.unlock();
    const double start = threadMilliseconds();
    const GLuint name = makeStorage(*_gl, order.size);
    glBindTexture(GL_TEXTURE_2D, 0);
    glFinish(); // Another context sees what is complete here.
    const double end = threadMilliseconds();
    lock.lock();
    _making = 0;
    if (_isMakingUnwanted)
        _unwanted.push_back(name);
    else
        _results[order.ticket] = {name, end - start};
}

} // namespace osgPagedTexture
