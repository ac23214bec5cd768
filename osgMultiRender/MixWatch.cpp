// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixWatch.h>

#include <osgMultiRender/AllCores.h>

#include <osgMultiRender/ImportFile.h>

namespace osgMultiRender
{

MixWatch::MixWatch(std::function<Files()> filesOf, std::function<void(const Files&)> changed,
                   std::chrono::milliseconds period)
    : _filesOf(std::move(filesOf)), _changed(std::move(changed))
{
    look(); // as they are now
    _thread = std::thread(
        [this, period]
        {
            useAllCores();
            run(period);
        });
}

MixWatch::~MixWatch()
{
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _ends = true;
    }
    _wake.notify_all();
    _thread.join();
}

void MixWatch::run(std::chrono::milliseconds period)
{
    std::unique_lock<std::mutex> lock(_mutex);
    while (!_wake.wait_for(lock, period, [this] { return _ends; }))
    {
        lock.unlock();
        if (const Files files = look(); !files.empty())
            _changed(files);
        lock.lock();
    }
}

MixWatch::Files MixWatch::look()
{
    Files changed;
    std::map<std::string, Seen> seen;
    for (const std::string& file : _filesOf())
    {
        if (seen.count(file))
            continue;
        const auto before = _seen.find(file);
        std::error_code timeError, sizeError;
        Seen now;
        now.time = std::filesystem::last_write_time(file, timeError);
        now.size = std::filesystem::file_size(file, sizeError);
        std::string text, error;
        if (before != _seen.end() &&
            (timeError || sizeError ||
             (now.time == before->second.time && now.size == before->second.size)))
            now = before->second;
        else if (!timeError && !sizeError)
        {
            // Of what is too large to be read (images) time and size decide.
            const bool isRead = readTextFile(file, text, error);
            now.content = std::hash<std::string>()(text);
            if (before != _seen.end() && (!isRead || now.content != before->second.content))
                changed.push_back(file);
        }
        seen.emplace(file, std::move(now));
    }
    _seen = std::move(seen);
    return changed;
}

} // namespace osgMultiRender
