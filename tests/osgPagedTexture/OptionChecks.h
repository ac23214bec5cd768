// SPDX-License-Identifier: MIT
// What holds for the settings of each scene of the kit.
#pragma once

#include <osgMultiRender/Option.h>
#include <support/NotifyCapture.h>
#include <support/SettingsPage.h>

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace paged
{

/// `changed` has a value for each option, which is not its default; `back` is what came of them as
/// text.
template <class Settings>
void expectChanged(const std::vector<osgMultiRender::Option<Settings>>& options,
                   const std::map<std::string, std::string>& changed, const Settings& back)
{
    EXPECT_EQ(options.size(), changed.size());
    for (const osgMultiRender::Option<Settings>& option : options)
    {
        EXPECT_EQ(option.format(back), changed.at(option.name)) << option.name;
        EXPECT_NE(option.format(Settings()), changed.at(option.name)) << option.name;
    }
}

/// Of three settings in a text, a wrong one, a right one and one that there is not.
template <class Scene> void expectWrongOnesAreNamedAndTheRestCounts()
{
    support::NotifyCapture notes;
    const osg::ref_ptr<Scene> scene = new Scene;
    scene->setSettingsText("gpu=-1,cpu=7,sise=3");
    const support::NotifyCapture::Lines warnings = notes.takeWarnings();
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[0].find("'gpu=-1'"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[1].find("'sise=3' is not known"), std::string::npos) << warnings[1];
    EXPECT_EQ(scene->getSettings().cpuMegabytes, 7.0);
}

/// A section of the page of settings has them all.
template <class Settings>
void expectDocumented(const std::vector<osgMultiRender::Option<Settings>>& options,
                      const std::string& section)
{
    std::vector<support::DocumentedSetting> settings;
    for (const osgMultiRender::Option<Settings>& option : options)
        settings.push_back({option.name, option.values, option.format(Settings())});
    EXPECT_EQ(support::undocumented(OSGKITS_SETTINGS_PAGE, section, settings),
              std::vector<std::string>());
}

} // namespace paged
