// SPDX-License-Identifier: MIT
#include "OptionChecks.h"

#include <osgPagedTexture/PagedKeys.h>
#include <osgPagedTexture/PagedOptions.h>
#include <osgPagedTexture/PagedScene.h>

#include <osgGA/EventVisitor>

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
    const PagedSettings changed = allChanged();
    PagedSettings back;
    EXPECT_TRUE(parsePagedOptions(back, formatPagedOptions(changed)).empty());
    paged::expectChanged(pagedOptions(), Changed, back);
    EXPECT_EQ(formatPagedOptions(PagedSettings()), "");
}

TEST(PagedOptionsTest, whatIsWrongInAFileIsNamedAndTheRestCounts)
{
    paged::expectWrongOnesAreNamedAndTheRestCounts<PagedScene>();
}

TEST(PagedOptionsTest, thePageOfSettingsHasThemAll)
{
    paged::expectDocumented(pagedOptions(), "## Paged textures");
}

TEST(PagedOptionsTest, eachKeyChangesItsSettingAndChangesItBack)
{
    const osg::ref_ptr<PagedScene> scene = new PagedScene;
    support::NotifyCapture notes;
    const auto press = [&](int key)
    {
        const osg::ref_ptr<osgGA::GUIEventAdapter> event = new osgGA::GUIEventAdapter;
        event->setEventType(osgGA::GUIEventAdapter::KEYDOWN);
        event->setKey(key);
        const osg::ref_ptr<osgGA::EventVisitor> visitor = new osgGA::EventVisitor;
        visitor->addEvent(event);
        scene->accept(*visitor);
        EXPECT_TRUE(event->getHandled()) << char(key);
    };
    for (const auto& [key, text] : {std::pair('H', "graph='on'"), std::pair('W', "show='levels'"),
                                    std::pair('F', "freeze='on'")})
    {
        press(key);
        EXPECT_EQ(scene->getSettingsText(), text);
        press(key);
        EXPECT_EQ(scene->getSettingsText(), "");
    }
    EXPECT_EQ(pagedKeys().size(), 3u);
}

} // namespace
