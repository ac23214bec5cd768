// SPDX-License-Identifier: MIT
// Full disks and folders that cannot be written, as the program meets them.
#include "../osgPagedTexture/CapturedWall.h"
#include "PhotographStore.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>

#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace
{

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Permissions bind root too from here on, in this process and in those it starts.
void bindToPermissions()
{
    __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
    __user_cap_data_struct data[2] = {};
    ASSERT_EQ(syscall(SYS_capget, &header, data), 0);
    const std::uint32_t passes = 1u << CAP_DAC_OVERRIDE | 1u << CAP_DAC_READ_SEARCH;
    data[0].effective &= ~passes;
    data[0].permitted &= ~passes;
    ASSERT_EQ(syscall(SYS_capset, &header, data), 0);
    // Else a program that root starts would have them again.
    ASSERT_EQ(prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), 0);
}

/// Runs osgtilestore where no file may grow beyond this: to a process as a full disk, but for the
/// number of the error, and for a kernel of any sandbox and user to do.
support::ProcessResult runOnFullDisk(int blocks, const Words& words)
{
    support::ChildProcess process;
    process.arguments = {"sh", "-c", "ulimit -f \"$0\" && exec \"$@\"", std::to_string(blocks),
                         OSGKITS_OSGTILESTORE};
    process.arguments.insert(process.arguments.end(), words.begin(), words.end());
    return process.run();
}

void expectOneLine(const support::ProcessResult& result, const std::string& file,
                   const std::string& cause)
{
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_NE(result.errors.find(file), std::string::npos) << result.errors;
    EXPECT_NE(result.errors.find(cause), std::string::npos) << result.errors;
    EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
}

/// What is in a folder and not below it, but for locks.
std::map<std::string, std::string> filesIn(const std::string& folder)
{
    std::map<std::string, std::string> files;
    for (const auto& each : fs::directory_iterator(folder))
        if (each.is_regular_file() && each.path().extension() != ".lock")
            files[each.path().string()] = bytesOf(each.path().string());
    return files;
}

/// Runs it with more and more room until it gets through; `look` is told of each that did not.
/// Returns how many these were.
int runUntilThereIsRoom(const Words& words, const std::string& file,
                        const std::function<void()>& look)
{
    for (int failed = 0, blocks = 0; blocks < 1 << 20; ++failed, blocks += 1 + 3 * blocks)
    {
        const auto result = runOnFullDisk(blocks, words);
        if (result.exitCode == 0)
            return failed;
        SCOPED_TRACE(words[0] + " with " + std::to_string(blocks) + " blocks");
        expectOneLine(result, file, "File too large; allow larger files");
        look();
    }
    ADD_FAILURE() << words[0] << " never gets through";
    return 0;
}

/// A store that was built before a photograph changed.
class OsgTileStoreFaultTest : public testing::Test
{
protected:
    void SetUp() override
    {
        ASSERT_EQ(_sample.build(_sample.store()).exitCode, 0);
        _before = bytesOf(_sample.store());
        _sample.write("5", 99);
    }

    Words buildWords() const
    {
        return {"build", _sample.photos(), "--store", _sample.store(), "--tile-side",
                "40",    "--border",       "4"};
    }

    /// The old store is whole, nothing lies about, and the next program does the rest.
    void expectOldStore() const
    {
        EXPECT_EQ(run({"verify", _sample.store()}).exitCode, 0);
        for (const auto& [file, bytes] : filesIn(_sample.file("")))
            EXPECT_EQ(file.find(".part"), std::string::npos) << file;
    }
    void expectNewStoreAfter(const Words& words) const
    {
        const auto result = run(words);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        EXPECT_EQ(run({"verify", _sample.store()}).exitCode, 0);
        EXPECT_EQ(run({"compact", _sample.store()}).exitCode, 0);
        ASSERT_EQ(_sample.build(_sample.file("again.tiles")).exitCode, 0);
        EXPECT_EQ(run({"extract", _sample.store(), _sample.file("a.ppm")}).exitCode, 0);
        EXPECT_EQ(run({"extract", _sample.file("again.tiles"), _sample.file("b.ppm")}).exitCode, 0);
        EXPECT_EQ(bytesOf(_sample.file("a.ppm")), bytesOf(_sample.file("b.ppm")));
        EXPECT_NE(bytesOf(_sample.store()), _before);
    }

