// SPDX-License-Identifier: MIT
#include "MaskCheck.h"
#include "SoupScene.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace
{

truth::MaskCheck& check()
{
    static truth::MaskCheck check(96, 72);
    return check;
}

/// Leaves triangles out as long as something leaks.
SoupScene shrink(SoupScene soup)
{
    const auto leaks = [](const SoupScene& smaller)
    {
        return check()
                   .compare(*smaller.createNode(), smaller.camera, 0, "", truth::volumeWays(),
                            false)
                   .getLeaks() > 0;
    };
    for (std::size_t step = std::max<std::size_t>(soup.triangles.size() / 2, 1); step > 0;
         step /= 2)
    {
        for (std::size_t i = 0; i + step <= soup.triangles.size();)
        {
            SoupScene smaller = soup;
            smaller.triangles.erase(smaller.triangles.begin() + i,
                                    smaller.triangles.begin() + i + step);
            if (leaks(smaller))
                soup = smaller;
            else
                i += step;
        }
    }
    return soup;
}

/// From the environment, so that one seed can be looked at; else `fallback`.
unsigned int numberFrom(const char* variable, unsigned int fallback)
{
    const char* text = std::getenv(variable);
    return text ? static_cast<unsigned int>(std::strtoul(text, nullptr, 10)) : fallback;
}

} // namespace

/// OSGKITS_SEED and OSGKITS_COUNT choose other seeds.
TEST(ShadowSoupGLTest, randomScenesHaveNoLeak)
{
    OSGKITS_NEED_GL(check().getViewer());
    const unsigned int first = numberFrom("OSGKITS_SEED", 1);
    const unsigned int count = numberFrom("OSGKITS_COUNT", truth::isLongRun() ? 10000 : 200);
    std::map<std::string, truth::MaskDifference> sums;
    unsigned int failed = 0;
    std::printf("seeds %u to %u\n", first, first + count - 1);
    for (unsigned int seed = first; seed < first + count && failed < 20; ++seed)
    {
        const SoupScene soup(seed);
        const std::string name = "soup." + std::to_string(seed);
        const truth::MaskResult result =
            check().compare(*soup.createNode(), soup.camera, 0, name, truth::volumeWays(), false);
        for (const auto& [way, difference] : result.differences)
            sums[way].add(difference);
        if (!result.getLeaks())
            continue;
        ++failed;
        const SoupScene small = shrink(soup);
        SCOPED_TRACE(small.describe());
        check().compare(*small.createNode(), small.camera, 0, name);
    }
    for (const auto& [way, sum] : sums)
    {
        std::printf("%s: %s\n", way.c_str(), sum.describe().c_str());
        EXPECT_GT(sum.shadowed, sum.object / 20) << "nothing would be seen of a shadow";
    }
}
