// SPDX-License-Identifier: MIT
#include "EmbedProcess.h"

#include <support/HeadlessViewer.h>

#include <osgDB/ReadFile>

EmbedProcess::EmbedProcess(std::string program, int width, int height)
    : _program(std::move(program)), _width(width), _height(height)
{
}

void EmbedProcess::SetUp()
{
    static support::HeadlessViewer viewer({16, 16});
    OSGKITS_NEED_GL(viewer);
}

support::ProcessResult EmbedProcess::run(const std::vector<std::string>& words,
                                         const std::string& capture, int frames) const
{
    support::ChildProcess process;
    process.arguments = {_program,
                         "-e",
                         "egl",
                         "--SingleThreaded",
                         "--window",
                         "0",
                         "0",
                         std::to_string(_width),
                         std::to_string(_height)};
    process.arguments.insert(process.arguments.end(), words.begin(), words.end());
    process.environment = {{"OSG_RUN_FRAME_COUNT", std::to_string(frames)},
                           {"OSG_HEADLESS_CAPTURE", capture}};
    process.unset = {"DISPLAY"};
    return process.run();
}

osg::ref_ptr<osg::Image> EmbedProcess::view(const std::vector<std::string>& words, int frames) const
{
    const std::string file = _folder.file("view.png");
    const support::ProcessResult result = run(words, file, frames);
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_EQ(result.errors, "");
    return osgDB::readRefImageFile(file);
}

void EmbedProcess::expectNamesWrongSwitches(const std::string& setting,
                                            const std::string& message) const
{
    const support::ProcessResult wrong = run({"-s", setting});
    EXPECT_EQ(wrong.exitCode, 2);
    EXPECT_NE(wrong.errors.find(message), std::string::npos) << wrong.errors;
    const support::ProcessResult option = run({"--nonsense"});
    EXPECT_EQ(option.exitCode, 2);
    EXPECT_NE(option.errors.find("--nonsense"), std::string::npos) << option.errors;
    const support::ProcessResult model = run({"nowhere.iv"});
    EXPECT_EQ(model.exitCode, 1);
    EXPECT_NE(model.errors.find("nowhere.iv"), std::string::npos) << model.errors;
}

void EmbedProcess::expectHelpNamesSettings() const
{
    const support::ProcessResult result = run({"--help"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_NE(result.output.find("-s <name=value>"), std::string::npos) << result.output;
}
