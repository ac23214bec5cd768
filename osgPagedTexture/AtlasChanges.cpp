// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasChanges.h>

#include <osgPagedTexture/SourceIndex.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <unordered_map>
#include <unordered_set>

namespace osgPagedTexture
{

namespace
{

using Indices = std::vector<std::size_t>;
using ByPath = std::unordered_map<std::string, Indices>; // pieces share their photograph's path

ByPath indexOf(const AtlasLayout& layout)
{
    ByPath index;
    index.reserve(layout.photos.size());
    for (std::size_t i = 0; i < layout.photos.size(); ++i)
    {
        index[layout.photos[i].path].push_back(i);
    }
    return index;
}

/// Files of a new name that have the content of one that is gone have moved, one for each.
void findMoves(const AtlasLayout& layout, const ByPath& known, AtlasChanges& changes)
{
    std::unordered_multimap<std::string, std::string> gone; // paths by content
    for (const std::string& path : changes.removed)
    {
        gone.emplace(layout.photos[known.at(path).front()].hash, path);
    }
    std::unordered_set<std::string> moved;
    std::vector<AtlasPhoto> added;
    for (AtlasPhoto& photo : changes.added)
    {
        const auto from = gone.find(photo.hash);
        if (from == gone.end())
        {
            added.push_back(std::move(photo));
            continue;
        }
        changes.moved.push_back({from->second, photo});
        moved.insert(from->second);
        gone.erase(from);
    }
    changes.added = std::move(added);
    std::vector<std::string> removed;
    std::copy_if(changes.removed.begin(), changes.removed.end(), std::back_inserter(removed),
                 [&](const std::string& path) { return moved.count(path) == 0; });
    changes.removed = std::move(removed);
}

/// Whether other parts of the atlas than before may be covered; then its place counts too.
bool hasRoom(const AtlasLayout& layout, const Indices& pieces, const AtlasPhoto& now)
{
    return std::all_of(pieces.begin(), pieces.end(),
                       [&](std::size_t i)
                       { return fitsInPlace(layout, i, now.width, now.height); });
}

void setFile(AtlasPhoto& photo, const AtlasPhoto& now)
{
    photo.width = now.width;
    photo.height = now.height;
    photo.bytes = now.bytes;
    photo.modified = now.modified;
    photo.hash = now.hash;
}

void setChanged(AtlasLayout& layout, const Indices& pieces, const AtlasPhoto& now)
{
    for (const std::size_t i : pieces)
    {
        const PixelRect before = layout.getCovered(layout.photos[i]);
        setFile(layout.photos[i], now);
        const PixelRect after = layout.getCovered(layout.photos[i]);
        layout.pending.push_back(before);
        if (after.width != before.width || after.height != before.height)
        {
            layout.pending.push_back(after);
        }
    }
}

void takeOut(AtlasLayout& layout, const std::unordered_set<std::string>& paths)
{
    const auto isOut = [&](const AtlasPhoto& photo) { return paths.count(photo.path) > 0; };
    for (const AtlasPhoto& photo : layout.photos)
    {
        if (isOut(photo))
        {
            layout.pending.push_back(layout.getCovered(photo));
        }
    }
    layout.photos.erase(std::remove_if(layout.photos.begin(), layout.photos.end(), isOut),
                        layout.photos.end());
}

void putIn(AtlasLayout& layout, std::vector<AtlasPhoto> photos)
{
    const std::size_t first = layout.photos.size();
    const std::int64_t width = layout.width, height = layout.height;
    addPhotos(layout, std::move(photos));
    for (std::size_t i = first; i < layout.photos.size(); ++i)
    {
        layout.pending.push_back(layout.getCovered(layout.photos[i]));
    }
    // Tiles at the former edge have shown its repetition.
    if (layout.width > width)
    {
        layout.pending.push_back({width, 0, layout.width - width, layout.height});
    }
    if (layout.height > height)
    {
        layout.pending.push_back({0, height, layout.width, layout.height - height});
    }
}

std::string sizeText(const AtlasPhoto& photo)
{
    return std::to_string(photo.width) + " x " + std::to_string(photo.height);
}

} // namespace

std::vector<std::string> findPhotosOf(const AtlasLayout& layout, const std::string& folder)
{
    std::vector<std::string> paths;
    for (const AtlasPhoto& photo : layout.photos)
    {
        paths.push_back(photo.path);
    }
    if (!layout.photoFolder.empty())
    {
        const std::filesystem::path inside(layout.photoFolder);
        for (const std::string& path :
             findPhotos((std::filesystem::path(folder) / inside).string()))
        {
            paths.push_back((inside / path).lexically_normal().generic_string());
        }
    }
    return paths;
}

bool AtlasChanges::empty() const
{
    return changed.empty() && added.empty() && removed.empty() && moved.empty() &&
           restamped.empty();
}

AtlasChanges findChanges(const AtlasLayout& layout, const std::string& folder,
                         const std::vector<std::string>& paths, bool lookInside,
                         unsigned int threads)
{
    const ByPath known = indexOf(layout);
    std::unordered_set<std::string> there;
    std::vector<std::string> suspects;
    for (const std::string& path : paths)
    {
        const auto stamp = stampOf((std::filesystem::path(folder) / path).string());
        if (!stamp || !there.insert(path).second)
        {
            continue;
        }
        const auto found = known.find(path);
        const AtlasPhoto* const photo =
            found == known.end() ? nullptr : &layout.photos[found->second.front()];
        if (!photo || lookInside || photo->modified == 0 || stamp->bytes != photo->bytes ||
            stamp->modified != photo->modified)
        {
            suspects.push_back(path);
        }
    }
    AtlasChanges changes;
    DescribedPhotos described = describePhotos(folder, suspects, threads);
    changes.failures = std::move(described.failures);
    for (AtlasPhoto& now : described.photos)
    {
        const auto found = known.find(now.path);
        if (found == known.end())
        {
            changes.added.push_back(std::move(now));
            continue;
        }
        const AtlasPhoto& before = layout.photos[found->second.front()];
        if (now.hash != before.hash)
        {
            changes.changed.push_back(std::move(now));
        }
        else if (now.modified != before.modified)
        {
            changes.restamped.push_back(std::move(now));
        }
    }
    for (const AtlasPhoto& photo : layout.photos)
    {
        if (there.insert(photo.path).second)
        {
            changes.removed.push_back(photo.path);
        }
    }
    findMoves(layout, known, changes);
    return changes;
}

std::vector<std::string> applyChanges(AtlasLayout& layout, const AtlasChanges& changes)
{
    std::vector<std::string> notes;
    const ByPath known = indexOf(layout);
    std::unordered_set<std::string> out(changes.removed.begin(), changes.removed.end());
    std::vector<AtlasPhoto> in = changes.added;
    for (const AtlasPhoto& now : changes.restamped)
    {
        for (const std::size_t i : known.at(now.path))
        {
            setFile(layout.photos[i], now);
        }
    }
    for (const AtlasPhoto& now : changes.changed)
    {
        const Indices& pieces = known.at(now.path);
        const AtlasPhoto& before = layout.photos[pieces.front()];
        const bool resized = before.width != now.width || before.height != now.height;
        if (!resized || hasRoom(layout, pieces, now))
        {
            setChanged(layout, pieces, now);
        }
        else if (!before.used.empty())
        {
            notes.push_back("photograph '" + now.path + "' is now " + sizeText(now) +
                            " pixels, and its used parts lie outside; make the atlas anew");
        }
        else
        {
            notes.push_back("photograph '" + now.path + "' is now " + sizeText(now) +
                            " pixels and lies elsewhere; write the model's coordinates anew");
            out.insert(now.path);
            in.push_back(now);
        }
    }
    for (const AtlasChanges::Move& move : changes.moved)
    {
        for (const std::size_t i : known.at(move.from))
        {
            layout.photos[i].path = move.to.path;
            setFile(layout.photos[i], move.to);
        }
    }
    if (!out.empty())
    {
        takeOut(layout, out);
    }
    if (!in.empty())
    {
        putIn(layout, std::move(in));
    }
    return notes;
}

} // namespace osgPagedTexture
