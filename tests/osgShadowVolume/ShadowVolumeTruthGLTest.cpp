// SPDX-License-Identifier: MIT
#include "MaskCheck.h"

#include <examples/plant/Plant.h>

#include <support/InventorModels.h>
#include <support/NotifyCapture.h>

#include <osg/ComputeBoundsVisitor>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/NodeVisitor>
#include <osg/PolygonMode>
#include <osgDB/ReadFile>

#include <filesystem>

using support::CameraSpec;

namespace
{

truth::MaskCheck& check()
{
    static truth::MaskCheck check(320, 240);
    return check;
}

/// Takes away what the truth does not know: lights of the model's own, lines and points, and
/// polygons drawn as such, which cover pixels.
class Preparation : public osg::NodeVisitor
{
public:
    bool isUsable = true; ///< Neither transparent nor a level of detail.
    std::size_t triangles = 0;

    Preparation() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override
    {
        const osg::StateSet* const state = node.getStateSet();
        if (state && state->getRenderingHint() == osg::StateSet::TRANSPARENT_BIN)
            isUsable = false;
        if (isWireframe(state))
            node.setNodeMask(0);
        else
            traverse(node);
    }

    void apply(osg::LOD&) override { isUsable = false; }

    void apply(osg::LightSource& source) override
    {
        source.setLight(nullptr);
        apply(static_cast<osg::Group&>(source));
    }

    void apply(osg::Geometry& geometry) override
    {
        if (isWireframe(geometry.getStateSet()))
            return geometry.setNodeMask(0);
        for (unsigned int i = geometry.getNumPrimitiveSets(); i-- > 0;)
        {
            const osg::PrimitiveSet& set = *geometry.getPrimitiveSet(i);
            if (set.getMode() < GL_TRIANGLES)
                geometry.removePrimitiveSet(i);
            else
                triangles += set.getNumIndices() / 3;
        }
        apply(static_cast<osg::Node&>(geometry));
    }

private:
    static bool isWireframe(const osg::StateSet* state)
    {
        const auto* const mode = state ? static_cast<const osg::PolygonMode*>(
                                             state->getAttribute(osg::StateAttribute::POLYGONMODE))
                                       : nullptr;
        return mode && mode->getMode(osg::PolygonMode::FRONT) != osg::PolygonMode::FILL;
    }
};

osg::ref_ptr<osg::Geode> ground(const osg::BoundingBox& box)
{
    const float size = 3.0f * box.radius();
    const osg::Vec3 center = box.center();
    const float z = box.zMin() - 0.02f * box.radius();
    osg::ref_ptr<osg::Geometry> quad =
        osg::createTexturedQuadGeometry(osg::Vec3(center.x() - size, center.y() - size, z),
                                        osg::Vec3(2.0f * size, 0, 0), osg::Vec3(0, 2.0f * size, 0));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(quad);
    return geode;
}

/// The model on a ground; lights 0 directional, 1 point, 2 spot.
struct ModelScene
{
    osg::ref_ptr<osg::Group> root;
    CameraSpec camera;

    ModelScene(osg::Node& model)
    {
        osg::ComputeBoundsVisitor bounds;
        model.accept(bounds);
        const osg::BoundingBox box = bounds.getBoundingBox();
        const osg::Vec3 center = box.center();
        const float r = box.radius();
        root = new osg::Group;
        root->addChild(&model);
        root->addChild(ground(box));
        root->addChild(truth::makeSource(0, osg::Vec4(0.53f, -0.31f, 0.79f, 0.0f)));
        root->addChild(
            truth::makeSource(1, osg::Vec4(center + osg::Vec3(1.13f, -0.72f, 1.61f) * r, 1.0f)));
        const osg::Vec3 offset = osg::Vec3(-1.52f, -0.91f, 1.97f) * r;
        root->addChild(truth::makeSource(2, osg::Vec4(center + offset, 1.0f), -offset, 35.0f));
        camera =
            CameraSpec::perspective(osg::Vec3d(center) + osg::Vec3d(0.9, -3.6, 2.1) * r, center,
                                    osg::Vec3d(0, 0, 1), 32.0, 320.0 / 240.0, 0.5 * r, 12.0 * r);
    }
};

struct Model
{
    std::string name;
    osg::ref_ptr<osg::Node> node;
};

/// `count` models of inventor-data, evenly from all that can be used.
std::vector<Model> models(std::size_t count)
{
    std::vector<Model> usable;
    for (const std::string& path : support::inventorModels())
    {
        // Models with missing textures warn; that is none of our business here.
        support::NotifyCapture notify;
        osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(path);
        notify.takeWarnings();
        Preparation preparation;
        if (node)
            node->accept(preparation);
        if (node && preparation.isUsable && preparation.triangles > 0 &&
            preparation.triangles < 100000)
            usable.push_back({std::filesystem::path(path).stem().string(), node});
    }
    std::vector<Model> chosen;
    for (std::size_t i = 0; i < count && !usable.empty(); ++i)
        chosen.push_back(usable[i * usable.size() / count]);
    return chosen;
}

/// All volumes, and maps for the contrast, in a picture where most is away from edges.
void compare(osg::Node& scene, const CameraSpec& camera, int light, const std::string& name,
             truth::MaskTable& table)
{
    std::vector<truth::Way> ways = truth::volumeWays();
    ways.push_back(truth::mapWay());
    const truth::MaskResult result = check().compare(scene, camera, light, name, ways);
    for (const auto& [way, difference] : result.differences)
        EXPECT_LE(difference.getBandShare(), 0.25) << name << ", " << way;
    table.add(name, result);
}

} // namespace

TEST(ShadowVolumeTruthGLTest, modelsUnderEveryKindOfLightHaveNoLeak)
{
    OSGKITS_NEED_GL(check().getViewer());
    const std::vector<Model> chosen = models(truth::isLongRun() ? 30 : 3);
    if (chosen.empty())
        GTEST_SKIP() << "NOT TESTED: inventor-data is not installed";
    truth::MaskTable table;
    static const char* const kinds[] = {"directional", "point", "spot"};
    for (const Model& model : chosen)
    {
        const ModelScene scene(*model.node);
        for (int light = 0; light < 3; ++light)
        {
            const std::string name = "truth." + model.name + "." + kinds[light];
            compare(*scene.root, scene.camera, light, name, table);
        }
    }
    table.print();
}

TEST(ShadowVolumeTruthGLTest, aPlantUnderEightLightsHasNoLeak)
{
    OSGKITS_NEED_GL(check().getViewer());
    PlantSettings settings;
    settings.objects = truth::isLongRun() ? 1000 : 60;
    const osg::ref_ptr<osg::Group> plant = makePlant(settings);
    const double size = plant->getBound().radius();
    // Of many objects some are looked at more closely, and all cast.
    const double fovy = truth::isLongRun() ? 18.0 : 38.0;
    const CameraSpec camera =
        CameraSpec::perspective({-0.9 * size, -1.0 * size, 0.6 * size}, {0, 0, 0}, {0, 0, 1}, fovy,
                                320.0 / 240.0, 0.1 * size, 4.0 * size);
    truth::MaskTable table;
    for (int light = 0; light < 8; light += truth::isLongRun() ? 1 : 5)
    {
        const std::string name = "truth.plant.light" + std::to_string(light);
        compare(*plant, camera, light, name, table);
    }
    table.print();
}
