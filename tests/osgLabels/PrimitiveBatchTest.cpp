// SPDX-License-Identifier: MIT
#include "PrimitiveScenes.h"

#include <osgLabels/PixelScale.h>
#include <osgLabels/UnitMesh.h>

#include <support/NotifyCapture.h>

#include <osg/ComputeBoundsVisitor>
#include <osg/TriangleFunctor>
#include <osgDB/Registry>
#include <osgUtil/LineSegmentIntersector>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <sstream>

using namespace osgLabels;

namespace
{

struct Triangles
{
    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false)
    {
        for (const osg::Vec3& corner : {a, b, c})
            box.expandBy(corner);
        area += 0.5 * osg::Vec3d((b - a) ^ (c - a)).length();
        volume += osg::Vec3d(a) * (osg::Vec3d(b) ^ osg::Vec3d(c)) / 6.0;
        ++count;
    }
    osg::BoundingBox box;
    double area = 0.0, volume = 0.0;
    unsigned int count = 0;
};

Triangles trianglesOf(const PrimitiveRun& run)
{
    osg::TriangleFunctor<Triangles> functor;
    run.accept(functor);
    return functor;
}

/// Sees triangles, as any Drawable's: the batch knows nothing of it.
class PlainIntersector : public osgUtil::LineSegmentIntersector
{
public:
    using LineSegmentIntersector::LineSegmentIntersector;
    Intersector* clone(osgUtil::IntersectionVisitor& visitor) override
    {
        osg::Matrixd inverse;
        inverse.invert(visitor.getModelMatrix() ? *visitor.getModelMatrix() : osg::Matrix());
        osg::ref_ptr<PlainIntersector> copy =
            new PlainIntersector(MODEL, _start * inverse, _end * inverse);
        copy->_parent = this;
        return copy.release();
    }
};

template <class Intersector>
std::vector<osgUtil::LineSegmentIntersector::Intersection>
hitsOf(osg::Node& node, const osg::Vec3d& from, const osg::Vec3d& to)
{
    osg::ref_ptr<Intersector> intersector = new Intersector(osgUtil::Intersector::MODEL, from, to);
    osgUtil::IntersectionVisitor visitor(intersector);
    node.accept(visitor);
    return {intersector->getIntersections().begin(), intersector->getIntersections().end()};
}

std::string nameHit(PrimitiveBatch& batch, const osg::Vec3d& from, const osg::Vec3d& to)
{
    const auto hits = hitsOf<osgUtil::LineSegmentIntersector>(batch, from, to);
    if (hits.empty())
        return "nothing";
    const int object = PrimitiveBatch::objectOf(hits[0].drawable, hits[0].primitiveIndex);
    return object < 0 ? "no object" : batch.getObjectName(unsigned(object));
}

std::vector<Primitive> crowd(unsigned int count)
{
    std::mt19937 engine(7);
    const auto random = [&] { return engine() / 4294967296.0; };
    std::vector<Primitive> crowd, row = rowOfShapes();
    for (unsigned int i = 0; i < count; ++i)
    {
        Primitive primitive = row[i % row.size()];
        for (int axis = 0; axis < 3; ++axis)
            primitive.position[axis] = 40.0 * random();
        primitive.name += "/" + std::to_string(i);
        crowd.push_back(primitive);
    }
    return crowd;
}

std::string write(const PrimitiveBatch& batch, const char* extension)
{
    std::ostringstream out(std::ios::binary);
    osgDB::ReaderWriter* plugin = osgDB::Registry::instance()->getReaderWriterForExtension("osgb");
    osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    if (std::string(extension) == "osgt")
        options->setOptionString("Ascii");
    EXPECT_TRUE(plugin->writeNode(batch, out, options).success());
    return out.str();
}

osgDB::ReaderWriter::ReadResult read(const std::string& text, const char* extension)
{
    std::istringstream in(text, std::ios::binary);
    osgDB::ReaderWriter* plugin = osgDB::Registry::instance()->getReaderWriterForExtension("osgb");
    osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    if (std::string(extension) == "osgt")
        options->setOptionString("Ascii");
    return plugin->readNode(in, options);
}