    const PhotographStore _sample;
    std::string _before;
};

} // namespace

TEST_F(OsgTileStoreFaultTest, aBuildOnAFullDiskNamesTheFileAndLeavesTheOldStore)
{
    const int failed = runUntilThereIsRoom(buildWords(), _sample.store(),
                                           [&]
                                           {
                                               expectOldStore();
                                               EXPECT_EQ(bytesOf(_sample.store()), _before);
                                           });
    EXPECT_GT(failed, 4) << "the layout, the kept pixels and the tiles";
    expectNewStoreAfter(buildWords());
}

TEST_F(OsgTileStoreFaultTest, anUpdateAfterABuildOnAFullDiskDoesTheRest)
{
    for (int blocks : {0, 8, 64, 256})
    {
        expectOneLine(runOnFullDisk(blocks, buildWords()), _sample.store(), "File too large");
        expectOldStore();
    }
    expectNewStoreAfter({"update", _sample.store()});
}

TEST_F(OsgTileStoreFaultTest, anUpdateOnAFullDiskNamesTheFileAndLeavesTheOldStore)
{
    const int failed = runUntilThereIsRoom({"update", _sample.store()}, _sample.store(),
                                           [&]
                                           {
                                               expectOldStore();
                                               EXPECT_EQ(bytesOf(_sample.store()), _before);
                                           });
    EXPECT_GT(failed, 4);
    expectNewStoreAfter({"update", _sample.store()});
}

TEST_F(OsgTileStoreFaultTest, compactOnAFullDiskLeavesTheStore)
{
    ASSERT_EQ(run({"update", _sample.store()}).exitCode, 0);
    const std::string updated = bytesOf(_sample.store());
    const int failed = runUntilThereIsRoom({"compact", _sample.store()}, _sample.store(),
                                           [&]
                                           {
                                               expectOldStore();
                                               EXPECT_EQ(bytesOf(_sample.store()), updated);
                                           });
    EXPECT_GT(failed, 4);
    EXPECT_EQ(run({"verify", _sample.store()}).exitCode, 0);
}

TEST_F(OsgTileStoreFaultTest, partsOfABuildOnAFullDiskAreBuiltAgainAndMerged)
{
    ASSERT_EQ(run(buildWords()).exitCode, 0);
    const std::string whole = bytesOf(_sample.store());
    for (const char* file : {"", ".layout.json", ".mips"})
        fs::remove(_sample.store() + file);
    const auto nothing = [] {};
    for (const char* shard : {"1/2", "2/2"})
    {
        Words words = buildWords();
        words.insert(words.end(), {"--shard", shard});
        EXPECT_GT(runUntilThereIsRoom(words, _sample.store(), nothing), 2);
    }
    EXPECT_GT(runUntilThereIsRoom({"merge", _sample.store()}, _sample.store(), nothing), 2);
    EXPECT_EQ(run({"verify", _sample.store()}).exitCode, 0);
    EXPECT_TRUE(bytesOf(_sample.store()) == whole);
}

// OpenImageIO's own file took no notice with PNG, and with JPEG it ended the process.
TEST_F(OsgTileStoreFaultTest, picturesOnAFullDiskAreNamedAndNotLeftInHalf)
{
    for (const char* name : {"x.png", "x.jpg", "x.tif"})
    {
        const std::string picture = _sample.file(name);
        const auto nothingThere = [&] { EXPECT_FALSE(fs::exists(picture)); };
        EXPECT_GT(runUntilThereIsRoom({"extract", _sample.store(), picture}, picture, nothingThere),
                  4);
        EXPECT_GT(fs::file_size(picture), 10000u);
    }
    for (const char* ending : {".png", ".jpg"})
    {
        const std::string picture = _sample.file("atlas") + ending;
        const auto result = runOnFullDisk(4, {"build", _sample.store() + ".layout.json", "--store",
                                              _sample.file("folder"), "--output", "libvt",
                                              "--atlas", picture, "--atlas-side", "150"});
        expectOneLine(result, _sample.file("atlas") + "_0_0.part" + ending, "File too large");
        EXPECT_FALSE(fs::exists(_sample.file("folder")));
    }
}

