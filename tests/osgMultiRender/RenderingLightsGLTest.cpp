// SPDX-License-Identifier: MIT
// The built-in renderings are lit by the lights that are on, whatever their numbers.
#include "osgMultiRender/MixedPictures.h"

#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/Material>

#include <set>

using namespace osgMultiRender;

namespace
{

/// Seen from above, so that all normals are of the side that is seen.
osg::ref_ptr<osg::Geometry> makeDome()
{
    constexpr int steps = 40;
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    const osg::ref_ptr<osg::DrawElementsUInt> faces = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (int j = 0; j <= steps; ++j)
        for (int i = 0; i <= steps; ++i)
        {
            const float x = 4.0f * float(i) / steps - 2.0f, y = 4.0f * float(j) / steps - 2.0f;
            vertices->push_back({x, y, -0.15f * (x * x + y * y)});
            normals->push_back({0.3f * x, 0.3f * y, 1.0f});
            normals->back().normalize();
            const auto at = unsigned(j * (steps + 1) + i), above = at + steps + 1;
            if (i < steps && j < steps)
                for (const unsigned int index : {at, at + 1, above + 1, at, above + 1, above})
                    faces->push_back(index);
        }
    const osg::ref_ptr<osg::Geometry> dome = new osg::Geometry;
    dome->setVertexArray(vertices);
    dome->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    const osg::ref_ptr<osg::Vec4Array> white = new osg::Vec4Array;
    white->push_back({1, 1, 1, 1});
    dome->setColorArray(white, osg::Array::BIND_OVERALL);
    dome->addPrimitiveSet(faces);
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, {0.3f, 0.25f, 0.2f, 1.0f});
    material->setDiffuse(osg::Material::FRONT_AND_BACK, {0.8f, 0.7f, 0.6f, 1.0f});
    material->setSpecular(osg::Material::FRONT_AND_BACK, {0.4f, 0.5f, 0.6f, 1.0f});
    material->setEmission(osg::Material::FRONT_AND_BACK, {0.02f, 0.03f, 0.04f, 1.0f});
    material->setShininess(osg::Material::FRONT_AND_BACK, 20.0f);
    dome->getOrCreateStateSet()->setAttributeAndModes(material);
    return dome;
}

enum class Kind
{
    Directional,
    Point,
    Spot
};

osg::ref_ptr<osg::Light> makeLight(int number, Kind kind, const osg::Vec4& color,
                                   const osg::Vec3& place)
{
    const osg::ref_ptr<osg::Light> light = new osg::Light(unsigned(number));
    light->setAmbient(color * 0.2f);
    light->setDiffuse(color);
    light->setSpecular(color);
    light->setPosition(osg::Vec4(place, kind == Kind::Directional ? 0.0f : 1.0f));
    if (kind != Kind::Directional)
    {
        light->setConstantAttenuation(0.5f);
        light->setLinearAttenuation(0.1f);
        light->setQuadraticAttenuation(0.05f);
    }
    if (kind == Kind::Spot)
    {
        light->setSpotCutoff(35.0f);
        light->setSpotExponent(3.0f);
        light->setDirection(-place / place.length());
    }
    return light;
}

class RenderingLightsGLTest : public MixedPictures
{
protected:
    void SetUp() override
    {
        MixedPictures::SetUp();
        _viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
        _camera = support::CameraSpec::perspective({0.0, -1.0, 7.0}, {0, 0, 0}, {0, 1, 0}, 35.0,
                                                   1.0, 1.0, 30.0);
    }

    /// `name` "": as GL draws it. Lights whose numbers are not in `on` have values all the same.
    osg::ref_ptr<osg::Image> drawLit(const std::string& name,
                                     const std::vector<osg::ref_ptr<osg::Light>>& lights,
                                     const std::set<int>& on)
    {
        const osg::ref_ptr<osg::Group> root = new osg::Group;
        root->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
        for (const auto& light : lights)
        {
            const osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
            source->setLight(light);
            root->addChild(source);
            root->getOrCreateStateSet()->setMode(GL_LIGHT0 + unsigned(light->getLightNum()),
                                                 on.count(light->getLightNum()) != 0);
        }
        const osg::ref_ptr<osg::Group> scene = name.empty() ? new osg::Group : new MixedScene;
        if (auto* mixed = dynamic_cast<MixedScene*>(scene.get()))
            mixed->addRendering(importNamed(name));
        scene->addChild(_dome);
        root->addChild(scene);
        return osg::clone(_viewer.renderFloat(root, _camera, Size, Size).get(),
                          osg::CopyOp::DEEP_COPY_ALL);
    }

    osg::ref_ptr<osg::Geometry> _dome = makeDome();
};

const osg::Vec4 Red(1.0f, 0.3f, 0.2f, 1.0f), Blue(0.2f, 0.4f, 0.9f, 1.0f);

double worstOf(const osg::Image& a, const osg::Image& b)
{
    return support::difference(a, b, 1.0).worst * 255.0;
}

} // namespace