using Lines = support::NotifyCapture::Lines;

} // namespace

TEST(PrimitiveBatchTest, trianglesAreThoseOfTheShapes)
{
    // Areas of the exact surfaces. Of 24 sides a polygon has 1.2 % less, ring and tube both.
    const double pi = osg::PI;
    const double side = std::sqrt(1.6 * 1.6 + 0.6 * 0.6);
    const double areas[] = {
        8.0 * (1.0 * 0.5 + 0.5 * 0.3 + 0.3 * 1.0),
        2.0 * pi * 0.4 * (2.4 + 0.4),
        4.0 * pi * 0.81,
        0.0, // of a half ellipsoid: see its volume
        pi * (0.9 + 0.3) * side + pi * (0.81 + 0.09),
        0.0,
        1.57 * 0.8 * 2.0 * pi * 0.25 + 2.0 * pi * 0.0625,
        4.0 * pi * pi * 0.9 * 0.04,
        4.0 * 0.6,
        8.0 * (0.09 + 2.0 * 0.36),
    };
    const double volumes[] = {8.0 * 0.15,
                              pi * 0.16 * 2.4,
                              4.0 / 3.0 * pi * 0.729,
                              2.0 / 3.0 * pi * 0.81 * 0.5,
                              pi * 1.6 / 3.0 * (0.81 + 0.27 + 0.09),
                              4.0 * 0.63 * 1.6 / 3.0,
                              1.57 * 0.8 * pi * 0.0625,
                              2.0 * pi * pi * 0.9 * 0.0016,
                              0.0,
                              8.0 * 0.09 * 1.2};
    const auto row = rowOfShapes();
    for (std::size_t i = 0; i < row.size(); ++i)
    {
        const auto batch = batchOf({row[i]});
        ASSERT_EQ(batch->getRuns().size(), 1u);
        const Triangles triangles = trianglesOf(*batch->getRuns()[0]);
        EXPECT_EQ(triangles.count, batch->getRuns()[0]->getNumTriangles());
        // At this level a thin tube has 6 sides, 17 % less in volume, an elbow's tube 12.
        const double share = i == 7 ? 0.2 : i == 6 ? 0.06 : 0.04;
        if (areas[i] > 0.0)
        {
            EXPECT_NEAR(triangles.area, areas[i], share * areas[i]) << row[i].name;
        }
        EXPECT_NEAR(triangles.volume, volumes[i], share * volumes[i] + 1e-5) << row[i].name;
        EXPECT_LE(triangles.volume, volumes[i] + 1e-4) << row[i].name;
    }
}

TEST(PrimitiveBatchTest, boundsHoldAllTriangles)
{
    const auto batch = batchOf(crowd(500));
    ASSERT_FALSE(batch->getRuns().empty());
    for (const auto& run : batch->getRuns())
    {
        const osg::BoundingBox inside = trianglesOf(*run).box, box = run->getBoundingBox();
        for (int axis = 0; axis < 3; ++axis)
        {
            EXPECT_LE(box._min[axis], inside._min[axis] + 1e-5);
            EXPECT_GE(box._max[axis], inside._max[axis] - 1e-5);
            // Not far more: half a shape's reach at most.
            EXPECT_NEAR(box._min[axis], inside._min[axis], 1.0);
            EXPECT_NEAR(box._max[axis], inside._max[axis], 1.0);
        }
    }
}

TEST(PrimitiveBatchTest, anEmptyBatchIsBuiltDrawnAndWritten)
{
    const auto batch = batchOf({});
    EXPECT_EQ(batch->getNumObjects(), 0u);
    EXPECT_FALSE(batch->getBound().valid());
    const osg::ref_ptr<osg::Node> copy = read(write(*batch, "osgb"), "osgb").getNode();
    ASSERT_TRUE(dynamic_cast<PrimitiveBatch*>(copy.get()));
    EXPECT_EQ(static_cast<PrimitiveBatch&>(*copy).getNumObjects(), 0u);
}

