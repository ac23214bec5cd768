// SPDX-License-Identifier: MIT
#include "RenderScenes.h"

#include <osg/AnimationPath>
#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

namespace scenes
{

osg::ref_ptr<osg::Node> square(const osg::Vec4& color)
{
    osg::ref_ptr<osg::Geometry> geometry = osg::createTexturedQuadGeometry(
        osg::Vec3(-1.0f, 0.0f, -1.0f), osg::Vec3(2.0f, 0.0f, 0.0f), osg::Vec3(0.0f, 0.0f, 2.0f));
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(1);
    (*colors)[0] = color;
    geometry->setColorArray(colors, osg::Array::BIND_OVERALL);
    geometry->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    return geometry;
}

osg::ref_ptr<osg::Node> glowingSquare(const osg::Vec3& color)
{
    osg::ref_ptr<osg::Node> node = square(osg::Vec4(0.0f, 0.0f, 0.0f, 1.0f));
    osg::ref_ptr<osg::Material> material = new osg::Material;
    const osg::Vec4 black(0.0f, 0.0f, 0.0f, 1.0f);
    material->setAmbient(osg::Material::FRONT_AND_BACK, black);
    material->setDiffuse(osg::Material::FRONT_AND_BACK, black);
    material->setEmission(osg::Material::FRONT_AND_BACK, osg::Vec4(color, 1.0f));
    node->getOrCreateStateSet()->setAttribute(material);
    node->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    return node;
}

osg::ref_ptr<osg::Node> movingSquare(const osg::Vec4& color)
{
    osg::ref_ptr<osg::AnimationPath> path = new osg::AnimationPath;
    path->setLoopMode(osg::AnimationPath::NO_LOOPING);
    for (double x : {0.0, 100.0})
        path->insert(x, osg::AnimationPath::ControlPoint(osg::Vec3d(x, 0.0, 0.0)));
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform;
    transform->setDataVariance(osg::Object::DYNAMIC);
    transform->setUpdateCallback(new osg::AnimationPathCallback(path));
    transform->addChild(square(color));
    return transform;
}

osg::ref_ptr<osg::Node> pagedSquare(const osg::Vec4& color, const std::string& file)
{
    osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    lod->addChild(square(color), 0.0f, 1e6f);
    lod->setFileName(1, file);
    lod->setRange(1, 0.0f, 1e6f);
    lod->setRange(0, 1e6f, 1e7f);
    lod->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
    lod->setRadius(2.0f);
    return lod;
}

osg::ref_ptr<osg::Node> squareWithLight(int number)
{
    osg::ref_ptr<osg::LightSource> light = new osg::LightSource;
    light->getLight()->setLightNum(number);
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(light);
    group->addChild(square(osg::Vec4(1.0f, 1.0f, 1.0f, 1.0f)));
    return group;
}

void write(const osg::Node& scene, const std::string& file)
{
    ASSERT_TRUE(osgDB::writeNodeFile(scene, file)) << file;
}

} // namespace scenes
