// SPDX-License-Identifier: MIT
#include <osgPlugins/OiioImages.h>
#include <support/TemporaryFolder.h>

#include <osgDB/Options>

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

namespace
{

/// Reads damaged files of a format: a crash, a hang or a sanitizer's report fails the test.
class OiioDamageTest : public testing::TestWithParam<const char*>
{
protected:
    support::TemporaryFolder _folder;
    osgDB::ReaderWriter* const _plugin = oiioPlugin();
    // Damaged sizes are common here: large pictures cost time and show nothing more.
    osg::ref_ptr<osgDB::Options> _options = new osgDB::Options("oiio.maxMegabytes=64");

    std::string makeFile()
    {
        const osg::ref_ptr<osg::Image> image =
            makeImage(40, 33, std::string(GetParam()) == "zfile" ? 1 : 4, GL_UNSIGNED_BYTE);
        fillWithRamps(*image);
        const std::string path = _folder.file(std::string("good.") + GetParam());
        EXPECT_TRUE(_plugin->writeImage(*image, path, nullptr).success());
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    osgDB::ReaderWriter::ReadResult read(const std::string& bytes)
    {
        return _plugin->readImage(_folder.write(std::string("bad.") + GetParam(), bytes),
                                  _options.get());
    }
};

TEST_P(OiioDamageTest, truncatedFilesEndInAnErrorOrAnImage)
{
    const std::string good = makeFile();
    ASSERT_TRUE(read(good).validImage());
    // Most headers end within 64 bytes; the rest in 32 steps.
    const std::size_t step = std::max<std::size_t>(1, good.size() / 32);
    for (std::size_t size = 0; size < good.size(); size += size < 64 ? 4 : step)
    {
        osgDB::ReaderWriter::ReadResult result = read(good.substr(0, size));
        EXPECT_TRUE(result.validImage() || !result.message().empty()) << size;
        EXPECT_FALSE(size < 8 && result.validImage()) << size;
    }
}

TEST_P(OiioDamageTest, flippedBytesEndInAnErrorOrAnImage)
{
    const std::string good = makeFile();
    std::mt19937 random(2024);
    for (int round = 0; round < 100; ++round)
    {
        std::string bad = good;
        // Half of the rounds damage the header, where sizes and offsets are.
        const std::size_t reach = round % 2 ? bad.size() : std::min<std::size_t>(bad.size(), 128);
        for (int flips = 1 + random() % 8; flips > 0; --flips)
        {
            bad[random() % reach] = static_cast<char>(random());
        }
        osgDB::ReaderWriter::ReadResult result = read(bad);
        EXPECT_TRUE(result.validImage() || !result.message().empty()) << round;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, OiioDamageTest,
                         testing::Values("exr", "tif", "bmp", "dpx", "fits", "gif", "hdr", "heic",
                                         "avif", "ico", "iff", "jpg", "jp2", "j2k", "png", "ppm",
                                         "rla", "sgi", "tga", "webp", "zfile"),
                         [](const auto& format) { return std::string(format.param); });

} // namespace
