// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BoundTextures.h>

#include <osgPagedTexture/NeedCollector.h>
#include <osgPagedTexture/PagedSubload.h>

#include <osg/TexGen>
#include <osg/TexMat>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgPagedTexture
{

void BoundTextures::take(const osg::StateSet& stateSet, const Pager& pager)
{
    for (unsigned int unit = 0; unit < stateSet.getNumTextureAttributeLists(); ++unit)
        for (const auto& each : stateSet.getTextureAttributeList()[unit])
            if (const osg::StateAttribute* attribute = each.second.first.get())
                takeAttribute(*attribute, unit, pager);
    for (unsigned int unit = 0; unit < stateSet.getNumTextureModeLists(); ++unit)
        for (const auto& mode : stateSet.getTextureModeList()[unit])
            if (mode.first >= GL_TEXTURE_GEN_S && mode.first <= GL_TEXTURE_GEN_T)
                _generated[unit] = mode.second & osg::StateAttribute::ON;
}

void BoundTextures::takeAttribute(const osg::StateAttribute& attribute, unsigned int unit,
                                  const Pager& pager)
{
    if (attribute.getType() == osg::StateAttribute::TEXMAT)
    {
        const osg::Matrix& m = static_cast<const osg::TexMat&>(attribute).getMatrix();
        _scales[unit] = std::abs(m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0));
    }
    if (attribute.getType() != osg::StateAttribute::TEXTURE)
        return;
    _textures.erase(std::remove_if(_textures.begin(), _textures.end(),
                                   [unit](const BoundTexture& bound)
                                   { return bound.unit == unit; }),
                    _textures.end());
    const auto* flat = dynamic_cast<const osg::Texture2D*>(&attribute);
    const auto* paged =
        flat ? dynamic_cast<const PagedSubload*>(flat->getSubloadCallback()) : nullptr;
    if (paged && paged->getPager() == &pager)
        _textures.push_back({unit, paged->getTexture()});
}

double BoundTextures::pixels(const BoundTexture& bound, const osg::Drawable& drawable,
                             const TexelView& view, SurfaceCache& cache) const
{
    const auto generated = _generated.find(bound.unit);
    if (generated != _generated.end() && generated->second)
        return std::numeric_limits<double>::infinity();
    TexelSurface surface = cache.get(drawable, bound.unit);
    const auto scale = _scales.find(bound.unit);
    if (scale != _scales.end())
        surface.uvDensity *= scale->second;
    return pixelsOfTexture(surface, view);
}

} // namespace osgPagedTexture
