// SPDX-License-Identifier: MIT
// Map labels over a town of 500 buildings, pixel by pixel against ray casting.
#include "CityPictures.h"

#include <gtest/gtest.h>

#include <osg/ComputeBoundsVisitor>

#include <cstdlib>
#include <map>

using namespace cityPictures;
using mapTruth::Effect;

namespace
{

/// Pixels of labels; the last two of those where the answer is the same within a pixel around.
struct Comparison
{
    std::size_t labels = 0, pixels = 0, affected = 0, differing = 0;
    std::size_t hiddenTooMuch = 0, shownTooMuch = 0;
};

class MapLabelsTruthGLTest : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(viewer()); }

    static const City& town()
    {
        static const City theTown = makeTown();
        return theTown;
    }

    /// A look at the town with as many labels as find room.
    static Comparison compare(const City& city, const support::CameraSpec& camera,
                              unsigned int seed, const std::string& settings = {},
                              const mapTruth::EffectOf& effectOf = mapTruth::effectByClass({}),
                              bool isAtBack = false)
    {
        const std::vector<InView> labels = chooseSpread(city.labels, camera, seed);
        const std::vector<PlatePixel> pixels = platePixels(labels, camera);
        const auto scene = makeScene(city.scene, labels,
                                     "declutter=off" + (settings.empty() ? "" : "," + settings));
        const auto without = makeScene(city.scene, {});
        const Picture picture = render(*scene, camera, 2), bare = render(*without, camera, 2);
        const mapTruth::MapTruth truth(*city.scene, camera, Width, Height, effectOf);
        Comparison result{labels.size(), pixels.size(), 0, 0, 0, 0};
        for (const PlatePixel& pixel : pixels)
        {
            const InView& label = labels[pixel.label];
            const mapTruth::Label ray{label.depth, label.label.feature, isAtBack};
            const double x = pixel.x + 0.5, y = pixel.y + 0.5;
            const Effect expected = truth.at(ray, x, y);
            const Effect found =
                picture && bare ? effectIn(*picture, *bare, pixel) : Effect::Outline;
            result.affected += expected != Effect::None;
            result.differing += found != expected;
            if (found == expected || !truth.isCertain(ray, x, y))
                continue;
            if (result.hiddenTooMuch + result.shownTooMuch < 5)
                ADD_FAILURE() << "'" << label.label.feature << "' at " << pixel.x << "," << pixel.y
                              << ": " << int(found) << " instead of " << int(expected);
            ++(found > expected ? result.hiddenTooMuch : result.shownTooMuch);
        }
        return result;
    }

    static void expectExact(const Comparison& found, const std::string& what)
    {
        EXPECT_EQ(found.hiddenTooMuch, 0u) << what;
        EXPECT_EQ(found.shownTooMuch, 0u) << what;
        // Pixels at edges, which rasterizers decide within 1/256 of a pixel, alpha tests less well.
        EXPECT_LT(double(found.differing), 0.004 * double(found.pixels)) << what;
        std::printf("%s: %zu labels, %zu pixels, %zu behind something, %zu differ at edges\n",
                    what.c_str(), found.labels, found.pixels, found.affected, found.differing);
    }
};

/// The middle of the box of a building.
osg::Vec3d middleOf(const City& city, const std::string& name)
{
    struct Find : osg::NodeVisitor
    {
        explicit Find(const std::string& text) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), name(text)
        {
        }
        void apply(osg::Node& node) override
        {
            if (node.getName() == name)
                found = node.getBound().center() * osg::computeLocalToWorld(getNodePath()) *
                        osg::Matrixd::inverse(node.asTransform()->asMatrixTransform()->getMatrix());
            traverse(node);
        }
        const std::string name;
        osg::Vec3d found;
    };
    Find find(name);
    city.scene->accept(find);
    return find.found;
}

/// The town with its buildings in quarters of 25, and labels in turn of a building, of its quarter
/// and of all buildings, each at the building.
City inQuarters()
{
    City city = makeTown();
    osg::Group* buildings = nullptr;
    for (unsigned int i = 0; i < city.scene->getNumChildren(); ++i)
        if (city.scene->getChild(i)->getName() == "Buildings")
            buildings = city.scene->getChild(i)->asGroup();
    std::vector<osg::ref_ptr<osg::Node>> all;
    for (unsigned int i = 0; i < buildings->getNumChildren(); ++i)
        all.push_back(buildings->getChild(i));
    buildings->removeChildren(0, buildings->getNumChildren());
    std::map<std::string, std::string> quarterOf;
    osg::ref_ptr<osg::Group> quarter;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        if (i % 25 == 0)
        {
            quarter = new osg::Group;
            quarter->setName("Quarter " + std::to_string(i / 25));
            buildings->addChild(quarter);
        }
        quarter->addChild(all[i]);
        quarterOf[all[i]->getName()] = quarter->getName();
    }
    for (std::size_t i = 0; i < city.labels.size(); ++i)
    {
        std::string& feature = city.labels[i].feature;
        feature = i % 3 == 0 ? feature : i % 3 == 1 ? quarterOf[feature] : "Buildings";
    }
    return city;
}

const bool isLong = std::getenv("OSGKITS_LONG") != nullptr;

} // namespace

