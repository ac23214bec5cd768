// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <osg/Drawable>
#include <osg/Matrixd>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace osgLabels
{

/// What a matrix does to a shape beside moving, turning, mirroring and scaling evenly: a symmetric
/// matrix of determinant 1, after which the rest of it is a similarity. None where nothing is left
/// (to 1e-6), and for matrices that flatten a shape by more than 10,000 to 1.
OSGLABELS_EXPORT std::optional<osg::Matrixd> unevenScaleOf(const osg::Matrixd& matrix);

/// The uneven scales above the drawables of a scene, each once, so that letters on them are not
/// stretched: an object's shape is fitted as it is seen, and its label's coordinates are those.
class UnevenScales
{
public:
    /// The number of that of a path's matrix; 0 for none, and where a drawable's shape can't be
    /// scaled.
    std::uint32_t numberOf(const osg::Drawable& drawable, const osg::Matrixd& matrix);
    /// Stays valid; null for 0.
    const osg::Matrixd* get(std::uint32_t number) const
    {
        return number ? _all[number - 1] : nullptr;
    }

private:
    std::map<std::array<float, 6>, std::pair<std::uint32_t, osg::Matrixd>> _numbers;
    std::vector<const osg::Matrixd*> _all;
};

} // namespace osgLabels
