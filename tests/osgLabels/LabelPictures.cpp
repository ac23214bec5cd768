// SPDX-License-Identifier: MIT
#include "LabelPictures.h"

#include <osg/ShapeDrawable>

#include <cstdlib>

namespace labelScene
{

const char* const Invisible = "ink=#00000001,plate=off";
const char* const Plain = "ink=#000000,plate=off";

support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer theViewer({Width, Height});
    theViewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    theViewer.getViewer().getCamera()->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT |
                                                    GL_STENCIL_BUFFER_BIT);
    return theViewer;
}

void PictureTest::SetUp()
{
    OSGKITS_NEED_GL(viewer());
    viewer().getViewer().getCamera()->getGraphicsContext()->makeCurrent();
}

osg::ref_ptr<osg::Geometry> rectangle(const osg::Vec3& corner, const osg::Vec3& width,
                                      const osg::Vec3& height, const osg::Vec4& color)
{
    constexpr unsigned int steps = 4;
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (unsigned int j = 0; j <= steps; ++j)
        for (unsigned int i = 0; i <= steps; ++i)
            vertices->push_back(corner + width * (float(i) / steps) + height * (float(j) / steps));
    osg::ref_ptr<osg::DrawElementsUShort> quads = new osg::DrawElementsUShort(GL_QUADS);
    for (unsigned int j = 0; j < steps; ++j)
        for (unsigned int i = 0; i < steps; ++i)
        {
            const auto first = static_cast<GLushort>(j * (steps + 1) + i);
            for (unsigned int offset : {0u, 1u, steps + 2u, steps + 1u})
                quads->push_back(static_cast<GLushort>(first + offset));
        }
    osg::Vec3 normal = width ^ height;
    normal.normalize();
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(new osg::Vec3Array(1, &normal), osg::Array::BIND_OVERALL);
    geometry->setColorArray(new osg::Vec4Array(1, &color), osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(quads);
    return geometry;
}

osg::ref_ptr<osg::Geode> named(const std::string& name, osg::Drawable* drawable)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->setName(name);
    geode->addDrawable(drawable);
    return geode;
}

osg::ref_ptr<osg::Geode> box(const std::string& name, const osg::Vec3& center,
                             const osg::Vec3& halfExtents, const osg::Vec4& color)
{
    osg::ref_ptr<osg::Box> shape = new osg::Box(center, 1.0f);
    shape->setHalfLengths(halfExtents);
    osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
    drawable->setColor(color);
    return named(name, drawable);
}

osg::ref_ptr<osg::Group> unlit(osg::Node* node)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    if (node)
        group->addChild(node);
    return group;
}

osg::ref_ptr<osgLabels::LabelScene> labelled(osg::Node* node, const std::string& settings)
{
    osg::ref_ptr<osgLabels::LabelScene> scene = new osgLabels::LabelScene;
    scene->setSettingsText("keys=off" + (settings.empty() ? std::string() : "," + settings));
    if (node)
        scene->addChild(node);
    return scene;
}

support::CameraSpec fromFront(double aspect)
{
    // 2 atan(1/4)
    return support::CameraSpec::perspective({0, -4, 0}, {0, 0, 0}, {0, 0, 1}, 28.0724869, aspect,
                                            0.5, 20.0);
}

support::CameraSpec parallel(double aspect)
{
    return {fromFront().view, osg::Matrixd::ortho(-aspect, aspect, -1.0, 1.0, 0.5, 20.0)};
}

Picture render(osg::Node& node, const support::CameraSpec& camera, int width, int height,
               unsigned int frames)
{
    // Where a test has viewers of its own.
    viewer().getViewer().getCamera()->getGraphicsContext()->makeCurrent();
    return viewer().render(&node, camera, width, height, frames);
}

double countOf(const osgLabels::LabelScene& scene, const std::string& name)
{
    const std::vector<osgMultiRender::Plan> plans = scene.getPlans();
    if (plans.empty())
        return -1.0;
    const auto found = plans.front().counts.find(name);
    return found == plans.front().counts.end() ? -1.0 : found->second;
}

std::string decisionOf(const osgLabels::LabelScene& scene)
{
    using Decision = osgMultiRender::PlanEntry::Decision;
    for (const osgMultiRender::Plan& plan : scene.getPlans())
        for (const osgMultiRender::PlanEntry& entry : plan.entries)
            if (entry.subject == "labels")
                return (entry.decision == Decision::Drawn ? "drawn: " : "dropped: ") + entry.reason;
    return {};
}

double changedShare(const osg::Image& actual, const osg::Image& other)
{
    return support::difference(actual, other, 2.0 / 255.0).getShareOver();
}

void keep(const osg::Image* image, const std::string& name)
{
    if (image && std::getenv("OSGKITS_KEEP_IMAGES"))
        support::writeImage(*image, name);
}

testing::AssertionResult areAlike(const osg::Image* actual, const osg::Image* expected,
                                  const std::string& name)
{
    keep(actual, name);
    return support::CompareImage{2.0 / 255.0, 0.001, 1.0}(actual, expected, name);
}

testing::AssertionResult areEqual(const osg::Image* actual, const osg::Image* expected,
                                  const std::string& name)
{
    keep(actual, name);
    return support::CompareImage{0.0, 0.0, 0.0}(actual, expected, name);
}

} // namespace labelScene
