// SPDX-License-Identifier: MIT
// RenderJob's statistics: what OSG and the kits tell of the frames that were drawn.
#include "RenderJob.h"

#include <algorithm>
#include <cmath>

namespace osgrender
{

namespace
{

/// Collects the plans of the kits in a scene.
class PlanCollector : public osg::NodeVisitor
{
public:
    PlanCollector() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override
    {
        if (const auto* planned = dynamic_cast<const osgMultiRender::Planned*>(&node))
        {
            const std::vector<osgMultiRender::Plan> found = planned->getPlans();
            plans.insert(plans.end(), found.begin(), found.end());
        }
        traverse(node);
    }

    std::vector<osgMultiRender::Plan> plans;
};

} // namespace

void RenderJob::gatherStatistics()
{
    const osg::Stats& stats = *_viewer->getCamera()->getStats();
    const unsigned int frame = _viewer->getFrameStamp()->getFrameNumber();
    const auto read = [&](const std::string& name)
    {
        double value = 0.0;
        stats.getAttribute(frame, name, value);
        return value;
    };
    PlanCollector collector;
    _model->accept(collector);
    _report.plans = collector.plans;
    const auto sum = [&](const std::string& name)
    {
        double total = 0.0;
        for (const osgMultiRender::Plan& plan : _report.plans)
        {
            const auto count = plan.counts.find(name);
            total += count == plan.counts.end() ? 0.0 : count->second;
        }
        return total;
    };
    // OSG's statistics have each leaf once; a kit adds the draws of its further passes.
    const double leaves = sum("leaves.program") + sum("leaves.fixedFunction");
    _report.drawCalls =
        read("Visible number of PrimitiveSets") + std::max(0.0, sum("drawCalls") - leaves);
    _report.triangles = sum("triangles");
    for (const char* mode : {"GL_TRIANGLES", "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN", "GL_POLYGON"})
        _report.triangles += read(std::string("Visible number of ") + mode);
    for (const char* mode : {"GL_QUADS", "GL_QUAD_STRIP"})
        _report.triangles += 2.0 * read(std::string("Visible number of ") + mode);
    _report.passes = std::max(1.0, sum("passes"));
    _report.programsCompiled = sum("programs.compiled") + _contents.programs;
    _report.programsReused = sum("programs.reused");
    _report.textureBytes = _capture->getTextureBytes();
    _report.renderer = _capture->getRenderer();
    const osg::Camera& camera = *_viewer->getCamera();
    const osg::Vec3d middle = _model->getBound().center();
    _report.camera = describeCamera(camera, -(middle * camera.getViewMatrix()).z());
}

void RenderJob::gatherTimes(unsigned int firstFrame)
{
    const osg::Stats& stats = *_viewer->getCamera()->getStats();
    const auto read = [&](const std::string& name)
    {
        Times times;
        double seconds = 0.0;
        for (unsigned int i = firstFrame; i <= stats.getLatestFrameNumber(); ++i)
        {
            if (stats.getAttribute(i, name, seconds))
                times.milliseconds.push_back(1000.0 * seconds);
        }
        return times;
    };
    _report.cull = read("Cull traversal time taken");
    _report.draw = read("Draw traversal time taken");
    _report.gpu = read("GPU draw time taken");
}

void RenderJob::measureCoverage()
{
    const osg::ref_ptr<osg::Image> picture = _capture->getPicture();
    const osg::Vec4 clear = _viewer->getCamera()->getClearColor();
    long covered = 0;
    for (unsigned int y = 0; y < unsigned(picture->t()); ++y)
    {
        for (unsigned int x = 0; x < unsigned(picture->s()); ++x)
        {
            const osg::Vec4 color = picture->getColor(x, y);
            bool same = true;
            for (int i = 0; i < 3; ++i)
                same = same && std::abs(color[i] - clear[i]) <= 1.5f / 255.0f;
            covered += !same;
        }
    }
    _report.coverage = double(covered) / (double(picture->s()) * double(picture->t()));
}

} // namespace osgrender
