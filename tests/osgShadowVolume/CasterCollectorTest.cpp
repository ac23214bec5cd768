// SPDX-License-Identifier: MIT
#include <osgShadowVolume/CasterCollector.h>

#include <support/InventorModels.h>

#include <osg/AutoTransform>
#include <osg/Billboard>
#include <osg/Camera>
#include <osg/ClearNode>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/PolygonMode>
#include <osg/PositionAttitudeTransform>
#include <osg/Projection>
#include <osg/Sequence>
#include <osg/ShapeDrawable>
#include <osg/Switch>
#include <osg/ValueObject>
#include <osgDB/ReadFile>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderStage>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>

using namespace osgShadowVolume;

namespace
{

using Matrix = std::array<double, 16>;
using Matrices = std::map<const osg::Drawable*, std::multiset<Matrix>>;
using Counts = std::map<std::string, unsigned int>;

Matrix bitsOf(const osg::Matrixd& matrix)
{
    Matrix bits;
    std::memcpy(bits.data(), matrix.ptr(), sizeof bits);
    return bits;
}

/// A group that collects its casters where the cull traversal of a view meets it.
class Probe : public osg::Group
{
public:
    TransparentCasters transparent = TransparentCasters::BY_ALPHA;
    std::unique_ptr<CasterCollector> collector;

    void traverse(osg::NodeVisitor& visitor) override
    {
        if (osgUtil::CullVisitor* view = visitor.asCullVisitor())
        {
            collector = std::make_unique<CasterCollector>(*view, transparent);
            collector->collect(*this);
        }
        osg::Group::traverse(visitor);
    }
};

/// What a view of 640 x 480 pixels sees of a scene, without culling.
class View
{
public:
    explicit View(const osg::Matrixd& view, osg::Node::NodeMask mask = ~0u)
        : _visitor(new osgUtil::CullVisitor), _graph(new osgUtil::StateGraph),
          _stage(new osgUtil::RenderStage), _stamp(new osg::FrameStamp)
    {
        _visitor->setStateGraph(_graph);
        _visitor->setRenderStage(_stage);
        _visitor->reset();
        _visitor->setFrameStamp(_stamp);
        _visitor->setTraversalMask(mask);
        _visitor->setLODScale(1.25f);
        _visitor->setCullingMode(osg::CullSettings::NO_CULLING);
        _visitor->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        _visitor->pushViewport(new osg::Viewport(0, 0, 640, 480));
        _visitor->pushProjectionMatrix(
            new osg::RefMatrix(osg::Matrixd::perspective(40.0, 4.0 / 3.0, 1.0, 1000.0)));
        _visitor->pushModelViewMatrix(new osg::RefMatrix(view), osg::Transform::ABSOLUTE_RF);
    }

    Matrices cull(osg::Node& scene)
    {
        scene.accept(*_visitor);
        Matrices matrices;
        addLeaves(*_graph, matrices);
        return matrices;
    }

private:
    /// The nearest PolygonMode of the path that says so.
    static bool isWireframe(const osgUtil::StateGraph* graph)
    {
        for (; graph; graph = graph->_parent)
            if (const osg::StateSet* state = graph->getStateSet())
                if (const auto* mode = static_cast<const osg::PolygonMode*>(
                        state->getAttribute(osg::StateAttribute::POLYGONMODE)))
                    return mode->getMode(osg::PolygonMode::FRONT) != osg::PolygonMode::FILL;
        return false;
    }

    static void addLeaves(const osgUtil::StateGraph& graph, Matrices& matrices)
    {
        for (const auto& leaf : graph._leaves)
            if (whyNoCaster(*leaf->getDrawable()) == NoCaster::CASTS && !isWireframe(&graph))
                matrices[leaf->getDrawable()].insert(bitsOf(*leaf->_modelview));
        for (const auto& child : graph._children)
            addLeaves(*child.second, matrices);
    }

