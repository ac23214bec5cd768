// SPDX-License-Identifier: MIT
#include "FeatureSubject.h"

#include <osg/LightModel>
#include <osg/Material>
#include <osg/StateSet>

namespace feature
{

namespace
{

constexpr auto On = osg::StateAttribute::ON;
constexpr auto Off = osg::StateAttribute::OFF;
constexpr auto Both = osg::Material::FRONT_AND_BACK;

/// Gives the scene a material; the light stands aside, so that highlights are off the middle.
Build withMaterial(const std::function<void(osg::Material&)>& change)
{
    return [change](osg::Group& root)
    {
        osg::ref_ptr<osg::Material> material = new osg::Material;
        change(*material);
        root.getOrCreateStateSet()->setAttributeAndModes(material);
        addLight(root, light());
    };
}

void addColorModes(Family& family)
{
    using M = osg::Material;
    const std::vector<std::pair<std::string, M::ColorMode>> modes = {
        {"Off", M::OFF},           {"Ambient", M::AMBIENT},
        {"Diffuse", M::DIFFUSE},   {"Specular", M::SPECULAR},
        {"Emission", M::EMISSION}, {"AmbientAndDiffuse", M::AMBIENT_AND_DIFFUSE}};
    Subject colored;
    colored.colors = Subject::Colors::PerVertex;
    for (const auto& [name, mode] : modes)
    {
        const auto change = [mode = mode](M& m)
        {
            m.setColorMode(mode);
            m.setAmbient(Both, osg::Vec4(0.3f, 0.9f, 0.3f, 1));
            m.setDiffuse(Both, osg::Vec4(0.5f, 0.4f, 0.6f, 0.8f));
            m.setSpecular(Both, osg::Vec4(0.2f, 0.2f, 0.2f, 1));
            m.setEmission(Both, osg::Vec4(0.1f, 0.0f, 0.0f, 1));
            m.setShininess(Both, 12.0f);
        };
        const std::string plain = "colorModeOffWithoutColors";
        family.add("colorMode" + name + "PerVertex", withMaterial(change), colored).twin =
            mode == M::OFF ? plain : "";
        // the material's own value takes the place of the color, its diffuse one that of both
        family.add("colorMode" + name + "WithoutColors", withMaterial(change)).twin =
            mode == M::OFF || mode == M::AMBIENT_AND_DIFFUSE ? "" : plain;
    }
    colored.colors = Subject::Colors::Overall;
    family.add("colorModeDiffuseOverall", withMaterial([](M& m) { m.setColorMode(M::DIFFUSE); }),
               colored);
    colored.colors = Subject::Colors::PerPrimitiveSet;
    family.add("colorModeDiffusePerPrimitiveSet",
               withMaterial([](M& m) { m.setColorMode(M::DIFFUSE); }), colored);
    colored.colors = Subject::Colors::PerVertex;
    colored.open = true;
    const auto faces = [](M::ColorMode mode)
    {
        return [mode](osg::Group& root)
        {
            withMaterial(
                [mode](M& m)
                {
                    m.setColorMode(mode);
                    m.setAmbient(M::FRONT, osg::Vec4(0.2f, 0.2f, 0.9f, 1));
                    m.setAmbient(M::BACK, osg::Vec4(0.9f, 0.2f, 0.2f, 1));
                    m.setDiffuse(M::FRONT, osg::Vec4(0.2f, 0.8f, 0.2f, 1));
                    m.setDiffuse(M::BACK, osg::Vec4(0.8f, 0.8f, 0.1f, 1));
                    m.setEmission(M::BACK, osg::Vec4(0.2f, 0.0f, 0.2f, 1));
                })(root);
            osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
            model->setTwoSided(true);
            root.getOrCreateStateSet()->setAttributeAndModes(model);
        };
    };
    family.add("facesDifferent", faces(M::OFF), colored);
    family.add("facesDifferentColorModeDiffuse", faces(M::DIFFUSE), colored);
    family.add("facesDifferentColorModeEmission", faces(M::EMISSION), colored);
}

void addMaterials(Family& family)
{
    using M = osg::Material;
    family.add("none", [](osg::Group& root) { addLight(root, light()); });
    family.add("ambient", withMaterial([](M& m) { m.setAmbient(Both, osg::Vec4(1, 0, 1, 1)); }));
    family.add("diffuse",
               withMaterial([](M& m) { m.setDiffuse(Both, osg::Vec4(0.2f, 0.9f, 0.4f, 1)); }));
    family.add("diffuseAlpha",
               withMaterial([](M& m) { m.setDiffuse(Both, osg::Vec4(0.2f, 0.9f, 0.4f, 0.3f)); }));
    family.add("emission",
               withMaterial([](M& m) { m.setEmission(Both, osg::Vec4(0.5f, 0.1f, 0.2f, 1)); }));
    family.add("valuesAboveOneAndBelowZero", withMaterial(
                                                 [](M& m)
                                                 {
                                                     m.setDiffuse(Both, osg::Vec4(3, -1, 0.5f, 2));
                                                     m.setAmbient(Both, osg::Vec4(-2, 1, 0.5f, 1));
                                                 }));
    for (float shininess : {0.0f, 1.0f, 20.0f, 128.0f})
    {
        family.add("shininess" + std::to_string(int(shininess)),
                   withMaterial(
                       [shininess](M& m)
                       {
                           m.setDiffuse(Both, osg::Vec4(0.3f, 0.3f, 0.5f, 1));
                           m.setSpecular(Both, osg::Vec4(1, 0.9f, 0.7f, 1));
                           m.setShininess(Both, shininess);
                       }));
    }
    family.add("frontOnlySet",
               [](osg::Group& root) {
                   withMaterial([](M& m) { m.setDiffuse(M::FRONT, osg::Vec4(1, 0, 0, 1)); })(root);
               });
}

void addLighting(Family& family)
{
    Subject colored;
    colored.colors = Subject::Colors::PerVertex;
    const auto lighting = [](unsigned int value) {
        return [value](osg::Group& root)
        { root.getOrCreateStateSet()->setMode(GL_LIGHTING, value); };
    };
    family.add("headlight", lighting(On));
    family.add("off", lighting(Off));
    family.add("headlightColors", lighting(On), colored);
    family.add("offColors", lighting(Off), colored);
    family.add("offMaterial",
               [](osg::Group& root)
               {
                   withMaterial([](osg::Material& m)
                                { m.setDiffuse(Both, osg::Vec4(0.9f, 0.3f, 0.1f, 0.6f)); })(root);
                   root.getOrCreateStateSet()->setMode(GL_LIGHTING, Off);
               });
    family.add("onWithoutLights",
               [](osg::Group& root) { root.getOrCreateStateSet()->setMode(GL_LIGHT0, Off); });
}

} // namespace

void addMaterialScenes(std::vector<FeatureScene>& scenes)
{
    Family material(scenes, "material");
    addMaterials(material);
    addColorModes(material);
    Family lighting(scenes, "lighting");
    addLighting(lighting);
}

} // namespace feature
