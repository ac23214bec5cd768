// SPDX-License-Identifier: MIT
#include <osgPagedTexture/MemoryBudget.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace osgPagedTexture
{

MemoryBudget::Reservation::Reservation(Reservation&& other) noexcept
    : _budget(std::exchange(other._budget, nullptr)), _bytes(std::exchange(other._bytes, 0))
{
}

MemoryBudget::Reservation& MemoryBudget::Reservation::operator=(Reservation&& other) noexcept
{
    if (this != &other)
    {
        change(0);
        _budget = std::exchange(other._budget, nullptr);
        _bytes = std::exchange(other._bytes, 0);
    }
    return *this;
}

void MemoryBudget::Reservation::change(std::uint64_t bytes)
{
    if (_budget)
    {
        _budget->change(_bytes, bytes);
        _bytes = bytes;
    }
}

MemoryBudget::Reservation MemoryBudget::reserve(std::uint64_t bytes,
                                                const std::atomic<bool>& cancelled)
{
    // A flag wakes nobody, so it is looked at from time to time.
    constexpr auto glance = std::chrono::milliseconds(20);
    std::unique_lock<std::mutex> lock(_mutex);
    const std::uint64_t number = ++_lastNumber;
    _queue.push_back(number);
    const auto fits = [&]
    { return _queue.front() == number && (_held == 0 || _held + bytes <= _limit); };
    while (!fits() && !cancelled)
    {
        _changed.wait_for(lock, glance);
    }
    Reservation reservation;
    if (fits() && !cancelled)
    {
        reservation._budget = this;
        reservation._bytes = bytes;
        _held += bytes;
        _peak = std::max(_peak, _held);
    }
    _queue.erase(std::find(_queue.begin(), _queue.end(), number));
    lock.unlock();
    _changed.notify_all();
    return reservation;
}

void MemoryBudget::change(std::uint64_t oldBytes, std::uint64_t newBytes)
{
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _held = _held - oldBytes + newBytes;
        _peak = std::max(_peak, _held);
    }
    _changed.notify_all();
}

std::uint64_t MemoryBudget::getHeld() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return _held;
}

std::uint64_t MemoryBudget::getPeak() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return _peak;
}

} // namespace osgPagedTexture