    osg::ref_ptr<osgUtil::CullVisitor> _visitor;
    osg::ref_ptr<osgUtil::StateGraph> _graph;
    osg::ref_ptr<osgUtil::RenderStage> _stage;
    osg::ref_ptr<osg::FrameStamp> _stamp;
};

Matrices matricesOf(CasterCollector& collector)
{
    Matrices matrices;
    for (const Caster& caster : collector.getCasters())
        for (const auto& drawable : caster.source)
            matrices[drawable.get()].insert(bitsOf(*caster.modelview));
    return matrices;
}

std::vector<osg::Matrixd> viewsOf(const osg::Node& scene)
{
    const osg::BoundingSphere bound = scene.getBound();
    const osg::Vec3d center = bound.center();
    const double r = bound.radius();
    return {osg::Matrixd::lookAt(center + osg::Vec3d(1.1, -2.3, 0.7) * r, center, {0, 0, 1}),
            osg::Matrixd::lookAt(center + osg::Vec3d(-9.1, 0.3, 4.7) * r, center, {0, 1, 0}),
            osg::Matrixd::scale(1, -1, 1.3) * osg::Matrixd::translate(0.1, 0.2, -7.3)};
}

/// From each of the views the casters are those drawables of the view's leaves that have triangles,
/// under the same matrices. Returns how many there were.
std::size_t expectTheLeaves(osg::Node* model, osg::Node::NodeMask mask = ~0u)
{
    std::size_t count = 0;
    osg::ref_ptr<osg::MatrixTransform> root = new osg::MatrixTransform;
    root->setMatrix(osg::Matrixd::rotate(0.3, osg::Vec3d(1, 2, 3)));
    osg::ref_ptr<Probe> probe = new Probe;
    probe->transparent = TransparentCasters::ALL;
    root->addChild(probe);
    probe->addChild(model);
    for (const osg::Matrixd& matrix : viewsOf(*root))
    {
        View view(matrix, mask);
        const Matrices expected = view.cull(*root);
        EXPECT_EQ(matricesOf(*probe->collector), expected);
        count += expected.size();
    }
    return count;
}

osg::ref_ptr<osg::Geometry> triangle(float x = 0.0f)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    vertices->push_back({x, 0, 0});
    vertices->push_back({x + 1, 0, 0});
    vertices->push_back({x, 1, 0});
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    return geometry;
}

/// Whether Coin crashes on the model without a display, which it asks how finely to divide NURBS.
bool needsDisplay(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    return text.find("Nurbs") != std::string::npos;
}

/// Collects under a probe with these children.
osg::ref_ptr<Probe> collect(std::initializer_list<osg::Node*> children,
                            TransparentCasters transparent = TransparentCasters::BY_ALPHA,
                            osg::StateSet* above = nullptr)
{
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->setStateSet(above);
    osg::ref_ptr<Probe> probe = new Probe;
    probe->transparent = transparent;
    root->addChild(probe);
    for (osg::Node* child : children)
        probe->addChild(child);
    View view(osg::Matrixd::translate(0, 0, -10));
    view.cull(*root);
    return probe;
}

std::size_t drawablesIn(const Probe& probe)
{
    std::size_t count = 0;
    for (const Caster& caster : probe.collector->getCasters())
        count += caster.source.size();
    return count;
}

osg::ref_ptr<osg::Material> material(float alpha)
{
    osg::ref_ptr<osg::Material> made = new osg::Material;
    made->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, alpha));
    return made;
}

/// How many of one triangle, under a group and with a state of its own, cast.
std::size_t castsWith(TransparentCasters transparent, osg::StateSet* above, osg::StateSet* own,
                      const osg::Vec4* color = nullptr)
{
    osg::ref_ptr<osg::Geometry> geometry = triangle();
    geometry->setStateSet(own);
    if (color)
        geometry->setColorArray(new osg::Vec4Array(1, color), osg::Array::BIND_OVERALL);
    return drawablesIn(*collect({geometry}, transparent, above));
}

