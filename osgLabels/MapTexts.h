// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphSet.h>
#include <osgLabels/LabelTable.h>
#include <osgLabels/MapFeatures.h>
#include <osgLabels/MapLabels.h>

#include <osg/observer_ptr>

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
class MapTexts
{
public:
    MapTexts(std::shared_ptr<GlyphSet> glyphs, MapFeatures& features);

    /// The labels of a node, as they are now; those that can't be shown are left out, which a node
    /// is said once. While nobody changes the node.
    std::shared_ptr<const std::vector<PreparedLabel>> of(const MapLabels& node);
    /// A label that stays as long as this.
    PreparedLabel add(const MapLabel& label);

    bool setText(std::uint32_t identifier, const std::string& text);
    std::string getText(std::uint32_t identifier) const;
    const std::shared_ptr<LabelTable>& getTable() const { return _table; }

private:
    struct Known
    {
        osg::observer_ptr<const MapLabels> node;
        unsigned int modifiedCount = 0;
        std::shared_ptr<const std::vector<PreparedLabel>> labels;
    };
    PreparedLabel prepare(const MapLabel& label);
    float widthOf(const LabelTable::Codes& codes) const;
    void forget(const Known& known);
    void sweep();

    const std::shared_ptr<GlyphSet> _glyphs;
    MapFeatures& _features;
    const std::shared_ptr<LabelTable> _table = std::make_shared<LabelTable>();
    mutable std::mutex _mutex;
    std::unordered_map<const MapLabels*, Known> _known;
    std::size_t _sweepAt = 64;
    std::vector<std::string> _texts{1}; ///< By identifier.
    std::vector<std::uint32_t> _free;
};

} // namespace osgLabels
