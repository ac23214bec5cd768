// SPDX-License-Identifier: MIT
#include <osgLabels/MapTexts.h>

#include <osg/Notify>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

MapTexts::MapTexts(std::shared_ptr<GlyphSet> glyphs, StyleOf styleOf, MapFeatures& features)
    : _glyphs(std::move(glyphs)), _styleOf(std::move(styleOf)), _features(features)
{
    _table->setMessage([](const std::string& line)
                       { OSG_WARN << "osgLabels::MapLabels: " << line << std::endl; });
    if (_glyphs->getSpacing() == Spacing::Proportional)
        _table->setAdvances([set = _glyphs](std::uint32_t code)
                            { return set->getGlyph(code)->advance; });
}

float MapTexts::widthOf(const LabelTable::Codes& codes) const
{
    const std::size_t length = std::min(codes.size(), LabelTable::MaxLength);
    if (_glyphs->getSpacing() == Spacing::Cells)
        return float(length) * _glyphs->getCellAdvance();
    float width = 0.0f;
    for (std::size_t i = 0; i < length; ++i)
        width += _glyphs->getGlyph(codes[i])->advance;
    return width;
}

PreparedLabel MapTexts::prepare(const MapLabel& label)
{
    PreparedLabel prepared;
    const LabelTable::Codes codes = _glyphs->codesOf(label.text);
    prepared.anchor = label.anchor;
    prepared.priority = label.priority;
    prepared.style = _styleOf(label.style);
    prepared.width = widthOf(codes);
    prepared.feature = _features.use(label.feature);
    if (_free.empty())
    {
        prepared.identifier = std::uint32_t(_texts.size());
        _texts.emplace_back();
    }
    else
    {
        prepared.identifier = _free.back();
        _free.pop_back();
    }
    _texts[prepared.identifier] = label.text;
    _table->setCodes(prepared.identifier, codes);
    return prepared;
}

void MapTexts::forget(const Known& known)
{
    if (!known.labels)
        return;
    for (const PreparedLabel& label : *known.labels)
    {
        _table->remove(label.identifier);
        _texts[label.identifier].clear();
        _free.push_back(label.identifier);
    }
}

/// Forgets nodes that have died, now and then.
void MapTexts::sweep()
{
    if (_known.size() < _sweepAt)
        return;
    for (auto known = _known.begin(); known != _known.end();)
        if (known->second.node.valid())
            ++known;
        else
        {
            forget(known->second);
            known = _known.erase(known);
        }
    _sweepAt = std::max<std::size_t>(64, 2 * _known.size());
}

std::shared_ptr<const std::vector<PreparedLabel>> MapTexts::of(const MapLabels& node)
{
    std::lock_guard<std::mutex> lock(_mutex);
    sweep();
    Known& known = _known[&node];
    if (known.labels && known.node.get() == &node && known.modifiedCount == node.getModifiedCount())
        return known.labels;
    forget(known);
    auto labels = std::make_shared<std::vector<PreparedLabel>>();
    std::size_t wrong = 0;
    for (const MapLabel& label : node.getLabels())
    {
        const bool isRight = std::isfinite(label.anchor.length2()) && std::isfinite(label.priority);
        wrong += !isRight;
        if (isRight && !label.text.empty())
            labels->push_back(prepare(label));
    }
    if (wrong)
        OSG_WARN << "osgLabels::MapLabels: " << wrong << " labels of node '" << node.getName()
                 << "' have an anchor or a priority that is no finite number; they are not shown"
                 << std::endl;
    known = {&node, node.getModifiedCount(), labels};
    return labels;
}

PreparedLabel MapTexts::add(const MapLabel& label)
{
    std::lock_guard<std::mutex> lock(_mutex);
    return prepare(label);
}

bool MapTexts::setText(std::uint32_t identifier, const std::string& text)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (identifier == 0 || identifier >= _texts.size() || _texts[identifier].empty())
        return false;
    const LabelTable::Codes codes = _glyphs->codesOf(text);
    _texts[identifier] = text;
    for (auto& [node, known] : _known)
    {
        const auto& labels = *known.labels;
        const auto found =
            std::find_if(labels.begin(), labels.end(),
                         [&](const PreparedLabel& l) { return l.identifier == identifier; });
        if (found == labels.end())
            continue;
        auto changed = std::make_shared<std::vector<PreparedLabel>>(labels);
        (*changed)[std::size_t(found - labels.begin())].width = widthOf(codes);
        known.labels = changed; // views hold the old ones
        break;
    }
    return _table->setCodes(identifier, codes);
}

std::string MapTexts::getText(std::uint32_t identifier) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return identifier < _texts.size() ? _texts[identifier] : std::string();
}

} // namespace osgLabels
