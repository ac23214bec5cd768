// SPDX-License-Identifier: MIT
#include "PictureFiles.h"

#include <osgPagedTexture/ImageFile.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

using namespace osgPagedTexture;
using Kind = ImageError::Kind;

namespace
{

struct Failure
{
    Kind kind = Kind::Cancelled;
    std::string text = "no error";
};

Failure failureOf(const std::string& path, const ReadSettings& settings = {})
{
    try
    {
        readImageFile(path, settings);
        return {};
    }
    catch (const ImageError& error)
    {
        return {error.getKind(), error.what()};
    }
}

/// A file that says something else at one place, the highest byte first.
std::string patched(const std::string& text, std::size_t at, std::uint32_t value, int bytes)
{
    std::string number;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
    {
        number.push_back(static_cast<char>(value >> shift & 0xff));
    }
    return text.substr(0, at) + number + text.substr(at + number.size());
}

/// A PNG whose header says another size, with the right CRC.
std::string resizedPng(std::string text, std::uint32_t width, std::uint32_t height)
{
    text = patched(patched(text, 16, width, 4), 20, height, 4);
    std::uint32_t crc = 0xffffffff;
    for (std::size_t at = 12; at < 29; ++at)
    {
        crc ^= static_cast<unsigned char>(text[at]);
        for (int bit = 0; bit < 8; ++bit)
        {
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
        }
    }
    return patched(text, 29, ~crc, 4);
}

std::string readText(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

class ImageFileErrorTest : public testing::Test
{
protected:
    support::TemporaryFolder folder;
};

TEST_F(ImageFileErrorTest, AMissingFileIsNamed)
{
    const Failure failure = failureOf("/nowhere/a.jpg");
    EXPECT_EQ(failure.kind, Kind::Unreadable);
    EXPECT_EQ(failure.text,
              "'/nowhere/a.jpg': there is no such file; check the path that the model "
              "names");
}

TEST_F(ImageFileErrorTest, AnEmptyFileIsNamed)
{
    const std::string path = folder.write("a.jpg", "");
    EXPECT_EQ(failureOf(path).text,
              "'" + path + "': is empty (0 bytes); copy it from its source again");
}

TEST_F(ImageFileErrorTest, AFolderIsNoPicture)
{
    EXPECT_EQ(failureOf(folder.getPath().string()).kind, Kind::Unreadable);
}

TEST_F(ImageFileErrorTest, AFileWithoutRightsIsUnreadable)
{
    const std::string path = folder.write("a.jpg", "text");
    std::filesystem::permissions(path, std::filesystem::perms::none);
    const uid_t user = geteuid(); // root reads every file, nobody does not
    ASSERT_TRUE(user != 0 || seteuid(65534) == 0);
    const Failure failure = failureOf(path);
    ASSERT_TRUE(user != 0 || seteuid(0) == 0);
    EXPECT_EQ(failure.kind, Kind::Unreadable);
    EXPECT_NE(failure.text.find("Permission denied; check its permissions"), std::string::npos)
        << failure.text;
}

TEST_F(ImageFileErrorTest, TextIsNoPictureWhateverItsName)
{
    for (const char* name : {"a.jpg", "a.png", "a.txt", "a"})
    {
        const Failure failure = failureOf(folder.write(name, "once upon a time there was a file"));
        EXPECT_EQ(failure.kind, Kind::Damaged) << name;
        EXPECT_NE(failure.text.find("no picture of a known format"), std::string::npos)
            << failure.text;
    }
}

TEST_F(ImageFileErrorTest, AJpegHeaderThatPromisesTooMuchIsRefusedBeforeMemoryIsTaken)
{
    std::string text = encodeJpeg(samplePicture(64, 64, 3));
    const std::size_t frame = text.find("\xff\xc0");
    text = patched(text, frame + 5, 0xffdcffdc, 4); // 65500 x 65500
    const Failure failure = failureOf(folder.write("a.jpg", text));
    EXPECT_EQ(failure.kind, Kind::Refused);
    EXPECT_NE(failure.text.find("65500x65500"), std::string::npos) << failure.text;
    EXPECT_THROW(readImageInfo(folder.file("a.jpg")), ImageError);
}

TEST_F(ImageFileErrorTest, HeadersOfOtherFormatsThatPromiseTooMuchAreRefused)
{
    const Pixels picture = samplePicture(64, 64, 4);
    // Where width and height stand, the bytes of each, and the larger value.
    writePicture(folder.file("a.png"), picture);
    const std::string png = readText(folder.file("a.png"));
    EXPECT_EQ(failureOf(folder.write("b.png", resizedPng(png, 64, 63))).kind, Kind::Cancelled)
        << "the CRC is right";
    EXPECT_EQ(failureOf(folder.write("b.png", resizedPng(png, 15000, 15000))).kind, Kind::Refused);
    EXPECT_EQ(failureOf(folder.write("b.png", resizedPng(png, 60000, 60000))).kind, Kind::Refused);
    writePicture(folder.file("a.tga"), picture);
    const std::string tga = readText(folder.file("a.tga"));
    const std::string bomb = patched(patched(tga, 12, 0xfeff, 2), 14, 0xfeff, 2);
    EXPECT_EQ(failureOf(folder.write("b.tga", bomb)).kind, Kind::Refused);
    writePicture(folder.file("a.bmp"), samplePicture(64, 64, 3));
    const std::string bmp = readText(folder.file("a.bmp"));
    const std::string larger = patched(patched(bmp, 18, 0x003e0000, 4), 22, 0x003e0000, 4);
    EXPECT_EQ(failureOf(folder.write("b.bmp", larger)).kind, Kind::Refused) << 15872;
}

/// OpenImageIO reads a whole PPM when it opens it.
TEST_F(ImageFileErrorTest, aPpmBeyondTheLimitIsRefusedBeforeMemoryIsTaken)
{
    const std::string path = folder.write("a.ppm", "P6 40000 40000 255\n");
    std::filesystem::resize_file(path, 19 + std::uintmax_t(40000) * 40000 * 3); // sparse
    const auto peak = []()
    {
        rusage use{};
        getrusage(RUSAGE_SELF, &use);
        return use.ru_maxrss; // KiB
    };
    const long before = peak();
    EXPECT_EQ(failureOf(path).kind, Kind::Refused);
    EXPECT_THROW(readImageInfo(path), ImageError);
    EXPECT_LT(peak() - before, 64 << 10) << "of 4.5 GiB";
}

TEST_F(ImageFileErrorTest, ThePixelLimitIsKept)
{
    ReadSettings settings;
    settings.limits.maxPixels = 64 * 64 - 1;
    writePicture(folder.file("a.png"), samplePicture(64, 64, 3));
    folder.write("a.jpg", encodeJpeg(samplePicture(64, 64, 3)));
    for (const char* name : {"a.png", "a.jpg"})
    {
        EXPECT_EQ(failureOf(folder.file(name), settings).kind, Kind::Refused) << name;
        EXPECT_NO_THROW(readImageFile(folder.file(name)));
    }
}

TEST_F(ImageFileErrorTest, ATruncatedPngIsDamaged)
{
    writePicture(folder.file("a.png"), samplePicture(128, 128, 3));
    const std::string text = readText(folder.file("a.png"));
    for (std::size_t size : {text.size() / 10, text.size() / 2, text.size() - 100})
    {
        EXPECT_EQ(failureOf(folder.write("b.png", text.substr(0, size))).kind, Kind::Damaged)
            << size << " of " << text.size();
    }
}

TEST_F(ImageFileErrorTest, ManyScansAreRefusedAsTheyTakeForEver)
{
    JpegOptions options;
    options.progressive = true;
    const std::string text = encodeJpeg(samplePicture(64, 64, 1), options);
    // The last scan again and again.
    const std::size_t scan = text.rfind("\xff\xda");
    std::string bomb = text.substr(0, text.size() - 2);
    for (int i = 0; i < 1000; ++i)
    {
        bomb += text.substr(scan, text.size() - 2 - scan);
    }
    EXPECT_EQ(failureOf(folder.write("a.jpg", bomb + "\xff\xd9")).kind, Kind::Damaged);
}

TEST_F(ImageFileErrorTest, ACancelledReadEndsSoon)
{
    const std::atomic<bool> cancelled{true};
    ReadSettings settings;
    settings.cancelled = &cancelled;
    writePicture(folder.file("a.png"), samplePicture(64, 64, 3));
    folder.write("a.jpg", encodeJpeg(samplePicture(64, 64, 3)));
    for (const char* name : {"a.png", "a.jpg"})
    {
        EXPECT_EQ(failureOf(folder.file(name), settings).text,
                  "'" + folder.file(name) + "': no longer needed");
    }
}
