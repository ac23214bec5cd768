// SPDX-License-Identifier: MIT
// Memory that takes too long for a frame. Not installed.
#pragma once

#include <osgPagedTexture/SharedContext.h>
#include <osgPagedTexture/TextureStorage.h>

#include <osg/ref_ptr>

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace osgPagedTexture
{

/// Makes the memory of textures in a thread and a context of its own, and gives back that of
/// chains.
///
/// A driver that clears what it allocates takes longer for one texture than a frame may: llvmpipe
/// 0.7 ms a MiB, which is 30 ms for 8192 x 8192 texels of BC1. Memory of 45 MiB goes back to the
/// system in 2 ms. All but the constructor may be called from any thread.
class StorageThread
{
public:
    using Ticket = std::uint64_t;

    /// What has become of an order.
    struct Result
    {
        GLuint name = 0;           ///< 0: GL has no memory for it, or isUsable() is false.
        double milliseconds = 0.0; ///< CPU time that it took.
    };

    /// `gl` is that of the context with which textures are shared.
    StorageThread(std::unique_ptr<SharedContext> context, osg::ref_ptr<osg::GLExtensions> gl);

    /// Waits for the texture in the making. Textures that nobody has taken go.
    ~StorageThread();

    /// False when it has turned out that the thread can't use its context.
    bool isUsable() const;

    /// The ticket is not 0.
    Ticket order(const TextureSize& size);

    /// Nothing while it is in the making; the texture is the caller's.
    std::optional<Result> take(Ticket ticket);

    /// Nobody will take it.
    void cancel(Ticket ticket);

    /// Ends in the thread, if it is the last owner.
    void drop(std::shared_ptr<const void> memory);

private:
    struct Order
    {
        Ticket ticket;
        TextureSize size;
    };

    void work();
    void giveBack(std::unique_lock<std::mutex>& lock);
    void make(const Order& order, std::unique_lock<std::mutex>& lock);

    const std::unique_ptr<SharedContext> _context;
    const osg::ref_ptr<osg::GLExtensions> _gl;
    mutable std::mutex _mutex; ///< Of all that follows.
    std::condition_variable _changed;
    std::deque<Order> _orders;
    std::map<Ticket, Result> _results;
    std::vector<GLuint> _unwanted;
    std::vector<std::shared_ptr<const void>> _dropped;
    Ticket _last = 0;
    Ticket _making = 0;
    bool _isMakingUnwanted = false;
    bool _isUsable = true;
    bool _ends = false;
    std::thread _thread;
};

} // namespace osgPagedTexture
