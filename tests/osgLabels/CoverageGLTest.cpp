// SPDX-License-Identifier: MIT
#include "CoveragePage.h"

#include <support/HeadlessViewer.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

using osgLabels::FontFace;
using osgLabels::GlyphAtlas;
using osgLabels::GlyphSet;

namespace
{

struct Letters
{
    Letters()
    {
        std::string error;
        glyphs = std::make_shared<GlyphSet>(FontFace::openOrDefault("", error));
        page = std::make_unique<CoveragePage>(glyphs);
        atlas = new GlyphAtlas(glyphs);
        atlas->update();
    }
    std::shared_ptr<GlyphSet> glyphs;
    std::unique_ptr<CoveragePage> page;
    osg::ref_ptr<GlyphAtlas> atlas;
};

} // namespace

TEST(CoverageGLTest, table)
{
    support::HeadlessViewer viewer({256, 256});
    OSGKITS_NEED_GL(viewer);
    const auto t0 = std::chrono::steady_clock::now();
    Letters setup;
    std::printf(
        "setup %.0f ms, %u glyphs, %zu bytes\n",
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - t0).count(),
        setup.atlas->getNumGlyphs(), setup.atlas->getBytes());
    const struct
    {
        const char* name;
        double degrees, squash;
    } views[] = {{"head-on", 0, 1},      {"rotated", 27, 1},   {"squashed", 0, 4},
                 {"squashed 27", 27, 4}, {"grazing", 0, 5.76}, {"grazing 27", 27, 5.76}};
    for (const auto& v : views)
    {
        std::printf("%-12s", v.name);
        for (double em : {2., 4., 6.7, 8., 12., 16., 24., 32., 64., 128., 200.})
        {
            const CoverageView view{v.name, v.degrees, v.squash, em};
            const int size = em > 40 ? 256 : 128;
            const auto truth = setup.page->makeTruth(view, size);
            const auto picture =
                viewer.renderFloat(setup.page->makeNode(view, *setup.atlas), {}, size, size);
            std::printf(" %6.2f", getRmsPercent(*picture, *truth));
            std::fflush(stdout);
        }
        std::puts("");
    }
}
