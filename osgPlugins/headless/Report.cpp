// SPDX-License-Identifier: MIT
#include "Report.h"

#include <osg/Notify>

#include <mutex>
#include <set>

namespace osgHeadless
{

void reportOnce(const Backend& backend, const std::string& error)
{
    static auto* mutex = new std::mutex;
    static auto* reported = new std::set<std::string>; // never destroyed: Coin may ask at exit
    std::lock_guard<std::mutex> lock(*mutex);
    if (reported->insert(error).second)
    {
        OSG_WARN << backend.getPluginName() << ": " << error << std::endl;
    }
}

} // namespace osgHeadless
