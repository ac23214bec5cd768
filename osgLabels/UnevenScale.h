// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <osg/Drawable>
#include <osg/Matrixd>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace osgLabels
{

/// What a matrix does to a shape beside moving, turning, mirroring and scaling evenly: a symmetric
/// matrix of determinant 1, after which the rest of it is a similarity. None where nothing is left
/// (to 1e-6), and for matrices that flatten a shape by more than 10,000 to 1.
OSGLABELS_EXPORT std::optional<osg::Matrixd> unevenScaleOf(const osg::Matrixd& matrix);

/// The uneven scales above the drawables of a scene, each once, so that letters on them are not
/// stretched: an object's shape is fitted as it is seen, and its label's coordinates are those.
/// One that nothing holds any more is forgotten, and its number is given again.
class UnevenScales
{
public:
    /// Holds that of a path's matrix and returns its number; 0, which holds nothing, for none, and
    /// where a drawable's shape can't be scaled.
    std::uint32_t hold(const osg::Drawable& drawable, const osg::Matrixd& matrix);
    /// Once for each hold(); nothing for 0.
    void release(std::uint32_t number);
    /// Null for 0 and for what nothing holds.
    std::shared_ptr<const osg::Matrixd> get(std::uint32_t number) const
    {
        return number && number <= _all.size() ? _all[number - 1].matrix : nullptr;
    }

private:
    using Key = std::array<float, 6>;
    struct Scale
    {
        std::shared_ptr<const osg::Matrixd> matrix; ///< Null for a number that is free.
        Key key{};
        std::uint32_t holders = 0;
    };
    std::map<Key, std::uint32_t> _numbers;
    std::vector<Scale> _all;
    std::vector<std::uint32_t> _free;
};

} // namespace osgLabels
