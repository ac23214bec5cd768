// SPDX-License-Identifier: MIT
#include "FeatureSubject.h"

#include <osg/ClipNode>
#include <osg/ClipPlane>
#include <osg/CullFace>
#include <osg/FrontFace>
#include <osg/LightModel>
#include <osg/LineStipple>
#include <osg/LineWidth>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/Point>
#include <osg/PolygonMode>
#include <osg/PolygonOffset>
#include <osg/PolygonStipple>
#include <osg/ShadeModel>
#include <osg/StateSet>

namespace feature
{

namespace
{

constexpr auto On = osg::StateAttribute::ON;
constexpr auto Off = osg::StateAttribute::OFF;

Subject with(Subject::Colors colors, Subject::Normals normals = Subject::Normals::Unit)
{
    Subject subject;
    subject.colors = colors;
    subject.normals = normals;
    return subject;
}

void addColors(Family& family)
{
    using Colors = Subject::Colors;
    const auto unlit = [](osg::Group& root)
    { root.getOrCreateStateSet()->setMode(GL_LIGHTING, Off); };
    family.add("none", unlit);
    family.add("overall", unlit, with(Colors::Overall));
    family.add("perPrimitiveSet", unlit, with(Colors::PerPrimitiveSet));
    family.add("perVertex", unlit, with(Colors::PerVertex));
    family.add("bytes",
               [](osg::Group& root)
               {
                   root.getOrCreateStateSet()->setMode(GL_LIGHTING, Off);
                   osg::Geometry* geometry =
                       root.getChild(0)->asGeode()->getDrawable(1)->asGeometry();
                   osg::ref_ptr<osg::Vec4ubArray> colors = new osg::Vec4ubArray;
                   for (unsigned int i = 0; i < geometry->getVertexArray()->getNumElements(); ++i)
                       colors->push_back(osg::Vec4ub(37 * i, 250 - i / 2, 90, 255));
                   colors->setNormalize(true);
                   geometry->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
               });
    family.add(
        "perVertexFlat",
        [unlit](osg::Group& root)
        {
            unlit(root);
            root.getStateSet()->setAttributeAndModes(new osg::ShadeModel(osg::ShadeModel::FLAT));
        },
        with(Colors::PerVertex));
    const auto secondary = [unlit](unsigned int sum)
    {
        return [unlit, sum](osg::Group& root)
        {
            unlit(root);
            root.getStateSet()->setMode(GL_COLOR_SUM, sum);
            root.getStateSet()->setTextureAttributeAndModes(0, texture2D());
            for (unsigned int i = 0; i < 2; ++i)
            {
                osg::Geometry* geometry = root.getChild(0)->asGeode()->getDrawable(i)->asGeometry();
                osg::ref_ptr<osg::Vec3Array> colors = new osg::Vec3Array;
                for (unsigned int k = 0; k < geometry->getVertexArray()->getNumElements(); ++k)
                    colors->push_back(osg::Vec3(0.05f * (k % 9), 0.1f * (k % 4), 0.2f));
                geometry->setSecondaryColorArray(colors, osg::Array::BIND_PER_VERTEX);
            }
        };
    };
    family.add("secondarySummed", secondary(On), with(Colors::Overall));
    family.add("secondaryNotSummed", secondary(Off), with(Colors::Overall));
}

void addNormals(Family& family)
{
    using Normals = Subject::Normals;
    const auto modes = [](GLenum mode, const osg::Matrix& matrix)
    {
        return [mode, matrix](osg::Group& root)
        {
            osg::ref_ptr<osg::Node> subject = root.getChild(0);
            osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
            transform->addChild(subject);
            root.setChild(0, transform);
            osg::ref_ptr<osg::Material> material = new osg::Material;
            material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0.4f, 0.5f, 0.6f, 1));
            material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0.5f, 0.5f, 0.5f, 1));
            material->setShininess(osg::Material::FRONT_AND_BACK, 10.0f);
            osg::StateSet* state = root.getOrCreateStateSet();
            state->setAttributeAndModes(material);
            state->setMode(GL_NORMALIZE, mode == GL_NORMALIZE ? On : Off);
            state->setMode(GL_RESCALE_NORMAL, mode == GL_RESCALE_NORMAL ? On : Off);
            const osg::ref_ptr<osg::Light> bright = light(1);
            bright->setAmbient(osg::Vec4(0.5f, 0.7f, 0.9f, 1));
            addLight(root, bright);
        };
    };
    const osg::Matrix same, twice = osg::Matrix::scale(0.7, 0.7, 0.7),
                            uneven = osg::Matrix::scale(1.2, 0.6, 0.8),
                            mirrored = osg::Matrix::scale(-1, 1, 0.9);
    const Subject unevenNormals = with(Subject::Colors::None, Normals::Uneven);
    family.add("unit", modes(GL_NONE, same));
    family.add("scaled", modes(GL_NONE, twice));
    family.add("scaledNormalize", modes(GL_NORMALIZE, twice));
    family.add("scaledRescale", modes(GL_RESCALE_NORMAL, twice)).twin = "scaledNormalize";
    family.add("unevenScale", modes(GL_NONE, uneven));
    family.add("unevenScaleNormalize", modes(GL_NORMALIZE, uneven));
    family.add("mirroredNormalize", modes(GL_NORMALIZE, mirrored));
    family.add("mirrored", modes(GL_NONE, mirrored));
    family.add("unevenNormals", modes(GL_NONE, same), unevenNormals);
    family.add("unevenNormalsNormalize", modes(GL_NORMALIZE, same), unevenNormals).twin = "unit";
    family.add("unevenNormalsRescale", modes(GL_RESCALE_NORMAL, twice), unevenNormals);
    family.add("zeroNormals", modes(GL_NONE, same), with(Subject::Colors::None, Normals::Zero));
    family
        .add("zeroNormalsNormalize", modes(GL_NORMALIZE, same),
             with(Subject::Colors::None, Normals::Zero))
        .twin = "zeroNormals";
    family.add("overallNormal",
               [=](osg::Group& root)
               {
                   for (unsigned int i = 0; i < 2; ++i)
                   {
                       osg::ref_ptr<osg::Vec3Array> normal = new osg::Vec3Array;
                       normal->push_back(osg::Vec3(-0.5f, -0.7f, 0.5f));
                       root.getChild(0)->asGeode()->getDrawable(i)->asGeometry()->setNormalArray(
                           normal, osg::Array::BIND_OVERALL);
                   }
                   modes(GL_NONE, same)(root);
               });
    family.add(
        "none",
        [](osg::Group& root)
        { root.getOrCreateStateSet()->setTextureAttributeAndModes(0, texture2D()); },
        with(Subject::Colors::None, Normals::None));
    family.add("flatShaded",
               [=](osg::Group& root)
               {
                   modes(GL_NORMALIZE, same)(root);
                   root.getStateSet()->setAttributeAndModes(
                       new osg::ShadeModel(osg::ShadeModel::FLAT));
               });
}

