// SPDX-License-Identifier: MIT
#include <precision/SpotScene.h>

#include <osgShadowVolume/LitScene.h>

#include <osg/Geometry>
#include <osg/LightModel>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/Math>

#include <cmath>
#include <functional>

namespace precision
{

namespace
{

struct SurfacePoint
{
    osg::Vec3 position;
    osg::Vec3 normal;
};

/// A surface over the unit square in columns x rows cells of two triangles.
osg::ref_ptr<osg::Geometry> makeSurface(int columns, int rows,
                                        const std::function<SurfacePoint(double u, double v)>& at)
{
    osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (int row = 0; row <= rows; ++row)
    {
        for (int column = 0; column <= columns; ++column)
        {
            const SurfacePoint point = at(column / double(columns), row / double(rows));
            positions->push_back(point.position);
            normals->push_back(point.normal);
        }
    }
    const unsigned int stride = columns + 1;
    for (int row = 0; row < rows; ++row)
    {
        for (int column = 0; column < columns; ++column)
        {
            const unsigned int first = row * stride + column;
            for (unsigned int corner :
                 {first, first + 1, first + stride + 1, first, first + stride + 1, first + stride})
            {
                triangles->push_back(corner);
            }
        }
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(positions);
    geometry->setNormalArray(normals);
    geometry->addPrimitiveSet(triangles);
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    return geometry;
}

SurfacePoint floorPoint(double u, double v)
{
    return {osg::Vec3(4.0 * u - 2.0, 4.0 * v - 2.0, 0.0), osg::Vec3(0.0f, 0.0f, 1.0f)};
}

SurfacePoint spherePoint(double u, double v)
{
    const double longitude = 2.0 * osg::PI * u;
    const double latitude = osg::PI * (v - 0.5);
    const osg::Vec3 normal(std::cos(latitude) * std::cos(longitude),
                           std::cos(latitude) * std::sin(longitude), std::sin(latitude));
    return {normal * 0.5f + osg::Vec3(0.6f, 0.3f, 0.5f), normal};
}

osg::ref_ptr<osg::LightSource> makeSpot()
{
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    osg::Light* const light = source->getLight();
    light->setLightNum(1);
    light->setPosition(osg::Vec4(-0.7f, -0.6f, 2.0f, 1.0f));
    light->setDirection(osg::Vec3(0.35f, 0.3f, -1.0f));
    light->setSpotCutoff(28.0f);
    light->setSpotExponent(12.0f);
    light->setAmbient(osg::Vec4(0.0f, 0.0f, 0.0f, 1.0f));
    light->setDiffuse(osg::Vec4(0.9f, 0.85f, 0.7f, 1.0f));
    light->setSpecular(osg::Vec4(0.6f, 0.6f, 0.6f, 1.0f));
    return source;
}

} // namespace

osg::ref_ptr<osg::Group> makeLitScene(Lighting lighting)
{
    if (lighting == Lighting::FixedFunction)
    {
        return new osg::Group;
    }
    osg::ref_ptr<osgShadowVolume::LitScene> scene = new osgShadowVolume::LitScene;
    scene->setLighting(osgShadowVolume::LitScene::Lighting::PIXEL);
    return scene;
}

osg::ref_ptr<osg::Group> makeSpotScene(int floorCells)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(makeSpot());
    scene->addChild(makeSurface(floorCells, floorCells, floorPoint));
    scene->addChild(makeSurface(96, 48, spherePoint));

    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(0.5f, 0.5f, 0.6f, 1.0f));
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0.8f, 0.8f, 0.8f, 1.0f));
    material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0.5f, 0.5f, 0.5f, 1.0f));
    material->setShininess(osg::Material::FRONT_AND_BACK, 30.0f);
    osg::StateSet* const state = scene->getOrCreateStateSet();
    state->setAttributeAndModes(material);
    state->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    state->setMode(GL_LIGHT1, osg::StateAttribute::ON);
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity(osg::Vec4(0.15f, 0.15f, 0.15f, 1.0f));
    state->setAttribute(model);
    return scene;
}

} // namespace precision
