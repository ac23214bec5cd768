// SPDX-License-Identifier: MIT
#include "MapTruth.h"

#include <osg/AlphaFunc>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Texture2D>
#include <osg/ValueObject>

#include <gtest/gtest.h>

#include <random>

using namespace mapTruth;

namespace
{

constexpr int Size = 100;

/// Looks along +y from y = -10 at x and z from -5 to 5 of the plane y = 0.
support::CameraSpec camera(double zNear = 0.5)
{
    return support::CameraSpec::perspective({0, -10, 0}, {0, 0, 0}, {0, 0, 1},
                                            2.0 * osg::RadiansToDegrees(std::atan(0.5)), 1.0, zNear,
                                            100.0);
}

using Triangles = std::vector<std::array<osg::Vec3, 3>>;

/// Two triangles of corners that are counterclockwise from outside.
void quad(Triangles& mesh, const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c,
          const osg::Vec3& d)
{
    mesh.push_back({a, b, c});
    mesh.push_back({a, c, d});
}

void box(Triangles& mesh, const osg::Vec3& low, const osg::Vec3& high)
{
    const auto at = [&](int x, int y, int z)
    { return osg::Vec3(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z()); };
    quad(mesh, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
    quad(mesh, at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1));
    quad(mesh, at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1));
    quad(mesh, at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
    quad(mesh, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
    quad(mesh, at(0, 1, 0), at(1, 1, 0), at(1, 0, 0), at(0, 0, 0));
}

osg::ref_ptr<osg::Geometry> geometryOf(const Triangles& mesh)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const auto& triangle : mesh)
        vertices->insert(vertices->end(), triangle.begin(), triangle.end());
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(
        new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<int>(vertices->size())));
    return geometry;
}

/// A Geode of that name below a transform.
osg::ref_ptr<osg::Node> named(const std::string& name, const Triangles& mesh,
                              const osg::Matrixd& matrix = osg::Matrixd())
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->setName(name);
    geode->addDrawable(geometryOf(mesh));
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
    transform->addChild(geode);
    return transform;
}

osg::ref_ptr<osg::Node> boxNode(const std::string& name, const osg::Vec3& low,
                                const osg::Vec3& high)
{
    Triangles mesh;
    box(mesh, low, high);
    return named(name, mesh);
}

osg::ref_ptr<osg::Group> groupOf(std::initializer_list<osg::ref_ptr<osg::Node>> nodes)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (const auto& node : nodes)
        group->addChild(node);
    return group;
}

/// At y of the world.
Label labelAt(double y, const std::string& feature = "", bool isAtBack = false)
{
    return {y + 10.0, feature, isAtBack};
}

/// In the middle of the picture, with and without Embree.
Effect inMiddle(osg::Node& scene, const Label& label, double zNear = 0.5,
                const EffectOf& effectOf = effectByClass({}))
{
    const MapTruth truth(scene, camera(zNear), Size, Size, effectOf);
    // Beside the edges between triangles.
    const Effect effect = truth.at(label, 50.3, 50.7);
    EXPECT_EQ(truth.atByAll(label, 50.3, 50.7), effect);
    return effect;
}

} // namespace

TEST(MapTruthTest, aClosedBodyHidesWhatLiesBehindItAndNothingBefore)
{
    const auto scene = groupOf({boxNode("b", {-1, 2, -1}, {1, 4, 1})});
    EXPECT_EQ(inMiddle(*scene, labelAt(1.0)), Effect::None);
    EXPECT_EQ(inMiddle(*scene, labelAt(3.0)), Effect::None); // inside
    EXPECT_EQ(inMiddle(*scene, labelAt(3.999)), Effect::None);
    EXPECT_EQ(inMiddle(*scene, labelAt(4.001)), Effect::Hide);
    EXPECT_EQ(inMiddle(*scene, labelAt(50.0)), Effect::Hide);
}

TEST(MapTruthTest, aFeatureNeverHidesItsOwnLabel)
{
    const auto scene =
        groupOf({boxNode("own", {-1, 2, -1}, {1, 4, 1}), boxNode("b", {-1, 6, -1}, {1, 8, 1})});
    EXPECT_EQ(inMiddle(*scene, labelAt(5.0, "own")), Effect::None);
    EXPECT_EQ(inMiddle(*scene, labelAt(9.0, "own")), Effect::Hide);
    EXPECT_EQ(inMiddle(*scene, labelAt(9.0, "b")), Effect::Hide);
    // All that lies below a node of the name is its own.
    scene->setName("all");
    EXPECT_EQ(inMiddle(*scene, labelAt(9.0, "all")), Effect::None);
}

TEST(MapTruthTest, whereFeatureSharesAWallTheOtherOneHidesFromThereOn)
{
    const auto scene =
        groupOf({boxNode("a", {-1, 2, -1}, {1, 4, 1}), boxNode("b", {-1, 4, -1}, {1, 6, 1})});
    EXPECT_EQ(inMiddle(*scene, labelAt(5.0, "b")), Effect::Hide);
    EXPECT_EQ(inMiddle(*scene, labelAt(5.0, "a")), Effect::None);
    EXPECT_EQ(inMiddle(*scene, labelAt(6.1, "a")), Effect::Hide);
}