void addClipping(Family& family)
{
    const auto clipped = [](const std::vector<osg::Vec4d>& planes)
    {
        return [planes](osg::Group& root)
        {
            osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
            for (unsigned int i = 0; i < planes.size(); ++i)
                clip->addClipPlane(new osg::ClipPlane(i, planes[i]));
            osg::ref_ptr<osg::Node> subject = root.getChild(0);
            clip->addChild(subject);
            root.setChild(0, clip);
        };
    };
    family.add("none", [](osg::Group&) {});
    family.add("onePlane", clipped({{1, 0.2, 0.3, 0.3}}));
    family.add("threePlanes", clipped({{1, 0, 0, 0.8}, {-1, 0, 0.2, 0.5}, {0, 0, -1, 0.4}}));
    family.add("planeFourOfASet",
               [](osg::Group& root)
               {
                   osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
                   clip->addClipPlane(new osg::ClipPlane(4, osg::Vec4d(0, 0, 1, 0.2)));
                   osg::ref_ptr<osg::MatrixTransform> turned =
                       new osg::MatrixTransform(osg::Matrix::rotate(0.8, osg::Vec3d(0, 1, 0)));
                   turned->addChild(clip);
                   root.addChild(turned);
                   root.getOrCreateStateSet()->setMode(GL_CLIP_PLANE4, On);
               });
    family
        .add("planeOff",
             [=](osg::Group& root)
             {
                 clipped({{1, 0.2, 0.3, 0.3}, {0, 0, 1, 0.2}})(root);
                 root.getOrCreateStateSet()->setMode(GL_CLIP_PLANE1,
                                                     Off | osg::StateAttribute::OVERRIDE);
             })
        .twin = "onePlane";
}

