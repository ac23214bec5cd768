// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <osg/Node>

#include <regex>
#include <string>
#include <vector>

namespace osgLabels
{

/// What becomes of the pixels of a map label that something else stands before. Of several
/// things the first action of these counts.
enum class MapAction : unsigned int
{
    Hide,
    Outline, ///< The edges of its letters are left.
    Recolor, ///< Letters take LabelSettings::mapColor.
    Fade,    ///< Drawn with LabelSettings::mapFade of its opacity.
    Ignore   ///< As if nothing stood there.
};
constexpr unsigned int NumMapActions = 4; ///< Those that change something.

/// What stands before labels, by classes: "tree:fade,building:hide".
class OSGLABELS_EXPORT MapClasses
{
public:
    /// Rules of a regular expression (ECMAScript) and an action, separated by commas; the first
    /// that fits counts. Fills `error` and returns false where the text is none; "" is no rule.
    bool parse(const std::string& text, std::string& error);

    /// What the last node of a path does to labels. From that node up, each one's class is its user
    /// value "labelClass", else its name; the first that a rule is found in counts. Hide where
    /// none is.
    MapAction actionOf(const osg::NodePath& path) const;
    /// Of a name alone.
    const MapAction* find(const std::string& name) const;

private:
    struct Rule
    {
        std::regex pattern;
        MapAction action;
    };
    std::vector<Rule> _rules;
};

} // namespace osgLabels
