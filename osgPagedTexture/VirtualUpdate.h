// SPDX-License-Identifier: MIT
// Tile stores that a viewer itself brings up to date. Not installed.
#pragma once

#include <functional>
#include <future>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// Brings tile stores up to date with the photographs they were built from, in a thread of its own
/// beside the frames. Thread safe.
class VirtualUpdate
{
public:
    /// Waits for the store that is written just now.
    ~VirtualUpdate();

    /// Updates those of the stores that know their photographs as updateTileStore() does, and says
    /// what was done. Then, and at once for those that know none, calls `afterwards`, from its
    /// thread. Asked for again meanwhile, it does it again.
    void start(const std::vector<std::string>& stores,
               const std::function<void(const std::string& store)>& afterwards);

    bool isRunning() const;

private:
    void run(const std::function<void(const std::string& store)>& afterwards);
    /// The next store; empty, and no longer running, where there is none.
    std::string next();

    mutable std::mutex _mutex;
    std::set<std::string> _due;
    bool _isRunning = false;
    std::future<void> _thread;
};

} // namespace osgPagedTexture