TEST_F(RenderingLightsGLTest, aLightThatIsOffCountsForNothingAndNumberThreeAsNumberZero)
{
    for (const BuiltInRendering& rendering : getBuiltInRenderings())
    {
        if (rendering.vertex.find("osg_EnabledLights") == std::string::npos &&
            rendering.fragment.find("osg_EnabledLights") == std::string::npos)
            continue;
        SCOPED_TRACE(rendering.name);
        const auto left = makeLight(3, Kind::Point, Red, {-2, 1, 2});
        const auto right = makeLight(0, Kind::Directional, Blue, {2, 1, 1});
        const auto three = drawLit(rendering.name, {right, left}, {3});
        const auto asZero =
            drawLit(rendering.name, {makeLight(0, Kind::Point, Red, {-2, 1, 2})}, {0});
        const auto both = drawLit(rendering.name, {right, left}, {0, 3});
        const auto none = drawLit(rendering.name, {right, left}, {});
        support::writeImage(*both, "lights-" + rendering.name);
        EXPECT_LE(worstOf(*three, *asZero), 0.01);
        EXPECT_GT(worstOf(*three, *both), 10.0);
        EXPECT_GT(worstOf(*three, *none), 10.0);
    }
}

TEST_F(RenderingLightsGLTest, lightsAreWrittenIntoTheProgramWhereNothingMoves)
{
    constexpr unsigned int settle = 2, settled = 3 * settle + 4;
    _scene->setSettleFrames(settle);
    _scene->addRendering(importNamed("phong"));
    _scene->addChild(_dome);
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::StateSet* state = root->getOrCreateStateSet();
    for (const auto& light : {makeLight(0, Kind::Directional, Blue, {2, 1, 1}),
                              makeLight(3, Kind::Spot, Red, {-2, 1, 2})})
    {
        const osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
        source->setLight(light);
        root->addChild(source);
        state->setMode(GL_LIGHT0 + unsigned(light->getLightNum()), osg::StateAttribute::ON);
    }
    root->addChild(_scene);
    const auto drawn = [&](unsigned int frames)
    {
        return osg::clone(_viewer.renderFloat(root, _camera, Size, Size, frames).get(),
                          osg::CopyOp::DEEP_COPY_ALL);
    };
    const osg::ref_ptr<osg::Image> first = drawn(1);
    const double linked = count("mix.programs.linked");
    const osg::ref_ptr<osg::Image> later = drawn(settled);
    EXPECT_EQ(count("mix.programs.linked"), linked + 1.0);
    // Compilers order sums of equal terms as they like.
    EXPECT_LE(worstOf(*first, *later), 0.01);
    drawn(settled);
    EXPECT_EQ(count("mix.programs.linked"), linked + 1.0);

    state->setMode(GL_LIGHT3, osg::StateAttribute::OFF);
    const osg::ref_ptr<osg::Image> switched = drawn(1);
    EXPECT_EQ(count("mix.programs.linked"), linked + 1.0);
    EXPECT_GT(worstOf(*switched, *later), 10.0);
    EXPECT_LE(worstOf(*switched, *drawn(settled)), 0.01);
    EXPECT_EQ(count("mix.programs.linked"), linked + 2.0);
    state->setMode(GL_LIGHT3, osg::StateAttribute::ON);
    EXPECT_LE(worstOf(*drawn(1), *later), 0.01);
    drawn(settled);
    EXPECT_EQ(count("mix.programs.linked"), linked + 2.0) << "it has been kept";
}

TEST_F(RenderingLightsGLTest, allSurfacesWithShadingKnowTheLights)
{
    int number = 0;
    for (const BuiltInRendering& rendering : getBuiltInRenderings())
        number +=
            (rendering.vertex + rendering.fragment).find("osg_EnabledLights") != std::string::npos;
    EXPECT_EQ(number, 11); // not wires, distance and X-rays, which no light changes
}

TEST_F(RenderingLightsGLTest, materialEqualsTheFixedFunctionUnderLightsOfAllKinds)
{
    for (const Kind kind : {Kind::Directional, Kind::Point, Kind::Spot})
        for (const Kind other : {Kind::Directional, Kind::Point, Kind::Spot})
        {
            SCOPED_TRACE(std::to_string(int(kind)) + " and " + std::to_string(int(other)));
            const std::vector<osg::ref_ptr<osg::Light>> lights = {
                makeLight(0, Kind::Directional, {0.9f, 0.9f, 0.1f, 1.0f}, {0, -2, 1}),
                makeLight(1, kind, Red, {-1.5f, 1, 2}), makeLight(6, other, Blue, {1.5f, 0.5f, 2})};
            const auto fixed = drawLit("", lights, {1, 6});
            const auto material = drawLit("material", lights, {1, 6});
            if (kind == Kind::Spot && other == Kind::Point)
            {
                support::writeImage(*fixed, "lights-fixed");
                support::writeImage(*material, "lights-material-two");
            }
            // The rim of a cone is a step between vertices: rounding decides a few of them.
            const auto difference = support::difference(*material, *fixed, 2.0 / 255.0);
            EXPECT_EQ(difference.pixelsOver, 0u) << difference.worst * 255.0;
            EXPECT_GT(worstOf(*fixed, *drawLit("", lights, {1})), 10.0);
        }
}