TEST(PrimitiveBatchTest, linesHitTheObjectThatLiesThere)
{
    const auto row = rowOfShapes();
    const auto batch = batchOf(row);
    for (const Primitive& primitive : row)
    {
        if (primitive.shape == Shape::Torus)
            continue; // nothing at its centre
        const osg::Vec3d along(0.02, -0.01, 5.0);
        EXPECT_EQ(nameHit(*batch, primitive.position + along, primitive.position - along),
                  primitive.name);
    }
    EXPECT_EQ(nameHit(*batch, {1.5, 40.0, 5.0}, {1.5, 40.0, -5.0}), "nothing");
}

TEST(PrimitiveBatchTest, linesHitTheSameAsAnyOtherVisitorOfTriangles)
{
    const auto batch = batchOf(crowd(400));
    std::mt19937 engine(3);
    unsigned int hits = 0;
    for (int i = 0; i < 200; ++i)
    {
        const auto random = [&] { return 40.0 * (engine() / 4294967296.0); };
        osg::Vec3d from, to;
        for (int axis = 0; axis < 3; ++axis)
        {
            from[axis] = random();
            to[axis] = random();
        }
        const auto quick = hitsOf<osgUtil::LineSegmentIntersector>(*batch, from, to);
        const auto plain = hitsOf<PlainIntersector>(*batch, from, to);
        ASSERT_EQ(quick.size(), plain.size()) << i;
        for (std::size_t hit = 0; hit < quick.size(); ++hit)
        {
            EXPECT_NEAR(quick[hit].ratio, plain[hit].ratio, 1e-6); // of 40, in floats
            EXPECT_EQ(quick[hit].drawable, plain[hit].drawable);
            EXPECT_EQ(quick[hit].primitiveIndex, plain[hit].primitiveIndex);
            EXPECT_EQ(quick[hit].nodePath, plain[hit].nodePath);
        }
        hits += unsigned(quick.size());
    }
    EXPECT_GT(hits, 50u);
}

TEST(PrimitiveBatchTest, farFromTheOriginObjectsKeepTheirPlaces)
{
    const osg::Vec3d far(1e7, -2e7, 3e6);
    const auto row = rowOfShapes(far);
    const auto batch = batchOf(row);
    ASSERT_EQ(batch->getNumObjects(), row.size());
    std::size_t compared = 0;
    for (unsigned int i = 0; i < batch->getNumObjects(); ++i)
    {
        const Primitive kept = batch->getPrimitive(i);
        for (const Primitive& primitive : row)
        {
            // Floats relative to a cell of 30 m.
            if (primitive.name == kept.name)
            {
                EXPECT_LT((primitive.position - kept.position).length(), 2e-6) << kept.name;
                ++compared;
            }
        }
    }
    EXPECT_EQ(compared, row.size());
    const osg::Vec3d along(0.0, 0.0, 5.0), at = row[2].position;
    const auto hits = hitsOf<osgUtil::LineSegmentIntersector>(*batch, at + along, at - along);
    ASSERT_FALSE(hits.empty());
    EXPECT_NEAR(hits[0].getWorldIntersectPoint().z(), at.z() + 0.9, 0.02); // 24 sides
}

