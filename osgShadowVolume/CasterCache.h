// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/CasterMesh.h>
#include <osgShadowVolume/TriangleReader.h>

#include <osg/observer_ptr>

#include <list>
#include <mutex>
#include <unordered_map>

namespace osgShadowVolume
{

/// The meshes of casters, shared by groups, views, lights and frames.
///
/// A mesh is made anew where a vertex array or the indices of one of its Geometries were exchanged
/// or made dirty(), and forgotten 60 frames after its last use or when one of its Drawables dies.
/// Functions may be called from any thread.
class OSGSHADOWVOLUME_EXPORT CasterCache : public osg::Referenced
{
public:
    /// The cache of the process; it lives as long as somebody holds it.
    static osg::ref_ptr<CasterCache> instance();

    static constexpr unsigned int FramesUnused = 60;

    /// The mesh of these Drawables, built now where it is not there or no longer true. None of them
    /// may change while it runs. Looks at each array's count: ask once a frame, not for each light.
    /// A Drawable that is no Geometry has no counts and is taken not to change.
    osg::ref_ptr<CasterMesh> get(const CasterSource& source);

    /// Forgets what is no longer used; each view calls it in each frame. Viewers with frame numbers
    /// of their own may share a cache; their frames add up.
    void evict(unsigned int frameNumber);

    std::size_t getSize() const;  ///< Meshes that it holds.
    std::size_t getBuilt() const; ///< Meshes made so far.

protected:
    ~CasterCache() override;

private:
    struct Entry
    {
        std::vector<osg::observer_ptr<const osg::Drawable>> drawables;
        std::vector<TriangleContent> contents;
        osg::ref_ptr<CasterMesh> mesh;
        std::size_t lastUse; ///< In frames counted here.
    };
    using Key = std::vector<const osg::Drawable*>;
    struct Hash
    {
        std::size_t operator()(const Key& key) const;
    };
    static bool isAlive(const Entry& entry);

    mutable std::mutex _mutex;
    std::unordered_map<Key, Entry, Hash> _entries;
    std::size_t _built = 0;
    std::size_t _frames = 0;
    unsigned int _frameNumber = 0;
};

} // namespace osgShadowVolume
