// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LuxLegend.h>

#include <osgShadowVolume/FalseColors.h>

#include <osgMultiRender/Overlay.h>

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Viewport>
#include <osgText/Text>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace osgShadowVolume
{

namespace
{

/// Frames after which no draw thread holds what was culled.
constexpr unsigned int FramesKept = 8;

osg::ref_ptr<osgText::Text> makeText(const std::string& words, const osg::Vec3& position,
                                     float size, osgText::TextBase::AlignmentType alignment)
{
    osg::ref_ptr<osgText::Text> text = new osgText::Text;
    text->setCharacterSize(size);
    text->setAlignment(alignment);
    text->setPosition(position);
    text->setText(words);
    text->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, 1.0f));
    return text;
}

/// A strip of quads upwards; row i has colors[i] on both sides.
osg::ref_ptr<osg::Geometry> makeBar(const osg::BoundingBox& box, const osg::Vec4Array& rows)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        const float y = box.yMin() + (box.yMax() - box.yMin()) * float(i) / float(rows.size() - 1);
        for (const float x : {box.xMin(), box.xMax()})
        {
            vertices->push_back(osg::Vec3(x, y, 0.0f));
            colors->push_back(rows[i]);
        }
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(
        new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, static_cast<int>(vertices->size())));
    return geometry;
}

void addScale(osg::Geode& geode, const osg::BoundingBox& bar, float size, double maximum)
{
    const double step = roundUp(maximum / 5.0);
    osg::ref_ptr<osg::Vec3Array> ticks = new osg::Vec3Array;
    for (int i = 0; i * step <= maximum * (1.0 + 1e-9); ++i)
    {
        const float y = bar.yMin() + (bar.yMax() - bar.yMin()) * float(i * step / maximum);
        char words[32];
        std::snprintf(words, sizeof(words), "%.6g", i * step);
        geode.addDrawable(makeText(words, osg::Vec3(bar.xMax() + 0.7f * size, y, 0.0f), size,
                                   osgText::TextBase::LEFT_CENTER));
        ticks->push_back(osg::Vec3(bar.xMax(), y, 0.0f));
        ticks->push_back(osg::Vec3(bar.xMax() + 0.4f * size, y, 0.0f));
    }
    osg::ref_ptr<osg::Geometry> lines = new osg::Geometry;
    osg::ref_ptr<osg::Vec4Array> white = new osg::Vec4Array(1);
    (*white)[0].set(1.0f, 1.0f, 1.0f, 1.0f);
    lines->setVertexArray(ticks);
    lines->setColorArray(white, osg::Array::BIND_OVERALL);
    lines->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, static_cast<int>(ticks->size())));
    geode.addDrawable(lines);
}

osg::ref_ptr<osg::Node> makeLegend(int width, int height, double maximum)
{
    // Readable in a picture of 320x240, not a poster in one of 1920x1080.
    const float size = std::round(std::clamp(float(height) / 36.0f, 11.0f, 48.0f));
    const float length = std::round(0.6f * float(height));
    const float low = std::round(0.5f * (float(height) - length) - 0.5f * size);
    const osg::BoundingBox bar(size, low, 0.0f, 2.2f * size, low + length, 0.0f);

    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    for (int i = 0; i <= 64; ++i)
    {
        const glm::vec3 c = falseColor(i / 64.0);
        colors->push_back(osg::Vec4(c.x, c.y, c.z, 1.0f));
    }
    osg::ref_ptr<osg::Geode> scale = new osg::Geode;
    scale->addDrawable(makeBar(bar, *colors));
    addScale(*scale, bar, size, maximum);
    scale->addDrawable(makeText("lux", osg::Vec3(bar.xMin(), bar.yMax() + 0.8f * size, 0.0f), size,
                                osgText::TextBase::LEFT_BASE_LINE));

    osg::BoundingBox around = scale->getBoundingBox();
    const float margin = 0.5f * size;
    around.expandBy(osg::Vec3(around.xMin() - margin, around.yMin() - margin, 0.0f));
    around.expandBy(osg::Vec3(around.xMax() + margin, around.yMax() + margin, 0.0f));
    osg::ref_ptr<osg::Vec4Array> shade = new osg::Vec4Array(2);
    (*shade)[0] = (*shade)[1] = osg::Vec4(0.0f, 0.0f, 0.0f, 0.6f);
    osg::ref_ptr<osg::Geode> panel = new osg::Geode;
    panel->addDrawable(makeBar(around, *shade));

    osg::ref_ptr<osg::Group> legend = new osg::Group;
    legend->addChild(panel);
    legend->addChild(scale);
    return osgMultiRender::makeOverlay(width, height, *legend);
}

} // namespace

osg::Node& LuxLegend::get(int width, int height, double maximum, unsigned int frame)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _entries.erase(std::remove_if(_entries.begin(), _entries.end(),
                                  [frame](const Entry& entry)
                                  { return entry.frame + FramesKept < frame; }),
                   _entries.end());
    for (Entry& entry : _entries)
        if (entry.width == width && entry.height == height && entry.maximum == maximum)
        {
            entry.frame = frame;
            return *entry.node;
        }
    _entries.push_back({width, height, maximum, makeLegend(width, height, maximum), frame});
    _entries.back().node->setThreadSafeRefUnref(true);
    return *_entries.back().node;
}

void LuxLegend::cull(osgUtil::CullVisitor& visitor, double maximum)
{
    const osg::Viewport* viewport = visitor.getViewport();
    if (!viewport || viewport->width() < 1.0 || viewport->height() < 1.0)
        return;
    const osg::FrameStamp* stamp = visitor.getFrameStamp();
    get(int(viewport->width()), int(viewport->height()), maximum,
        stamp ? stamp->getFrameNumber() : 0)
        .accept(visitor);
}

void LuxLegend::resizeGLObjectBuffers(unsigned int maxSize)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (Entry& entry : _entries)
        entry.node->resizeGLObjectBuffers(maxSize);
}

void LuxLegend::releaseGLObjects(osg::State* state) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (const Entry& entry : _entries)
        entry.node->releaseGLObjects(state);
}

} // namespace osgShadowVolume
