// SPDX-License-Identifier: MIT
#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>

using support::ChildProcess;

namespace
{

ChildProcess shell(const std::string& script)
{
    ChildProcess process;
    process.arguments = {"sh", "-c", script};
    return process;
}

} // namespace

TEST(ChildProcess, outputErrorsAndExitCodeAreKeptApart)
{
    const support::ProcessResult result = shell("echo out; echo err >&2; exit 3").run();
    EXPECT_EQ(result.output, "out\n");
    EXPECT_EQ(result.errors, "err\n");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_FALSE(result.timedOut);
}

TEST(ChildProcess, outputLargerThanAPipeDoesNotBlock)
{
    EXPECT_EQ(shell("yes | head -c 1000000; yes | head -c 300000 >&2").run().output.size(),
              1000000u);
}

TEST(ChildProcess, environmentAndFolderAreTheGivenOnes)
{
    support::TemporaryFolder folder;
    ChildProcess process = shell("echo $OSGKITS_A$OSGKITS_B; pwd");
    setenv("OSGKITS_B", "seen", 1);
    process.environment["OSGKITS_A"] = "a b";
    process.unset = {"OSGKITS_B"};
    process.folder = folder.getPath().string();
    EXPECT_EQ(process.run().output, "a b\n" + process.folder + "\n");
}

TEST(ChildProcess, deathBySignalAndMissingProgramHaveTheShellsCodes)
{
    EXPECT_EQ(shell("kill -SEGV $$").run().exitCode, 128 + SIGSEGV);
    ChildProcess missing;
    missing.arguments = {"osgkits-no-such-program"};
    EXPECT_EQ(missing.run().exitCode, 127);
}

TEST(ChildProcess, timeOutEndsTheProgramAndItsChildren)
{
    ChildProcess process = shell("echo begun; sleep 100 | sleep 100");
    process.timeoutSeconds = 0.3;
    const auto start = std::chrono::steady_clock::now();
    const support::ProcessResult result = process.run();
    EXPECT_TRUE(result.timedOut);
    EXPECT_EQ(result.output, "begun\n");
    EXPECT_EQ(result.exitCode, 128 + SIGKILL);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(TemporaryFolder, isFreshAndGoneAtTheEnd)
{
    std::filesystem::path path;
    {
        support::TemporaryFolder folder, other;
        path = folder.getPath();
        EXPECT_NE(path, other.getPath());
        EXPECT_TRUE(std::filesystem::exists(folder.write("a.txt", "text")));
    }
    EXPECT_FALSE(std::filesystem::exists(path));
}