TEST(MapTruthTest, aWallOfACourtHidesTheCourtButNotItsOwnLabel)
{
    // Two wings of one mesh, a court between them.
    Triangles wings;
    box(wings, {-1, 1, -1}, {1, 2, 1});
    box(wings, {-1, 5, -1}, {1, 6, 1});
    const auto scene = groupOf({named("court", wings)});
    EXPECT_EQ(inMiddle(*scene, labelAt(1.5)), Effect::None);
    EXPECT_EQ(inMiddle(*scene, labelAt(3.0)), Effect::Hide);
    EXPECT_EQ(inMiddle(*scene, labelAt(5.5)), Effect::Hide);
    EXPECT_EQ(inMiddle(*scene, labelAt(3.0, "court")), Effect::None);
}

TEST(MapTruthTest, anOpenSheetHidesFromBothSides)
{
    for (const bool isTurned : {false, true})
    {
        Triangles sheet;
        quad(sheet, {-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1});
        if (isTurned)
            for (auto& triangle : sheet)
                std::swap(triangle[0], triangle[1]);
        const auto scene = groupOf({named("sheet", sheet)});
        EXPECT_EQ(inMiddle(*scene, labelAt(1.9)), Effect::None);
        EXPECT_EQ(inMiddle(*scene, labelAt(2.1)), Effect::Hide);
    }
}

TEST(MapTruthTest, aMeshThatIsNotClosedOrNotWoundConsistentlyHidesFromItsFrontOn)
{
    Triangles open, mixed;
    box(open, {-1, 2, -1}, {1, 4, 1});
    mixed = open;
    open.pop_back();
    std::swap(mixed[4][0], mixed[4][1]);
    for (const Triangles& mesh : {open, mixed})
    {
        const auto scene = groupOf({named("b", mesh)});
        EXPECT_EQ(inMiddle(*scene, labelAt(1.9)), Effect::None);
        EXPECT_EQ(inMiddle(*scene, labelAt(3.0)), Effect::Hide);
    }
}

TEST(MapTruthTest, neitherMirrorsNorWindingChangeWhereABodyIsLeft)
{
    Triangles inside;
    box(inside, {-1, 2, -1}, {1, 4, 1});
    const Triangles outward = inside;
    for (auto& triangle : inside)
        std::swap(triangle[0], triangle[1]);
    for (const Triangles& mesh : {outward, inside})
        for (const double mirror : {1.0, -1.0})
        {
            const auto scene = groupOf({named("b", mesh, osg::Matrixd::scale(mirror, 1.0, 1.0))});
            EXPECT_EQ(inMiddle(*scene, labelAt(3.0)), Effect::None);
            EXPECT_EQ(inMiddle(*scene, labelAt(4.1)), Effect::Hide);
        }
}

TEST(MapTruthTest, theCameraMayBeInsideOfABody)
{
    const auto scene = groupOf({boxNode("b", {-20, -20, -20}, {20, 3, 20})});
    EXPECT_EQ(inMiddle(*scene, labelAt(2.0)), Effect::None);
    EXPECT_EQ(inMiddle(*scene, labelAt(4.0)), Effect::Hide);
    // What lies before the near plane counts for nothing.
    const auto near = groupOf({boxNode("b", {-1, -9.9f, -1}, {1, -9.7f, 1})});
    EXPECT_EQ(inMiddle(*near, labelAt(4.0), 0.05), Effect::Hide);
    EXPECT_EQ(inMiddle(*near, labelAt(4.0), 0.5), Effect::None);
}

TEST(MapTruthTest, atTheBackOfItsFeatureALabelIsWhereTheRayLeavesItFirst)
{
    const auto scene =
        groupOf({boxNode("own", {-1, 2, -1}, {1, 4, 1}), boxNode("b", {-1, 5, -1}, {1, 6, 1})});
    EXPECT_EQ(inMiddle(*scene, labelAt(7.0, "own")), Effect::Hide);
    EXPECT_EQ(inMiddle(*scene, labelAt(7.0, "own", true)), Effect::None);
    const auto before =
        groupOf({boxNode("own", {-1, 4, -1}, {1, 8, 1}), boxNode("b", {-1, 5, -1}, {1, 6, 1})});
    EXPECT_EQ(inMiddle(*before, labelAt(4.5, "own")), Effect::None);
    EXPECT_EQ(inMiddle(*before, labelAt(4.5, "own", true)), Effect::Hide);
    EXPECT_EQ(inMiddle(*before, labelAt(4.5, "other", true)), Effect::None);
}

