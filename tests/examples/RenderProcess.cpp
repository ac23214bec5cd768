// SPDX-License-Identifier: MIT
#include "RenderProcess.h"

#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <filesystem>
#include <fstream>
#include <sstream>

support::ProcessResult
RenderProcess::run(const std::vector<std::string>& words,
                   const std::map<std::string, std::string>& environment) const
{
    support::ChildProcess process;
    process.arguments = {OSGKITS_OSGRENDER, "--size", "160x120"};
    process.arguments.insert(process.arguments.end(), words.begin(), words.end());
    process.environment = environment;
    process.unset = {"DISPLAY", "OSG_NOTIFY_LEVEL", "OSG_LIBRARY_PATH", "OSG_MULTI_SAMPLES"};
    process.folder = _folder.getPath().string();
    return process.run();
}

void RenderProcess::expectRenders(const std::vector<std::string>& words) const
{
    const support::ProcessResult result = run(words);
    EXPECT_EQ(result.exitCode, 0) << testing::PrintToString(words);
    EXPECT_EQ(result.errors, "") << testing::PrintToString(words);
}

void RenderProcess::expectFails(const std::vector<std::string>& words, int exitCode,
                                const std::string& text) const
{
    const support::ProcessResult result = run(words);
    EXPECT_EQ(result.exitCode, exitCode) << testing::PrintToString(words) << result.errors;
    EXPECT_NE(result.errors.find(text), std::string::npos)
        << testing::PrintToString(words) << " printed: " << result.errors;
}

osg::ref_ptr<osg::Image> RenderProcess::picture(const std::string& name) const
{
    osgDB::FilePathList& folders = osgDB::Registry::instance()->getLibraryFilePathList();
    if (folders.empty() || folders.front() != OSGKITS_LIBRARIES)
        folders.push_front(OSGKITS_LIBRARIES);
    osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(_folder.file(name));
    EXPECT_TRUE(image.valid()) << name;
    if (!image)
    {
        image = new osg::Image;
        image->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_BYTE);
    }
    return image;
}

bool RenderProcess::exists(const std::string& name) const
{
    return std::filesystem::exists(_folder.file(name));
}

std::string RenderProcess::read(const std::string& name) const
{
    std::ostringstream text;
    text << std::ifstream(_folder.file(name)).rdbuf();
    return text.str();
}
