// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualUpdate.h>

#include <osgMultiRender/AllCores.h>

#include <osgPagedTexture/TileUpdate.h>

#include <osg/Notify>

namespace osgPagedTexture
{

namespace
{

/// Whether it is a packed store that says which photographs it was built from.
bool knowsPhotographs(const std::string& store)
{
    try
    {
        TileStoreOrigin::parse(TilePackReader(store).getSettings().description);
        return true;
    }
    catch (const TileStoreError&)
    {
        return false;
    }
}

void updateStore(const std::string& store)
{
    // Where photographs are not at hand the store is still good to look at.
    TileUpdateSettings settings;
    settings.keepMissing = true;
    try
    {
        const TileUpdateReport done = updateTileStore(store, settings);
        OSG_NOTICE << "osgPagedTexture::VirtualScene: '" << store << "': " << done.changed
                   << " photographs changed, " << done.added << " added, " << done.removed
                   << " removed, " << done.moved << " moved; " << done.changedTiles
                   << " tiles are new" << std::endl;
        for (const auto* lines : {&done.notes, &done.failures})
            for (const std::string& line : *lines)
                OSG_WARN << "osgPagedTexture::VirtualScene: " << line << std::endl;
    }
    catch (const TileStoreError& error)
    {
        OSG_WARN << "osgPagedTexture::VirtualScene: " << error.what() << "; it stays as it is"
                 << std::endl;
    }
}

} // namespace

VirtualUpdate::~VirtualUpdate()
{
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _due.clear();
    }
    if (_thread.valid())
        _thread.wait();
}

void VirtualUpdate::start(const std::vector<std::string>& stores,
                          const std::function<void(const std::string& store)>& afterwards)
{
    std::vector<std::string> others;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        for (const std::string& store : stores)
        {
            if (knowsPhotographs(store))
                _due.insert(store);
            else
                others.push_back(store);
        }
        if (!_due.empty() && !_isRunning)
        {
            _isRunning = true;
            _thread = std::async(std::launch::async,
                                 [this, afterwards]
                                 {
                                     osgMultiRender::useAllCores();
                                     run(afterwards);
                                 });
        }
    }
    for (const std::string& store : others)
        afterwards(store);
}

bool VirtualUpdate::isRunning() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _isRunning;
}

void VirtualUpdate::run(const std::function<void(const std::string& store)>& afterwards)
{
    for (std::string store = next(); !store.empty(); store = next())
    {
        updateStore(store);
        afterwards(store);
    }
}

std::string VirtualUpdate::next()
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (_due.empty())
    {
        _isRunning = false;
        return {};
    }
    return _due.extract(_due.begin()).value();
}

} // namespace osgPagedTexture