TEST(MapTruthTest, theStrongestEffectOfAllClassesBeforeALabelCounts)
{
    const auto tree = boxNode("tree-4", {-1, 0, -1}, {1, 1, 1}),
               house = boxNode("house", {-1, 2, -1}, {1, 3, 1}),
               bush = boxNode("bush", {-1, 4, -1}, {1, 5, 1});
    tree->setUserValue("labelClass", std::string("tree"));
    const auto scene = groupOf({tree, house, bush});
    const EffectOf effects =
        effectByClass({{"tree", Effect::Fade}, {"house", Effect::Outline}, {"bush", Effect::None}});
    EXPECT_EQ(inMiddle(*scene, labelAt(1.5), 0.5, effects), Effect::Fade);
    EXPECT_EQ(inMiddle(*scene, labelAt(3.5), 0.5, effects), Effect::Outline);
    EXPECT_EQ(inMiddle(*scene, labelAt(5.5), 0.5, effects), Effect::Outline);
    EXPECT_EQ(inMiddle(*scene, labelAt(5.5, "house"), 0.5, effects), Effect::Fade);
    EXPECT_EQ(inMiddle(*scene, labelAt(5.5)), Effect::Hide);
}

TEST(MapTruthTest, texelsThatFailTheAlphaTestHideNothing)
{
    // The left half of the picture is there.
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            image->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, x < 4 ? 1.0f : 0.0f), x, y);
    Triangles mesh;
    quad(mesh, {-2, 2, -2}, {2, 2, -2}, {2, 2, 2}, {-2, 2, 2});
    const auto geometry = geometryOf(mesh);
    const osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
    for (const osg::Vec3& corner : *static_cast<osg::Vec3Array*>(geometry->getVertexArray()))
        places->push_back({0.25f * corner.x() + 0.5f, 0.25f * corner.z() + 0.5f});
    geometry->setTexCoordArray(0, places);
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    osg::StateSet* const state = geode->getOrCreateStateSet();
    state->setTextureAttributeAndModes(0, new osg::Texture2D(image));
    state->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    const MapTruth tested(*geode, camera(), Size, Size);
    EXPECT_EQ(tested.at(labelAt(3.0), 49.0, 50.7), Effect::Hide);
    EXPECT_EQ(tested.at(labelAt(3.0), 51.0, 50.7), Effect::None);
    EXPECT_FALSE(tested.isCertain(labelAt(3.0), 49.5, 50.7));
    state->setMode(GL_ALPHA_TEST, osg::StateAttribute::OFF);
    EXPECT_EQ(MapTruth(*geode, camera(), Size, Size).at(labelAt(3.0), 51.0, 50.7), Effect::Hide);
}

TEST(MapTruthTest, certaintyEndsAPixelFromAnEdgeAndAtTheDepthOfAFace)
{
    // Seen from x = 25 to 75 of 100 pixels where it is nearest: 2.5 wide at 5 before the eye.
    const auto scene = groupOf({boxNode("b", {-1.25f, -5, -1.25f}, {1.25f, -4.99f, 1.25f})});
    const MapTruth truth(*scene, camera(), Size, Size);
    const Label label = labelAt(0.0);
    for (const double x : {22.0, 23.5, 24.5, 25.5, 26.5, 30.0, 73.5, 74.5, 75.5, 76.5})
        EXPECT_EQ(truth.isCertain(label, x, 50.5),
                  std::min(std::abs(x - 25), std::abs(x - 75)) > 1.1)
            << x;
    EXPECT_FALSE(truth.isCertain(labelAt(-4.99 + 1e-6), 50.3, 50.7));
    EXPECT_TRUE(truth.isCertain(labelAt(-4.99 + 1e-3), 50.3, 50.7));
}

TEST(MapTruthTest, parallelRaysAreTracedToo)
{
    support::CameraSpec parallel = camera();
    parallel.projection.makeOrtho(-5, 5, -5, 5, 0.5, 100);
    const auto scene = groupOf({boxNode("b", {1, 2, -1}, {2, 4, 1})});
    const MapTruth truth(*scene, parallel, Size, Size);
    for (const auto& [x, hidden] :
         {std::pair(59.0, false), {61.0, true}, {69.0, true}, {71.0, false}})
    {
        EXPECT_EQ(truth.at(labelAt(4.1), x, 50.7), hidden ? Effect::Hide : Effect::None) << x;
        EXPECT_EQ(truth.at(labelAt(3.9), x, 50.7), Effect::None);
    }
}

TEST(MapTruthTest, embreeFindsWhatALookAtAllTrianglesFinds)
{
    std::mt19937 engine(9);
    const auto random = [&engine] { return float(engine() * 0x1p-32); };
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    for (int i = 0; i < 200; ++i)
    {
        const osg::Vec3 low(random() * 16 - 8, random() * 30 - 8, random() * 16 - 8);
        scene->addChild(boxNode("b" + std::to_string(i % 20), low,
                                low + osg::Vec3(random(), random(), random()) * 2));
    }
    const MapTruth truth(*scene, camera(), Size, Size);
    int hidden = 0;
    for (int i = 0; i < 3000; ++i)
    {
        const Label label = labelAt(random() * 30 - 8, "b" + std::to_string(i % 20), i % 3 == 0);
        const double x = random() * Size, y = random() * Size;
        const Effect effect = truth.at(label, x, y);
        ASSERT_EQ(effect, truth.atByAll(label, x, y)) << i;
        hidden += effect == Effect::Hide;
    }
    EXPECT_GT(hidden, 500);
    EXPECT_LT(hidden, 2500);
}
