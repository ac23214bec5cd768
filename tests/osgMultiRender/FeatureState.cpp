// SPDX-License-Identifier: MIT
#include "FeatureSubject.h"

#include <osg/Fog>
#include <osg/Material>
#include <osg/Point>
#include <osg/PointSprite>
#include <osg/StateSet>
#include <osg/TexEnv>
#include <osg/TexMat>
#include <osg/VertexProgram>

namespace feature
{

namespace
{

using Attribute = osg::StateAttribute;
constexpr auto On = Attribute::ON;
constexpr auto Off = Attribute::OFF;

osg::ref_ptr<osg::Material> paint(const osg::Vec3& color)
{
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(color, 1));
    material->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(color * 0.5f, 1));
    return material;
}

/// Three StateSets above one another: of the group, of the geode and of the torus.
struct Levels
{
    osg::StateSet& group;
    osg::StateSet& geode;
    osg::StateSet& torus;
};

Build nested(const std::function<void(const Levels&)>& change)
{
    return [change](osg::Group& root)
    {
        osg::Geode* geode = root.getChild(0)->asGeode();
        change({*root.getOrCreateStateSet(), *geode->getOrCreateStateSet(),
                *geode->getDrawable(1)->getOrCreateStateSet()});
    };
}

void addInheritance(Family& family)
{
    const osg::Vec3 red(0.9f, 0.1f, 0.2f), green(0.1f, 0.8f, 0.2f), blue(0.2f, 0.2f, 0.9f);
    const auto materials = [=](unsigned int group, unsigned int geode, unsigned int ring = On)
    {
        return nested(
            [=](const Levels& s)
            {
                s.group.setAttributeAndModes(paint(red), group);
                s.geode.setAttributeAndModes(paint(green), geode);
                s.torus.setAttributeAndModes(paint(blue), ring);
            });
    };
    family.add("innermostWins", materials(On, On));
    family.add("overrideOfTheGroup", materials(On | Attribute::OVERRIDE, On));
    family.add("overrideOfTheGeode", materials(On, On | Attribute::OVERRIDE));
    family
        .add("protectedUnderOverride",
             materials(On | Attribute::OVERRIDE, On | Attribute::PROTECTED))
        .twin = "innermostWins"; // what is protected hands no override on
    family.add("protectedTorusUnderOverride",
               materials(On | Attribute::OVERRIDE, On, On | Attribute::PROTECTED));
    family
        .add("overrideAndProtected",
             materials(On | Attribute::OVERRIDE, On | Attribute::OVERRIDE | Attribute::PROTECTED))
        .twin = "overrideOfTheGeode";
}

void addModes(Family& family)
{
    family.add("textureOffBelow", nested(
                                      [](const Levels& s)
                                      {
                                          s.group.setTextureAttributeAndModes(0, texture2D());
                                          s.torus.setTextureMode(0, GL_TEXTURE_2D, Off);
                                      }));
    family.add("textureOffBelowOverride", nested(
                                              [](const Levels& s)
                                              {
                                                  s.group.setTextureAttributeAndModes(
                                                      0, texture2D(), On | Attribute::OVERRIDE);
                                                  s.torus.setTextureMode(0, GL_TEXTURE_2D, Off);
                                              }));
    family
        .add("textureOffProtectedBelowOverride",
             nested(
                 [](const Levels& s)
                 {
                     s.group.setTextureAttributeAndModes(0, texture2D(), On | Attribute::OVERRIDE);
                     s.torus.setTextureMode(0, GL_TEXTURE_2D, Off | Attribute::PROTECTED);
                 }))
        .twin = "textureOffBelow";
    family.add("textureWithoutItsMode",
               nested([](const Levels& s) { s.group.setTextureAttribute(0, texture2D()); }));
    family.add("lightingOffBelow",
               nested([](const Levels& s) { s.torus.setMode(GL_LIGHTING, Off); }));
    family.add("lightingOffOverride", nested(
                                          [](const Levels& s)
                                          {
                                              s.group.setMode(GL_LIGHTING,
                                                              Off | Attribute::OVERRIDE);
                                              s.torus.setMode(GL_LIGHTING, On);
                                          }));
    family.add("fogOffBelow", nested(
                                  [](const Levels& s)
                                  {
                                      osg::ref_ptr<osg::Fog> fog = new osg::Fog;
                                      fog->setMode(osg::Fog::EXP);
                                      fog->setDensity(0.15f);
                                      fog->setColor(osg::Vec4(0.9f, 0.9f, 0.2f, 1));
                                      s.group.setAttributeAndModes(fog);
                                      s.torus.setMode(GL_FOG, Off);
                                  }));
    family.add("textureReplacedBelow",
               nested(
                   [](const Levels& s)
                   {
                       s.group.setTextureAttributeAndModes(0, texture2D(GL_RGB, 1));
                       s.torus.setTextureAttributeAndModes(0, texture2D(GL_RGB, 3));
                   }));
    family.add("texEnvInherited",
               nested(
                   [](const Levels& s)
                   {
                       s.group.setTextureAttributeAndModes(0,
                                                           new osg::TexEnv(osg::TexEnv::REPLACE));
                       s.torus.setTextureAttributeAndModes(0, texture2D(GL_RGB, 1));
                   }));
    family.add("texMatInherited", nested(
                                      [](const Levels& s)
                                      {
                                          s.group.setTextureAttributeAndModes(
                                              0, new osg::TexMat(osg::Matrix::scale(2, 2, 1)));
                                          s.torus.setTextureAttributeAndModes(0,
                                                                              texture2D(GL_RGB, 1));
                                      }));
    family.add("textureOnAnotherUnitBelow",
               nested(
                   [](const Levels& s)
                   {
                       s.group.setTextureAttributeAndModes(0, texture2D(GL_RGB, 1));
                       s.torus.setTextureAttributeAndModes(1, texture2D(GL_RGB, 3));
                   }));
}

/// States that no surface function mirrors.
void addBeyond(Family& family)
{
    family
        .add("vertexProgram",
             [](osg::Group& root)
             {
                 osg::ref_ptr<osg::VertexProgram> program = new osg::VertexProgram;
                 program->setVertexProgram("!!ARBvp1.0\n"
                                           "OPTION ARB_position_invariant;\n"
                                           "MOV result.color, vertex.normal;\n"
                                           "END\n");
                 root.getOrCreateStateSet()->setAttributeAndModes(program);
             })
        .beyond = true;
    family
        .addNodes("pointSprite",
                  [](osg::Group& root)
                  {
                      const osg::ref_ptr<osg::Geometry> points = torus();
                      points->removePrimitiveSet(0, points->getNumPrimitiveSets());
                      points->addPrimitiveSet(new osg::DrawArrays(
                          GL_POINTS, 0, points->getVertexArray()->getNumElements()));
                      osg::StateSet* state = points->getOrCreateStateSet();
                      state->setTextureAttributeAndModes(0, texture2D(GL_RGB, 1));
                      state->setTextureAttributeAndModes(0, new osg::PointSprite);
                      state->setAttributeAndModes(new osg::Point(9.0f));
                      root.addChild(points);
                  })
        .beyond = true;
}

} // namespace

void addStateScenes(std::vector<FeatureScene>& scenes)
{
    Family state(scenes, "state");
    addInheritance(state);
    addModes(state);
    Family beyond(scenes, "beyond");
    addBeyond(beyond);
}

} // namespace feature
