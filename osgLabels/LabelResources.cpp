// SPDX-License-Identifier: MIT
#include <osgLabels/LabelResources.h>

#include <osgLabels/LabelUnits.h>

#include <osg/Notify>

#include <algorithm>

namespace osgLabels
{

namespace
{

void warn(const std::string& line)
{
    OSG_WARN << "osgLabels::LabelScene: " << line << std::endl;
}

std::shared_ptr<GlyphSet> makeGlyphs(const LabelSettings& settings)
{
    std::string error;
    std::shared_ptr<FontFace> face = FontFace::openOrDefault(settings.font, error);
    if (!error.empty())
        warn(face ? error + "; " + face->getFile() + " is used" : error);
    if (!face)
        return nullptr;
    return std::make_shared<GlyphSet>(
        face, settings.proportional ? Spacing::Proportional : Spacing::Cells, warn);
}

osg::ref_ptr<GlyphAtlas> makeAtlas(const LabelSettings& settings,
                                   const std::shared_ptr<GlyphSet>& glyphs)
{
    if (!glyphs)
        return nullptr;
    float outline = 0.0f;
    for (const LabelStyle& style : settings.styles)
        outline = std::max(outline, style.outlineWidth);
    osg::ref_ptr<GlyphAtlas> atlas = new GlyphAtlas(glyphs, outline);
    atlas->setLegibleSize(settings.readable);
    return atlas;
}

} // namespace

LabelResources::LabelResources(const LabelSettings& s)
    : settings(s), glyphs(makeGlyphs(s)), _atlas(makeAtlas(s, glyphs))
{
    table->setMessage(warn);
}

bool LabelResources::setText(std::uint32_t identifier, const std::string& text)
{
    if (!glyphs)
        return false;
    thread_local LabelTable::Codes codes;
    codes.clear();
    glyphs->appendCodes(text, codes);
    return table->setCodes(identifier, codes);
}

void LabelResources::update(osg::State& state, osg::StateSet& into)
{
    into.merge(*buffers.update(state));
    into.merge(*objects.update(state));
    std::lock_guard<std::mutex> lock(_atlasMutex);
    _atlas->update();
    _atlas->apply(into, GlyphsUnit);
}

void LabelResources::releaseGLObjects(osg::State* state)
{
    buffers.releaseGLObjects(state);
    objects.releaseGLObjects(state);
    targets.releaseGLObjects(state);
    programs.releaseGLObjects(state);
    screen->releaseGLObjects(state);
    std::lock_guard<std::mutex> lock(_atlasMutex);
    osg::ref_ptr<osg::StateSet> textures = new osg::StateSet;
    if (_atlas)
        _atlas->apply(*textures, GlyphsUnit);
    textures->releaseGLObjects(state);
}

} // namespace osgLabels