TEST(PrimitiveBatchTest, filesKeepAllObjects)
{
    const auto batch = batchOf(crowd(3000));
    for (const char* extension : {"osgb", "osgt"})
    {
        const std::string text = write(*batch, extension);
        const osg::ref_ptr<osg::Node> node = read(text, extension).getNode();
        auto* copy = dynamic_cast<PrimitiveBatch*>(node.get());
        ASSERT_TRUE(copy) << extension;
        ASSERT_EQ(copy->getNumObjects(), 3000u);
        std::set<std::string> names;
        for (unsigned int i = 0; i < 3000; ++i)
        {
            names.insert(copy->getObjectName(i));
            const Primitive a = batch->getPrimitive(i), b = copy->getPrimitive(i);
            if (std::string(extension) == "osgt")
                continue; // built anew, maybe in another order
            EXPECT_EQ(a.name, b.name);
            EXPECT_EQ(a.shape, b.shape);
            EXPECT_EQ(a.size, b.size);
            EXPECT_EQ(a.position, b.position);
            EXPECT_EQ(a.rotation, b.rotation);
            EXPECT_EQ(a.color, b.color);
        }
        EXPECT_EQ(names.size(), 3000u);
        osg::ComputeBoundsVisitor before, after;
        batch->accept(before);
        copy->accept(after);
        EXPECT_NEAR((before.getBoundingBox()._min - after.getBoundingBox()._min).length(), 0.0,
                    1e-3);
        if (std::string(extension) == "osgb")
        {
            EXPECT_LT(text.size(), 3000 * 80u);
        }
    }
}

TEST(PrimitiveBatchTest, textFilesKeepObjectsFarFromTheOrigin)
{
    const osg::Vec3d far(1e7, -2e7, 3e6);
    const auto batch = batchOf(rowOfShapes(far));
    const osg::ref_ptr<osg::Node> node = read(write(*batch, "osgt"), "osgt").getNode();
    auto* copy = dynamic_cast<PrimitiveBatch*>(node.get());
    ASSERT_TRUE(copy);
    ASSERT_EQ(copy->getNumObjects(), 10u);
    for (unsigned int i = 0; i < 10; ++i)
    {
        const Primitive a = batch->getPrimitive(i), b = copy->getPrimitive(i);
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.size, b.size);
        EXPECT_LT((a.position - b.position).length(), 2e-6);
    }
}

TEST(PrimitiveBatchTest, filesThatAreCutOffAreRefused)
{
    const std::string text = write(*batchOf(crowd(300)), "osgb");
    for (std::size_t size = text.size() / 8; size < text.size() - 8; size += text.size() / 8)
    {
        support::NotifyCapture capture;
        auto result = read(text.substr(0, size), "osgb");
        const auto* batch = dynamic_cast<PrimitiveBatch*>(result.getNode());
        EXPECT_TRUE(!batch || batch->getNumObjects() == 0) << size;
        capture.takeWarnings();
    }
}

TEST(PrimitiveBatchTest, numbersInFilesThatFitNothingAreRefused)
{
    PrimitiveBatch::Content content = batchOf(crowd(300))->getContent();
    osg::ref_ptr<PrimitiveBatch> batch = new PrimitiveBatch;
    PrimitiveBatch::Content wrong = content;
    wrong.runs[1].count += 1;
    EXPECT_NE(batch->setContent(wrong), "");
    wrong = content;
    wrong.runs.pop_back();
    EXPECT_NE(batch->setContent(wrong), "");
    wrong = content;
    wrong.runs[0].cell = 5;
    EXPECT_NE(batch->setContent(wrong), "");
    wrong = content;
    wrong.names = {};
    EXPECT_NE(batch->setContent(wrong), "");
    EXPECT_EQ(batch->getNumObjects(), 0u);
    EXPECT_EQ(batch->setContent(content), "");
    EXPECT_EQ(batch->getNumObjects(), 300u);
}

TEST(PrimitiveBatchTest, whatCannotBeDrawnIsLeftOutWithAWarning)
{
    support::NotifyCapture capture;
    osg::ref_ptr<PrimitiveBatch> batch = new PrimitiveBatch;
    Primitive primitive;
    primitive.name = "P-1";
    primitive.size.x() = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(batch->add(primitive));
    primitive.size.x() = 1.0f;
    primitive.shape = Shape::TexCoord;
    EXPECT_FALSE(batch->add(primitive));
    EXPECT_EQ(capture.takeWarnings(),
              (Lines{"osgLabels::PrimitiveBatch: 'P-1' is left out, its size is negative or not "
                     "finite",
                     "osgLabels::PrimitiveBatch: 'P-1' is left out, shape 10 has no mesh"}));
    batch->build();
    EXPECT_EQ(batch->getNumObjects(), 0u);
}

