// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>

namespace osgPagedTexture
{

/// Bytes that threads hold at once, at most a limit: who needs more waits, first come first served.
/// Who needs more than the limit holds it alone. Any thread; outlives its reservations.
class OSGPAGEDTEXTURE_EXPORT MemoryBudget
{
public:
    /// Bytes held until it goes. Move only.
    class OSGPAGEDTEXTURE_EXPORT Reservation
    {
    public:
        Reservation() = default;
        Reservation(Reservation&& other) noexcept;
        Reservation& operator=(Reservation&& other) noexcept;
        ~Reservation() { change(0); }

        /// Holds another number of bytes from now on, without waiting: for less than before.
        void change(std::uint64_t bytes);

        explicit operator bool() const { return _budget != nullptr; }

    private:
        friend class MemoryBudget;
        MemoryBudget* _budget = nullptr;
        std::uint64_t _bytes = 0;
    };

    explicit MemoryBudget(std::uint64_t limitBytes) : _limit(limitBytes) {}

    /// Waits until the bytes fit; empty where `cancelled` became true first. A thread that holds a
    /// reservation must not ask for another.
    Reservation reserve(std::uint64_t bytes, const std::atomic<bool>& cancelled);

    std::uint64_t getHeld() const;
    std::uint64_t getPeak() const;

private:
    void change(std::uint64_t oldBytes, std::uint64_t newBytes);

    const std::uint64_t _limit;
    mutable std::mutex _mutex;
    std::condition_variable _changed;
    std::deque<std::uint64_t> _queue; ///< Who waits, by number.
    std::uint64_t _lastNumber = 0;
    std::uint64_t _held = 0;
    std::uint64_t _peak = 0;
};

} // namespace osgPagedTexture
