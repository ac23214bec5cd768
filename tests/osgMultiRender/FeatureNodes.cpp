// SPDX-License-Identifier: MIT
#include "FeatureSubject.h"

#include <osg/Billboard>
#include <osg/LOD>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PositionAttitudeTransform>
#include <osg/ShapeDrawable>
#include <osg/StateSet>
#include <osg/Switch>
#include <osgText/Text>

namespace feature
{

namespace
{

/// The subject drawn by one of OSG's three ways, in a color of its own to tell them apart.
Build drawnBy(bool displayList, bool bufferObject, const osg::Vec4& color)
{
    return [=](osg::Group& root)
    {
        osg::Geode* geode = root.getChild(0)->asGeode();
        for (unsigned int i = 0; i < geode->getNumDrawables(); ++i)
        {
            osg::Geometry* geometry = geode->getDrawable(i)->asGeometry();
            geometry->setUseDisplayList(displayList);
            geometry->setUseVertexBufferObjects(bufferObject);
            osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(1, &color);
            geometry->setColorArray(colors, osg::Array::BIND_OVERALL);
        }
    };
}

void addDrawables(Family& family)
{
    family.add("displayList", drawnBy(true, false, {1, 0.6f, 0.6f, 1}));
    family.add("vertexBufferObject", drawnBy(false, true, {0.6f, 1, 0.6f, 1}));
    family.add("vertexArray", drawnBy(false, false, {0.6f, 0.6f, 1, 1}));
    const std::vector<std::pair<std::string, std::function<osg::Shape*()>>> shapes = {
        {"Box", [] { return new osg::Box(osg::Vec3(), 1.3f, 0.9f, 1.1f); }},
        {"Sphere", [] { return new osg::Sphere(osg::Vec3(), 0.9f); }},
        {"Cone", [] { return new osg::Cone(osg::Vec3(), 0.8f, 1.5f); }},
        {"Cylinder", [] { return new osg::Cylinder(osg::Vec3(), 0.5f, 1.4f); }},
        {"Capsule", [] { return new osg::Capsule(osg::Vec3(), 0.4f, 0.9f); }}};
    for (const auto& [name, make] : shapes)
    {
        family.addNodes(
            "shape" + name,
            [make = make](osg::Group& root)
            {
                osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(make());
                drawable->setColor(osg::Vec4(0.8f, 0.6f, 0.3f, 1));
                osg::ref_ptr<osg::MatrixTransform> turned =
                    new osg::MatrixTransform(osg::Matrix::rotate(0.5, osg::Vec3d(1, 0.3, 0.6)));
                turned->addChild(drawable);
                turned->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture2D());
                root.addChild(turned);
            });
    }
}

void addNodes(Family& family)
{
    family.addNodes("sameNodeUnderTwoTransforms",
                    [](osg::Group& root)
                    {
                        const osg::ref_ptr<osg::Geode> subject = subjectGeode();
                        for (double x : {-0.7, 0.7})
                        {
                            osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(
                                osg::Matrix::scale(0.5, 0.5, 0.5) *
                                osg::Matrix::rotate(x, 0, 0, 1) * osg::Matrix::translate(x, 0, 0));
                            transform->addChild(subject);
                            transform->getOrCreateStateSet()->setMode(GL_NORMALIZE,
                                                                      osg::StateAttribute::ON);
                            root.addChild(transform);
                        }
                        osg::ref_ptr<osg::Material> material = new osg::Material;
                        material->setDiffuse(osg::Material::FRONT, osg::Vec4(1, 0.4f, 0.3f, 1));
                        root.getChild(1)->getStateSet()->setAttributeAndModes(material);
                    });
    family.addNodes(
        "billboard",
        [](osg::Group& root)
        {
            osg::ref_ptr<osg::Billboard> billboard = new osg::Billboard;
            billboard->setMode(osg::Billboard::POINT_ROT_EYE);
            billboard->setNormal(osg::Vec3(0, -1, 0));
            for (float x : {-0.6f, 0.6f})
                billboard->addDrawable(osg::createTexturedQuadGeometry(osg::Vec3(-0.5f, 0, -0.5f),
                                                                       osg::Vec3(1, 0, 0),
                                                                       osg::Vec3(0, 0, 1)),
                                       osg::Vec3(x, 0, x));
            billboard->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture2D());
            root.addChild(billboard);
        });
    family.addNodes("levelOfDetail",
                    [](osg::Group& root)
                    {
                        osg::ref_ptr<osg::LOD> lod = new osg::LOD;
                        lod->addChild(backdrop(), 0.0f, 3.0f);
                        lod->addChild(torus(), 3.0f, 1e6f);
                        root.addChild(lod);
                    });
    family.addNodes("switch",
                    [](osg::Group& root)
                    {
                        osg::ref_ptr<osg::Switch> choice = new osg::Switch;
                        choice->addChild(backdrop(), true);
                        choice->addChild(torus(), false);
                        root.addChild(choice);
                    });
    family.addNodes("attitudeTransform",
                    [](osg::Group& root)
                    {
                        osg::ref_ptr<osg::PositionAttitudeTransform> transform =
                            new osg::PositionAttitudeTransform;
                        transform->setAttitude(osg::Quat(0.6, osg::Vec3d(0, 1, 0)));
                        transform->setPivotPoint(osg::Vec3d(0.2, 0, 0.3));
                        transform->addChild(subjectGeode());
                        root.addChild(transform);
                    });
    family.addNodes("text",
                    [](osg::Group& root)
                    {
                        root.addChild(backdrop());
                        osg::ref_ptr<osgText::Text> text = new osgText::Text;
                        text->setText("osgKits");
                        text->setCharacterSize(0.6f);
                        text->setAxisAlignment(osgText::Text::XZ_PLANE);
                        text->setPosition(osg::Vec3(-1.1f, -0.6f, 0.0f));
                        text->setColor(osg::Vec4(1, 0.9f, 0.2f, 1));
                        root.addChild(text);
                    });
}

} // namespace

void addNodeScenes(std::vector<FeatureScene>& scenes)
{
    Family drawable(scenes, "drawable");
    addDrawables(drawable);
    Family node(scenes, "node");
    addNodes(node);
}

} // namespace feature
