// SPDX-License-Identifier: MIT
#include <osgLabels/FeatureTree.h>

#include <algorithm>

namespace osgLabels
{

FeatureTree::Part FeatureTree::add(Part parent, std::uint64_t key, const std::string& name)
{
    const auto [found, isNew] = _byKey.emplace(key, Part(_nodes.size()));
    if (!isNew)
        return found->second;
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

void FeatureTree::number(Part top, std::uint32_t around, std::uint32_t& next)
{
    // Subgraphs may be deeper than the stack.
    struct Step
    {
        Part part;
        std::size_t child;
        std::uint32_t number;
        std::uint32_t inner; ///< First number that what is inside may get.
    };
    std::vector<Step> path{{top, 0, around, next}};
    while (!path.empty())
    {
        Step& step = path.back();
        Node& node = _nodes[step.part];
        if (step.child == 0 && isFeature(node))
        {
            Range* named = node.name && _isUsed[node.name] ? &_ranges[node.name] : nullptr;
            const bool isAnother = named && named->first <= named->last;
            step.number = isAnother ? named->first : next++;
            step.inner = next;
            if (named && !isAnother)
                *named = {step.number, step.number};
        }
        node.number = step.number;
        if (step.child < node.inside.size())
        {
            const std::uint32_t number = step.number;
            const Part inside = node.inside[step.child++];
            path.push_back({inside, 0, number, next});
            continue;
        }
        // Of several parts with one name the first one's numbers follow its own.
        const bool isFirst = step.inner == step.number + 1;
        node.last = isFeature(node) && isFirst ? next - 1 : node.number;
        if (isFeature(node) && isFirst && node.name && _isUsed[node.name])
            _ranges[node.name].last = node.last;
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
    std::uint32_t next = First;
    number(Scene, Foreign, next);
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
