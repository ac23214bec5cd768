// SPDX-License-Identifier: MIT
#include "Report.h"

#include <nlohmann/json.hpp>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/fstream>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace osgrender
{

namespace
{

nlohmann::json toJson(const Times& times)
{
    if (times.milliseconds.empty())
        return nullptr;
    return {{"median", times.quantile(0.5)},
            {"p99", times.quantile(0.99)},
            {"min", times.quantile(0.0)},
            {"count", times.milliseconds.size()}};
}

nlohmann::json toJson(const osgMultiRender::Plan& plan)
{
    nlohmann::json entries = nlohmann::json::array();
    for (const osgMultiRender::PlanEntry& entry : plan.entries)
        entries.push_back({{"subject", entry.subject},
                           {"decision", osgMultiRender::toString(entry.decision)},
                           {"reason", entry.reason}});
    return {{"kit", plan.kit},
            {"view", plan.view},
            {"frame", plan.frame},
            {"entries", entries},
            {"counts", plan.counts}};
}

nlohmann::json toJson(const osg::Vec3d& v)
{
    return {v.x(), v.y(), v.z()};
}

nlohmann::json toJson(const PointResult& point)
{
    nlohmann::json lights = nlohmann::json::array();
    for (const auto& [light, lux] : point.lights)
        lights.push_back({{"light", light}, {"lux", lux}});
    return {{"point", toJson(point.probe.point)},
            {"normal", toJson(point.probe.normal)},
            {"lux", point.lux},
            {"lights", lights}};
}

nlohmann::json toJson(const GridResult& grid)
{
    return {{"corner", toJson(grid.grid.corner)},
            {"u", toJson(grid.grid.u)},
            {"v", toJson(grid.grid.v)},
            {"columns", grid.grid.columns},
            {"rows", grid.grid.rows},
            {"minimum", grid.minimum},
            {"mean", grid.mean},
            {"maximum", grid.maximum},
            {"uniformity", grid.uniformity}};
}

nlohmann::json toJson(const PickResult& pick)
{
    return {{"point", {pick.point.x, pick.point.y}},
            {"identifier", pick.identifier},
            {"text", pick.text},
            {"path", pick.path}};
}

} // namespace

double Times::quantile(double share) const
{
    if (milliseconds.empty())
        return 0.0;
    std::vector<double> sorted = milliseconds;
    std::sort(sorted.begin(), sorted.end());
    const double rank = std::ceil(share * double(sorted.size()));
    return sorted[std::size_t(std::max(rank, 1.0)) - 1];
}

nlohmann::json toJson(const Report& report)
{
    nlohmann::json json = {
        {"model", report.model},
        {"backend", report.backend},
        {"renderer",
         {{"vendor", report.renderer.vendor},
          {"name", report.renderer.name},
          {"version", report.renderer.version},
          {"glsl", report.renderer.glsl}}},
        {"size", {report.width, report.height}},
        {"samples", report.samples},
        {"frames", report.frames},
        {"camera", report.camera},
        {"loadMs", report.loadMs},
        {"firstFrameMs", report.firstFrameMs},
        {"frameMs", toJson(report.frame)},
        {"cullMs", toJson(report.cull)},
        {"drawMs", toJson(report.draw)},
        {"gpuMs", toJson(report.gpu)},
        {"passes", report.passes},
        {"drawCalls", report.drawCalls},
        {"triangles", report.triangles},
        {"programs", {{"compiled", report.programsCompiled}, {"reused", report.programsReused}}},
        {"textureBytes", report.textureBytes},
        {"coverage", report.coverage},
        {"glErrors", report.glErrors},
        {"warnings", report.warnings},
        {"plans", nlohmann::json::array()}};
    for (const osgMultiRender::Plan& plan : report.plans)
        json["plans"].push_back(toJson(plan));
    for (const PointResult& point : report.probes.points)
        json["probes"].push_back(toJson(point));
    for (const GridResult& grid : report.probes.grids)
        json["probeGrids"].push_back(toJson(grid));
    for (const PickResult& pick : report.picks)
        json["picks"].push_back(toJson(pick));
    if (report.comparison)
        json["comparison"] = *report.comparison;
    return json;
}

bool writeReport(const Report& report, const std::string& file, std::string& error)
{
    const std::string folder = osgDB::getFilePath(file);
    if (!folder.empty())
        osgDB::makeDirectory(folder);
    osgDB::ofstream stream(file.c_str());
    // A file name need not be UTF-8; what is not is replaced instead of thrown.
    stream << toJson(report).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
    stream.close();
    if (!stream)
        error = "can't write '" + file + "'";
    return error.empty();
}

std::string planText(const Report& report)
{
    std::ostringstream text;
    for (const osgMultiRender::Plan& plan : report.plans)
        text << osgMultiRender::toString(plan);
    if (report.plans.empty())
        text << "OpenSceneGraph's own rendering, no kit in the scene:\n  " << report.drawCalls
             << " draw calls, " << report.triangles << " triangles: drawn, in one pass\n";
    return text.str();
}

} // namespace osgrender
