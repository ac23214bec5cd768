// SPDX-License-Identifier: MIT
#include "FeatureSubject.h"

#include <osg/LightModel>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/StateSet>

namespace feature
{

namespace
{

using Change = std::function<void(osg::Light&)>;

void addShine(osg::Group& root)
{
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(0.8f, 0.6f, 0.6f, 1));
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0.6f, 0.6f, 0.6f, 1));
    material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0.8f, 0.8f, 0.8f, 1));
    material->setShininess(osg::Material::FRONT_AND_BACK, 18.0f);
    root.getOrCreateStateSet()->setAttributeAndModes(material);
}

Build withLight(const Change& change)
{
    return [change](osg::Group& root)
    {
        addShine(root);
        osg::ref_ptr<osg::Light> only = light();
        change(*only);
        addLight(root, only);
    };
}

/// Near the subject, so that distance and direction vary over it.
void makePoint(osg::Light& l)
{
    l.setPosition(osg::Vec4(-0.5f, -1.8f, 0.6f, 1.0f));
    l.setDiffuse(osg::Vec4(0.9f, 0.8f, 0.5f, 1.0f));
}

/// Points at a vertex of the backdrop, which a cone of one degree would miss otherwise; a wide
/// one stands in the middle of the torus, so that some of it is behind.
void makeSpot(osg::Light& l, float cutoff, float exponent)
{
    makePoint(l);
    l.setAmbient(osg::Vec4(1, 0.6f, 0.3f, 1));
    const bool wide = cutoff >= 90.0f;
    // a cone of no width is aimed beside the vertex: on it, the last bit of a cosine would decide
    const osg::Vec3 vertex(cutoff == 0.0f ? 0.95f : 1.05f, 1.6f, 0.8f);
    const osg::Vec3 place = wide ? osg::Vec3(-0.2f, -0.4f, 0.1f) : osg::Vec3(-0.5f, -1.8f, 0.6f);
    l.setPosition(osg::Vec4(place, 1.0f));
    l.setDirection(vertex - place);
    l.setSpotCutoff(cutoff);
    l.setSpotExponent(exponent);
}

void addKinds(Family& family)
{
    family.add("directional", withLight([](osg::Light&) {}));
    family.add("directionalLong",
               withLight([](osg::Light& l) { l.setPosition(osg::Vec4(300, -500, -200, 0)); }));
    family.add("ambientOnly", withLight(
                                  [](osg::Light& l)
                                  {
                                      l.setDiffuse(osg::Vec4());
                                      l.setSpecular(osg::Vec4());
                                      l.setAmbient(osg::Vec4(0.8f, 0.2f, 0.6f, 1));
                                  }));
    family.add("negativeDiffuse", withLight(
                                      [](osg::Light& l)
                                      {
                                          l.setAmbient(osg::Vec4(1, 1, 1, 1));
                                          l.setDiffuse(osg::Vec4(-0.5f, -0.1f, 0, 1));
                                      }));
    family.add("point", withLight(makePoint));
    family.add("pointHomogeneous", withLight(
                                       [](osg::Light& l)
                                       {
                                           makePoint(l);
                                           l.setPosition(osg::Vec4(0.5f, -0.9f, 0.6f, 0.5f));
                                       }));
    const auto attenuated = [](float constant, float linear, float quadratic)
    {
        return withLight(
            [=](osg::Light& l)
            {
                makePoint(l);
                l.setConstantAttenuation(constant);
                l.setLinearAttenuation(linear);
                l.setQuadraticAttenuation(quadratic);
            });
    };
    family.add("pointConstant", attenuated(2.0f, 0.0f, 0.0f));
    family.add("pointLinear", attenuated(0.0f, 0.7f, 0.0f));
    family.add("pointQuadratic", attenuated(0.0f, 0.0f, 0.4f));
    family.add("pointAllAttenuations", attenuated(0.3f, 0.2f, 0.1f));
}

void addSpots(Family& family)
{
    for (float cutoff : {0.0f, 1.0f, 20.0f, 45.0f, 90.0f, 180.0f})
    {
        for (float exponent : {0.0f, 1.0f, 128.0f})
        {
            const std::string name =
                "spot" + std::to_string(int(cutoff)) + "Exponent" + std::to_string(int(exponent));
            FeatureScene& scene =
                family.add(name, withLight([=](osg::Light& l) { makeSpot(l, cutoff, exponent); }));
            // a cone of no width lights nothing, one of 180 degrees is a point light, and within
            // one degree no power falls visibly except the highest
            if (cutoff == 0.0f && exponent > 0.0f)
                scene.twin = "spot0Exponent0";
            if (cutoff == 180.0f && exponent > 0.0f)
                scene.twin = "spot180Exponent0";
            if (cutoff == 1.0f && exponent > 0.0f)
                scene.twin = "spot1Exponent0";
            // beyond 20 degrees nothing is left of it
            if (cutoff == 45.0f && exponent == 128.0f)
                scene.twin = "spot20Exponent128";
        }
    }
    // OpenGL 2.1 specification, equation 2.4: a light at infinity has a spot factor, too
    family.add("spotAtInfinity", withLight(
                                     [](osg::Light& l)
                                     {
                                         makeSpot(l, 30.0f, 4.0f);
                                         l.setDirection(osg::Vec3(0.1f, 0.2f, -1.0f));
                                         l.setPosition(osg::Vec4(0.0f, 0.0f, 1.0f, 0.0f));
                                     }));
    FeatureScene& elsewhere = family.add("spotAtInfinityElsewhere",
                                         withLight(
                                             [](osg::Light& l)
                                             {
                                                 makeSpot(l, 30.0f, 4.0f);
                                                 l.setDirection(osg::Vec3(1.0f, 0.0f, 0.0f));
                                                 l.setPosition(osg::Vec4(0.0f, 0.0f, 1.0f, 0.0f));
                                             }));
    elsewhere.twin = "spot0Exponent0"; // its cone meets nothing
    family.add("spotUnnormalizedDirection", withLight(
                                                [](osg::Light& l)
                                                {
                                                    makeSpot(l, 30.0f, 4.0f);
                                                    l.setDirection(osg::Vec3(0.5f, 8.0f, -1.0f));
                                                }));
}

