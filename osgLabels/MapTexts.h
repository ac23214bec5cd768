// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/FramesInFlight.h>
#include <osgLabels/GlyphSet.h>
#include <osgLabels/LabelTable.h>
#include <osgLabels/MapFeatures.h>
#include <osgLabels/MapLabels.h>

#include <osg/observer_ptr>

#include <optional>

namespace osgLabels
{

/// A label of a node, as it is drawn.
struct PreparedLabel
{
    osg::Vec3d anchor;
    double priority = 0.0;
    std::uint32_t identifier = 0; ///< Of its text in the table of map labels.
    std::uint32_t style = 0;
    float width = 0.0f; ///< em
    FeatureTree::Name feature = FeatureTree::None;
    FeatureTree::Part part = FeatureTree::Scene; ///< Of a label by user values.
};

/// The texts of map labels: they have a table of their own, so that numbers of surface labels stay
/// without gaps. Thread safe.
class OSGLABELS_EXPORT MapTexts
{
public:
    /// The number of a named style; 0 for an empty name.
    using StyleOf = std::function<std::uint32_t(const std::string& name)>;
    /// Identifiers that `frames` may show are not given again.
    MapTexts(std::shared_ptr<GlyphSet> glyphs, StyleOf styleOf, MapFeatures& features,
             const FramesInFlight& frames);

    /// The labels of a node, as they are now; those that can't be shown are left out, which a node
    /// is said once. While nobody changes the node.
    std::shared_ptr<const std::vector<PreparedLabel>> of(const MapLabels& node);
    /// A label that stays until remove().
    PreparedLabel add(const MapLabel& label);
    void remove(const PreparedLabel& label);

    /// False for an identifier that no label has.
    bool setText(std::uint32_t identifier, const std::string& text);
    bool setStyle(std::uint32_t identifier, std::uint32_t style);
    std::string getText(std::uint32_t identifier) const;
    std::optional<std::uint32_t> getStyle(std::uint32_t identifier) const;
    /// Takes what setText() and setStyle() have changed in a label of add().
    void update(PreparedLabel& label) const;
    const std::shared_ptr<LabelTable>& getTable() const { return _table; }

private:
    struct Known
    {
        osg::observer_ptr<const MapLabels> node;
        unsigned int modifiedCount = 0;
        std::shared_ptr<const std::vector<PreparedLabel>> labels;
    };
    struct Text
    {
        std::string text; ///< Empty: no label has the identifier.
        std::uint32_t style = 0;
        float width = 0.0f;
    };
    PreparedLabel prepare(const MapLabel& label, std::uint32_t identifier);
    std::uint32_t newIdentifier();
    bool isKnown(std::uint32_t identifier) const;
    void setTextOf(std::uint32_t identifier, const std::string& text);
    void updateNodes(std::uint32_t identifier);
    float widthOf(const LabelTable::Codes& codes) const;
    void forget(const std::vector<PreparedLabel>& labels, std::size_t first);
    void sweep();

    const std::shared_ptr<GlyphSet> _glyphs;
    const StyleOf _styleOf;
    MapFeatures& _features;
    const FramesInFlight& _frames;
    const std::shared_ptr<LabelTable> _table = std::make_shared<LabelTable>();
    mutable std::mutex _mutex;
    std::unordered_map<const MapLabels*, Known> _known;
    std::size_t _sweepAt = 64;
    std::vector<Text> _texts{1}; ///< By identifier.
    std::vector<std::uint32_t> _free;
    Retired<std::uint32_t> _retired;
};

} // namespace osgLabels
