// SPDX-License-Identifier: MIT
#include "FeatureSubject.h"

#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Fog>
#include <osg/LightModel>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/StateSet>

#include <tuple>

namespace feature
{

namespace
{

/// Alpha 0, 1/4, 1/2, 3/4, 1 in columns, with no values between.
osg::ref_ptr<osg::Texture2D> alphaSteps()
{
    const auto texture = texture2D(GL_RGBA, 1);
    osg::Image* image = texture->getImage();
    for (int y = 0; y < image->t(); ++y)
        for (int x = 0; x < image->s(); ++x)
            image->data(x, y)[3] = 255 * (x * 5 / image->s()) / 4;
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    return texture;
}

void addAlphaTests(Family& family)
{
    using F = osg::AlphaFunc;
    // references between the steps, except where the whole range decides
    const std::vector<std::tuple<std::string, F::ComparisonFunction, float>> tests = {
        {"Never", F::NEVER, 0.5f},         {"Less", F::LESS, 0.4f},
        {"Equal", F::EQUAL, 1.0f},         {"LessEqual", F::LEQUAL, 0.6f},
        {"Greater", F::GREATER, 0.4f},     {"NotEqual", F::NOTEQUAL, 0.0f},
        {"GreaterEqual", F::GEQUAL, 0.6f}, {"Always", F::ALWAYS, 0.5f}};
    for (const auto& [name, function, reference] : tests)
    {
        family.add("test" + name,
                   [function = function, reference = reference](osg::Group& root)
                   {
                       osg::StateSet* state =
                           root.getChild(0)->asGeode()->getDrawable(1)->getOrCreateStateSet();
                       state->setTextureAttributeAndModes(0, alphaSteps());
                       state->setAttributeAndModes(new F(function, reference));
                   });
    }
    family.add(
        "testOfVertexAlpha",
        [](osg::Group& root)
        {
            osg::StateSet* state = root.getOrCreateStateSet();
            state->setAttributeAndModes(new F(F::GREATER, 0.613f));
            state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        },
        []
        {
            Subject s;
            s.colors = Subject::Colors::PerVertex;
            return s;
        }());
    family.add("testOff",
               [](osg::Group& root)
               {
                   osg::StateSet* state = root.getOrCreateStateSet();
                   state->setTextureAttributeAndModes(0, alphaSteps());
                   state->setAttribute(new F(F::GREATER, 0.6f));
                   state->setMode(GL_ALPHA_TEST, osg::StateAttribute::OFF);
               });
}

using FogChange = std::function<void(osg::Fog&)>;

Build withFog(const FogChange& change)
{
    return [change](osg::Group& root)
    {
        osg::ref_ptr<osg::Fog> fog = new osg::Fog;
        fog->setColor(osg::Vec4(0.8f, 0.5f, 0.3f, 1.0f));
        change(*fog);
        root.getOrCreateStateSet()->setAttributeAndModes(fog);
    };
}

void makeLinear(osg::Fog& fog)
{
    fog.setMode(osg::Fog::LINEAR);
    fog.setStart(4.5f);
    fog.setEnd(9.0f);
}

void addFogs(Family& family)
{
    family.add("none", [](osg::Group&) {});
    family.add("linear", withFog(makeLinear));
    family.add("linearInverted", withFog(
                                     [](osg::Fog& fog)
                                     {
                                         fog.setMode(osg::Fog::LINEAR);
                                         fog.setStart(7.5f);
                                         fog.setEnd(5.0f);
                                     }));
    family.add("exp", withFog(
                          [](osg::Fog& fog)
                          {
                              fog.setMode(osg::Fog::EXP);
                              fog.setDensity(0.12f);
                          }));
    family.add("exp2", withFog(
                           [](osg::Fog& fog)
                           {
                               fog.setMode(osg::Fog::EXP2);
                               fog.setDensity(0.12f);
                           }));
    family.add("coordinates",
               [](osg::Group& root)
               {
                   withFog(
                       [](osg::Fog& fog)
                       {
                           makeLinear(fog);
                           fog.setFogCoordinateSource(GL_FOG_COORDINATE);
                       })(root);
                   osg::Geode* geode = root.getChild(0)->asGeode();
                   for (unsigned int i = 0; i < geode->getNumDrawables(); ++i)
                   {
                       osg::Geometry* geometry = geode->getDrawable(i)->asGeometry();
                       const unsigned int count = geometry->getVertexArray()->getNumElements();
                       osg::ref_ptr<osg::FloatArray> coordinates = new osg::FloatArray(count);
                       for (unsigned int k = 0; k < count; ++k)
                           (*coordinates)[k] = 4.0f + float(k % 9) * 0.5f;
                       geometry->setFogCoordArray(coordinates, osg::Array::BIND_PER_VERTEX);
                   }
               });
    family.add("linearTexturedUnlit",
               [](osg::Group& root)
               {
                   withFog(makeLinear)(root);
                   root.getStateSet()->setTextureAttributeAndModes(0, texture2D());
                   root.getStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
               });
    family.add("linearAfterSeparateSpecular",
               [](osg::Group& root)
               {
                   withFog(makeLinear)(root);
                   osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
                   model->setColorControl(osg::LightModel::SEPARATE_SPECULAR_COLOR);
                   root.getStateSet()->setAttributeAndModes(model);
                   osg::ref_ptr<osg::Material> material = new osg::Material;
                   material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, 1));
                   material->setShininess(osg::Material::FRONT_AND_BACK, 10.0f);
                   root.getStateSet()->setAttributeAndModes(material);
                   root.getStateSet()->setTextureAttributeAndModes(0, texture2D());
                   addLight(root, light());
               });
}

