// SPDX-License-Identifier: MIT
#include "FloorPictures.h"

#include <osg/Geometry>
#include <osg/Light>
#include <osg/LightModel>

#include <cmath>

using osgShadowVolume::ShadowedScene;
using osgShadowVolume::Shadows;

namespace floorScene
{

support::CameraSpec fromAbove()
{
    support::CameraSpec spec;
    spec.view = osg::Matrixd::lookAt(osg::Vec3d(0, 0, 20), osg::Vec3d(), osg::Vec3d(0, 1, 0));
    spec.projection = osg::Matrixd::ortho(-4, 4, -4, 4, 1, 40);
    return spec;
}

osg::Vec2d placeOf(int x, int y)
{
    return {-4.0 + 8.0 * (x + 0.5) / Width, -4.0 + 8.0 * (y + 0.5) / Height};
}

osg::ref_ptr<osg::Geode> rectangle(const osg::Vec3& corner, const osg::Vec3& width,
                                   const osg::Vec3& height)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry(corner, width, height));
    return geode;
}

osg::ref_ptr<osg::Geode> floorGeode()
{
    return rectangle({-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
}

osg::ref_ptr<osg::Geode> occluder(double z)
{
    const osg::Vec3 u(std::cos(0.5236f), std::sin(0.5236f), 0), v(-u.y(), u.x(), 0);
    return rectangle(osg::Vec3(0, 0, float(z)) - u - v, u * 2, v * 2);
}

bool isUnderOccluder(const osg::Vec2d& p)
{
    const osg::Vec2d u(std::cos(0.5236), std::sin(0.5236));
    return std::abs(p * u) < 1.0 && std::abs(p * osg::Vec2d(-u.y(), u.x())) < 1.0;
}

osg::ref_ptr<osg::LightSource> lightSource(unsigned int number, const osg::Vec4& position,
                                           float brightness)
{
    osg::ref_ptr<osg::Light> light = new osg::Light(number);
    light->setPosition(position);
    light->setAmbient(osg::Vec4(0, 0, 0, 1));
    light->setDiffuse(osg::Vec4(brightness, brightness, brightness, 1));
    light->setSpecular(osg::Vec4(0, 0, 0, 1));
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(light);
    return source;
}

osg::ref_ptr<ShadowedScene> shadowed()
{
    osg::ref_ptr<ShadowedScene> scene = new ShadowedScene;
    scene->setShadows(Shadows::MAP);
    scene->setLightScope(osgShadowVolume::LitScene::LightScope::ALL);
    osg::StateSet* state = scene->getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity(osg::Vec4(0, 0, 0, 1)); // shadows are black
    state->setAttribute(model);
    return scene;
}

support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer viewer({Width, Height});
    if (viewer.isValid())
        viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    return viewer;
}

osg::ref_ptr<osg::Image> picture(ShadowedScene& scene, const support::CameraSpec& camera)
{
    return viewer().render(&scene, camera, Width, Height, 2);
}

int red(const osg::Image& image, int x, int y)
{
    return *image.data(x, y);
}

double wrongShare(const osg::Image& image, const std::function<bool(const osg::Vec2d&)>& inShadow)
{
    unsigned int wrong = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
            wrong += (red(image, x, y) < 20) != inShadow(placeOf(x, y));
    return double(wrong) / (Width * Height);
}

std::string entryOf(const osgMultiRender::Plan& plan, const std::string& subject)
{
    for (const osgMultiRender::PlanEntry& entry : plan.entries)
        if (entry.subject.find(subject) != std::string::npos)
            return std::string(toString(entry.decision)) + ": " + entry.reason;
    return {};
}

} // namespace floorScene
