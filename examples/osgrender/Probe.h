// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Node>
#include <osg/Vec3d>

#include <string>
#include <utility>
#include <vector>

namespace osgrender
{

/// A point to measure illuminance at, in world coordinates.
struct ProbePoint
{
    osg::Vec3d point;
    osg::Vec3d normal{0.0, 0.0, 1.0};
};

/// A rectangle of points to measure at.
struct ProbeGrid
{
    osg::Vec3d corner, u, v;
    osg::Vec3d normal;                  ///< Zero: u x v, turned upwards.
    unsigned int columns = 0, rows = 0; ///< 0: as many as EN 12464-1 asks for.
};

/// What a command line asks to measure.
struct ProbeSetting
{
    std::vector<ProbePoint> points;
    std::vector<ProbeGrid> grids;
    double metresPerUnit = 0.0; ///< 0: what the scene states.
    double candela = 0.0;       ///< Of point and spot lights that state none; 0: unknown.
    double lux = 0.0;           ///< Of directional lights likewise.
    std::string csv;            ///< File for all points of all grids; empty: none.

    bool isAsked() const { return !points.empty() || !grids.empty(); }
};

struct PointResult
{
    ProbePoint probe;
    double lux = 0.0;
    std::vector<std::pair<std::string, double>> lights; ///< Each light's share.
};

struct GridResult
{
    ProbeGrid grid; ///< With the number of points that it has.
    double minimum = 0.0, mean = 0.0, maximum = 0.0, uniformity = 0.0;
    std::vector<osg::Vec3d> points;
    std::vector<double> lux; ///< Parallel to `points`.
};

struct ProbeResult
{
    std::vector<PointResult> points;
    std::vector<GridResult> grids;
};

/// Reads "x,y,z" or "x,y,z,nx,ny,nz". Returns false and fills `error` on anything else, and on a
/// normal of length 0.
bool parseProbe(const std::string& text, ProbePoint& probe, std::string& error);

/// Reads "corner:x,y,z;u:x,y,z;v:x,y,z[;n:COLUMNSxROWS][;normal:x,y,z]". Returns false and fills
/// `error` on a missing, unknown or wrong part, and on sides that span no area.
bool parseProbeGrid(const std::string& text, ProbeGrid& grid, std::string& error);

/// Measures in the model as it is now. Returns false and fills `error` where scale or intensities
/// are unknown, or this osgrender has no osgShadowVolume.
bool measure(osg::Node& model, const ProbeSetting& setting, ProbeResult& result,
             std::string& error);

/// One line a point or grid.
std::string probeText(const ProbeResult& result);

/// Writes all points of all grids: grid, column, row, position and lux. Returns false and fills
/// `error` when the file can't be written.
bool writeProbeCsv(const ProbeResult& result, const std::string& file, std::string& error);

} // namespace osgrender
