// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TextureState.h>

#include <osg/Drawable>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

using Value = osg::StateAttribute::OverrideValue;

/// Whether a nearer value counts, and from here on whether it stays against those below it.
bool wins(bool& fixed, Value value)
{
    if (fixed && !(value & osg::StateAttribute::PROTECTED))
        return false;
    fixed = (value & osg::StateAttribute::OVERRIDE) != 0;
    return true;
}

/// INHERIT where no kind of texture is switched; ON where any is on.
Value modeOf(const osg::StateSet& stateSet, unsigned int unit,
             std::initializer_list<osg::StateAttribute::GLMode> modes)
{
    Value found = osg::StateAttribute::INHERIT;
    for (osg::StateAttribute::GLMode mode : modes)
    {
        const Value value = stateSet.getTextureMode(unit, mode);
        if (value & osg::StateAttribute::ON)
            return value;
        if (!(value & osg::StateAttribute::INHERIT))
            found = value;
    }
    return found;
}

} // namespace

void TextureState::merge(Entry& entry, const osg::StateSet& stateSet, unsigned int unit)
{
    using Attribute = osg::StateAttribute;
    if (const auto* pair = stateSet.getTextureAttributePair(unit, Attribute::TEXTURE))
        if (wins(entry.textureFixed, pair->second))
            entry.unit.texture = pair->first->asTexture();
    if (const auto* pair = stateSet.getTextureAttributePair(unit, Attribute::TEXMAT))
        if (wins(entry.matrixFixed, pair->second))
            entry.unit.matrix = static_cast<osg::TexMat*>(pair->first.get());
    const Value shown =
        modeOf(stateSet, unit, {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP});
    if (!(shown & Attribute::INHERIT) && wins(entry.offFixed, shown))
        entry.unit.isOff = !(shown & Attribute::ON);
    const Value generated = modeOf(stateSet, unit, {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T});
    if (!(generated & Attribute::INHERIT) && wins(entry.generatedFixed, generated))
        entry.unit.isGenerated = (generated & Attribute::ON) != 0;
}

void TextureState::push(const osg::StateSet* stateSet)
{
    _stack.push_back(_stack.back());
    if (!stateSet)
        return;
    std::vector<Entry>& units = _stack.back();
    const std::size_t count = std::max<std::size_t>(stateSet->getNumTextureAttributeLists(),
                                                    stateSet->getNumTextureModeLists());
    if (units.size() < count)
        units.resize(count);
    for (std::size_t unit = 0; unit < count; ++unit)
        merge(units[unit], *stateSet, static_cast<unsigned int>(unit));
}

void TextureState::pop()
{
    _stack.pop_back();
}

TextureUnit TextureState::get(unsigned int unit) const
{
    return unit < getUnits() ? _stack.back()[unit].unit : TextureUnit();
}

void TextureStateVisitor::apply(osg::Node& node)
{
    _state.push(node.getStateSet());
    traverse(node);
    _state.pop();
}

void TextureStateVisitor::apply(osg::Drawable& drawable)
{
    _state.push(drawable.getStateSet());
    visit(drawable, _state);
    _state.pop();
}

} // namespace osgPagedTexture
