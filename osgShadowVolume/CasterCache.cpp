// SPDX-License-Identifier: MIT
#include <osgShadowVolume/CasterCache.h>

#include <algorithm>
#include <functional>

namespace osgShadowVolume
{

osg::ref_ptr<CasterCache> CasterCache::instance()
{
    static std::mutex mutex;
    static osg::observer_ptr<CasterCache> shared;
    std::lock_guard<std::mutex> lock(mutex);
    osg::ref_ptr<CasterCache> cache;
    if (!shared.lock(cache))
    {
        cache = new CasterCache;
        shared = cache;
    }
    return cache;
}

CasterCache::~CasterCache() = default;

std::size_t CasterCache::Hash::operator()(const Key& key) const
{
    std::size_t hash = key.size();
    for (const osg::Drawable* drawable : key)
        hash = (hash ^ (std::size_t(drawable) >> 4)) * std::size_t(0x9e3779b97f4a7c15u);
    return hash ^ hash >> 32;
}

bool CasterCache::isAlive(const Entry& entry)
{
    return std::all_of(entry.drawables.begin(), entry.drawables.end(),
                       [](const auto& drawable) { return drawable.valid(); });
}

osg::ref_ptr<CasterMesh> CasterCache::get(const CasterSource& source)
{
    Key key;
    key.reserve(source.size());
    for (const auto& drawable : source)
        key.push_back(drawable.get());
    std::vector<TriangleContent> contents;
    contents.reserve(2 * source.size());
    for (const auto& drawable : source)
        appendContents(*drawable, contents);
    osg::ref_ptr<CasterMesh> mesh;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        Entry& entry = _entries[key];
        // A dead Drawable's address may be that of a new one.
        if (!entry.mesh || !isAlive(entry) || entry.contents != contents)
        {
            entry.drawables.assign(source.begin(), source.end());
            entry.contents = std::move(contents);
            entry.mesh = new CasterMesh;
            ++_built;
        }
        entry.lastUse = _frames;
        mesh = entry.mesh;
    }
    // Not under the lock: views that need other meshes go on meanwhile.
    mesh->build(source);
    return mesh;
}

void CasterCache::evict(unsigned int frameNumber)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (frameNumber == _frameNumber)
        return;
    _frameNumber = frameNumber;
    ++_frames;
    for (auto it = _entries.begin(); it != _entries.end();)
    {
        if (_frames - it->second.lastUse > FramesUnused || !isAlive(it->second))
            it = _entries.erase(it);
        else
            ++it;
    }
}

std::size_t CasterCache::getSize() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _entries.size();
}

std::size_t CasterCache::getBuilt() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _built;
}

} // namespace osgShadowVolume
