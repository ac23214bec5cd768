// SPDX-License-Identifier: MIT
#include "FeatureSubject.h"

#include <osg/MatrixTransform>
#include <osg/StateSet>
#include <osg/TexEnv>
#include <osg/TexGen>
#include <osg/TexGenNode>
#include <osg/TexMat>
#include <osg/TextureCubeMap>

namespace feature
{

namespace
{

using Mode = osg::TexGen::Mode;

void setPlanes(osg::TexGen& texGen)
{
    texGen.setPlane(osg::TexGen::S, osg::Plane(0.9, 0.1, 0.3, 0.1));
    texGen.setPlane(osg::TexGen::T, osg::Plane(0.2, 0.5, 0.8, 0.2));
    texGen.setPlane(osg::TexGen::R, osg::Plane(0.1, 0.2, 0.6, 0.3));
    texGen.setPlane(osg::TexGen::Q, osg::Plane(0.0, 0.05, 0.1, 1.0));
}

/// Generates the coordinates named by `modes` on the unit, with a texture for them to show on.
void generate(osg::Group& root, unsigned int unit, Mode mode, const std::vector<GLenum>& modes)
{
    osg::ref_ptr<osg::TexGen> texGen = new osg::TexGen;
    texGen->setMode(mode);
    setPlanes(*texGen);
    osg::StateSet* state = root.getOrCreateStateSet();
    state->setTextureAttribute(unit, texGen);
    for (GLenum coordinate : modes)
        state->setTextureMode(unit, coordinate, osg::StateAttribute::ON);
    if (mode == osg::TexGen::NORMAL_MAP || mode == osg::TexGen::REFLECTION_MAP)
    {
        osg::ref_ptr<osg::TextureCubeMap> cube = new osg::TextureCubeMap;
        for (unsigned int face = 0; face < 6; ++face)
            cube->setImage(face, pattern(GL_RGB, face));
        cube->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
        for (auto axis : {osg::Texture::WRAP_S, osg::Texture::WRAP_T, osg::Texture::WRAP_R})
            cube->setWrap(axis, osg::Texture::CLAMP_TO_EDGE);
        state->setTextureAttributeAndModes(unit, cube);
        return;
    }
    state->setTextureAttributeAndModes(unit, texture2D(GL_RGB, unit));
}

const std::vector<GLenum> ST = {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T};
const std::vector<GLenum> STR = {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_R};
const std::vector<GLenum> STRQ = {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_R,
                                  GL_TEXTURE_GEN_Q};

Build generating(unsigned int unit, Mode mode, const std::vector<GLenum>& modes)
{
    return [=](osg::Group& root) { generate(root, unit, mode, modes); };
}

/// Turns and moves the torus alone. OSG gives GL the eye planes under the matrix of the drawable
/// that it applies the TexGen for, so that eye-linear is object-linear for the first one drawn.
Build turned(const Build& build)
{
    return [build](osg::Group& root)
    {
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(
            osg::Matrix::rotate(0.4, osg::Vec3d(0, 0, 1)) * osg::Matrix::translate(0.1, 0.2, 0.1));
        osg::Geode* subject = root.getChild(0)->asGeode();
        transform->addChild(subject->getDrawable(1));
        subject->removeDrawables(1);
        root.addChild(transform);
        build(root);
    };
}

void addModes(Family& family)
{
    family.add("objectLinear", generating(0, osg::TexGen::OBJECT_LINEAR, ST));
    family.add("eyeLinear", generating(0, osg::TexGen::EYE_LINEAR, ST)).twin = "objectLinear";
    family.add("sphereMap", generating(0, osg::TexGen::SPHERE_MAP, ST));
    family.add("normalMap", generating(0, osg::TexGen::NORMAL_MAP, STR));
    family.add("reflectionMap", generating(0, osg::TexGen::REFLECTION_MAP, STR));
    family.add("objectLinearTurned", turned(generating(0, osg::TexGen::OBJECT_LINEAR, ST)));
    family.add("eyeLinearTurned", turned(generating(0, osg::TexGen::EYE_LINEAR, ST)));
    family.add("sphereMapTurned", turned(generating(0, osg::TexGen::SPHERE_MAP, ST)));
    family.add("objectLinearProjective", generating(0, osg::TexGen::OBJECT_LINEAR, STRQ));
    family.add("eyeLinearProjective", generating(0, osg::TexGen::EYE_LINEAR, STRQ)).twin =
        "objectLinearProjective";
    family.add("objectLinearSAlone", generating(0, osg::TexGen::OBJECT_LINEAR, {GL_TEXTURE_GEN_S}));
    family.add("eyeLinearTAlone", generating(0, osg::TexGen::EYE_LINEAR, {GL_TEXTURE_GEN_T}));
    family.add("sphereMapSAlone", generating(0, osg::TexGen::SPHERE_MAP, {GL_TEXTURE_GEN_S}));
}

void addCombinations(Family& family)
{
    family.add("sphereMapOverTexture",
               [](osg::Group& root)
               {
                   osg::StateSet* state = root.getOrCreateStateSet();
                   state->setTextureAttributeAndModes(0, texture2D(GL_RGB, 2));
                   generate(root, 1, osg::TexGen::SPHERE_MAP, ST);
                   state->setTextureAttributeAndModes(1, new osg::TexEnv(osg::TexEnv::ADD));
               });
    family.add("objectLinearWithMatrix",
               [](osg::Group& root)
               {
                   generate(root, 0, osg::TexGen::OBJECT_LINEAR, ST);
                   root.getOrCreateStateSet()->setTextureAttributeAndModes(
                       0, new osg::TexMat(osg::Matrix::scale(2, 3, 1)));
               });
    family.add("differentModesOnThreeUnits",
               [](osg::Group& root)
               {
                   generate(root, 0, osg::TexGen::EYE_LINEAR, ST);
                   generate(root, 1, osg::TexGen::REFLECTION_MAP, STR);
                   generate(root, 2, osg::TexGen::OBJECT_LINEAR, ST);
               });
    family.add("texGenNode",
               [](osg::Group& root)
               {
                   generate(root, 0, osg::TexGen::OBJECT_LINEAR, ST);
                   root.getStateSet()->removeTextureAttribute(0, osg::StateAttribute::TEXGEN);
                   for (GLenum coordinate : ST)
                       root.getStateSet()->setTextureMode(0, coordinate, osg::StateAttribute::ON);
                   osg::ref_ptr<osg::TexGenNode> node = new osg::TexGenNode;
                   node->getTexGen()->setMode(osg::TexGen::EYE_LINEAR);
                   setPlanes(*node->getTexGen());
                   osg::ref_ptr<osg::MatrixTransform> transform =
                       new osg::MatrixTransform(osg::Matrix::rotate(0.8, osg::Vec3d(0, 1, 0)));
                   transform->addChild(node);
                   root.addChild(transform);
               });
    Subject uneven;
    uneven.normals = Subject::Normals::Uneven;
    family.add(
        "sphereMapOfUnevenNormals",
        [](osg::Group& root)
        {
            generate(root, 0, osg::TexGen::SPHERE_MAP, ST);
            root.getStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        },
        uneven);
    family.add(
        "sphereMapOfNormalizedNormals",
        [](osg::Group& root)
        {
            generate(root, 0, osg::TexGen::SPHERE_MAP, ST);
            root.getStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
            root.getStateSet()->setMode(GL_NORMALIZE, osg::StateAttribute::ON);
        },
        uneven);
}

} // namespace

void addTexGenScenes(std::vector<FeatureScene>& scenes)
{
    Family family(scenes, "texGen");
    addModes(family);
    addCombinations(family);
}

} // namespace feature
