// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <cstdint>
#include <memory>
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
///
/// A part stays as long as somebody holds it, labels it, or has a part inside of it.
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

    /// How features lie in each other, by number.
    struct Nesting
    {
        struct Step
        {
            std::uint32_t around; ///< Number of the feature that it lies in, or Foreign.
            std::uint32_t last;   ///< Of what is inside.
            std::uint32_t depth;  ///< 0 in no other.
        };
        std::vector<Step> steps; ///< From First on.

        /// Of the feature of that depth that a number lies in or is; the number alone where there
        /// is none.
        Range at(std::uint32_t number, std::uint32_t depth) const;
        /// Of the feature with a number.
        std::uint32_t depthOf(std::uint32_t number) const;
    };

    /// The part with this key, made if it is new. `key` tells parts of the scene apart; one that
    /// had another name is another part's from now on. It stays until somebody has held it.
    Part add(Part parent, std::uint64_t key, const std::string& name);
    void hold(Part part);
    /// Once for each hold().
    void release(Part part);
    /// A label names a part for itself, whatever its name; it holds it.
    void addLabel(Part part);
    void removeLabel(Part part);
    /// A label names all parts of a name; there may be none yet. Empty: None.
    Name use(const std::string& name);
    /// Once for each use().
    void unuse(Name name);
    bool isUsed(const std::string& name) const;

    /// Of what lies in a part, and in no part inside of it. Numbers may change with each call of
    /// the others.
    std::uint32_t getNumber(Part part);
    /// Of a feature and what is inside; several parts of one name are one feature.
    Range getRange(Name name);
    Range getRangeOfPart(Part part);
    /// As numbers are now; not changed later.
    std::shared_ptr<const Nesting> getNesting();

    /// Grows when numbers that were given have changed.
    unsigned int getModifiedCount() const { return _modifiedCount; }

    /// With the scene.
    std::size_t getPartCount() const { return _nodes.size() - _freeParts.size(); }
    /// Of parts and labels.
    std::size_t getNameCount() const { return _names.size(); }

private:
    struct Node
    {
        std::uint64_t key = 0;
        Part parent = Scene;
        std::uint32_t place = 0; ///< Among the parent's parts.
        Name name = None;
        std::uint32_t labels = 0; ///< That name it for itself.
        std::uint32_t holds = 0;  ///< By these and by others.
        std::uint32_t number = Foreign;
        std::uint32_t last = Foreign; ///< Of what is inside.
        std::vector<Part> inside;
    };
    struct Named
    {
        const std::string* text = nullptr; ///< In _names; null for a number that is free.
        std::uint32_t parts = 0;
        std::uint32_t uses = 0;
        Range range;
    };

    Name nameOf(const std::string& text);
    void forget(Name name);
    void free(Part part);
    void update();
    void number(const std::vector<std::vector<Part>>& named);
    bool isFeature(const Node& node) const;

    std::vector<Node> _nodes{1};
    std::vector<Part> _freeParts;
    std::unordered_map<std::uint64_t, Part> _byKey;
    std::unordered_map<std::string, Name> _names;
    std::vector<Named> _named{1}; ///< By name.
    std::vector<Name> _freeNames;
    std::shared_ptr<const Nesting> _nesting = std::make_shared<Nesting>();
    bool _isCurrent = true;
    unsigned int _modifiedCount = 0;
};

} // namespace osgLabels
