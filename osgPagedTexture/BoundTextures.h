// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/TexelNeed.h>

#include <osg/Drawable>
#include <osg/StateSet>

#include <map>
#include <vector>

namespace osgPagedTexture
{

class Pager;
class SurfaceCache;

/// A texture of a pager that is on in a unit.
struct BoundTexture
{
    unsigned int unit = 0;
    unsigned int texture = 0;
};

/// What the StateSets on the way to a drawable say of textures.
class BoundTextures
{
public:
    /// Whether a StateSet says anything of textures.
    static bool areIn(const osg::StateSet& stateSet)
    {
        return stateSet.getNumTextureAttributeLists() + stateSet.getNumTextureModeLists() > 0;
    }

    /// That of one more StateSet.
    void take(const osg::StateSet& stateSet, const Pager& pager);

    const std::vector<BoundTexture>& get() const { return _textures; }

    /// See pixelsOfTexture(); infinite where texture coordinates are generated.
    double pixels(const BoundTexture& bound, const osg::Drawable& drawable, const TexelView& view,
                  SurfaceCache& cache) const;

private:
    void takeAttribute(const osg::StateAttribute& attribute, unsigned int unit, const Pager& pager);

    std::vector<BoundTexture> _textures;
    std::map<unsigned int, double> _scales; ///< Area that the texture matrix makes of one.
    std::map<unsigned int, bool> _generated;
};

} // namespace osgPagedTexture