/// A torus of one translucent color at a place.
osg::ref_ptr<osg::Node> pane(const osg::Vec4& color, const osg::Vec3d& place,
                             osg::BlendFunc* function = nullptr)
{
    const osg::ref_ptr<osg::Geometry> geometry = torus();
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(1, &color);
    geometry->setColorArray(colors, osg::Array::BIND_OVERALL);
    osg::ref_ptr<osg::MatrixTransform> transform =
        new osg::MatrixTransform(osg::Matrix::translate(place));
    transform->addChild(geometry);
    osg::StateSet* state = transform->getOrCreateStateSet();
    state->setAttributeAndModes(function ? function : new osg::BlendFunc);
    state->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    return transform;
}

void addBlends(Family& family)
{
    const osg::Vec4 red(0.9f, 0.2f, 0.1f, 0.5f), green(0.1f, 0.8f, 0.3f, 0.4f),
        blue(0.2f, 0.3f, 0.9f, 0.6f);
    const auto over = [&](const std::vector<std::pair<osg::Vec4, osg::Vec3d>>& panes)
    {
        return [panes](osg::Group& root)
        {
            for (const auto& [color, place] : panes)
                root.addChild(pane(color, place));
            root.addChild(backdrop());
        };
    };
    family.addNodes("one", over({{red, {0, 0, 0}}}));
    family.addNodes("threeBackToFront",
                    over({{red, {0, 1, 0}}, {green, {0.3, 0, 0}}, {blue, {0, -1, 0}}}));
    family
        .addNodes("threeFrontToBack",
                  over({{blue, {0, -1, 0}}, {green, {0.3, 0, 0}}, {red, {0, 1, 0}}}))
        .twin = "threeBackToFront"; // the bin sorts them
    family.addNodes("additive",
                    [=](osg::Group& root)
                    {
                        root.addChild(pane(red, {0, 0, 0}, new osg::BlendFunc(GL_ONE, GL_ONE)));
                        root.addChild(backdrop());
                    });
    family.addNodes("withoutDepthWrites",
                    [=](osg::Group& root)
                    {
                        for (double y : {-0.2, 0.2})
                        {
                            root.addChild(pane(green, {0, y, 0}));
                            root.getChild(root.getNumChildren() - 1)
                                ->getOrCreateStateSet()
                                ->setAttributeAndModes(
                                    new osg::Depth(osg::Depth::LESS, 0, 1, false));
                        }
                        root.addChild(backdrop());
                    });
    family.addNodes("unsortedBins",
                    [=](osg::Group& root)
                    {
                        root.addChild(pane(red, {0, 0, 0}));
                        root.addChild(pane(blue, {0.2, -0.5, 0}));
                        root.getChild(0)->getStateSet()->setRenderBinDetails(7, "RenderBin");
                        root.getChild(1)->getStateSet()->setRenderBinDetails(3, "RenderBin");
                        root.addChild(backdrop());
                    });
    family.add("texturedBlend",
               [](osg::Group& root)
               {
                   osg::StateSet* state =
                       root.getChild(0)->asGeode()->getDrawable(1)->getOrCreateStateSet();
                   state->setTextureAttributeAndModes(0, texture2D(GL_RGBA, 2));
                   state->setAttributeAndModes(new osg::BlendFunc);
                   state->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
               });
}

} // namespace

void addFragmentScenes(std::vector<FeatureScene>& scenes)
{
    Family alpha(scenes, "alpha");
    addAlphaTests(alpha);
    Family fog(scenes, "fog");
    addFogs(fog);
    Family blend(scenes, "blend");
    addBlends(blend);
}

} // namespace feature