TEST_F(MapLabelsTruthGLTest, labelsOfARecordedPathAreHiddenExactlyWhereRaysAre)
{
    std::size_t pixels = 0, hidden = 0;
    for (double seconds = 0.0; seconds <= 40.0; seconds += isLong ? 1.0 : 8.0)
    {
        const Comparison found =
            compare(town(), cameraAt(seconds), static_cast<unsigned int>(seconds));
        expectExact(found, "second " + std::to_string(seconds));
        pixels += found.pixels;
        hidden += found.affected;
    }
    // Or nothing would be tested.
    EXPECT_GT(hidden, pixels / 10);
    EXPECT_LT(hidden, pixels - pixels / 10);
}

TEST_F(MapLabelsTruthGLTest, labelsInsideOfTheirFeaturesAndBehindThemAreNotHiddenByThem)
{
    for (const double seconds : {2.0, 13.0, 35.0})
    {
        const support::CameraSpec camera = cameraAt(seconds);
        const osg::Vec3d away =
            osg::Matrixd::transform3x3(osg::Vec3d(0, 0, -1), osg::Matrixd::inverse(camera.view));
        for (const double metres : {0.0, 40.0})
        {
            City moved = town();
            for (osgLabels::MapLabel& label : moved.labels)
                label.anchor += away * metres - osg::Vec3d(0.0, 0.0, 8.0);
            expectExact(compare(moved, camera, 13), std::to_string(int(metres)) +
                                                        " m behind the roof at second " +
                                                        std::to_string(seconds));
        }
    }
}

TEST_F(MapLabelsTruthGLTest, labelsOfQuartersAndOfBuildingsInThemAreHiddenExactlyToo)
{
    const City quarters = inQuarters();
    std::size_t pixels = 0, hidden = 0;
    for (const double seconds : {2.0, 13.0, 35.0})
    {
        // Far behind their roofs, so that rays pass several buildings of a quarter.
        const support::CameraSpec camera = cameraAt(seconds);
        const osg::Vec3d away =
            osg::Matrixd::transform3x3(osg::Vec3d(0, 0, -1), osg::Matrixd::inverse(camera.view));
        City moved = quarters;
        for (osgLabels::MapLabel& label : moved.labels)
            label.anchor += away * 80.0 - osg::Vec3d(0.0, 0.0, 12.0);
        const Comparison found = compare(moved, camera, static_cast<unsigned int>(seconds));
        expectExact(found, "quarters at second " + std::to_string(seconds));
        pixels += found.pixels;
        hidden += found.affected;
    }
    EXPECT_GT(hidden, pixels / 50);
}

TEST_F(MapLabelsTruthGLTest, treesFadeAndTerrainIsIgnoredWhereRulesSaySo)
{
    const auto effects = mapTruth::effectByClass(
        {{"tree", Effect::Fade}, {"terrain", Effect::None}, {"street", Effect::None}});
    for (const double seconds : {14.0, 19.0, 27.0})
        expectExact(compare(town(), cameraAt(seconds), 3,
                            "mapclass='tree:fade,terrain:ignore,street:ignore'", effects),
                    "classes at second " + std::to_string(seconds));
}

TEST_F(MapLabelsTruthGLTest, atTheBacksOfTheirFeaturesLabelsAreHiddenByWhatLiesBefore)
{
    for (const double seconds : {4.0, 17.0, 30.0})
        expectExact(compare(town(), cameraAt(seconds), 5, "mapdepth=back",
                            mapTruth::effectByClass({}), true),
                    "backs at second " + std::to_string(seconds));
}

TEST_F(MapLabelsTruthGLTest, theCameraMayBeInsideOfABuilding)
{
    for (const char* building : {"Building 1", "Building 20", "Building 80"})
    {
        const osg::Vec3d eye = middleOf(town(), building);
        const auto camera =
            support::CameraSpec::perspective(eye, eye + osg::Vec3d(0.3, 1.0, 0.02), {0, 0, 1}, 50.0,
                                             double(Width) / Height, 0.1, 3000.0);
        expectExact(compare(town(), camera, 7), std::string("inside of ") + building);
        // In the same room, of no feature.
        City inside = town();
        inside.labels = {{eye + osg::Vec3d(0.3, 1.0, 0.02) * 2.0, "here", 0.0, {}, {}}};
        const Comparison here = compare(inside, camera, 7);
        expectExact(here, std::string("within ") + building);
        EXPECT_GT(here.pixels, 500u);
        EXPECT_EQ(here.affected, 0u);
    }
}

TEST_F(MapLabelsTruthGLTest, parallelViewsAreExactToo)
{
    support::CameraSpec camera = cameraAt(8.0);
    camera.projection.makeOrtho(-240.0, 240.0, -180.0, 180.0, 1.0, 1500.0);
    expectExact(compare(town(), camera, 9), "parallel");
}

TEST_F(MapLabelsTruthGLTest, tenThousandKilometresFromTheOriginLabelsAreAsExact)
{
    const City far = makeTown(1e7);
    for (const double seconds : {0.0, 18.0})
        expectExact(compare(far, moved(cameraAt(seconds), 1e7), 11),
                    "far away at second " + std::to_string(seconds));
}