osg::ref_ptr<osg::StateSet> blended(float alpha, osg::StateAttribute::GLModeValue mode = 1,
                                    osg::StateAttribute::OverrideValue attribute = 1)
{
    osg::ref_ptr<osg::StateSet> stateSet = new osg::StateSet;
    stateSet->setMode(GL_BLEND, mode);
    stateSet->setAttribute(material(alpha), attribute);
    return stateSet;
}

} // namespace

TEST(CasterCollectorTest, matricesOfInventorModelsAreThoseOfTheLeaves)
{
    const std::vector<std::string> models = support::inventorModels();
    if (models.empty())
        GTEST_SKIP() << "NOT TESTED: inventor-data is not installed";
    std::size_t count = 0;
    for (const std::string& path : models)
    {
        SCOPED_TRACE(path);
        if (needsDisplay(path))
            continue;
        osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile(path);
        if (model)
            count += expectTheLeaves(model);
    }
    EXPECT_GT(count, 1000u);
    std::cout << count << " drawables compared\n";
}

TEST(CasterCollectorTest, nodesThatChooseByTheViewChooseAlike)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    const auto fill = [](osg::Group* group)
    {
        for (int i = 0; i < 5; ++i)
            group->addChild(triangle(float(i)));
        return group;
    };
    for (const osg::LOD::RangeMode mode :
         {osg::LOD::DISTANCE_FROM_EYE_POINT, osg::LOD::PIXEL_SIZE_ON_SCREEN})
        for (osg::LOD* lod : {new osg::LOD, static_cast<osg::LOD*>(new osg::PagedLOD)})
        {
            lod->setRangeMode(mode);
            fill(lod);
            for (unsigned int i = 0; i < 5; ++i)
                lod->setRange(i, i * i * 10.0f, (i + 1) * (i + 1) * 10.0f);
            osg::ref_ptr<osg::PositionAttitudeTransform> turned =
                new osg::PositionAttitudeTransform;
            turned->setAttitude(osg::Quat(0.7, osg::Vec3d(1, 1, 0)));
            turned->setPosition(osg::Vec3d(3, 2, 1));
            turned->setScale(osg::Vec3d(1.1, 0.7, 3));
            turned->addChild(lod);
            scene->addChild(turned);
        }
    osg::ref_ptr<osg::Switch> one = new osg::Switch;
    fill(one);
    one->setSingleChildOn(2);
    scene->addChild(one);
    osg::ref_ptr<osg::Sequence> sequence = new osg::Sequence;
    fill(sequence);
    sequence->setValue(3);
    scene->addChild(sequence);
    for (const osg::AutoTransform::AutoRotateMode mode :
         {osg::AutoTransform::ROTATE_TO_SCREEN, osg::AutoTransform::ROTATE_TO_CAMERA,
          osg::AutoTransform::ROTATE_TO_AXIS})
    {
        osg::ref_ptr<osg::AutoTransform> automatic = new osg::AutoTransform;
        automatic->setAutoRotateMode(mode);
        automatic->setAutoScaleToScreen(true);
        automatic->setPosition(osg::Vec3d(1, 2, 3));
        fill(automatic);
        scene->addChild(automatic);
    }
    for (const osg::Transform::ReferenceFrame frame :
         {osg::Transform::ABSOLUTE_RF, osg::Transform::ABSOLUTE_RF_INHERIT_VIEWPOINT})
    {
        osg::ref_ptr<osg::MatrixTransform> absolute = new osg::MatrixTransform;
        absolute->setReferenceFrame(frame);
        absolute->setMatrix(osg::Matrixd::translate(0, 0, -50));
        osg::ref_ptr<osg::LOD> lod = new osg::LOD;
        fill(lod);
        for (unsigned int i = 0; i < 5; ++i)
            lod->setRange(i, i * 15.0f, i * 15.0f + 15.0f);
        absolute->addChild(lod);
        absolute->addChild(fill(new osg::Group));
        scene->addChild(absolute);
    }
    EXPECT_GT(expectTheLeaves(scene), 3u * 20u);
}

