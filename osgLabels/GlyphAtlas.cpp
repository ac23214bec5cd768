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
      _texture(new GlyphTexture(GL_RGBA, _images.getWidth(), _images.getHeight())),
      _levels(
          new osg::Uniform(osg::Uniform::FLOAT_VEC4, "osgLabels_levels", GlyphImages::Levels + 1)),
      _letters(new osg::Uniform("osgLabels_letters", osg::Vec3())),
      _legible(new osg::Uniform("osgLabels_legible", osg::Vec2(2.0f, 1.0f)))
{
    for (unsigned int level = 0; level < GlyphImages::Levels; ++level)
        _levels->setElement(
            level, toLevel(_images.getLevels()[level], _images.getMargin(static_cast<int>(level))));
    _levels->setElement(GlyphImages::Levels,
                        toLevel(_images.getDistance(), _images.getDistanceMargin()));
    updateLetters();
}

bool GlyphAtlas::update()
{
    const std::uint32_t end = _glyphs->getSize();
    if (_count == end)
        return false;
    for (; _count < end; ++_count)
    {
        for (int which = 0; which < _images.getImagesPerGlyph(); ++which)
            _texture->add(_images.make(_count, which));
        _meanSum += _images.getMeanCoverage(_count, 0);
    }
    updateLetters();
    return true;
}

void GlyphAtlas::updateLetters()
{
    _letters->set(osg::Vec3(_glyphs->getCellAdvance(), _images.getOverhang(),
                            _count ? static_cast<float>(_meanSum / _count) : 0.0f));
}

std::string GlyphAtlas::getDefines() const
{
    std::string defines;
    if (_glyphs->getSpacing() == Spacing::Proportional)
        defines += "#define OSGLABELS_PROPORTIONAL\n";
    if (_images.getImagesPerGlyph() > 1)
        defines += "#define OSGLABELS_OUTLINE\n";
    return defines;
}

void GlyphAtlas::apply(osg::StateSet& stateSet, unsigned int unit) const
{
    stateSet.setTextureAttribute(unit, _texture);
    stateSet.addUniform(new osg::Uniform("osgLabels_glyphs", static_cast<int>(unit)));
    stateSet.addUniform(new osg::Uniform(
        "osgLabels_layer", osg::Vec2(static_cast<float>(_images.getWidth()),
                                     static_cast<float>(_images.getImagesPerGlyph()))));
    const glm::vec2 step(_images.getQuarterStep());
    const glm::vec2 end = step + glm::vec2(_images.getDistance().x, _images.getDistance().y) + 0.5f;
    stateSet.addUniform(
        new osg::Uniform("osgLabels_quarters", osg::Vec4(step.x, step.y, end.x, end.y)));
    for (const auto& uniform : {_levels, _letters, _legible})
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
    return _texture->getBytes();
}

} // namespace osgLabels
