// SPDX-License-Identifier: MIT
#include <osgLabels/GlyphAtlas.h>

#include <algorithm>

namespace osgLabels
{

namespace
{

osg::Vec4 toLevel(const ImageRectangle& rectangle, float margin)
{
    return {rectangle.scale, rectangle.offset.x, rectangle.offset.y, margin};
}

} // namespace

GlyphAtlas::GlyphAtlas(std::shared_ptr<const GlyphSet> glyphs, float outlineWidth)
    : _glyphs(std::move(glyphs)), _images(_glyphs, outlineWidth),
      _boxes(new GlyphTexture(GL_RGBA, _images.getBoxesWidth(), _images.getBoxesHeight())),
      _distances(
          new GlyphTexture(GL_RED, _images.getDistance().width, _images.getDistance().height)),
      _levels(new osg::Uniform(osg::Uniform::FLOAT_VEC4, "osgLabels_levels", GlyphImages::Levels)),
      _distanceLevel(new osg::Uniform("osgLabels_distanceLevel", osg::Vec4())),
      _imageWidths(new osg::Uniform("osgLabels_imageWidths",
                                    osg::Vec2(static_cast<float>(_images.getBoxesWidth()),
                                              static_cast<float>(_images.getDistance().width)))),
      _letters(new osg::Uniform("osgLabels_letters", osg::Vec4())),
      _legible(new osg::Uniform("osgLabels_legible", osg::Vec2(2.0f, 1.0f)))
{
    for (unsigned int level = 0; level < GlyphImages::Levels; ++level)
        _levels->setElement(
            level, toLevel(_images.getLevels()[level], _images.getMargin(static_cast<int>(level))));
    _distanceLevel->set(toLevel(_images.getDistance(), _images.getDistanceMargin()));
    updateLetters();
}

bool GlyphAtlas::update()
{
    const std::uint32_t end = _glyphs->getSize();
    if (_count == end)
        return false;
    for (; _count < end; ++_count)
    {
        for (int image = 0; image < _images.getImagesPerGlyph(); ++image)
        {
            _boxes->add(_images.makeBoxes(_count, image));
            _distances->add(_images.makeDistance(_count, image));
        }
        _meanSum += _images.getMeanCoverage(_count, 0);
    }
    updateLetters();
    return true;
}

void GlyphAtlas::updateLetters()
{
    const bool isCells = _glyphs->getSpacing() == Spacing::Cells;
    _letters->set(osg::Vec4(isCells ? _glyphs->getCellAdvance() : 0.0f, _images.getOverhang(),
                            static_cast<float>(_images.getImagesPerGlyph()),
                            _count ? static_cast<float>(_meanSum / _count) : 0.0f));
}

void GlyphAtlas::apply(osg::StateSet& stateSet, unsigned int firstUnit) const
{
    stateSet.setTextureAttribute(firstUnit, _boxes);
    stateSet.setTextureAttribute(firstUnit + 1, _distances);
    stateSet.addUniform(new osg::Uniform("osgLabels_boxes", static_cast<int>(firstUnit)));
    stateSet.addUniform(new osg::Uniform("osgLabels_distances", static_cast<int>(firstUnit) + 1));
    for (const auto& uniform : {_levels, _distanceLevel, _imageWidths, _letters, _legible})
        stateSet.addUniform(uniform);
}

void GlyphAtlas::setLegibleSize(float pixelsPerEm)
{
    osg::Vec2 legible;
    _legible->get(legible);
    _legible->set(osg::Vec2(std::max(0.0f, pixelsPerEm), legible.y()));
}

float GlyphAtlas::getLegibleSize() const
{
    osg::Vec2 legible;
    _legible->get(legible);
    return legible.x();
}

void GlyphAtlas::setToneBelowLegible(bool enabled)
{
    osg::Vec2 legible;
    _legible->get(legible);
    _legible->set(osg::Vec2(legible.x(), enabled ? 1.0f : 0.0f));
}

bool GlyphAtlas::getToneBelowLegible() const
{
    osg::Vec2 legible;
    _legible->get(legible);
    return legible.y() > 0.0f;
}

std::size_t GlyphAtlas::getBytes() const
{
    return _boxes->getBytes() + _distances->getBytes();
}

} // namespace osgLabels