void addNumbers(Family& family)
{
    const auto numbered = [](const std::vector<unsigned int>& numbers)
    {
        return [numbers](osg::Group& root)
        {
            addShine(root);
            root.getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::OFF);
            for (unsigned int number : numbers)
            {
                osg::ref_ptr<osg::Light> l = light(number);
                l->setDiffuse(l->getDiffuse() * (numbers.size() > 2 ? 0.35f : 0.9f));
                addLight(root, l);
            }
        };
    };
    for (unsigned int number = 0; number < 8; ++number)
        family.add("number" + std::to_string(number), numbered({number}));
    family.add("numbers03", numbered({0, 3}));
    family.add("numbers1257", numbered({1, 2, 5, 7}));
    family.add("numbersAll", numbered({0, 1, 2, 3, 4, 5, 6, 7}));
    family.add("numbersAllBackwards", numbered({7, 6, 5, 4, 3, 2, 1, 0})).twin = "numbersAll";
}

void addPlaces(Family& family)
{
    family.add("underATransform",
               [](osg::Group& root)
               {
                   addShine(root);
                   osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
                   source->setLight(light(1));
                   makePoint(*source->getLight());
                   osg::ref_ptr<osg::MatrixTransform> transform =
                       new osg::MatrixTransform(osg::Matrix::rotate(0.9, osg::Vec3d(0, 1, 0)) *
                                                osg::Matrix::translate(0.3, -0.2, 0.4));
                   transform->addChild(source);
                   root.addChild(transform);
                   root.getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
               });
    family.add("fixedToTheEye",
               [](osg::Group& root)
               {
                   addShine(root);
                   osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
                   source->setReferenceFrame(osg::LightSource::ABSOLUTE_RF);
                   source->setLight(light(1));
                   source->getLight()->setPosition(osg::Vec4(1.5f, 0.5f, -4.0f, 1.0f));
                   root.addChild(source);
                   root.getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
               });
    family.add("asAttributeOfTheStateSet",
               [](osg::Group& root)
               {
                   osg::ref_ptr<osg::Light> l = light(2);
                   makePoint(*l);
                   root.getOrCreateStateSet()->setAttributeAndModes(l);
               });
    family.add("onForOneOfTwo",
               [](osg::Group& root)
               {
                   addShine(root);
                   addLight(root, light(3));
                   root.getChild(0)->asGeode()->getDrawable(1)->getOrCreateStateSet()->setMode(
                       GL_LIGHT3, osg::StateAttribute::OFF);
               });
}

void addLightModels(Family& family)
{
    const auto model = [](bool twoSided, bool local, bool separate, const osg::Vec4& ambient)
    {
        return [=](osg::Group& root)
        {
            addShine(root);
            osg::ref_ptr<osg::Light> l = light();
            makePoint(*l);
            l->setSpecular(osg::Vec4(1, 0.8f, 0.5f, 1));
            addLight(root, l);
            osg::ref_ptr<osg::LightModel> lightModel = new osg::LightModel;
            lightModel->setTwoSided(twoSided);
            lightModel->setLocalViewer(local);
            lightModel->setColorControl(separate ? osg::LightModel::SEPARATE_SPECULAR_COLOR
                                                 : osg::LightModel::SINGLE_COLOR);
            lightModel->setAmbientIntensity(ambient);
            root.getOrCreateStateSet()->setAttributeAndModes(lightModel);
            root.getOrCreateStateSet()->setTextureAttributeAndModes(0, texture2D());
        };
    };
    const osg::Vec4 dim(0.1f, 0.1f, 0.1f, 1);
    Subject open;
    open.open = true;
    family.add("plain", model(false, false, false, dim), open);
    family.add("twoSided", model(true, false, false, dim), open);
    family.add("localViewer", model(false, true, false, dim), open);
    family.add("separateSpecular", model(false, false, true, dim), open);
    family.add("ambient", model(false, false, false, osg::Vec4(0.6f, 0.3f, 0.2f, 1)), open);
    family.add("twoSidedLocalSeparate", model(true, true, true, dim), open);
}

} // namespace

void addLightScenes(std::vector<FeatureScene>& scenes)
{
    Family light(scenes, "light");
    addKinds(light);
    addSpots(light);
    Family number(scenes, "lightNumber");
    addNumbers(number);
    addPlaces(number);
    Family model(scenes, "lightModel");
    addLightModels(model);
}

} // namespace feature
