// SPDX-License-Identifier: MIT
#include <osgLabels/LabelResources.h>

#include <osgLabels/Chunker.h>
#include <osgLabels/LabelUnits.h>
#include <osgLabels/ObjectFit.h>

#include <osg/Notify>

#include <algorithm>
#include <map>

namespace osgLabels
{

namespace
{

/// Drawables that are looked at in each cull, whether they are still where they were.
constexpr std::size_t sweptAtOnce = 256;

void warn(const std::string& line)
{
    OSG_WARN << "osgLabels::LabelScene: " << line << std::endl;
}

LabelSourceSettings sourceOf(const LabelSettings& settings)
{
    LabelSourceSettings source;
    source.match = settings.match;
    const std::string value = "value:";
    if (settings.source == "description")
        source.from = LabelFrom::DESCRIPTION;
    else if (settings.source.compare(0, value.size(), value) == 0)
    {
        source.from = LabelFrom::VALUE;
        source.value = settings.source.substr(value.size());
    }
    else if (settings.source != "name")
    {
        source.from = LabelFrom::TABLE;
        source.table = settings.source;
    }
    return source;
}

float widestOutline(const LabelSettings& settings)
{
    float outline = 0.0f;
    for (const LabelStyle& style : settings.styles)
        outline = std::max(outline, style.outlineWidth);
    // Of map labels behind something only outlines may be left.
    if (settings.map != "off" || settings.mapClass.find(":outline") != std::string::npos ||
        settings.mapAction == MapAction::Outline)
        outline = std::max(outline, 0.06f);
    return outline;
}

} // namespace

LabelResources::LabelResources(const LabelSettings& s, osg::Group& group) : settings(s)
{
    table->setMessage(warn);
    std::shared_ptr<FontFace> face = FontFace::openOrDefault(settings.font, _error);
    if (face && !_error.empty())
    {
        warn(_error + "; " + face->getFile() + " is used");
        _error.clear();
    }
    const std::shared_ptr<const LabelSource> source =
        face ? LabelSource::create(sourceOf(settings), _error) : nullptr;
    if (!source)
    {
        warn(_error + "; there are no labels");
        return;
    }
    _glyphs = std::make_shared<GlyphSet>(
        face, settings.proportional ? Spacing::Proportional : Spacing::Cells, warn);
    if (settings.proportional)
        table->setAdvances([glyphs = _glyphs](std::uint32_t code)
                           { return glyphs->getGlyph(code)->advance; });
    _atlas = new GlyphAtlas(_glyphs, widestOutline(settings));
    _atlas->setLegibleSize(settings.readable);
    const auto encodeText = [this](const std::string& text) { return encode(text); };
    const auto numberOfStyle = [this](const std::string& name)
    { return name.empty() ? 0u : styleOf(name).value_or(0); };
    batches.setSource(source, encodeText, numberOfStyle);
    batches.collect(group);
    collector = std::make_unique<LabelCollector>(table, source, encodeText, shared, numberOfStyle);
    if (hasSurfaceLabels())
        collector->collect(group);
    fitNew();
    map = std::make_unique<MapScene>(settings, _glyphs, numberOfStyle, batches, objects,
                                     shared->frames, group);
    if (settings.chunk)
        makeChunks(group);
}

LabelTable::Codes LabelResources::encode(const std::string& text)
{
    return _glyphs->codesOf(text);
}

void LabelResources::sweep(osg::Group& group)
{
    if (!collector)
        return;
    collector->sweep(group, sweptAtOnce);
    batches.sweep();
}

void LabelResources::fitNew()
{
    if (!collector)
        return;
    // Instances share theirs.
    std::map<std::pair<const osg::Drawable*, std::uint32_t>, ObjectRecord> fitted;
    for (const std::uint32_t object : collector->takeNew())
    {
        const LabelCollector::Object found = collector->getObject(object);
        if (!found.drawable)
            continue;
        const auto key = std::make_pair(found.drawable.get(), found.scale);
        auto record = fitted.find(key);
        if (record == fitted.end())
            record = fitted
                         .emplace(key, recordOf(*found.drawable, collector->getScale(found).get(),
                                                settings.texCoord, found.identifier))
                         .first;
        record->second.identifier = found.identifier;
        objects.set(object, record->second);
    }
}

void LabelResources::makeChunks(osg::Group& group)
{
    std::vector<MapRecords::Chunked> chunked;
    Chunker chunker(
        [&](const osg::NodePath& path)
        {
            chunked.push_back({collector->getObject(group, path), path});
            return chunked.back().object;
        });
    Chunks chunks = chunker.chunk(group);
    map->records.setChunked(std::move(chunked));
    for (const Chunks::Object& object : chunks.objects)
        objects.set(object.object,
                    recordOf(*object.geometry, object.localToChunk, settings.texCoord,
                             collector->getObject(object.object).identifier));
    OSG_INFO << "osgLabels::LabelScene: " << chunks.gathered << " of " << chunks.drawables
             << " drawables are gathered in " << chunks.chunks << " chunks" << std::endl;
    _chunks = chunks.node;
}

void LabelResources::update(osg::State& state, osg::StateSet& into)
{
    into.merge(*buffers.update(state));
    into.merge(*objects.update(state));
    updateGlyphs(into);
}

bool LabelResources::hasSurfaceLabels() const
{
    return settings.surface == SurfaceLabels::On ||
           (settings.surface == SurfaceLabels::Auto && settings.map == "off");
}

void LabelResources::updateGlyphs(osg::StateSet& into)
{
    std::lock_guard<std::mutex> lock(_atlasMutex);
    _atlas->update();
    _atlas->apply(into, GlyphsUnit);
}

bool LabelResources::hasOutlines() const
{
    return widestOutline(settings) > 0.0f;
}

std::string LabelResources::getDefines(bool isPaged, std::uint32_t shapes) const
{
    std::string defines = _atlas->getDefines();
    if (isPaged)
        defines += "#define OSGLABELS_PAGED\n";
    if (settings.texCoord >= 0)
        defines += "#define OSGLABELS_TEXTURED\n";
    if (shapes != ~0u)
        defines += "#define OSGLABELS_SHAPES " + std::to_string(shapes) + "\n";
    return defines;
}

bool LabelResources::setText(std::uint32_t identifier, const std::string& text)
{
    if (identifier >= MapScene::FirstIdentifier)
        return collector && map->texts.setText(identifier - MapScene::FirstIdentifier, text);
    return collector && (batches.setText(identifier, text) || collector->setText(identifier, text));
}

std::string LabelResources::getText(std::uint32_t identifier) const
{
    if (!collector)
        return {};
    if (identifier >= MapScene::FirstIdentifier)
        return map->texts.getText(identifier - MapScene::FirstIdentifier);
    const LabelBatches::Found found = batches.find(identifier);
    if (!found.batch)
        return collector->getText(identifier);
    return found.hasText ? found.text : found.batch->getObjectName(found.object);
}

std::optional<std::uint32_t> LabelResources::styleOf(const std::string& name)
{
    const std::optional<unsigned int> style = settings.findStyle(name);
    if (style)
        return *style;
    bool isNew;
    {
        std::lock_guard<std::mutex> lock(_stylesMutex);
        isNew = _unknownStyles.insert(name).second;
    }
    std::string known;
    for (std::size_t i = 1; i < settings.styles.size(); ++i)
        known += (i > 1 ? ", " : "") + settings.styles[i].name;
    if (isNew)
        warn("there is no style '" + name + "'; " +
             (known.empty() ? "define it: styles='" + name + ":ink=#ff0000'"
                            : "there are " + known));
    return std::nullopt;
}

bool LabelResources::setStyle(std::uint32_t identifier, const std::string& name)
{
    const std::optional<std::uint32_t> style = styleOf(name);
    if (!collector || !style)
        return false;
    if (identifier >= MapScene::FirstIdentifier)
        return map->texts.setStyle(identifier - MapScene::FirstIdentifier, *style);
    return batches.find(identifier).batch ? table->setStyle(identifier, *style)
                                          : collector->setStyle(identifier, *style);
}

std::string LabelResources::getStyle(std::uint32_t identifier) const
{
    const std::uint32_t style =
        map && identifier >= MapScene::FirstIdentifier
            ? map->texts.getStyle(identifier - MapScene::FirstIdentifier).value_or(0)
            : table->getStyle(identifier);
    return style && style < settings.styles.size() ? settings.styles[style].name
                                                   : LabelStyle::DefaultName;
}

std::string LabelResources::getPath(osg::Group& group, std::uint32_t identifier) const
{
    if (!collector)
        return {};
    const LabelBatches::Found found = batches.find(identifier);
    osg::NodePath path;
    if (!found.batch)
        path = collector->getNodePath(group, identifier);
    else if (const osg::NodePathList paths = found.batch->getParentalNodePaths(&group);
             !paths.empty())
        path = paths.front();
    std::string text;
    for (const osg::Node* node : path)
        text += "/" + (node->getName().empty() ? std::string(node->className()) : node->getName());
    return found.batch ? text + "/object " + std::to_string(found.object) : text;
}

void LabelResources::releaseGLObjects(osg::State* state)
{
    buffers.releaseGLObjects(state);
    objects.releaseGLObjects(state);
    targets.releaseGLObjects(state);
    programs.releaseGLObjects(state);
    if (map)
        map->releaseGLObjects(state);
    screen->releaseGLObjects(state);
    std::lock_guard<std::mutex> lock(_atlasMutex);
    osg::ref_ptr<osg::StateSet> textures = new osg::StateSet;
    if (_atlas)
        _atlas->apply(*textures, GlyphsUnit);
    textures->releaseGLObjects(state);
}

} // namespace osgLabels
