// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace osgLabels
{

/// The named parts of a scene, one inside another, and which of them labels name.
///
/// A part that a label names is a feature; so is what lies in it, but for features of its own.
/// Numbers are given so that those inside a feature follow its own. All that is in no feature has
/// the number Foreign.
class OSGLABELS_EXPORT FeatureTree
{
public:
    using Part = std::uint32_t;
    using Name = std::uint32_t;
    static constexpr Part Scene = 0;            ///< What all parts lie in.
    static constexpr Name None = 0;             ///< Of a label without a feature.
    static constexpr std::uint32_t Foreign = 1; ///< 0 is nothing at all.
    static constexpr std::uint32_t First = 2;   ///< Number of a feature.

    /// Numbers from `first` to `last`; none where last < first.
    struct Range
    {
        std::uint32_t first = 1, last = 0;
    };

    /// The part with this key, made if it is new. `key` tells parts of the scene apart; one that
    /// had another name is another part's from now on.
    Part add(Part parent, std::uint64_t key, const std::string& name);
    /// A label names a part for itself, whatever its name.
    void setLabelled(Part part);
    /// A label names all parts of a name; there may be none yet. Empty: None.
    Name use(const std::string& name);
    bool isUsed(const std::string& name) const;

    /// Of what lies in a part, and in no part inside of it. Numbers may change with each call of
    /// the others.
    std::uint32_t getNumber(Part part);
    /// Of a feature and what is inside; several parts of one name are one feature.
    Range getRange(Name name);
    Range getRangeOfPart(Part part);

    /// Grows when numbers that were given have changed.
    unsigned int getModifiedCount() const { return _modifiedCount; }

private:
    struct Node
    {
        Part parent = Scene;
        Name name = None;
        bool isLabelled = false;
        std::uint32_t number = Foreign;
        std::uint32_t last = Foreign; ///< Of what is inside.
        std::vector<Part> inside;
    };

    void update();
    void number(const std::vector<std::vector<Part>>& named);
    bool isFeature(const Node& node) const;

    std::vector<Node> _nodes{1};
    std::unordered_map<std::uint64_t, Part> _byKey;
    std::unordered_map<std::string, Name> _names;
    std::vector<bool> _isUsed{false};    ///< By name.
    std::vector<Range> _ranges{Range{}}; ///< By name.
    bool _isCurrent = true;
    unsigned int _modifiedCount = 0;
};

} // namespace osgLabels
