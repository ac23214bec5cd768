// SPDX-License-Identifier: MIT
#include <osgLabels/FeatureTree.h>

#include <algorithm>

namespace osgLabels
{

FeatureTree::Name FeatureTree::nameOf(const std::string& text)
{
    const auto [found, isNew] = _names.emplace(text, None);
    if (!isNew)
        return found->second;
    if (_freeNames.empty())
    {
        found->second = Name(_named.size());
        _named.emplace_back();
    }
    else
    {
        found->second = _freeNames.back();
        _freeNames.pop_back();
    }
    _named[found->second].text = &found->first;
    return found->second;
}

/// Where neither a part nor a label has it.
void FeatureTree::forget(Name name)
{
    Named& named = _named[name];
    if (!name || named.parts || named.uses)
        return;
    _names.erase(_names.find(*named.text));
    named = {};
    _freeNames.push_back(name);
}

FeatureTree::Part FeatureTree::add(Part parent, std::uint64_t key, const std::string& name)
{
    if (const auto known = _byKey.find(key); known != _byKey.end())
    {
        const Name same = _nodes[known->second].name;
        if (same ? *_named[same].text == name : name.empty())
            return known->second;
    }
    Part part = Part(_nodes.size());
    if (_freeParts.empty())
        _nodes.emplace_back();
    else
    {
        part = _freeParts.back();
        _freeParts.pop_back();
    }
    _byKey[key] = part;
    Node& node = _nodes[part];
    node.key = key;
    node.parent = parent;
    node.place = std::uint32_t(_nodes[parent].inside.size());
    node.name = name.empty() ? None : nameOf(name);
    node.number = node.last = _nodes[parent].number;
    _nodes[parent].inside.push_back(part);
    if (node.name)
        ++_named[node.name].parts;
    if (isFeature(node))
        _isCurrent = false;
    return part;
}

void FeatureTree::hold(Part part)
{
    ++_nodes[part].holds;
}

void FeatureTree::release(Part part)
{
    --_nodes[part].holds;
    // Those around it stayed for its sake only.
    while (part != Scene && !_nodes[part].holds && _nodes[part].inside.empty())
    {
        const Part around = _nodes[part].parent;
        free(part);
        part = around;
    }
}

/// The numbers of others stay: ranges have gaps then.
void FeatureTree::free(Part part)
{
    Node& node = _nodes[part];
    if (const auto known = _byKey.find(node.key); known != _byKey.end() && known->second == part)
        _byKey.erase(known);
    std::vector<Part>& beside = _nodes[node.parent].inside;
    beside[node.place] = beside.back();
    _nodes[beside.back()].place = node.place;
    beside.pop_back();
    if (node.name)
    {
        --_named[node.name].parts;
        forget(node.name);
    }
    node = {};
    _freeParts.push_back(part);
}

void FeatureTree::addLabel(Part part)
{
    hold(part);
    if (_nodes[part].labels++ == 0)
        _isCurrent = false;
}

void FeatureTree::removeLabel(Part part)
{
    if (--_nodes[part].labels == 0)
        _isCurrent = false;
    release(part);
}

FeatureTree::Name FeatureTree::use(const std::string& name)
{
    if (name.empty())
        return None;
    const Name number = nameOf(name);
    // Even where no part has it: what adds only parts whose names are used takes note.
    if (_named[number].uses++ == 0)
        _isCurrent = false;
    return number;
}

void FeatureTree::unuse(Name name)
{
    if (!name)
        return;
    Named& named = _named[name];
    if (--named.uses == 0)
    {
        named.range = {};
        if (named.parts)
            _isCurrent = false;
    }
    forget(name);
}

bool FeatureTree::isUsed(const std::string& name) const
{
    const auto found = _names.find(name);
    return found != _names.end() && _named[found->second].uses;
}

bool FeatureTree::isFeature(const Node& node) const
{
    return node.labels || _named[node.name].uses;
}

/// All parts of one name are one feature: what lies in any of them gets numbers behind its own.
void FeatureTree::number(const std::vector<std::vector<Part>>& named)
{
    // Subgraphs may be deeper than the stack.
    struct Step
    {
        std::vector<Part> parts;
        std::uint32_t number;
        std::uint32_t depth; ///< Of the next feature inside.
        bool isFeature;
        std::size_t part = 0, child = 0;
    };
    std::uint32_t next = First;
    auto nesting = std::make_shared<Nesting>();
    std::vector<bool> isDone(_nodes.size());
    std::vector<Step> path;
    const auto enter = [&](Part part, std::uint32_t around)
    {
        const Node& node = _nodes[part];
        const bool isNew = isFeature(node), hasName = _named[node.name].uses > 0;
        const std::uint32_t depth = path.empty() ? 0 : path.back().depth;
        if (isNew)
            nesting->steps.push_back({around, next, depth});
        Step step{isNew && hasName ? named[node.name] : std::vector<Part>{part},
                  isNew ? next++ : around, depth + isNew, isNew};
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
        if (step.isFeature)
            nesting->steps[step.number - First].last = next - 1;
        for (const Part each : step.parts)
            if (step.isFeature)
            {
                Node& node = _nodes[each];
                node.last = next - 1;
                if (_named[node.name].uses)
                    _named[node.name].range = {node.number, node.last};
            }
        path.pop_back();
    }
    _nesting = nesting;
}

FeatureTree::Range FeatureTree::Nesting::at(std::uint32_t number, std::uint32_t depth) const
{
    if (number < First || number - First >= steps.size() || steps[number - First].depth < depth)
        return {number, number};
    while (steps[number - First].depth > depth)
        number = steps[number - First].around;
    return {number, steps[number - First].last};
}

std::uint32_t FeatureTree::Nesting::depthOf(std::uint32_t number) const
{
    return number < First || number - First >= steps.size() ? 0 : steps[number - First].depth;
}

void FeatureTree::update()
{
    if (_isCurrent)
        return;
    _isCurrent = true;
    ++_modifiedCount;
    std::vector<std::vector<Part>> named(_named.size());
    for (Named& each : _named)
        each.range = {};
    for (Part part = 0; part < _nodes.size(); ++part)
        if (const Name name = _nodes[part].name; _named[name].uses)
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
    return _named[name].range;
}

std::shared_ptr<const FeatureTree::Nesting> FeatureTree::getNesting()
{
    update();
    return _nesting;
}

FeatureTree::Range FeatureTree::getRangeOfPart(Part part)
{
    update();
    return {_nodes[part].number, _nodes[part].last};
}

} // namespace osgLabels
