// SPDX-License-Identifier: MIT
// This process has to be smaller than the one it measures: what it has when it forks counts, too.
#include "TileStoreRun.h"

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace
{

namespace fs = std::filesystem;

/// 24 photographs of 2000 x 1500 pixels: about 8,700 pixels square, whose rows take 79 MiB in tiles
/// of 512 pixels.
class OsgTileStoreMemoryTest : public testing::Test
{
protected:
    void SetUp() override
    {
        fs::create_directories(_folder.file("photos"));
        for (int i = 0; i < 24; ++i)
            writePhoto(i, 0);
    }

    void writePhoto(int number, int seed) const
    {
        const std::string place = _folder.file("photos/" + std::to_string(number) + ".ppm");
        const std::string content = _folder.file("content" + std::to_string(seed));
        if (!fs::exists(content))
        {
            std::ofstream file(content, std::ios::binary);
            file << "P6\n2000 1500\n255\n";
            for (int y = 0; y < 1500; ++y)
            {
                std::string row(std::size_t(3 * 2000), '\0');
                for (std::size_t x = 0; x < row.size(); ++x)
                    row[x] = char(int(x) / 7 + y / 5 + 40 * seed);
                file << row;
            }
        }
        fs::remove(place);
        fs::create_hard_link(content, place);
    }

    std::string photos() const { return _folder.file("photos"); }
    std::string store() const { return _folder.file("photos.tiles"); }

    std::vector<std::string> buildWords(const std::string& memory,
                                        const std::vector<std::string>& more = {}) const
    {
        std::vector<std::string> words{
            "build", photos(),   "--store", store(),       "--memory", memory,     "--threads",
            "2",     "--border", "0",       "--tile-side", "512",      "--no-sync"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    /// MiB that it takes more than the program by itself.
    static double memoryOf(const std::vector<std::string>& words)
    {
        const auto result = run(words);
        EXPECT_EQ(result.exitCode, 0) << words[0] << ": " << result.errors;
        return result.peakMiB - run({"--help"}).peakMiB;
    }

    const support::TemporaryFolder _folder;
};

/// What there is besides rows, in MiB: twice 4 of what is to be written, the index, code that the
/// program by itself does not touch, and what two threads encode. Up to 14 here.
constexpr double Besides = 24.0;

} // namespace

TEST_F(OsgTileStoreMemoryTest, aBuildTakesWhatItIsAllowedOrSaysTheLeast)
{
    EXPECT_LT(memoryOf(buildWords("20MiB")), 20.0 + Besides);
    EXPECT_EQ(run({"verify", store()}).exitCode, 0);
    EXPECT_LT(memoryOf(buildWords("32MiB")), 32.0 + Besides);
    EXPECT_GT(memoryOf(buildWords("1GiB")), 32.0 + Besides) << "it makes no difference here";
    for (const char* little : {"4MiB", "1MiB", "64KiB", "1"})
    {
        const auto result = run(buildWords(little));
        EXPECT_EQ(result.exitCode, 1);
        EXPECT_NE(result.errors.find("takes 13 MiB of rows, more than the"), std::string::npos)
            << result.errors;
        EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1);
    }
    EXPECT_EQ(run(buildWords("13MiB")).exitCode, 0) << "what was said is enough";
    EXPECT_EQ(run(buildWords("0")).exitCode, 2);
    EXPECT_EQ(run(buildWords("much")).exitCode, 2);
}

TEST_F(OsgTileStoreMemoryTest, partsOfABuildAndUpdatesTakeWhatTheyAreAllowed)
{
    for (const char* part : {"1/2", "2/2"})
        EXPECT_LT(memoryOf(buildWords("20MiB", {"--shard", part})), 20.0 + Besides);
    ASSERT_EQ(run({"merge", store()}).exitCode, 0);
    for (const char* memory : {"20MiB", "32MiB"})
    {
        writePhoto(7, memory[0]);
        EXPECT_LT(memoryOf({"update", store(), "--memory", memory, "--threads", "2", "--no-sync"}),
                  std::atof(memory) + Besides);
    }
    EXPECT_EQ(run({"verify", store()}).exitCode, 0);
}
