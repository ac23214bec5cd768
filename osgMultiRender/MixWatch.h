// SPDX-License-Identifier: MIT
// Looks after files of renderings in a thread of its own. Not installed.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace osgMultiRender
{

/// Calls back when a file has other contents than before.
///
/// Looks at times and sizes each `period`, and reads a file only when these have changed; a file
/// that is written anew with the same contents is none that has changed. One that is away for a
/// while (editors rename) is waited for. The callbacks come from the thread of the watch, which the
/// destructor waits for.
class MixWatch
{
public:
    using Files = std::vector<std::string>;

    /// `filesOf` says what to look after, each time anew; `changed` gets which of them have.
    MixWatch(std::function<Files()> filesOf, std::function<void(const Files&)> changed,
             std::chrono::milliseconds period);
    ~MixWatch();
    MixWatch(const MixWatch&) = delete;
    MixWatch& operator=(const MixWatch&) = delete;

private:
    struct Seen
    {
        std::filesystem::file_time_type time;
        std::uintmax_t size = 0;
        std::size_t content = 0; ///< Of what is in it.
    };

    void run(std::chrono::milliseconds period);
    Files look();

    std::function<Files()> _filesOf;
    std::function<void(const Files&)> _changed;
    std::map<std::string, Seen> _seen;
    std::mutex _mutex;
    std::condition_variable _wake;
    bool _ends = false;
    std::thread _thread; ///< Last: it uses all others.
};

} // namespace osgMultiRender
