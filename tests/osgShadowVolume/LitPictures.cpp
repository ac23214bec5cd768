// SPDX-License-Identifier: MIT
#include "LitPictures.h"

#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/LightSource>
#include <osg/Shape>
#include <osg/ShapeDrawable>

namespace lit
{

support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer viewer({Width, Height});
    return viewer;
}

support::CameraSpec camera()
{
    return support::CameraSpec::perspective({0, -8, 3}, {0, 0, 0}, {0, 0, 1}, 30.0,
                                            double(Width) / Height, 1.0, 30.0);
}

osg::ref_ptr<osg::Geode> ball(const osg::Vec3& center, const osg::Vec4& color)
{
    osg::ref_ptr<osg::TessellationHints> hints = new osg::TessellationHints;
    hints->setDetailRatio(0.5f);
    osg::ref_ptr<osg::ShapeDrawable> sphere =
        new osg::ShapeDrawable(new osg::Sphere(center, 0.8f), hints);
    sphere->setColor(color);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(sphere);
    return geode;
}

void makeTransparent(osg::Node& node, bool nest)
{
    osg::StateSet* stateSet = node.getOrCreateStateSet();
    stateSet->setAttributeAndModes(new osg::BlendFunc, osg::StateAttribute::ON);
    stateSet->setAttribute(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
    stateSet->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    stateSet->setNestRenderBins(nest);
}

osg::ref_ptr<osg::Node> lightSource(unsigned int number, const osg::Vec4& position,
                                    const osg::Vec4& color, osg::StateSet& scope)
{
    osg::ref_ptr<osg::Light> light = new osg::Light(number);
    light->setPosition(position);
    light->setAmbient(osg::Vec4(0, 0, 0, 1));
    light->setDiffuse(color);
    light->setSpecular(osg::Vec4(0, 0, 0, 1));
    scope.setMode(GL_LIGHT0 + number, osg::StateAttribute::ON);
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(light);
    source->setReferenceFrame(osg::LightSource::RELATIVE_RF);
    return source;
}

osg::ref_ptr<osg::Image> picture(osg::Node& scene, unsigned int frames)
{
    // Another viewer of the test may have made its own context current.
    viewer().getViewer().getCamera()->getGraphicsContext()->makeCurrent();
    return viewer().render(&scene, camera(), Width, Height, frames);
}

osg::ref_ptr<osgShadowVolume::LitScene> litScene(Lighting lighting)
{
    osg::ref_ptr<osgShadowVolume::LitScene> kit = new osgShadowVolume::LitScene;
    kit->setLighting(lighting);
    return kit;
}

osgMultiRender::Plan planOf(const osgMultiRender::SurfaceGroup& kit)
{
    const std::vector<osgMultiRender::Plan> plans = kit.getPlans();
    if (plans.empty())
    {
        ADD_FAILURE() << "the kit drew nothing";
        return {};
    }
    EXPECT_EQ(plans.back().counts.at("variants.failed"), 0.0);
    return plans.back();
}

std::string entryOf(const osgMultiRender::Plan& plan, const std::string& subject)
{
    for (const osgMultiRender::PlanEntry& entry : plan.entries)
        if (entry.subject.find(subject) != std::string::npos)
            return std::string(toString(entry.decision)) + ": " + entry.reason;
    return {};
}

void expectSameAsStock(const Build& build, const std::string& name, unsigned int frames)
{
    osg::ref_ptr<osg::Group> plain = new osg::Group;
    const osg::ref_ptr<osg::Node> stock = build(*plain);
    const osg::ref_ptr<osg::Image> expected = picture(*stock, frames);
    osg::ref_ptr<osgShadowVolume::LitScene> kit = litScene(Lighting::VERTEX);
    const osg::ref_ptr<osg::Node> scene = build(*kit);
    const osg::ref_ptr<osg::Image> actual = picture(*scene, frames);
    ASSERT_TRUE(expected.valid() && actual.valid());
    EXPECT_TRUE(support::CompareImage()(actual, expected, name));
    const osgMultiRender::Plan plan = planOf(*kit);
    EXPECT_GT(plan.counts.at("leaves.program"), 0.0) << name << ": nothing was drawn by a program";
    if (std::getenv("OSGKITS_KEEP_IMAGES"))
        support::writeImage(*actual, name);
}

bool differ(const osg::Image& a, const osg::Image& b)
{
    return support::difference(a, b, 4.0 / 255.0).getShareOver() > 0.005;
}

} // namespace lit
