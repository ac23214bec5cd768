// SPDX-License-Identifier: MIT
#include <osgLabels/FeatureTree.h>

#include <algorithm>

namespace osgLabels
{

FeatureTree::Part FeatureTree::add(Part parent, std::uint64_t key, const std::string& name)
{
    const auto [found, isNew] = _byKey.emplace(key, Part(_nodes.size()));
    if (!isNew)
    {
        const auto known = name.empty() ? _names.end() : _names.find(name);
        const Name same = known == _names.end() ? None : known->second;
        if (_nodes[found->second].name == same && (same || name.empty()))
            return found->second;
        found->second = Part(_nodes.size());
    }
    Node node;
    node.parent = parent;
    if (!name.empty())
    {
        node.name = _names.emplace(name, Name(_names.size() + 1)).first->second;
        _isUsed.resize(_names.size() + 1);
        _ranges.resize(_names.size() + 1);
    }
    const bool isFeature = node.name && _isUsed[node.name];
    const std::uint32_t around = _nodes[parent].number;
    node.number = node.last = around;
    _nodes.push_back(node);
    _nodes[parent].inside.push_back(found->second);
    if (isFeature)
        _isCurrent = false;
    return found->second;
}

void FeatureTree::setLabelled(Part part)
{
    _isCurrent = _isCurrent && _nodes[part].isLabelled;
    _nodes[part].isLabelled = true;
}

FeatureTree::Name FeatureTree::use(const std::string& name)
{
    if (name.empty())
        return None;
    const Name number = _names.emplace(name, Name(_names.size() + 1)).first->second;
    _isUsed.resize(_names.size() + 1);
    _ranges.resize(_names.size() + 1);
    _isCurrent = _isCurrent && _isUsed[number];
    _isUsed[number] = true;
    return number;
}

bool FeatureTree::isUsed(const std::string& name) const
{
    const auto found = _names.find(name);
    return found != _names.end() && _isUsed[found->second];
}

bool FeatureTree::isFeature(const Node& node) const
{
    return node.isLabelled || (node.name && _isUsed[node.name]);
}

/// All parts of one name are one feature: what lies in any of them gets numbers behind its own.
void FeatureTree::number(const std::vector<std::vector<Part>>& named)
{
    // Subgraphs may be deeper than the stack.
    struct Step
    {
        std::vector<Part> parts;
        std::uint32_t number;
        bool isFeature;
        std::size_t part = 0, child = 0;
    };
    std::uint32_t next = First;
    std::vector<bool> isDone(_nodes.size());
    std::vector<Step> path;
    const auto enter = [&](Part part, std::uint32_t around)
    {
        const Node& node = _nodes[part];
        const bool isNew = isFeature(node), hasName = node.name && _isUsed[node.name];
        Step step{isNew && hasName ? named[node.name] : std::vector<Part>{part},
                  isNew ? next++ : around, isNew};
        for (const Part each : step.parts)
        {
            isDone[each] = true;
            _nodes[each].number = _nodes[each].last = step.number;
        }
        path.push_back(std::move(step));
    };
    enter(Scene, Foreign);
    while (!path.empty())
    {
        Step& step = path.back();
        if (step.part < step.parts.size())
        {
            const std::vector<Part>& inside = _nodes[step.parts[step.part]].inside;
            if (step.child == inside.size())
            {
                ++step.part;
                step.child = 0;
            }
            else if (const Part child = inside[step.child++]; !isDone[child])
                enter(child, step.number);
            continue;
        }
        for (const Part each : step.parts)
            if (step.isFeature)
            {
                Node& node = _nodes[each];
                node.last = next - 1;
                if (node.name && _isUsed[node.name])
                    _ranges[node.name] = {node.number, node.last};
            }
        path.pop_back();
    }
}

void FeatureTree::update()
{
    if (_isCurrent)
        return;
    _isCurrent = true;
    ++_modifiedCount;
    std::fill(_ranges.begin(), _ranges.end(), Range{});
    std::vector<std::vector<Part>> named(_isUsed.size());
    for (Part part = 0; part < _nodes.size(); ++part)
        if (const Name name = _nodes[part].name; name && _isUsed[name])
            named[name].push_back(part);
    number(named);
}

std::uint32_t FeatureTree::getNumber(Part part)
{
    update();
    return _nodes[part].number;
}

FeatureTree::Range FeatureTree::getRange(Name name)
{
    update();
    return name ? _ranges[name] : Range{};
}

FeatureTree::Range FeatureTree::getRangeOfPart(Part part)
{
    update();
    return {_nodes[part].number, _nodes[part].last};
}

} // namespace osgLabels
