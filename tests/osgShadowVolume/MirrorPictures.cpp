// SPDX-License-Identifier: MIT
#include "MirrorPictures.h"

#include <osg/Geometry>
#include <osg/LightModel>
#include <osg/Material>
#include <osg/ShapeDrawable>

#include <cmath>
#include <cstdlib>

namespace mirrorScene
{

using osgMultiRender::PlanEntry;
using osgShadowVolume::LitScene;
using osgShadowVolume::ShadowedScene;

support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer viewer({Width, Height});
    if (viewer.isValid())
        viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    return viewer;
}

support::CameraSpec camera(const osg::Vec3d& eye, const osg::Vec3d& center)
{
    return support::CameraSpec::perspective(eye, center, {0, 0, 1}, 50.0, double(Width) / Height,
                                            0.5, 100.0);
}

osg::ref_ptr<osg::Image> picture(osg::Node& scene, const support::CameraSpec& from)
{
    return viewer().render(&scene, from, Width, Height, 2);
}

osg::ref_ptr<ShadowedScene> emptyScene()
{
    osg::ref_ptr<ShadowedScene> scene = new ShadowedScene;
    scene->setLightScope(LitScene::LightScope::ALL);
    osg::StateSet* state = scene->getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity(osg::Vec4(0.2f, 0.2f, 0.2f, 1));
    state->setAttribute(model);
    return scene;
}

void setColor(osg::Node& node, const osg::Vec4& color, const osg::Vec4& emission)
{
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, color);
    material->setAmbient(osg::Material::FRONT_AND_BACK, color);
    material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0.3f, 0.3f, 0.3f, color.a()));
    material->setShininess(osg::Material::FRONT_AND_BACK, 20.0f);
    material->setEmission(osg::Material::FRONT_AND_BACK, emission);
    node.getOrCreateStateSet()->setAttribute(material);
}

osg::ref_ptr<osg::Geode> box(const osg::Vec3& center, const osg::Vec3& size, const osg::Vec4& color)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(new osg::Box(center, size.x(), size.y(), size.z())));
    setColor(*geode, color);
    return geode;
}

osg::ref_ptr<osg::Geode> quad(const osg::Vec3& corner, const osg::Vec3& u, const osg::Vec3& v,
                              const osg::Vec4& color)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry(corner, u, v));
    setColor(*geode, color);
    return geode;
}

osg::ref_ptr<osg::LightSource> light(unsigned int number, const osg::Vec4& position,
                                     const osg::Vec4& color)
{
    osg::ref_ptr<osg::Light> made = new osg::Light(number);
    made->setPosition(position);
    made->setDiffuse(color);
    made->setSpecular(color);
    made->setAmbient(osg::Vec4(0, 0, 0, 1));
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(made);
    return source;
}

osg::ref_ptr<osg::Group> lights()
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(light(0, {-2, -3, 6, 1}, {0.5f, 0.5f, 0.4f, 1}));
    group->addChild(light(1, {3, -4, 5, 0}, {0.3f, 0.3f, 0.5f, 1}));
    return group;
}

osg::ref_ptr<osg::Group> things()
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(quad({-4, -8, 0}, {8, 0, 0}, {0, 8, 0}, {0.8f, 0.8f, 0.7f, 1}));
    group->addChild(box({-1, -2, 0.5f}, {1, 1, 1}, {0.9f, 0.2f, 0.2f, 1}));
    group->addChild(box({0.5f, -3, 1.0f}, {0.6f, 0.6f, 2}, {0.2f, 0.9f, 0.2f, 1}));
    group->addChild(box({1.8f, -1.5f, 1.4f}, {0.5f, 0.7f, 0.4f}, {0.2f, 0.3f, 0.9f, 1}));
    return group;
}

osg::ref_ptr<osg::Geode> wall(const std::string& mirror)
{
    osg::ref_ptr<osg::Geode> geode = quad(Corner, Along, Up, {0, 0, 0, 1});
    geode->setName("wall");
    if (!mirror.empty())
        geode->addDescription(mirror);
    return geode;
}

osg::ref_ptr<osg::MatrixTransform> behindWall()
{
    osg::Vec3d n = osg::Vec3d(Along) ^ osg::Vec3d(Up);
    n.normalize();
    const double d = -(n * osg::Vec3d(Corner));
    osg::Matrixd m;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            m(row, column) -= 2.0 * n[row] * n[column];
    m.setTrans(n * (-2.0 * d));
    return new osg::MatrixTransform(m);
}

const unsigned char* pixel(const osg::Image& image, int x, int y)
{
    return image.data(unsigned(x), unsigned(y));
}

bool isAlike(const unsigned char* a, const unsigned char* b, int tolerance)
{
    return std::abs(a[0] - b[0]) <= tolerance && std::abs(a[1] - b[1]) <= tolerance &&
           std::abs(a[2] - b[2]) <= tolerance;
}

osg::ref_ptr<osg::Image> wallMask(const support::CameraSpec& from)
{
    osg::ref_ptr<ShadowedScene> scene = emptyScene();
    scene->setMirrors(false);
    osg::ref_ptr<osg::Group> dark = things();
    dark->getOrCreateStateSet()->setAttributeAndModes(
        new osg::Material, osg::StateAttribute::OVERRIDE | osg::StateAttribute::ON);
    auto* black = static_cast<osg::Material*>(
        dark->getStateSet()->getAttribute(osg::StateAttribute::MATERIAL));
    for (auto set :
         {&osg::Material::setDiffuse, &osg::Material::setAmbient, &osg::Material::setSpecular})
        (black->*set)(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 0, 0, 1));
    scene->addChild(dark);
    osg::ref_ptr<osg::Geode> white = wall("");
    setColor(*white, {0, 0, 0, 1}, {1, 1, 1, 1});
    scene->addChild(white);
    return picture(*scene, from);
}

osgMultiRender::Plan planOf(const ShadowedScene& scene)
{
    for (const osgMultiRender::Plan& plan : scene.getPlans())
        if (plan.view.compare(0, 6, "mirror") != 0)
            return plan;
    return {};
}

std::string reasonOf(const ShadowedScene& scene, const std::string& subject,
                     PlanEntry::Decision decision)
{
    for (const PlanEntry& entry : planOf(scene).entries)
        if (entry.subject == subject && entry.decision == decision)
            return entry.reason;
    return "";
}

double passesOf(const ShadowedScene& scene)
{
    osgMultiRender::Plan plan = planOf(scene);
    return plan.counts.count("mirrors.passes") ? plan.counts["mirrors.passes"] : -1.0;
}

osg::ref_ptr<ShadowedScene> wallScene(const osg::ref_ptr<osg::Geode>& mirror)
{
    osg::ref_ptr<ShadowedScene> scene = emptyScene();
    scene->addChild(lights());
    scene->addChild(things());
    scene->addChild(mirror);
    return scene;
}

} // namespace mirrorScene
