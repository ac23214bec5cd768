// SPDX-License-Identifier: MIT
#include "Probe.h"

#include "Parse.h"

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/fstream>

#include <cstdio>
#include <set>

namespace osgrender
{

namespace
{

/// To six digits, as %g writes them.
std::string toText(double value)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.6g", value);
    return text;
}

std::string toText(const osg::Vec3d& v)
{
    return toText(v.x()) + "," + toText(v.y()) + "," + toText(v.z());
}

bool parseCells(const std::string& text, ProbeGrid& grid)
{
    const std::vector<std::string> parts = split(text, 'x');
    long columns = 0, rows = 0;
    if (parts.size() != 2 || !parseWhole(parts[0], 1, 10000, columns) ||
        !parseWhole(parts[1], 1, 10000, rows))
        return false;
    grid.columns = static_cast<unsigned int>(columns);
    grid.rows = static_cast<unsigned int>(rows);
    return true;
}

/// Reads one "key:value". The message says what the value has to be.
std::string parsePart(const std::string& key, const std::string& value, ProbeGrid& grid)
{
    if (key == "n")
        return parseCells(value, grid) ? "" : "n takes COLUMNSxROWS, each 1 to 10000";
    osg::Vec3d* vector = key == "corner"   ? &grid.corner
                         : key == "u"      ? &grid.u
                         : key == "v"      ? &grid.v
                         : key == "normal" ? &grid.normal
                                           : nullptr;
    if (!vector)
        return "unknown part '" + key + "' (known: corner u v n normal)";
    return parseVector(value, *vector) ? "" : key + " takes three numbers x,y,z";
}

} // namespace

bool parseProbe(const std::string& text, ProbePoint& probe, std::string& error)
{
    double values[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    const std::vector<std::string> parts = split(text, ',');
    bool right = parts.size() == 3 || parts.size() == 6;
    for (std::size_t i = 0; right && i < parts.size(); ++i)
        right = parseNumber(parts[i], values[i]);
    probe.point.set(values[0], values[1], values[2]);
    probe.normal.set(values[3], values[4], values[5]);
    if (!right)
        error = "'" + text + "' is neither x,y,z nor x,y,z,nx,ny,nz";
    else if (probe.normal.length2() == 0.0)
        error = "the normal has length 0";
    return error.empty();
}

bool parseProbeGrid(const std::string& text, ProbeGrid& grid, std::string& error)
{
    grid = ProbeGrid();
    std::set<std::string> seen;
    for (const std::string& part : split(text, ';'))
    {
        const std::size_t colon = part.find(':');
        const std::string key = part.substr(0, colon);
        if (colon == std::string::npos)
            error = "'" + part + "' is not key:value";
        else if (!seen.insert(key).second)
            error = "'" + key + "' is given twice";
        else
            error = parsePart(key, part.substr(colon + 1), grid);
        if (!error.empty())
            return false;
    }
    if (!seen.count("corner") || !seen.count("u") || !seen.count("v"))
        error = "corner:x,y,z, u:x,y,z and v:x,y,z are needed";
    else if (!((grid.u ^ grid.v).length2() > 0.0))
        error = "u and v span no area";
    else if (seen.count("normal") && grid.normal.length2() == 0.0)
        error = "the normal has length 0";
    return error.empty();
}

std::string probeText(const ProbeResult& result)
{
    std::string text;
    for (const PointResult& point : result.points)
    {
        text += "probe " + toText(point.probe.point) + " normal " + toText(point.probe.normal) +
                ": " + toText(point.lux) + " lux";
        for (const auto& [light, lux] : point.lights)
            text += (&light == &point.lights.front().first ? " = " : " + ") + toText(lux) + " (" +
                    light + ")";
        text += "\n";
    }
    for (const GridResult& grid : result.grids)
        text += "probe grid at " + toText(grid.grid.corner) + ", " +
                std::to_string(grid.grid.columns) + "x" + std::to_string(grid.grid.rows) +
                " points: minimum " + toText(grid.minimum) + " lux, mean " + toText(grid.mean) +
                " lux, maximum " + toText(grid.maximum) + " lux, uniformity " +
                toText(grid.uniformity) + "\n";
    return text;
}

bool writeProbeCsv(const ProbeResult& result, const std::string& file, std::string& error)
{
    const std::string folder = osgDB::getFilePath(file);
    if (!folder.empty())
        osgDB::makeDirectory(folder);
    osgDB::ofstream stream(file.c_str());
    stream << "grid,column,row,x,y,z,lux\n";
    for (std::size_t i = 0; i < result.grids.size(); ++i)
    {
        const GridResult& grid = result.grids[i];
        for (std::size_t point = 0; point < grid.points.size(); ++point)
            stream << i << "," << point % grid.grid.columns << "," << point / grid.grid.columns
                   << "," << toText(grid.points[point]) << "," << toText(grid.lux[point]) << "\n";
    }
    stream.close();
    if (!stream)
        error = "can't write '" + file + "'";
    return error.empty();
}

} // namespace osgrender
