// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>
#include <osgShadowVolume/LightReach.h>
#include <osgShadowVolume/ShadowSettings.h>
#include <osgShadowVolume/TriangleTree.h>

#include <osg/Node>
#include <osg/Vec3d>

#include <string>
#include <vector>

namespace osgShadowVolume
{

/// A rectangle of measuring points: a work plane, a floor, a part of a wall.
///
/// Points lie at the centres of equal cells, as EN 12464-1 has it. Its zone of 0.5 m along walls
/// that is left out is the caller's: make the plane smaller.
struct WorkPlane
{
    osg::Vec3d corner;        ///< World coordinates.
    osg::Vec3d u, v;          ///< The two sides from that corner.
    unsigned int columns = 0; ///< Cells along u; 0 for the standard's number.
    unsigned int rows = 0;    ///< Cells along v; likewise.
    osg::Vec3d normal;        ///< Side that is lit; zero: u x v, turned upwards.
};

/// The number of cells by EN 12464-1, section 4.4: sides d / p, rounded, with the grid size
/// p = 0.2 * 5^log10(d) metres, at most 10 m, where d is the longer side, or the shorter one if the
/// longer is at least twice as long. Sides in metres; 1 at least.
OSGSHADOWVOLUME_EXPORT void fillStandardCells(double uMetres, double vMetres, unsigned int& columns,
                                              unsigned int& rows);

/// Direct illuminance at points of a scene, in double precision, with shadows by ray casting.
///
/// Every LightSource that is not masked or switched off shines on everything, whatever GL modes are
/// on; the viewer's headlight is none. What casts shadows is what casts them in the picture. A
/// surface on which a point or a lamp lies (within 1e-6 of the scene's size) takes no light from
/// it. Reflected light does not count.
class OSGSHADOWVOLUME_EXPORT IlluminanceProbe
{
public:
    struct Reading
    {
        double lux = 0.0;
        std::vector<double> luxOfLight; ///< Parallel to getLights().
    };
    struct PlaneReading
    {
        double minimum = 0.0, mean = 0.0, maximum = 0.0; ///< Lux.
        double uniformity = 0.0;                         ///< Minimum by mean; 0 where it is dark.
        unsigned int columns = 0, rows = 0;
        std::vector<osg::Vec3d> points; ///< Row by row.
        std::vector<double> lux;        ///< Parallel to `points`.
    };

    /// Takes triangles and lights as they are now; the scene may change or go afterwards. Of the
    /// settings count metresPerUnit (0: what the scene states), candela and lux (of lights that
    /// state nothing), shadows (OFF: none) and transparentCasters.
    IlluminanceProbe(osg::Node& scene, const ShadowSettings& settings);

    /// Empty, or one line on what is unknown: scale, or lights without intensity. Then measure()
    /// is not to be called.
    const std::string& getError() const { return _error; }

    const std::vector<EyeLight>& getLights() const { return _lights; } ///< World coordinates.
    std::size_t getNumTriangles() const { return _tree.getNumTriangles(); }
    double getMetresPerUnit() const { return _metresPerUnit; }

    /// Lux on a surface element at a point, in world coordinates. The normal has any length; by
    /// default it points up, for horizontal illuminance. A zero normal gives 0. Thread safe.
    Reading measure(const osg::Vec3d& point,
                    const osg::Vec3d& normal = osg::Vec3d(0.0, 0.0, 1.0)) const;

    /// Lux at all points of a plane. One without an area gives no points.
    PlaneReading measure(const WorkPlane& plane) const;

private:
    std::vector<EyeLight> _lights;
    TriangleTree _tree;
    double _tolerance = 0.0;
    double _metresPerUnit = 0.0;
    std::string _error;
};

} // namespace osgShadowVolume
