// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>

namespace osgLabels
{

/// The frames that have been culled and may still be drawn. Numbers that such a frame may show mean
/// what they meant until it is over. Thread safe.
class FramesInFlight
{
public:
    /// A frame is in flight as long as its ticket lives.
    using Ticket = std::shared_ptr<const void>;

    Ticket begin()
    {
        std::lock_guard<std::mutex> lock(_mutex);
        dropEnded();
        const auto ticket = std::make_shared<const char>();
        _frames.push_back({++_last, ticket});
        return ticket;
    }
    /// The number of the last one that has begun; they count from 1.
    std::uint64_t getLast() const
    {
        std::lock_guard<std::mutex> lock(_mutex);
        return _last;
    }
    /// Whether that one and all before it are over.
    bool areOver(std::uint64_t number) const
    {
        std::lock_guard<std::mutex> lock(_mutex);
        dropEnded();
        return _frames.empty() || _frames.front().number > number;
    }

private:
    struct Frame
    {
        std::uint64_t number;
        std::weak_ptr<const void> ticket;
    };

    void dropEnded() const
    {
        while (!_frames.empty() && _frames.front().ticket.expired())
            _frames.pop_front();
    }

    mutable std::mutex _mutex;
    mutable std::deque<Frame> _frames;
    std::uint64_t _last = 0;
};

/// What has become free but may still be shown by a frame in flight. Not thread safe.
template <class T> class Retired
{
public:
    void add(T what, const FramesInFlight& frames)
    {
        _waiting.push_back({frames.getLast(), std::move(what)});
    }
    /// Calls `f` with all that no frame can show any more.
    template <class F> void release(const FramesInFlight& frames, F f)
    {
        for (; !_waiting.empty() && frames.areOver(_waiting.front().frame); _waiting.pop_front())
            f(_waiting.front().what);
    }
    void clear() { _waiting.clear(); }

private:
    struct Waiting
    {
        std::uint64_t frame;
        T what;
    };
    std::deque<Waiting> _waiting;
};

} // namespace osgLabels
