// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PagedGraph.h>

#include <osgPagedTexture/Pager.h>

#include <osgMultiRender/Overlay.h>

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Viewport>
#include <osgText/Text>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cstdio>

namespace osgPagedTexture
{

namespace
{

constexpr std::size_t GraphsKept = 16; ///< Of several views and frames.
constexpr std::size_t Bars = 256;      ///< Frames.
constexpr float Height = 60.0f;        ///< Pixels of twice the budget.

void addQuad(osg::Vec3Array& vertices, osg::Vec4Array& colors, float x, float y, float width,
             float height, const osg::Vec4& color)
{
    for (const osg::Vec3& corner :
         {osg::Vec3(x, y, 0), osg::Vec3(x + width, y, 0), osg::Vec3(x + width, y + height, 0),
          osg::Vec3(x, y + height, 0)})
    {
        vertices.push_back(corner);
        colors.push_back(color);
    }
}

osg::ref_ptr<osg::Geometry> makeBars(const std::vector<double>& times, double budget)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    addQuad(*vertices, *colors, 6.0f, 6.0f, 488.0f, Height + 44.0f, // As wide as the text.
            osg::Vec4(0.0f, 0.0f, 0.0f, 0.6f));
    const std::size_t first = times.size() > Bars ? times.size() - Bars : 0;
    for (std::size_t i = first; i < times.size(); ++i)
    {
        const float share = float(std::clamp(times[i] / (2.0 * budget), 0.0, 1.0));
        addQuad(*vertices, *colors, 10.0f + float(i - first), 10.0f, 1.0f, 1.0f + share * Height,
                times[i] > budget ? osg::Vec4(1.0f, 0.4f, 0.2f, 1.0f)
                                  : osg::Vec4(0.4f, 0.9f, 0.4f, 1.0f));
    }
    addQuad(*vertices, *colors, 10.0f, 10.0f + 0.5f * Height, float(Bars), 1.0f,
            osg::Vec4(1.0f, 1.0f, 1.0f, 0.7f));
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, int(vertices->size())));
    return geometry;
}

std::string wordsOf(const Pager& pager)
{
    const PagerStatistics s = pager.getStatistics();
    const FrameTimes times = pager.getUploadTimes();
    char words[256];
    std::snprintf(words, sizeof words,
                  "GPU %.1f of %.0f MiB, %zu of %zu textures, %zu to come\n"
                  "upload ms p50 %.2f p99 %.2f max %.2f, %.0f KiB now%s",
                  double(s.upload.bytes) / 1048576.0, pager.getSettings().gpuMegabytes, s.resident,
                  s.textures, s.changing, times.getPercentile(50.0), times.getPercentile(99.0),
                  times.getLargest(), double(s.upload.lastUploaded) / 1024.0,
                  s.bias > 0.0 ? ", short of memory" : "");
    return words;
}

osg::ref_ptr<osg::Node> makeGraph(double width, double height, const Pager& pager)
{
    osg::ref_ptr<osgText::Text> text = new osgText::Text;
    text->setCharacterSize(11.0f);
    text->setPosition(osg::Vec3(10.0f, 16.0f + Height + 16.0f, 0.0f));
    text->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, 1.0f));
    text->setText(wordsOf(pager));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(
        makeBars(pager.getUploadTimes().getValues(), pager.getSettings().uploadMilliseconds));
    geode->addDrawable(text);
    return osgMultiRender::makeOverlay(width, height, *geode);
}

} // namespace

void PagedGraph::cull(osgUtil::CullVisitor& visitor, const Pager& pager)
{
    const osg::Viewport* viewport = visitor.getViewport();
    if (!viewport)
        return;
    const osg::ref_ptr<osg::Node> graph = makeGraph(viewport->width(), viewport->height(), pager);
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _kept.push_back(graph);
        if (_kept.size() > GraphsKept)
            _kept.pop_front();
    }
    // What is in front of everything has no part in the near and far planes.
    const osg::CullSettings::ComputeNearFarMode mode = visitor.getComputeNearFarMode();
    visitor.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    graph->accept(visitor);
    visitor.setComputeNearFarMode(mode);
}

} // namespace osgPagedTexture
