// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/MapPlacement.h>

#include <vector>

namespace osgLabels
{

/// Where map labels lie in a picture and how far away, in tiles: says which surfaces can't stand
/// before any of them.
class MapCoverage
{
public:
    explicit MapCoverage(const PixelBox& viewport);

    /// `distance`: nothing farther hides the label. `own`: what never does.
    void add(const PixelBox& box, double distance, const FeatureTree::Range& own);

    /// Whether something in a box, nowhere nearer than `distance`, may stand before a label that
    /// is not its own. `number` is that of its feature; 0: of several.
    bool mayHide(const PixelBox& box, double distance, std::uint32_t number) const;
    /// Whether its own label is there; `number` 0: that of any feature.
    bool mayOwn(const PixelBox& box, std::uint32_t number) const;

    /// Around all labels.
    const PixelBox& getBox() const { return _box; }

private:
    static constexpr int Tiles = 64; ///< On a side.

    struct Tile
    {
        /// Of the labels here, by two different owners: a feature is the owner of one at most.
        double farthest[2] = {-1e300, -1e300};
        FeatureTree::Range own[2];
        bool several = false; ///< More owners than two.
    };
    struct Span
    {
        int left, bottom, right, top; ///< The last ones too.
    };
    bool spanOf(const PixelBox& box, Span& span) const;

    PixelBox _viewport, _box;
    double _width, _height; ///< Of a tile.
    std::vector<Tile> _tiles;
};

} // namespace osgLabels
