// SPDX-License-Identifier: MIT
#pragma once

#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <osg/Image>

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

/// The stock programs of OSG as child processes, with nothing of ours but the plugins.
class StockPrograms : public testing::Test
{
protected:
    using Picture = osg::ref_ptr<osg::Image>;
    using Environment = std::map<std::string, std::string>;

    void SetUp() override;

    /// Three frames, without a display.
    support::ProcessResult run(const std::vector<std::string>& arguments,
                               Environment environment = {}) const;

    /// The last frame of osgviewer; null and a failure where it drew none.
    Picture view(const std::string& model, Environment environment = {},
                 const std::vector<std::string>& more = {"--SingleThreaded"}) const;

    /// Saves what `model` loads as `file`, which is returned.
    std::string convert(const std::string& model, const std::string& file) const;

    static bool differ(const osg::Image& a, const osg::Image& b);

    /// Lines that a program has wrapped and indented as one, words with a space between them.
    static std::string unwrapped(const std::string& text);

    int _width = 128, _height = 96; ///< Of pictures.
    support::TemporaryFolder _folder;
};
