// SPDX-License-Identifier: MIT
#include <osgLabels/MapTexts.h>

#include <osg/Notify>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

MapTexts::MapTexts(std::shared_ptr<GlyphSet> glyphs, StyleOf styleOf, MapFeatures& features,
                   const FramesInFlight& frames)
    : _glyphs(std::move(glyphs)), _styleOf(std::move(styleOf)), _features(features), _frames(frames)
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

std::uint32_t MapTexts::newIdentifier()
{
    _retired.release(_frames,
                     [this](std::uint32_t identifier)
                     {
                         _table->remove(identifier);
                         _free.push_back(identifier);
                     });
    if (_free.empty())
    {
        _texts.emplace_back();
        return std::uint32_t(_texts.size() - 1);
    }
    const std::uint32_t identifier = _free.back();
    _free.pop_back();
    return identifier;
}

void MapTexts::setTextOf(std::uint32_t identifier, const std::string& text)
{
    Text& known = _texts[identifier];
    if (known.text == text)
        return;
    const LabelTable::Codes codes = _glyphs->codesOf(text);
    known.text = text;
    known.width = widthOf(codes);
    _table->setCodes(identifier, codes);
}

PreparedLabel MapTexts::prepare(const MapLabel& label, std::uint32_t identifier)
{
    setTextOf(identifier, label.text);
    _texts[identifier].style = _styleOf(label.style);
    PreparedLabel prepared;
    prepared.identifier = identifier;
    prepared.anchor = label.anchor;
    prepared.priority = label.priority;
    prepared.style = _texts[identifier].style;
    prepared.width = _texts[identifier].width;
    prepared.feature = _features.use(label.feature);
    return prepared;
}

/// Their features, and the identifiers of those from the first one on.
void MapTexts::forget(const std::vector<PreparedLabel>& labels, std::size_t first)
{
    for (const PreparedLabel& label : labels)
        _features.unuse(label.feature);
    for (std::size_t i = first; i < labels.size(); ++i)
    {
        const std::uint32_t identifier = labels[i].identifier;
        _texts[identifier] = Text();
        _retired.add(identifier, _frames);
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
            if (known->second.labels)
                forget(*known->second.labels, 0);
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
    // The same label has the same identifier from change to change, as far as its place says so.
    const auto before =
        known.labels ? known.labels : std::make_shared<std::vector<PreparedLabel>>();
    auto labels = std::make_shared<std::vector<PreparedLabel>>();
    std::size_t wrong = 0;
    for (const MapLabel& label : node.getLabels())
    {
        const bool isRight = std::isfinite(label.anchor.length2()) && std::isfinite(label.priority);
        wrong += !isRight;
        if (isRight && !label.text.empty())
            labels->push_back(prepare(label, labels->size() < before->size()
                                                 ? (*before)[labels->size()].identifier
                                                 : newIdentifier()));
    }
    forget(*before, labels->size());
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
    return prepare(label, newIdentifier());
}

void MapTexts::remove(const PreparedLabel& label)
{
    std::lock_guard<std::mutex> lock(_mutex);
    forget({label}, 0);
}

bool MapTexts::isKnown(std::uint32_t identifier) const
{
    return identifier < _texts.size() && !_texts[identifier].text.empty();
}

void MapTexts::updateNodes(std::uint32_t identifier)
{
    for (auto& [node, known] : _known)
    {
        const auto& labels = *known.labels;
        const auto found =
            std::find_if(labels.begin(), labels.end(),
                         [&](const PreparedLabel& l) { return l.identifier == identifier; });
        if (found == labels.end())
            continue;
        auto changed = std::make_shared<std::vector<PreparedLabel>>(labels);
        PreparedLabel& label = (*changed)[std::size_t(found - labels.begin())];
        label.width = _texts[identifier].width;
        label.style = _texts[identifier].style;
        known.labels = changed; // views hold the old ones
        break;
    }
}

bool MapTexts::setText(std::uint32_t identifier, const std::string& text)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!isKnown(identifier))
        return false;
    setTextOf(identifier, text);
    updateNodes(identifier);
    return true;
}

bool MapTexts::setStyle(std::uint32_t identifier, std::uint32_t style)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!isKnown(identifier))
        return false;
    _texts[identifier].style = style;
    updateNodes(identifier);
    return true;
}

std::string MapTexts::getText(std::uint32_t identifier) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return isKnown(identifier) ? _texts[identifier].text : std::string();
}

std::optional<std::uint32_t> MapTexts::getStyle(std::uint32_t identifier) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!isKnown(identifier))
        return std::nullopt;
    return _texts[identifier].style;
}

void MapTexts::update(PreparedLabel& label) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    label.width = _texts[label.identifier].width;
    label.style = _texts[label.identifier].style;
}

} // namespace osgLabels
