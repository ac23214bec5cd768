// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualOptions.h>
#include <osgPagedTexture/VirtualScene.h>
#include <support/NotifyCapture.h>
#include <support/SettingsPage.h>

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
    ASSERT_EQ(virtualOptions().size(), Changed.size());
    for (const VirtualOption& option : virtualOptions())
    {
        EXPECT_EQ(option.format(back), Changed.at(option.name)) << option.name;
        EXPECT_NE(option.format(VirtualSettings()), Changed.at(option.name)) << option.name;
    }
    EXPECT_EQ(formatVirtualOptions(VirtualSettings()), "");
}

TEST(VirtualOptionsTest, whatIsWrongInAFileIsNamedAndTheRestCounts)
{
    support::NotifyCapture notes;
    const osg::ref_ptr<VirtualScene> scene = new VirtualScene;
    scene->setSettingsText("gpu=-1,cpu=7,sise=3");
    const support::NotifyCapture::Lines warnings = notes.takeWarnings();
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[0].find("'gpu=-1'"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[1].find("'sise=3' is not known"), std::string::npos) << warnings[1];
    EXPECT_EQ(scene->getSettings().cpuMegabytes, 7.0);
}

TEST(VirtualOptionsTest, thePageOfSettingsHasThemAll)
{
    std::vector<support::DocumentedSetting> settings;
    for (const VirtualOption& option : virtualOptions())
        settings.push_back({option.name, option.values, option.format(VirtualSettings())});
    EXPECT_EQ(support::undocumented(OSGKITS_SETTINGS_PAGE, "## Virtual textures", settings),
              std::vector<std::string>());
}

} // namespace osgPagedTexture
