// SPDX-License-Identifier: MIT
#pragma once

#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <osg/Image>

#include <gtest/gtest.h>

#include <string>
#include <vector>

/// Runs one of the viewers that embed a kit, without a display.
class EmbedProcess : public testing::Test
{
protected:
    /// The program, and the size of its pictures.
    EmbedProcess(std::string program, int width, int height);

    void SetUp() override;

    /// Draws so many frames, of which the last is saved as `capture`.
    support::ProcessResult run(const std::vector<std::string>& words,
                               const std::string& capture = {}, int frames = 2) const;

    /// The last frame of a run that is expected to succeed and to print nothing on standard error.
    osg::ref_ptr<osg::Image> view(const std::vector<std::string>& words, int frames = 2) const;

    /// Of the setting that nobody has, of another switch and of a model that is not there;
    /// `message` is what is said of the setting.
    void expectNamesWrongSwitches(const std::string& setting, const std::string& message) const;

    void expectHelpNamesSettings() const;

private:
    std::string _program;
    int _width, _height;
    support::TemporaryFolder _folder;
};
