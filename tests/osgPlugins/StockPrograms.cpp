// SPDX-License-Identifier: MIT
#include "StockPrograms.h"

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>

#include <osgDB/ReadFile>

#include <filesystem>
#include <sstream>

void StockPrograms::SetUp()
{
    static support::HeadlessViewer viewer({16, 16});
    OSGKITS_NEED_GL(viewer);
}

support::ProcessResult StockPrograms::run(const std::vector<std::string>& arguments,
                                          Environment environment) const
{
    environment["OSG_RUN_FRAME_COUNT"] = "3";
    support::ChildProcess process;
    process.arguments = arguments;
    process.environment = std::move(environment);
    process.unset = {"DISPLAY"};
    return process.run();
}

StockPrograms::Picture StockPrograms::view(const std::string& model, Environment environment,
                                           const std::vector<std::string>& more) const
{
    static int number = 0;
    const std::string file = _folder.file("view" + std::to_string(number++) + ".png");
    environment["OSG_HEADLESS_CAPTURE"] = file;
    std::vector<std::string> arguments = {"osgviewer",
                                          "-e",
                                          "egl",
                                          "--window",
                                          "0",
                                          "0",
                                          std::to_string(_width),
                                          std::to_string(_height)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.push_back(model);
    const support::ProcessResult result = run(arguments, environment);
    EXPECT_EQ(result.exitCode, 0) << result.output << result.errors;
    Picture picture = osgDB::readRefImageFile(file);
    EXPECT_TRUE(picture.valid()) << result.output << result.errors;
    return picture;
}

std::string StockPrograms::convert(const std::string& model, const std::string& file) const
{
    const std::string path = _folder.file(file);
    const support::ProcessResult result = run({"osgconv", model, path});
    EXPECT_EQ(result.exitCode, 0) << result.output << result.errors;
    EXPECT_TRUE(std::filesystem::exists(path)) << result.output << result.errors;
    return path;
}

bool StockPrograms::differ(const osg::Image& a, const osg::Image& b)
{
    return support::difference(a, b, 4.0 / 255.0).getShareOver() > 0.005;
}

std::string StockPrograms::unwrapped(const std::string& text)
{
    std::istringstream words(text);
    std::string line;
    for (std::string word; words >> word;)
        line += (line.empty() ? "" : " ") + word;
    return line;
}
