// SPDX-License-Identifier: MIT
// What is known of a generated refinery: the shapes of its meshes, the size of its tags.
#include <osgLabels/DrawableFit.h>
#include <osgLabels/LabelTable.h>

#include <refinery/Drawables.h>
#include <refinery/Refinery.h>

#include <osg/Geode>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>
#include <map>

using namespace osgLabels;

namespace
{

const char* nameOf(Shape shape)
{
    static const char* const names[] = {"none",    "box",     "cylinder", "sphere", "dish",
                                        "frustum", "pyramid", "torus",    "quad",   "extrusion"};
    return names[int(shape)];
}

/// Sizes that mean the same solid in the same order.
std::array<double, 3> ordered(Shape shape, std::array<double, 3> size)
{
    if (shape == Shape::Box)
        std::sort(size.begin(), size.end());
    if (shape == Shape::Frustum || shape == Shape::Pyramid || shape == Shape::Quad)
        std::sort(size.begin(), size.begin() + 2);
    if (shape == Shape::Quad)
        size[2] = 0.0;
    return size;
}

/// A frustum of one radius is a cylinder.
Shape meantBy(const Primitive& primitive)
{
    return primitive.shape == Shape::Frustum && primitive.size.x() == primitive.size.y()
               ? Shape::Cylinder
               : primitive.shape;
}

struct Row
{
    int right = 0, wrong = 0, projected = 0;
    double residual = 0.0; ///< Largest.
    double size = 0.0;     ///< Largest difference of a size, as a share of the largest one.
    double place = 0.0;    ///< The same of the middle.
};

void judge(const Primitive& primitive, const FittedShape& fit, Row& row)
{
    if (fit.projected)
    {
        ++row.projected;
        return;
    }
    const Shape shape = meantBy(primitive);
    if (fit.shape != shape)
    {
        ++row.wrong;
        return;
    }
    ++row.right;
    row.residual = std::max(row.residual, fit.residual);
    const auto is = ordered(shape, {fit.size.x, fit.size.y, fit.size.z});
    const auto was = ordered(shape, {primitive.size.x(), primitive.size.y(), primitive.size.z()});
    const double whole = std::max({was[0], was[1], was[2]});
    for (int i = 0; i < 3; ++i)
        row.size = std::max(row.size, std::abs(is[std::size_t(i)] - was[std::size_t(i)]) / whole);
    const osg::Vec3d origin(fit.origin.x, fit.origin.y, fit.origin.z);
    row.place = std::max(row.place, (origin - primitive.position).length() / whole);
}

} // namespace

TEST(Refinery, shapesOfAllObjectsAreThoseTheyWereMadeAs)
{
    std::map<Shape, Row> rows;
    makeRefinery({20000, 1},
                 [&](const Primitive& primitive)
                 {
                     // At its place a mesh has the rounding of floats; in a model it would have a
                     // matrix of its own.
                     Primitive here = primitive;
                     here.position = {};
                     Drawables drawables(DrawableLabels::None);
                     drawables.add(here);
                     const osg::Drawable* drawable =
                         drawables.get()->getChild(0)->asGeode()->getDrawable(0);
                     judge(here, fitDrawable(*drawable), rows[meantBy(here)]);
                 });
    std::cout << "shape,right,wrong,projected,residual,size,place\n" << std::setprecision(2);
    for (const auto& [shape, row] : rows)
    {
        std::cout << nameOf(shape) << ',' << row.right << ',' << row.wrong << ',' << row.projected
                  << ',' << row.residual << ',' << row.size << ',' << row.place << '\n';
        EXPECT_GT(row.right, 0) << nameOf(shape);
        EXPECT_EQ(row.wrong, 0) << nameOf(shape);
        EXPECT_EQ(row.projected, 0) << nameOf(shape);
        // A label lies on its shape: where sizes and middle are right it lies on the object.
        EXPECT_LT(row.residual, 0.005) << nameOf(shape);
        EXPECT_LT(row.size, 0.01) << nameOf(shape);
        EXPECT_LT(row.place, 0.01) << nameOf(shape);
    }
    EXPECT_GE(rows.size(), 6u);
}

TEST(Refinery, tagsOf300000ObjectsTakeLessThan20MiB)
{
    std::map<char, std::uint32_t> glyphs;
    LabelTable table;
    std::uint32_t objects = 0;
    const auto add = [&](const Primitive& primitive)
    {
        LabelTable::Codes codes;
        for (const char c : primitive.name)
            codes.push_back(glyphs.try_emplace(c, std::uint32_t(glyphs.size())).first->second);
        table.setCodes(++objects, codes);
    };
    makeRefinery({300000, 1}, add);
    const LabelTable::Sizes sizes = table.getSizes();
    std::cout << sizes.texts << " tags of " << glyphs.size()
              << " letters: " << double(sizes.textBytes + sizes.rowBytes) / (1 << 20)
              << " MiB on the GPU, " << double(sizes.mainBytes) / (1 << 20)
              << " MiB of main memory\n";
    EXPECT_GT(sizes.texts, 290000u);
    EXPECT_LE(sizes.bits, 6u);
    EXPECT_LE(sizes.textBytes + sizes.rowBytes, std::size_t(20) << 20);
}
