// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/LabelFile.h>

#include <osg/Node>

#include <memory>
#include <optional>
#include <regex>
#include <string>

namespace osgLabels
{

/// Where the text of an object comes from. On the way from the Drawable up, the first node that has
/// one gives it.
enum class LabelFrom
{
    NAME,        ///< Its name.
    DESCRIPTION, ///< Its first description that is not empty.
    VALUE,       ///< A user value: a string, a number or a truth value.
    TABLE        ///< The text that a file has for its name.
};

struct LabelSourceSettings
{
    LabelFrom from = LabelFrom::NAME;
    std::string value = "label"; ///< Name of the user value.
    std::string table;           ///< A file for readLabelFile().
    /// Only nodes count in whose name this ECMAScript regular expression is found; empty for all.
    std::string match;
    /// With `match` and NAME: the text made of what matched, "$1" and so on; empty for the name.
    std::string format;
};

/// Says which text the objects of a scene carry.
///
/// Names that nobody has given do not count: blank ones, the node's class ("Geode"), and what
/// Inventor's reader calls a Geode whose shape has no name, that of the shape's texture. Drawables
/// are nodes, too, so their own names come first. An empty text in a table or a user value is none,
/// and ends the search: so a part can be left out. The style of a label is what the table says for
/// its name; else the user value "labelStyle", a string, of the node that gives the text or of the
/// nearest one above that has it: a group's is that of all in it. Safe to use from any thread while
/// nobody changes the nodes.
class OSGLABELS_EXPORT LabelSource
{
public:
    /// Null with one line in `error` for a regular expression that is none, a format without a
    /// match, and a table that can't be read.
    static std::shared_ptr<const LabelSource> create(const LabelSourceSettings& settings,
                                                     std::string& error);

    struct Found
    {
        std::string text;      ///< UTF-8, not empty.
        std::size_t depth = 0; ///< path[depth] gives it.
        std::string style;     ///< Name of a LabelStyle; empty for none of its own.
    };
    /// The text of the last node of a path; none where it has no label.
    std::optional<Found> find(const osg::NodePath& path) const;

    /// The text of an object that is no node but has a name and lies at the end of the path; none
    /// without a label. `depth` is that of the path's last node.
    std::optional<Found> ofName(const std::string& name, const osg::NodePath& path) const;

    /// Name of the user value that says the style.
    static constexpr char StyleValue[] = "labelStyle";

    /// Whether a name says what the node is.
    static bool hasName(const osg::Node& node);

private:
    LabelSource() = default;
    std::optional<TableLabel> labelOf(const osg::Node& node) const;
    std::optional<TableLabel> inTable(const std::string& name) const;
    std::optional<std::string> formatted(const std::string& name) const;

    LabelSourceSettings _settings;
    std::regex _match;
    TextByName _texts;
};

} // namespace osgLabels
