// SPDX-License-Identifier: MIT
// Whose turn it is in a frame, and who gets what. Most textures of a large model are neither in
// view nor there, and cost nothing.
#include <osgPagedTexture/Pager.h>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

/// Something is to be decided of the texture.
void Pager::wake(unsigned int texture)
{
    if (_entries[texture].isActive)
        return;
    _entries[texture].isActive = true;
    _awake.push_back(texture);
}

/// Something has become of it that its target does not say.
void Pager::stir(unsigned int texture)
{
    _entries[texture].isCalm = false;
    wake(texture);
}

/// In order of their numbers, so that who woke first is not who gets most.
void Pager::meetAwake()
{
    const auto middle = std::ptrdiff_t(_active.size());
    std::sort(_awake.begin(), _awake.end());
    _active.insert(_active.end(), _awake.begin(), _awake.end());
    std::inplace_merge(_active.begin(), _active.begin() + middle, _active.end());
    _awake.clear();
}

/// What views of this frame see is the next one's need.
void Pager::rest()
{
    for (const std::vector<unsigned int>* textures : {&_active, &_awake})
        for (const unsigned int texture : *textures)
        {
            Entry& entry = _entries[texture];
            entry.soonBefore = entry.soonPixels;
            entry.pixels = entry.soonPixels = 0.0;
        }
    const auto end = std::remove_if(_active.begin(), _active.end(),
                                    [this](unsigned int texture) { return isIdle(texture); });
    for (auto each = end; each != _active.end(); ++each)
        _entries[*each].isActive = false;
    _active.erase(end, _active.end());
}

bool Pager::isIdle(unsigned int texture) const
{
    const Entry& entry = _entries[texture];
    if (entry.need >= 0.0 || entry.soonBefore > 0.0 || entry.request)
        return false;
    return std::all_of(_contexts.begin(), _contexts.end(),
                       [texture](const auto& each)
                       {
                           return each.second.resident[texture] == UploadEvent::Gone &&
                                  each.second.queued[texture] == None;
                       });
}

/// After all that changes what there is of it at full size.
void Pager::countWhole(Entry& entry)
{
    const bool counts = entry.users > 0 && !entry.failed && entry.bytes;
    const std::uint64_t bytes = counts ? (*entry.bytes)[std::size_t(entry.finest)] : 0;
    _wholeBytes += bytes - entry.wholeBytes;
    entry.wholeBytes = bytes;
}

ResidencyWish Pager::wishOf(unsigned int texture)
{
    Entry& entry = _entries[texture];
    ResidencyWish wish;
    entry.need = ResidencyWish::None;
    if (entry.users == 0 || !entry.bytes)
        return wish;
    const int levels = int(entry.bytes->size());
    // Levels count from the finest one that may be there.
    const auto wanted = [&](double pixels)
    {
        if (!(pixels > 0.0))
            return ResidencyWish::None;
        const double level = entry.onePixel - 0.5 * std::log2(pixels);
        return std::max(0.0, std::min(level, levels - 1.0) - entry.finest);
    };
    entry.need = wanted(entry.pixels);
    if (entry.failed)
        return wish;
    wish.bytes = entry.bytes->data() + entry.finest;
    wish.levels = levels - entry.finest;
    wish.need = entry.need;
    const double soon = std::max(entry.soonPixels, entry.soonBefore);
    wish.soon = soon == entry.pixels ? entry.need : wanted(soon);
    const int there = entry.isCalm ? entry.target : coarsest(texture);
    wish.resident = there == UploadEvent::Gone ? -1 : std::max(0, there - entry.finest);
    wish.lastUsed = entry.lastUsed;
    return wish;
}

void Pager::plan()
{
    _wishes.resize(_active.size());
    std::uint64_t others = _wholeBytes;
    for (std::size_t i = 0; i < _active.size(); ++i)
    {
        _wishes[i] = wishOf(_active[i]);
        others -= _entries[_active[i]].wholeBytes;
    }
    _plan = planResidency(_wishes, _settings.gpuBytes(), others);
}

/// Brings textures nearer to the plan. Most are where they should be.
void Pager::carryOut()
{
    _changing = 0;
    _asked = 0;
    for (std::size_t i = 0; i < _active.size(); ++i)
    {
        Entry& entry = _entries[_active[i]];
        const int target = _plan.first[i] < 0 ? -1 : _plan.first[i] + entry.finest;
        if (entry.isCalm && entry.target == target)
            continue;
        entry.target = target;
        moveTo(_active[i]);
    }
}

} // namespace osgPagedTexture
