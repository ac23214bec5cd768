// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixRest.h>

namespace osgMultiRender
{

namespace
{

/// Contexts may be a frame apart.
constexpr unsigned int MostBetween = 2;

/// Frame numbers of contexts that are apart may go back.
unsigned int framesSince(unsigned int earlier, unsigned int frame)
{
    return frame > earlier ? frame - earlier : 0;
}

} // namespace

void MixRest::see(std::uint64_t mixRevision, const osg::Matrixd& keysToScene, unsigned int frame)
{
    if (_isFirst || _mixRevision != mixRevision || _keysToScene != keysToScene)
        _changed = frame;
    _isFirst = false;
    _mixRevision = mixRevision;
    _keysToScene = keysToScene;
    forget(frame);
}

unsigned int MixRest::getQuietFrames(unsigned int frame) const
{
    return framesSince(_changed, frame);
}

unsigned int MixRest::want(const MixSet& set, unsigned int frame)
{
    const auto [found, isNew] = _wanted.try_emplace(set, Wanted{frame, frame});
    found->second.last = frame;
    return framesSince(found->second.first, frame);
}

void MixRest::forget(unsigned int frame)
{
    for (auto at = _wanted.begin(); at != _wanted.end();)
        at = framesSince(at->second.last, frame) > MostBetween ? _wanted.erase(at) : std::next(at);
}

} // namespace osgMultiRender
