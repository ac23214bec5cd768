// SPDX-License-Identifier: MIT
#include "OptionChecks.h"

#include <osgPagedTexture/VirtualOptions.h>
#include <osgPagedTexture/VirtualScene.h>

#include <gtest/gtest.h>

#include <map>

namespace osgPagedTexture
{

namespace
{

const std::map<std::string, std::string> Changed = {
    {"store", "a b,c'd.tiles"}, {"gpu", "64"},           {"cpu", "32"},       {"upload", "0.5"},
    {"threads", "3"},           {"compression", "none"}, {"quality", "fine"}, {"aniso", "8"},
    {"feedback", "4"},          {"fade", "0"},           {"wait", "on"},      {"watch", "off"},
    {"freeze", "on"},           {"show", "pages"},       {"graph", "on"},     {"keys", "off"}};

} // namespace

TEST(VirtualOptionsTest, eachSettingSurvivesAsText)
{
    VirtualSettings settings, back;
    std::string error;
    for (const auto& [name, value] : Changed)
        EXPECT_TRUE(setVirtualOption(settings, name, value, error)) << error;
    EXPECT_EQ(parseVirtualOptions(back, formatVirtualOptions(settings)),
              std::vector<std::string>());
    paged::expectChanged(virtualOptions(), Changed, back);
    EXPECT_EQ(formatVirtualOptions(VirtualSettings()), "");
}

TEST(VirtualOptionsTest, whatIsWrongInAFileIsNamedAndTheRestCounts)
{
    paged::expectWrongOnesAreNamedAndTheRestCounts<VirtualScene>();
}

TEST(VirtualOptionsTest, thePageOfSettingsHasThemAll)
{
    paged::expectDocumented(virtualOptions(), "## Virtual textures");
}

} // namespace osgPagedTexture
