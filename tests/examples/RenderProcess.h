// SPDX-License-Identifier: MIT
#pragma once

#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <osg/Image>

#include <gtest/gtest.h>

#include <string>
#include <vector>

/// Runs osgrender in a folder of its own, without a display.
class RenderProcess : public testing::Test
{
protected:
    /// osgrender with these words, at 160x120 unless they say another size.
    support::ProcessResult run(const std::vector<std::string>& words,
                               const std::map<std::string, std::string>& environment = {}) const;

    /// The same, expected to succeed and to print nothing on standard error.
    void expectRenders(const std::vector<std::string>& words) const;

    /// Expects the exit status and `text` in what was printed on standard error.
    void expectFails(const std::vector<std::string>& words, int exitCode,
                     const std::string& text) const;

    /// A picture in the folder; one pixel and a failure when it can't be read.
    osg::ref_ptr<osg::Image> picture(const std::string& name) const;

    bool exists(const std::string& name) const;
    std::string read(const std::string& name) const;

    support::TemporaryFolder _folder;
};
