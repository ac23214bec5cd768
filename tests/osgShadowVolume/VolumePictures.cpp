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
    if (node)
        transform->addChild(node);
    return transform;
}

void addTwoBoxes(osg::Group& group)
{
    group.addChild(floorScene::floorGeode());
    group.addChild(moved({1, 0.3f, 1}, box({}, 1)));
    group.addChild(moved({-1.2f, -0.5f, 0.8f}, box({}, 0.6f)));
    group.addChild(floorScene::lightSource(0, osg::Vec4(2.5f, 1, 5, 1), 0.5f));
    group.addChild(floorScene::lightSource(1, osg::Vec4(-1, 0.4f, 1.3f, 0), 0.4f));
}

osg::ref_ptr<ShadowedScene> twoBoxes()
{
    osg::ref_ptr<ShadowedScene> scene = shadowed();
    addTwoBoxes(*scene);
    return scene;
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

osg::ref_ptr<osg::Image> render(osg::Node& scene, const support::CameraSpec& camera, int width,
                                int height, unsigned int frames)
{
    // Another viewer of the test may have made its own context current.
    support::HeadlessViewer& viewer = floorScene::viewer();
    viewer.getViewer().getCamera()->getGraphicsContext()->makeCurrent();
    return viewer.render(&scene, camera, width, height, frames);
}

void keep(const osg::Image* image, const std::string& name)
{
    if (image && std::getenv("OSGKITS_KEEP_IMAGES"))
        support::writeImage(*image, name);
}

} // namespace volumeScene
