// SPDX-License-Identifier: MIT
#include <support/NotifyCapture.h>
#include <support/SettingsPage.h>

#include <osgPagedTexture/PagedOptions.h>
#include <osgPagedTexture/PagedScene.h>

#include <gtest/gtest.h>

#include <map>

namespace
{

using namespace osgPagedTexture;

/// A text for each option that is not its default.
const std::map<std::string, std::string> Changed = {
    {"gpu", "64.5"},         {"cpu", "12"},       {"upload", "0.5"},
    {"preview", "16"},       {"prefetch", "2.5"}, {"threads", "3"},
    {"compression", "none"}, {"quality", "best"}, {"cache", "/some folder/it's"},
    {"cachesize", "100"},    {"wait", "on"},      {"reload", "off"},
    {"degraded", "on"},      {"freeze", "on"},    {"show", "levels"},
    {"graph", "on"},         {"keys", "off"}};

PagedSettings allChanged()
{
    PagedSettings settings;
    std::string error;
    for (const auto& [name, text] : Changed)
        EXPECT_TRUE(setPagedOption(settings, name, text, error)) << error;
    return settings;
}

TEST(PagedOptionsTest, eachSettingSurvivesItsText)
{
    EXPECT_EQ(Changed.size(), pagedOptions().size());
    const PagedSettings changed = allChanged();
    PagedSettings back;
    EXPECT_TRUE(parsePagedOptions(back, formatPagedOptions(changed)).empty());
    for (const PagedOption& option : pagedOptions())
    {
        EXPECT_EQ(option.format(back), Changed.at(option.name)) << option.name;
        EXPECT_NE(option.format(PagedSettings()), Changed.at(option.name)) << option.name;
    }
    EXPECT_EQ(formatPagedOptions(PagedSettings()), "");
}

TEST(PagedOptionsTest, whatIsWrongInAFileIsNamedAndTheRestCounts)
{
    support::NotifyCapture notes;
    const osg::ref_ptr<PagedScene> scene = new PagedScene;
    scene->setSettingsText("gpu=-1,cpu=7,sise=3");
    const support::NotifyCapture::Lines warnings = notes.takeWarnings();
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[0].find("'gpu=-1'"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[1].find("'sise=3' is not known"), std::string::npos) << warnings[1];
    EXPECT_EQ(scene->getSettings().cpuMegabytes, 7.0);
}

TEST(PagedOptionsTest, thePageOfSettingsHasThemAll)
{
    std::vector<support::DocumentedSetting> settings;
    for (const PagedOption& option : pagedOptions())
        settings.push_back({option.name, option.values, option.format(PagedSettings())});
    EXPECT_EQ(support::undocumented(OSGKITS_SETTINGS_PAGE, "## Paged textures", settings),
              std::vector<std::string>());
}

} // namespace