/// The vertices and the edges of the torus alone, in color.
Build primitives(GLenum mode, const std::function<void(osg::StateSet&)>& change)
{
    return [=](osg::Group& root)
    {
        Subject subject;
        subject.colors = Subject::Colors::PerVertex;
        const osg::ref_ptr<osg::Geometry> geometry = torus(subject);
        geometry->removePrimitiveSet(0, geometry->getNumPrimitiveSets());
        geometry->addPrimitiveSet(
            new osg::DrawArrays(mode, 0, geometry->getVertexArray()->getNumElements()));
        osg::StateSet* state = geometry->getOrCreateStateSet();
        state->setMode(GL_LIGHTING, Off);
        change(*state);
        root.addChild(geometry);
    };
}

void addPrimitives(Family& family)
{
    for (float size : {1.0f, 4.0f, 9.0f})
        family.addNodes("points" + std::to_string(int(size)),
                        primitives(GL_POINTS, [size](osg::StateSet& state)
                                   { state.setAttributeAndModes(new osg::Point(size)); }));
    for (float width : {1.0f, 4.0f})
        family.addNodes("lines" + std::to_string(int(width)),
                        primitives(GL_LINE_STRIP, [width](osg::StateSet& state)
                                   { state.setAttributeAndModes(new osg::LineWidth(width)); }));
    family.addNodes("linesStippled",
                    primitives(GL_LINE_STRIP,
                               [](osg::StateSet& state)
                               {
                                   state.setAttributeAndModes(new osg::LineWidth(2.0f));
                                   state.setAttributeAndModes(new osg::LineStipple(2, 0x3f07));
                               }));
    family.addNodes("linesLit", primitives(GL_LINES, [](osg::StateSet& state)
                                           { state.setMode(GL_LIGHTING, On); }));
    family.addNodes("linesTextured",
                    primitives(GL_LINE_LOOP,
                               [](osg::StateSet& state)
                               {
                                   state.setAttributeAndModes(new osg::LineWidth(3.0f));
                                   state.setTextureAttributeAndModes(0, texture2D());
                               }));
    family
        .addNodes("pointsAttenuated",
                  primitives(GL_POINTS,
                             [](osg::StateSet& state)
                             {
                                 osg::ref_ptr<osg::Point> point = new osg::Point(30.0f);
                                 point->setDistanceAttenuation(osg::Vec3(0, 0, 0.4f));
                                 state.setAttributeAndModes(point);
                             }))
        .beyond = true;
}

void addPolygons(Family& family)
{
    using Face = osg::PolygonMode::Face;
    const auto attribute = [](const std::function<osg::StateAttribute*()>& make) {
        return [make](osg::Group& root)
        { root.getOrCreateStateSet()->setAttributeAndModes(make()); };
    };
    Subject open;
    open.open = true;
    family.add(
        "filled", [](osg::Group&) {}, open);
    family.add(
        "asLines",
        attribute([]
                  { return new osg::PolygonMode(Face::FRONT_AND_BACK, osg::PolygonMode::LINE); }),
        open);
    family.add(
        "asPoints",
        [](osg::Group& root)
        {
            root.getOrCreateStateSet()->setAttributeAndModes(
                new osg::PolygonMode(Face::FRONT_AND_BACK, osg::PolygonMode::POINT));
            root.getStateSet()->setAttributeAndModes(new osg::Point(3.0f));
        },
        open);
    family.add("cullBack", attribute([] { return new osg::CullFace(osg::CullFace::BACK); }), open);
    family.add("cullFront", attribute([] { return new osg::CullFace(osg::CullFace::FRONT); }),
               open);
    family.add(
        "clockwiseTwoSided",
        [](osg::Group& root)
        {
            root.getOrCreateStateSet()->setAttributeAndModes(
                new osg::FrontFace(osg::FrontFace::CLOCKWISE));
            osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
            model->setTwoSided(true);
            root.getStateSet()->setAttributeAndModes(model);
        },
        open);
    family.add("stippled",
               attribute(
                   []
                   {
                       GLubyte mask[128];
                       for (unsigned int i = 0; i < 128; ++i)
                           mask[i] = i % 8 < 4 ? 0xf0 : 0x3c;
                       return new osg::PolygonStipple(mask);
                   }),
               open);
    family.add("flat", attribute([] { return new osg::ShadeModel(osg::ShadeModel::FLAT); }), open);
}

} // namespace

void addVertexScenes(std::vector<FeatureScene>& scenes)
{
    Family color(scenes, "color");
    addColors(color);
    Family normal(scenes, "normal");
    addNormals(normal);
    Family clip(scenes, "clip");
    addClipping(clip);
    Family primitive(scenes, "primitive");
    addPrimitives(primitive);
    Family polygon(scenes, "polygon");
    addPolygons(polygon);
}

} // namespace feature
