// SPDX-License-Identifier: MIT
#include "VolumePictures.h"

#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/ShapeDrawable>

#include <cstdlib>
#include <limits>

using osgShadowVolume::ShadowedScene;

namespace volumeScene
{

namespace
{

struct NoBounds : osg::Drawable::ComputeBoundingBoxCallback
{
    osg::BoundingBox computeBound(const osg::Drawable&) const override { return {}; }
};

class Forgetting : public osg::NodeVisitor
{
public:
    Forgetting() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override
    {
        node.setCullingActive(false);
        traverse(node);
    }

    void apply(osg::Drawable& drawable) override
    {
        drawable.setComputeBoundingBoxCallback(new NoBounds);
        drawable.dirtyBound();
        drawable.setCullingActive(false);
    }
};

} // namespace

osg::ref_ptr<ShadowedScene> shadowed()
{
    osg::ref_ptr<ShadowedScene> scene = floorScene::shadowed();
    scene->setShadows(osgShadowVolume::Shadows::VOLUMES);
    scene->setKeys(false);
    return scene;
}

osg::ref_ptr<osg::Geode> box(const osg::Vec3& center, float side)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(new osg::Box(center, side)));
    return geode;
}

osg::ref_ptr<osg::MatrixTransform> moved(const osg::Vec3& place, osg::ref_ptr<osg::Node> node)
{
    osg::ref_ptr<osg::MatrixTransform> transform =
        new osg::MatrixTransform(osg::Matrix::translate(place));
    transform->addChild(node);
    return transform;
}

support::CameraSpec fromFront()
{
    return support::CameraSpec::perspective({0, -9, 7}, {0, 0, 0.5}, {0, 0, 1}, 40.0, 1.0, 1.0,
                                            40.0);
}

void forgetBounds(osg::Node& node)
{
    Forgetting visitor;
    node.accept(visitor);
}

osgMultiRender::Plan planOf(const ShadowedScene& scene)
{
    const std::vector<osgMultiRender::Plan> plans = scene.getPlans();
    if (!plans.empty())
        return plans.back();
    ADD_FAILURE() << "nothing was planned";
    return {};
}

std::string entryOf(const ShadowedScene& scene, const std::string& subject)
{
    return floorScene::entryOf(planOf(scene), subject);
}

double countOf(const ShadowedScene& scene, const std::string& name)
{
    const osgMultiRender::Plan plan = planOf(scene);
    const auto found = plan.counts.find(name);
    return found == plan.counts.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

double darkShare(const osg::Image& image)
{
    int dark = 0;
    for (int y = 0; y < image.t(); ++y)
        for (int x = 0; x < image.s(); ++x)
            dark += floorScene::red(image, x, y) < 20;
    return double(dark) / (image.s() * image.t());
}

testing::AssertionResult areEqual(const osg::Image* actual, const osg::Image* expected,
                                  const std::string& name)
{
    keep(actual, name);
    return support::CompareImage{0.0, 0.0, 0.0}(actual, expected, name);
}

void keep(const osg::Image* image, const std::string& name)
{
    if (image && std::getenv("OSGKITS_KEEP_IMAGES"))
        support::writeImage(*image, name);
}

} // namespace volumeScene
