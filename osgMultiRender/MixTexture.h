// SPDX-License-Identifier: MIT
// Textures of renderings. Not installed.
#pragma once

#include <osgMultiRender/Rendering.h>

#include <osg/Texture>

#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <utility>

namespace osgMultiRender
{

/// The texture with its image files, from OSG's object cache where it has them. One that can't be
/// read is white, with a warning.
osg::ref_ptr<osg::Texture> readTexture(const RenderingTexture& texture);

/// Textures that the programs of a scene share: one a rendering and unit, however many programs
/// show it. Thread safe.
class MixTextures
{
public:
    /// That of the rendering of an id; its files are read where it is not there yet.
    osg::ref_ptr<osg::Texture> get(std::uint64_t id, const RenderingTexture& texture);
    /// One white texel: what a rendering reads where the model has no texture.
    osg::ref_ptr<osg::Texture> getWhite();
    /// Forgets those of renderings of other ids.
    void keep(const std::set<std::uint64_t>& ids);

private:
    std::mutex _mutex;
    std::map<std::pair<std::uint64_t, unsigned int>, osg::ref_ptr<osg::Texture>> _textures;
    osg::ref_ptr<osg::Texture> _white;
};

} // namespace osgMultiRender