TEST(CasterCollectorTest, nodeMasksCount)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    for (const unsigned int mask : {1u, 2u, 3u, 0u})
    {
        osg::ref_ptr<osg::Group> group = new osg::Group;
        group->setNodeMask(mask);
        group->addChild(triangle());
        scene->addChild(group);
    }
    EXPECT_EQ(expectTheLeaves(scene, 2u), 3u * 2u);
}

TEST(CasterCollectorTest, whatCastsNothingIsCounted)
{
    osg::ref_ptr<osg::Billboard> billboard = new osg::Billboard;
    billboard->addDrawable(triangle());
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->addChild(triangle());
    osg::ref_ptr<osg::Projection> projection = new osg::Projection;
    projection->addChild(triangle());
    osg::ref_ptr<osg::ClearNode> clear = new osg::ClearNode;
    clear->addChild(triangle());
    osg::ref_ptr<osg::Geometry> lines = triangle();
    lines->setPrimitiveSet(0, new osg::DrawArrays(GL_LINES, 0, 2));
    osg::ref_ptr<Probe> probe = collect(
        {billboard, osg::clone(billboard.get()), camera, projection, clear, lines, triangle()});
    EXPECT_EQ(drawablesIn(*probe), 1u);
    EXPECT_EQ(probe->collector->getLeftOut(), (Counts{{"billboards", 2},
                                                      {"cameras", 1},
                                                      {"projections", 1},
                                                      {"clear nodes", 1},
                                                      {"points and lines", 1}}));
}

TEST(CasterCollectorTest, nodesMaySayThatTheyCastNothing)
{
    const auto group = [](auto&& say)
    {
        osg::ref_ptr<osg::Group> made = new osg::Group;
        made->addChild(triangle());
        say(*made);
        return made;
    };
    const auto castsWhere = [&](auto&& say) { return drawablesIn(*collect({group(say)})) == 1; };
    EXPECT_FALSE(castsWhere([](osg::Node& n) { n.setUserValue("castShadow", false); }));
    EXPECT_FALSE(castsWhere([](osg::Node& n) { n.setUserValue("castShadow", 0); }));
    EXPECT_FALSE(castsWhere([](osg::Node& n) { n.setUserValue("castShadow", 0.0); }));
    EXPECT_FALSE(
        castsWhere([](osg::Node& n) { n.setUserValue("castShadow", std::string("false")); }));
    EXPECT_FALSE(castsWhere([](osg::Node& n) { n.addDescription("castShadow=0"); }));
    EXPECT_TRUE(castsWhere([](osg::Node& n) { n.setUserValue("castShadow", true); }));
    EXPECT_TRUE(castsWhere([](osg::Node& n) { n.setUserValue("castShadow", 1); }));
    EXPECT_TRUE(castsWhere([](osg::Node& n) { n.setUserValue("other", 0); }));
    EXPECT_TRUE(castsWhere([](osg::Node& n) { n.addDescription("castShadow=1"); }));
    osg::ref_ptr<osg::Geometry> own = triangle();
    own->setUserValue("castShadow", false);
    EXPECT_EQ(collect({own})->collector->getLeftOut(), (Counts{{"castShadow=0", 1}}));
}