TEST(PrimitiveBatchTest, buildTakesMoreObjectsIn)
{
    const auto batch = batchOf(rowOfShapes());
    for (const Primitive& primitive : crowd(50))
        batch->add(primitive);
    EXPECT_EQ(batch->getNumObjects(), 10u);
    batch->build();
    EXPECT_EQ(batch->getNumObjects(), 60u);
    std::set<std::string> names;
    for (unsigned int i = 0; i < 60; ++i)
        names.insert(batch->getObjectName(i));
    EXPECT_EQ(names.size(), 60u);
    EXPECT_EQ(names.count("10\"-HC-4711-A1B"), 1u);
}

TEST(PrimitiveBatchTest, deepCopiesChangeAlone)
{
    const auto batch = batchOf(rowOfShapes());
    const osg::ref_ptr<PrimitiveBatch> deep =
        static_cast<PrimitiveBatch*>(batch->clone(osg::CopyOp::DEEP_COPY_ALL));
    deep->setColor(3, {1, 2, 3, 255});
    EXPECT_EQ(deep->getPrimitive(3).color, osg::Vec4ub(1, 2, 3, 255));
    EXPECT_NE(batch->getPrimitive(3).color, osg::Vec4ub(1, 2, 3, 255));
}

TEST(PrimitiveBatchTest, polygonsStayWithinHalfAPixelOfTheirCircle)
{
    for (float radius = 0.5f; radius < 900.0f; radius *= 1.1f)
    {
        const int sides = LevelSides[levelFor(radius)];
        EXPECT_LE(radius * (1.0f - std::cos(float(osg::PI) / float(sides))), 0.5f) << radius;
    }
    EXPECT_EQ(levelFor(0.0f), NumLevels - 1);
    EXPECT_EQ(levelFor(std::numeric_limits<float>::infinity()), 0);
}

TEST(PrimitiveBatchTest, objectsAreCoarserFarAwayAndNotDrawnWhereTooSmall)
{
    std::vector<Primitive> spheres(40);
    for (std::size_t i = 0; i < spheres.size(); ++i)
    {
        spheres[i].shape = Shape::Sphere;
        const float radius = i < 20 ? 1.0f : 0.01f;
        spheres[i].size.set(radius, radius, radius);
        spheres[i].position.set(0.1 * double(i), 0.0, 0.0);
    }
    const auto batch = batchOf(spheres);
    ASSERT_EQ(batch->getRuns().size(), 1u);
    const PrimitiveRun& run = *batch->getRuns()[0];
    const auto rangesAt = [&](double distance)
    {
        const double x = distance > 5.0 ? 0.0 : -1.95; // the cell lies at 1.95
        const PixelScale scale(osg::Matrixd::lookAt(osg::Vec3d(x, -distance, 0.0),
                                                    osg::Vec3d(x, 0.0, 0.0),
                                                    osg::Vec3d(0.0, 0.0, 1.0)),
                               osg::Matrixd::perspective(40.0, 1.0, 0.1, 1e5), 1000.0, 1000.0, 2.0);
        std::vector<PrimitiveRun::Range> ranges;
        run.forEachRange(scale, [&](const PrimitiveRun::Range& r) { ranges.push_back(r); });
        return ranges;
    };
    const auto near = rangesAt(4.0), whole = rangesAt(8.0), middle = rangesAt(100.0),
               far = rangesAt(3000.0);
    const auto drawn = [](const std::vector<PrimitiveRun::Range>& ranges)
    {
        unsigned int count = 0;
        for (const auto& range : ranges)
            count += range.count;
        return count;
    };
    EXPECT_EQ(drawn(near), 20u); // the small ones lie beside the view
    EXPECT_EQ(drawn(whole), 40u);
    EXPECT_LE(near[0].level, 1);
    ASSERT_EQ(middle.size(), 1u);
    EXPECT_EQ(middle[0].count, 20u); // 0.01 at 100 are 0.14 pixels
    EXPECT_GT(middle[0].level, near[0].level);
    EXPECT_TRUE(far.empty());
}