TEST_F(OsgTileStoreFaultTest, aModelOnAFullDiskIsNamedAndTheOldOneStays)
{
    const std::string model = CapturedWall(20, 16, 100, 80)
                                  .write(fs::path(_sample.photos()).parent_path().string(), ".jpg");
    const std::string layout = _sample.file("wall.layout.json"), store = _sample.file("wall.tiles");
    ASSERT_EQ(run({"layout", model, layout}).exitCode, 0);
    ASSERT_EQ(run({"build", layout, "--store", store}).exitCode, 0);
    fs::create_directories(_sample.file("models"));
    for (const char* ending : {".obj", ".osgb"})
    {
        const std::string output = _sample.file("models/wall") + ending;
        const Words words = {"atlas", model, layout, store, output, "--plain", "--overview", "16"};
        ASSERT_EQ(run(words).exitCode, 0);
        const auto before = filesIn(_sample.file("models"));
        const auto unchanged = [&] { EXPECT_TRUE(filesIn(_sample.file("models")) == before); };
        EXPECT_GT(runUntilThereIsRoom(words, _sample.file("models/wall"), unchanged), 2) << ending;
        unchanged(); // the same once more
        EXPECT_FALSE(fs::exists(output + ".part")) << ending;
    }
}

TEST_F(OsgTileStoreFaultTest, standardOutputOnAFullDiskIsAnError)
{
    for (const Words& words : {Words{"info", _sample.store(), "--json"}, Words{"--help"},
                               Words{"verify", _sample.store()}})
    {
        support::ChildProcess process;
        process.arguments = {"sh", "-c", "exec \"$0\" \"$@\" > /dev/full", OSGKITS_OSGTILESTORE};
        process.arguments.insert(process.arguments.end(), words.begin(), words.end());
        expectOneLine(process.run(), "standard output", "No space left on device");
    }
}

TEST_F(OsgTileStoreFaultTest, aFolderThatCannotBeWrittenIsNamedAndTheStoreIsStillRead)
{
    const std::string folder = fs::path(_sample.photos()).parent_path().string();
    const std::string model = CapturedWall(4, 4, 60, 50).write(folder, ".jpg");
    const std::string layout = _sample.store() + ".layout.json";
    const auto before = filesIn(folder);
    fs::permissions(folder, fs::perms(0555));
    ASSERT_FALSE(std::ofstream(_sample.file("probe"))) << "permissions do not bind";
    Words otherFolder = buildWords();
    otherFolder[3] = _sample.file("vt");
    otherFolder.insert(otherFolder.end(), {"--output", "libvt"});
    Words deepZoom = buildWords();
    deepZoom[3] = _sample.file("web.dzi");
    Words part = buildWords();
    part.insert(part.end(), {"--shard", "1/2"});
    Words picture = buildWords();
    picture.insert(picture.end(), {"--atlas", _sample.file("atlas.png")});
    const Words cases[] = {
        buildWords(),
        otherFolder,
        deepZoom,
        part,
        picture,
        {"update", _sample.store()},
        {"compact", _sample.store()},
        {"merge", _sample.store()},
        {"extract", _sample.store(), _sample.file("x.png")},
        {"layout", model, _sample.file("new.layout.json")},
        {"atlas", model, layout, _sample.store(), _sample.file("new.obj")},
        {"atlas", model, layout, _sample.store(), _sample.file("new.osgb")},
        {"reference", model, "camera1"},
    };
    for (const Words& words : cases)
    {
        SCOPED_TRACE(words[0]);
        const bool hasNoParts = words[0] == "merge";
        const auto result = run(words);
        expectOneLine(result, folder, hasNoParts ? "no part of" : "Permission denied");
        EXPECT_TRUE(filesIn(folder) == before);
    }
    EXPECT_EQ(run({"verify", _sample.store()}).exitCode, 0);
    EXPECT_EQ(run({"info", _sample.store()}).exitCode, 0);
    fs::permissions(folder, fs::perms::owner_all);
    expectNewStoreAfter({"update", _sample.store()});
}

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    bindToPermissions();
    return RUN_ALL_TESTS();
}
