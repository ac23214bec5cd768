// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PageCache.h>

namespace osgPagedTexture
{

const LoadedPage* PageCache::find(const PageVersion& page)
{
    const auto found = _byPage.find(page);
    if (found == _byPage.end())
    {
        return nullptr;
    }
    _statistics.hits += found->second->isUsed;
    found->second->isUsed = true;
    _entries.splice(_entries.begin(), _entries, found->second);
    return &found->second->loaded;
}

const LoadedPage* PageCache::look(const PageVersion& page) const
{
    const auto found = _byPage.find(page);
    return found == _byPage.end() ? nullptr : &found->second->loaded;
}

void PageCache::put(const PageVersion& page, const LoadedPage& loaded)
{
    remove(page);
    if (loaded.texels->size() > _maxBytes)
    {
        return;
    }
    _entries.push_front({page, loaded, false});
    _byPage[page] = _entries.begin();
    _statistics.bytes += loaded.texels->size();
    while (_statistics.bytes > _maxBytes)
    {
        remove(_entries.back().page);
    }
    _statistics.pages = _entries.size();
}

void PageCache::remove(PageVersion page)
{
    const auto found = _byPage.find(page);
    if (found != _byPage.end())
    {
        _statistics.bytes -= found->second->loaded.texels->size();
        _entries.erase(found->second);
        _byPage.erase(found);
    }
    _statistics.pages = _entries.size();
}

void PageCache::renameAll(const std::function<bool(PageVersion& page)>& rename)
{
    for (auto entry = _entries.begin(); entry != _entries.end();)
    {
        const PageVersion old = entry->page;
        PageVersion name = old;
        if (!rename(name))
        {
            ++entry;
            remove(old);
            continue;
        }
        if (!(name == old))
        {
            remove(name);
            _byPage.erase(old);
            entry->page = name;
            _byPage[name] = entry;
        }
        ++entry;
    }
}

} // namespace osgPagedTexture
