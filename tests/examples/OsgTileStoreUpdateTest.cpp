// SPDX-License-Identifier: MIT
#include "PhotographStore.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

namespace
{

namespace fs = std::filesystem;
using nlohmann::json;

TEST(OsgTileStoreUpdate, aChangedPhotographIsUpdatedToTheBytesOfAFullBuild)
{
    const PhotographStore sample;
    ASSERT_EQ(sample.build(sample.store()).exitCode, 0);
    auto result = run({"update", sample.store(), "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_EQ(json::parse(result.output)["touchedTiles"], 0);
    sample.write("north/1", 5);
    result = run({"update", sample.store(), "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json done = json::parse(result.output);
    EXPECT_EQ(done["changed"], 1);
    EXPECT_EQ(done["rebuilt"], "");
    EXPECT_GT(done["changedTiles"], 4);
    EXPECT_EQ(run({"verify", sample.store()}).exitCode, 0);
    EXPECT_EQ(run({"compact", sample.store()}).exitCode, 0);
    const std::string updated = bytesOf(sample.store());
    ASSERT_EQ(run({"build", sample.store() + ".layout.json", "--tile-side", "40", "--border", "4",
                   "--store", sample.store()})
                  .exitCode,
              0);
    EXPECT_EQ(bytesOf(sample.store()), updated);
}

TEST(OsgTileStoreUpdate, partsOfTheLargePictureAreWrittenWhereTheyHaveChanged)
{
    const PhotographStore sample;
    const std::string folder = fs::path(sample.store()).parent_path().string();
    const std::string picture = folder + "/atlas.ppm";
    ASSERT_EQ(sample.build(sample.store(), {"--atlas", picture, "--atlas-side", "150"}).exitCode,
              0);
    const auto parts = [&]
    {
        std::map<std::string, std::string> bytes;
        for (const auto& each : fs::directory_iterator(folder))
        {
            if (each.path().extension() == ".ppm")
            {
                bytes[each.path().string()] = bytesOf(each.path().string());
            }
        }
        return bytes;
    };
    const auto before = parts();
    ASSERT_GT(before.size(), 4u);
    sample.write("5", 99);
    const auto result = run({"update", sample.store(), "--atlas", picture, "--atlas-side", "150"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const auto updated = parts();
    std::size_t changed = 0;
    for (const auto& [file, bytes] : before)
    {
        changed += updated.at(file) != bytes;
    }
    EXPECT_GE(changed, 1u);
    EXPECT_LE(changed, 4u);
    ASSERT_EQ(run({"build", sample.store() + ".layout.json", "--store", folder + "/again.tiles",
                   "--atlas", picture, "--atlas-side", "150"})
                  .exitCode,
              0);
    EXPECT_EQ(parts(), updated);
}

TEST(OsgTileStoreUpdate, whatCannotBeReadIsNamedWithStatusOne)
{
    const PhotographStore sample;
    ASSERT_EQ(sample.build(sample.store()).exitCode, 0);
    std::ofstream(sample.photo("3")) << "nothing";
    const auto result = run({"update", sample.store()});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.errors.find("3.ppm"), std::string::npos) << result.errors;
    EXPECT_EQ(run({"update", sample.photo("3")}).exitCode, 1) << "no store";
    EXPECT_EQ(run({"update"}).exitCode, 2);
}

TEST(OsgTileStoreUpdate, partsOfSeveralProcessesMergeToTheStoreOfOne)
{
    const PhotographStore sample;
    ASSERT_EQ(sample.build(sample.store()).exitCode, 0);
    const std::string whole = bytesOf(sample.store());
    fs::remove(sample.store());
    fs::remove(sample.store() + ".layout.json");
    std::vector<std::thread> processes;
    std::vector<int> codes(3, -1);
    for (int i = 0; i < 3; ++i)
    {
        processes.emplace_back(
            [&, i]
            {
                codes[std::size_t(i)] =
                    sample.build(sample.store(), {"--shard", std::to_string(i + 1) + "/3"})
                        .exitCode;
            });
    }
    for (std::thread& each : processes)
    {
        each.join();
    }
    EXPECT_EQ(codes, std::vector<int>(3, 0));
    const auto merged = run({"merge", sample.store(), "--json"});
    ASSERT_EQ(merged.exitCode, 0) << merged.errors;
    EXPECT_EQ(json::parse(merged.output)["shards"], 3);
    EXPECT_EQ(bytesOf(sample.store()), whole);
    EXPECT_EQ(run({"merge", sample.store()}).exitCode, 1) << "no parts are left";
    for (const char* wrong : {"4/3", "0/3", "3", "1/x"})
    {
        EXPECT_EQ(sample.build(sample.store(), {"--shard", wrong}).exitCode, 2) << wrong;
    }
}

/// A running `update --watch`.
class Watch
{
public:
    explicit Watch(const std::string& store) : _process(fork())
    {
        if (_process == 0)
        {
            execl(OSGKITS_OSGTILESTORE, "osgtilestore", "update", "--watch", store.c_str(),
                  nullptr);
            _exit(127);
        }
        std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    /// Asks it to end and returns its exit code.
    int end() const
    {
        kill(_process, SIGTERM);
        int status = 0;
        waitpid(_process, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    /// Two looks, a second apart, and the update; the rest is for a busy machine.
    template <class Done> static bool waitUntil(const Done& done)
    {
        for (int wait = 0; wait < 300 && !done(); ++wait)
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        return done();
    }

private:
    const pid_t _process;
};

TEST(OsgTileStoreUpdate, aWatchUpdatesWhatIsSavedAndEndsWhenAsked)
{
    const PhotographStore sample;
    ASSERT_EQ(sample.build(sample.store()).exitCode, 0);
    const Watch watch(sample.store());
    const auto size = [&] { return fs::file_size(sample.store()); };
    for (int round = 0; round < 2; ++round)
    {
        const auto before = size();
        sample.write("5", 40 + round);
        EXPECT_TRUE(Watch::waitUntil([&] { return size() != before; })) << round;
    }
    EXPECT_EQ(watch.end(), 0);
    EXPECT_EQ(run({"verify", sample.store()}).exitCode, 0);
    EXPECT_EQ(run({"update", sample.store()}).exitCode, 0);
}

TEST(OsgTileStoreUpdate, aWatchCompactsWhereMoreThanThirtyPercentAreDead)
{
    const PhotographStore sample;
    ASSERT_EQ(sample.build(sample.store()).exitCode, 0);
    const auto deadShare = [&]
    {
        const auto info = run({"info", sample.store(), "--json"});
        return json::parse(info.output)["deadShare"].get<double>();
    };
    for (int round = 0; round < 20 && deadShare() <= 0.3; ++round)
    {
        sample.write("1", 50 + round);
        sample.write("2", 50 + round);
        ASSERT_EQ(run({"update", sample.store()}).exitCode, 0);
    }
    ASSERT_GT(deadShare(), 0.3) << "only a watch compacts";
    const Watch watch(sample.store());
    sample.write("5", 99);
    EXPECT_TRUE(Watch::waitUntil([&] { return deadShare() == 0.0; })) << deadShare();
    EXPECT_EQ(watch.end(), 0);
    EXPECT_EQ(run({"verify", sample.store()}).exitCode, 0);
}

} // namespace
