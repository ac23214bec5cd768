// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasWatch.h>

#include <osgPagedTexture/AtlasChanges.h>
#include <osgPagedTexture/SourceIndex.h>

#include <filesystem>
#include <map>

namespace osgPagedTexture
{

struct AtlasWatch::Content
{
    using Stamps = std::map<std::string, FileStamp>;
    Stamps take() const
    {
        Stamps stamps;
        for (const std::string& path : findPhotosOf(layout, folder))
        {
            if (const auto stamp = stampOf((std::filesystem::path(folder) / path).string()))
            {
                stamps.emplace(path, *stamp);
            }
        }
        return stamps;
    }

    AtlasLayout layout; ///< Its places do not matter here.
    std::string folder;
    Stamps known, last;
};

AtlasWatch::AtlasWatch(const AtlasLayout& layout, const std::string& folder)
    : _content(std::make_unique<Content>())
{
    _content->layout = layout;
    _content->folder = folder;
    _content->known = _content->last = _content->take();
}

AtlasWatch::~AtlasWatch() = default;
AtlasWatch::AtlasWatch(AtlasWatch&&) noexcept = default;

bool AtlasWatch::look()
{
    Content::Stamps now = _content->take();
    const bool rests = now == _content->last;
    const bool isOther = now != _content->known;
    _content->last = std::move(now);
    if (rests && isOther)
    {
        _content->known = _content->last;
    }
    return rests && isOther;
}

} // namespace osgPagedTexture
