// SPDX-License-Identifier: MIT
#include <precision/ShadowScenes.h>

#include <support/InventorModels.h>

#include <osg/ComputeBoundsVisitor>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/NodeVisitor>
#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>

#include <cmath>
#include <random>
#include <stdexcept>

namespace precision
{

namespace
{

/// Takes away colours, lights, lines and points: only white surfaces are left.
class Whitewash : public osg::NodeVisitor
{
public:
    Whitewash() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override
    {
        node.setStateSet(nullptr);
        traverse(node);
    }

    void apply(osg::LightSource& source) override
    {
        source.setLight(nullptr);
        apply(static_cast<osg::Node&>(source));
    }

    void apply(osg::Geometry& geometry) override
    {
        for (unsigned int i = geometry.getNumPrimitiveSets(); i-- > 0;)
            if (geometry.getPrimitiveSet(i)->getMode() < GL_TRIANGLES)
                geometry.removePrimitiveSet(i);
        osg::ref_ptr<osg::Vec4Array> white = new osg::Vec4Array(osg::Array::BIND_OVERALL);
        white->push_back(osg::Vec4(1, 1, 1, 1));
        geometry.setColorArray(white);
        apply(static_cast<osg::Node&>(geometry));
    }
};

ShadowScene makeScene(osg::Light* light)
{
    ShadowScene scene;
    scene.root = new osg::Group;
    scene.light = light;
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(light);
    scene.root->addChild(source);
    return scene;
}

osg::ref_ptr<osg::Geode> makeGround(const osg::Vec3& center, float size)
{
    osg::ref_ptr<osg::Geode> ground = new osg::Geode;
    ground->addDrawable(osg::createTexturedQuadGeometry(center - osg::Vec3(size, size, 0.0f),
                                                        osg::Vec3(2.0f * size, 0.0f, 0.0f),
                                                        osg::Vec3(0.0f, 2.0f * size, 0.0f)));
    return ground;
}

/// Triangles over the unit square, `cells` x `cells` of them with corners that lie anywhere, taken
/// to the wall that `origin`, `along` and `up` span.
osg::ref_ptr<osg::Geometry> makeWall(int cells, const osg::Vec3d& origin, const osg::Vec3d& along,
                                     const osg::Vec3d& up)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> jitter(-0.35, 0.35);
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i)
        {
            const bool isInner = i > 0 && j > 0 && i < cells && j < cells;
            const double u = (i + (isInner ? jitter(random) : 0.0)) / cells;
            const double v = (j + (isInner ? jitter(random) : 0.0)) / cells;
            vertices->push_back(osg::Vec3(origin + along * u + up * v));
        }
    const unsigned int step = unsigned(cells) + 1;
    for (unsigned int j = 0; j < unsigned(cells); ++j)
        for (unsigned int i = 0; i < unsigned(cells); ++i)
        {
            const unsigned int a = j * step + i;
            for (unsigned int corner : {a, a + 1, a + step + 1, a, a + step + 1, a + step})
                indices->push_back(corner);
        }
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_OVERALL);
    osg::Vec3d normal = along ^ up;
    normal.normalize();
    normals->push_back(osg::Vec3(normal));
    osg::ref_ptr<osg::Geometry> wall = new osg::Geometry;
    wall->setUseDisplayList(false);
    wall->setUseVertexBufferObjects(true);
    wall->setVertexArray(vertices);
    wall->setNormalArray(normals);
    wall->addPrimitiveSet(indices);
    return wall;
}

} // namespace

ShadowScene makeModelShadowScene(double aspect)
{
    const osg::ref_ptr<osg::Node> model =
        osgDB::readRefNodeFile(support::inventorModel("machines/simpleEngine.iv"));
    if (!model)
        throw std::runtime_error("machines/simpleEngine.iv of Debian's inventor-data is missing");
    Whitewash whitewash;
    model->accept(whitewash);
    osg::ComputeBoundsVisitor bounds;
    model->accept(bounds);
    const osg::BoundingBox box = bounds.getBoundingBox();
    const osg::Vec3 center = box.center();
    const float r = box.radius();
    osg::ref_ptr<osg::Light> light = new osg::Light(0);
    const osg::Vec3 offset = osg::Vec3(-1.52f, -0.91f, 1.97f) * r;
    light->setPosition(osg::Vec4(center + offset, 1.0f));
    light->setDirection(-offset);
    light->setSpotCutoff(35.0f);
    ShadowScene scene = makeScene(light);
    scene.root->addChild(model);
    scene.root->addChild(
        makeGround(osg::Vec3(center.x(), center.y(), box.zMin() - 0.02f * r), 3.0f * r));
    scene.camera = support::CameraSpec::perspective(
        osg::Vec3d(center) + osg::Vec3d(0.9, -3.6, 2.1) * r, center, osg::Vec3d(0, 0, 1), 32.0,
        aspect, 0.5 * r, 12.0 * r);
    return scene;
}

ShadowScene makeWallShadowScene(double aspect)
{
    // Turned so that no coordinate of the wall is round.
    const osg::Vec3d along(std::cos(0.37) * 6.0, std::sin(0.37) * 6.0, 0.0);
    const osg::Vec3d up(-0.3 * std::sin(0.37), 0.3 * std::cos(0.37), 2.5);
    const osg::Vec3d origin = osg::Vec3d(0.3, 0.2, 0.0) - along * 0.5;
    osg::ref_ptr<osg::Light> light = new osg::Light(0);
    light->setPosition(osg::Vec4(osg::Vec3(origin + along * 0.45 + up * 1.3), 1.0f));
    ShadowScene scene = makeScene(light);
    osg::ref_ptr<osg::Geode> content = new osg::Geode;
    content->addDrawable(makeWall(60, origin, along, up));
    for (int i = 0; i < 5; ++i)
        content->addDrawable(new osg::ShapeDrawable(
            new osg::Box(osg::Vec3(-2.2f + 1.1f * float(i), -1.4f + 0.3f * float(i % 2), 0.35f),
                         0.5f, 0.4f, 0.7f)));
    scene.root->addChild(content);
    scene.root->addChild(makeGround(osg::Vec3(0.0f, 0.0f, -0.02f), 7.0f));
    scene.camera = support::CameraSpec::perspective({3.0, -9.0, 5.5}, {0, 0, 0.6}, {0, 0, 1}, 40.0,
                                                    aspect, 1.0, 40.0);
    return scene;
}

} // namespace precision
