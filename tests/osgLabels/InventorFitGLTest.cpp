// SPDX-License-Identifier: MIT
#include <osgLabels/DrawableFit.h>

#include <support/HeadlessViewer.h>
#include <support/InventorModels.h>

#include <osg/NodeVisitor>
#include <osgDB/ReadFile>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>

using namespace osgLabels;

namespace
{

const char* nameOf(const FittedShape& fit)
{
    static const char* const names[] = {"none",    "box",     "cylinder", "sphere", "dish",
                                        "frustum", "pyramid", "torus",    "quad",   "extrusion"};
    if (fit.projected)
        return fit.shape == Shape::Quad ? "flat" : "projected";
    return names[int(fit.shape)];
}

class Drawables : public osg::NodeVisitor
{
public:
    Drawables() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Drawable& drawable) override { found.push_back(&drawable); }

    std::vector<osg::Drawable*> found;
};

struct Row
{
    int count = 0;
    double residual = 0.0, coarseness = 0.0;
};

} // namespace

TEST(InventorFitGLTest, recognisedShapesAreThoseOfTheirMeshes)
{
    // Some models need a context to be read.
    const support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    std::map<std::string, Row> rows;
    double seconds = 0.0;
    int drawables = 0;
    for (const std::string& path : support::inventorModels())
    {
        const osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile(path);
        if (!model)
            continue;
        Drawables all;
        model->accept(all);
        std::map<std::string, int> shapes;
        for (const osg::Drawable* drawable : all.found)
        {
            const auto start = std::chrono::steady_clock::now();
            const FittedShape fit = fitDrawable(*drawable);
            seconds +=
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            ++drawables;
            Row& row = rows[nameOf(fit)];
            ++row.count;
            ++shapes[nameOf(fit)];
            row.residual = std::max(row.residual, fit.residual);
            row.coarseness = std::max(row.coarseness, fit.coarseness);
            EXPECT_TRUE(std::isfinite(fit.origin.x + fit.origin.y + fit.origin.z + fit.size.x +
                                      fit.size.y + fit.size.z))
                << path;
            // A shape that is recognised is one.
            EXPECT_LT(fit.residual, 0.005) << path << ": " << nameOf(fit);
        }
        std::cout << path.substr(path.find("models/") + 7) << ":";
        for (const auto& [name, count] : shapes)
            std::cout << ' ' << count << ' ' << name;
        std::cout << "\n";
    }
    for (const auto& [name, row] : rows)
        std::cout << std::setw(10) << name << std::setw(6) << row.count << "  residual at most "
                  << row.residual << ", coarseness at most " << row.coarseness << "\n";
    std::cout << drawables << " drawables in " << 1e3 * seconds << " ms\n";
    if (support::inventorModels().empty())
        GTEST_SKIP() << "NOT TESTED: inventor-data is not installed";
    EXPECT_GT(rows["cylinder"].count, 0);
    EXPECT_GT(rows["sphere"].count, 0);
    EXPECT_GT(rows["box"].count, 0);
}
