// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/LabelSettings.h>

#include <osg/Node>

#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace osgLabels
{

/// What stands before labels, by classes: "tree:fade,building:hide".
class OSGLABELS_EXPORT MapClasses
{
public:
    /// Rules of a regular expression (ECMAScript) and an action, separated by commas; the first
    /// that fits counts. Fills `error` and returns false where the text is none; "" is no rule.
    bool parse(const std::string& text, std::string& error);

    /// What the last node of a path does to labels. From that node up, each one's class is its user
    /// value "labelClass", else its name; the first that a rule is found in counts.
    std::optional<MapAction> actionOf(const osg::NodePath& path) const;
    /// Of a name alone.
    std::optional<MapAction> find(const std::string& name) const;

private:
    struct Rule
    {
        std::regex pattern;
        MapAction action;
    };
    std::vector<Rule> _rules;
};

} // namespace osgLabels
