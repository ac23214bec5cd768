// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/CasterMesh.h>
#include <osgShadowVolume/Silhouette.h>

#include <map>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

namespace osgShadowVolume
{

/// Volumes found on the CPU, kept while neither light nor caster moves. Each graphics context has
/// its own: frames of different viewers are counted apart. Thread safe.
class OSGSHADOWVOLUME_EXPORT SilhouetteCache
{
public:
    struct Volume : public osg::Referenced
    {
        using Weighted = std::pair<float, osg::ref_ptr<osg::Geometry>>;
        std::vector<Weighted> sides;
        std::vector<Weighted> caps;

    protected:
        ~Volume() override = default;
    };

    /// The volume of a mesh; `light` as of toMeshLight().
    osg::ref_ptr<Volume> get(const osg::ref_ptr<CasterMesh>& mesh, const MeshLight& light,
                             unsigned int contextID, unsigned int frameNumber);
    /// Forgets the volumes of the context; without one, all.
    void releaseGLObjects(osg::State* state);

private:
    static constexpr unsigned int FramesUnused = 2;

    struct Entry
    {
        osg::ref_ptr<CasterMesh> mesh; ///< Held, so that the key stays its own.
        osg::ref_ptr<Volume> volume;
        unsigned int frameNumber = 0;
    };
    using Key = std::tuple<unsigned int, const CasterMesh*, float, float, float, float, float,
                           float, float, bool>;

    void evict(unsigned int contextID, unsigned int frameNumber);

    std::mutex _mutex;
    std::map<Key, Entry> _entries;
    std::map<unsigned int, unsigned int> _frameNumbers; ///< By context.
};

} // namespace osgShadowVolume