TEST(CasterCollectorTest, transparentCastersFollowTheSettings)
{
    using osg::StateAttribute;
    const auto by = TransparentCasters::BY_ALPHA;
    const osg::ref_ptr<osg::StateSet> thin = blended(0.3f), thick = blended(0.5f),
                                      solid = blended(1.0f);
    EXPECT_EQ(castsWith(by, nullptr, thin), 0u);
    EXPECT_EQ(castsWith(by, nullptr, thick), 1u);
    EXPECT_EQ(castsWith(by, thin, nullptr), 0u);
    EXPECT_EQ(castsWith(TransparentCasters::NONE, nullptr, thick), 0u);
    EXPECT_EQ(castsWith(TransparentCasters::NONE, nullptr, solid), 1u);
    EXPECT_EQ(castsWith(TransparentCasters::ALL, nullptr, thin), 1u);
    EXPECT_EQ(castsWith(by, nullptr, blended(0.3f, StateAttribute::OFF)), 1u);
    EXPECT_EQ(castsWith(by, thin, blended(0.3f, StateAttribute::OFF)), 1u);
    EXPECT_EQ(castsWith(by, thin, solid), 1u);
    // GL's own rules for what wins.
    const auto over = StateAttribute::ON | StateAttribute::OVERRIDE;
    const auto protect = StateAttribute::ON | StateAttribute::PROTECTED;
    EXPECT_EQ(castsWith(by, blended(0.3f, over, over), solid), 0u);
    EXPECT_EQ(castsWith(by, blended(0.3f, over, over), blended(1.0f, protect, protect)), 1u);
}

TEST(CasterCollectorTest, alphaIsThatOfTheColorWhereTheMaterialFollowsIt)
{
    const auto by = TransparentCasters::BY_ALPHA;
    const osg::Vec4 thin(1, 1, 1, 0.3f), solid(1, 1, 1, 1);
    EXPECT_EQ(castsWith(by, nullptr, blended(1.0f), &thin), 1u);
    osg::ref_ptr<osg::StateSet> follows = blended(0.3f);
    static_cast<osg::Material*>(follows->getAttribute(osg::StateAttribute::MATERIAL))
        ->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    EXPECT_EQ(castsWith(by, nullptr, follows, &solid), 1u);
    EXPECT_EQ(castsWith(by, nullptr, follows, &thin), 0u);
    osg::ref_ptr<osg::StateSet> bare = new osg::StateSet;
    bare->setMode(GL_BLEND, osg::StateAttribute::ON);
    EXPECT_EQ(castsWith(by, nullptr, bare, &thin), 0u);
    EXPECT_EQ(castsWith(by, nullptr, bare), 1u);
}

TEST(CasterCollectorTest, staticGeometriesUnderOneMatrixAreOneCaster)
{
    osg::ref_ptr<osg::Geometry> dynamic = triangle(), dynamicVertices = triangle();
    dynamic->setDataVariance(osg::Object::DYNAMIC);
    dynamicVertices->getVertexArray()->setDataVariance(osg::Object::DYNAMIC);
    osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform;
    moved->addChild(triangle(5));
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(triangle(9));
    osg::ref_ptr<Probe> probe =
        collect({triangle(0), dynamic, moved, group, dynamicVertices, triangle(20)});
    const std::vector<Caster>& casters = probe->collector->getCasters();
    ASSERT_EQ(casters.size(), 4u);
    EXPECT_EQ(casters[0].source.size(), 3u);
    EXPECT_FALSE(casters[0].dynamic);
    EXPECT_EQ(casters[0].box, osg::BoundingBox(0, 0, 0, 21, 1, 0));
    EXPECT_TRUE(casters[1].dynamic);
    EXPECT_EQ(casters[2].source.size(), 1u);
    EXPECT_TRUE(casters[3].dynamic);
    EXPECT_NE(casters[2].modelview, casters[0].modelview);
}

TEST(CasterCollectorTest, thirtyThousandDrawablesAreAllFound)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (int i = 0; i < 30000; ++i)
    {
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
        place->setMatrix(osg::Matrixd::translate(i % 100, i / 100 % 100, i / 10000));
        place->addChild(triangle());
        group->addChild(place);
    }
    for (int run = 0; run < 2; ++run) // The first one computes bounds.
        EXPECT_EQ(collect({group})->collector->getCasters().size(), 30000u);
}
