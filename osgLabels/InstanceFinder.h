// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <osg/BoundingBox>
#include <osg/Matrixd>
#include <osg/Node>

#include <cstdint>
#include <vector>

namespace osgLabels
{

/// All paths that lead from `top` down to `node`, both included, at most `most` of them.
OSGLABELS_EXPORT std::vector<osg::NodePath> pathsFrom(const osg::Node& top, const osg::Node& node,
                                                      std::size_t most);

/// Hash of the first `count` nodes of a path, by their addresses.
OSGLABELS_EXPORT std::uint64_t hashOf(const osg::NodePath& path, std::size_t count);

/// Which instance of a Drawable it is that has a given matrix.
///
/// A point of the Drawable that no rotation of it leaves in place is carried along; that is what
/// tells instances apart. It is searched for in cells of the Drawable's size.
class OSGLABELS_EXPORT InstanceFinder
{
public:
    static constexpr std::size_t None = ~std::size_t(0);

    InstanceFinder() = default;
    /// `box` is the Drawable's. Matrices are those of the paths below their first node.
    InstanceFinder(const osg::BoundingBox& box, const std::vector<osg::NodePath>& paths);

    /// Index of the path with this matrix, None where there is none within rounding errors.
    std::size_t find(const osg::Matrixd& localToTop, double roundingError) const;
    /// Index of the path nearest to this matrix.
    std::size_t findNearest(const osg::Matrixd& localToTop) const;

    std::size_t size() const { return _places.size(); }

private:
    struct Place
    {
        osg::Vec3d point;
        std::size_t path = 0;
    };

    std::size_t bucketOf(const osg::Vec3d& cell) const;
    osg::Vec3d cellOf(const osg::Vec3d& point) const;

    osg::Vec3d _point; ///< Local.
    double _size = 1.0;
    std::vector<Place> _places;          ///< By bucket.
    std::vector<std::uint32_t> _buckets; ///< First place of each bucket, and the end.
};

} // namespace osgLabels
