// SPDX-License-Identifier: MIT
// Thousands of damaged JPEGs: none may pass for a good one. What is damaged is told by how the
// mutant was made, and by libjpeg's own warnings in the plainest program that uses it.
#include "PictureFiles.h"

#include <osgPagedTexture/ImageFile.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csetjmp>
#include <cstdlib>
#include <random>

#include <jpeglib.h>

using namespace osgPagedTexture;

namespace
{

std::vector<std::string> seedFiles()
{
    std::vector<std::string> files;
    const Pixels colour = samplePicture(200, 150, 3), grey = samplePicture(90, 200, 1);
    for (const Pixels* picture : {&colour, &grey})
    {
        for (int variant = 0; variant < 4; ++variant)
        {
            JpegOptions options;
            options.progressive = variant & 1;
            options.fullChroma = variant & 2;
            options.orientation = variant ? 2 * variant : 0;
            options.quality = 60 + 10 * variant;
            files.push_back(encodeJpeg(*picture, options));
        }
    }
    JpegOptions cmyk;
    cmyk.cmyk = true;
    files.push_back(encodeJpeg(colour, cmyk));
    return files;
}

enum class Damage
{
    Truncated,
    BytesChanged,
    HeaderChanged,
    HeaderBomb,
    BytesDeleted
};

std::string damage(std::string file, Damage kind, std::mt19937& random)
{
    const auto put = [&](std::size_t range)
    { file[random() % range] = static_cast<char>(random()); };
    switch (kind)
    {
    case Damage::Truncated:
        file.resize(1 + random() % (file.size() - 1));
        break;
    case Damage::BytesChanged:
        for (unsigned int i = random() % 8 + 1; i > 0; --i)
        {
            put(file.size());
        }
        break;
    case Damage::HeaderChanged:
        for (unsigned int i = random() % 4 + 1; i > 0; --i)
        {
            put(std::min<std::size_t>(file.size(), 700));
        }
        break;
    case Damage::HeaderBomb:
        for (std::size_t at = 2; at + 9 < file.size(); ++at)
        {
            if (file[at] == '\xff' && (file[at + 1] == '\xc0' || file[at + 1] == '\xc2'))
            {
                file.replace(at + 5, 4, "\xff\xdc\xff\xdc");
                break;
            }
        }
        break;
    case Damage::BytesDeleted:
        file.erase(random() % file.size(), 1 + random() % 63);
        break;
    }
    return file;
}

struct PlainErrors
{
    jpeg_error_mgr base;
    std::jmp_buf jump;
};

/// Whether libjpeg decodes the whole file without an error or a warning.
bool isFaultlessForLibjpeg(const std::string& file)
{
    PlainErrors errors;
    jpeg_decompress_struct jpeg;
    jpeg.err = jpeg_std_error(&errors.base);
    errors.base.output_message = [](j_common_ptr) {};
    errors.base.error_exit = [](j_common_ptr info)
    { std::longjmp(reinterpret_cast<PlainErrors*>(info->err)->jump, 1); };
    static std::vector<JSAMPLE> row; // not lost by the jump
    jpeg_create_decompress(&jpeg);
    if (setjmp(errors.jump))
    {
        jpeg_destroy_decompress(&jpeg);
        return false;
    }
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(file.data()), file.size());
    jpeg_read_header(&jpeg, TRUE);
    if (std::uint64_t(jpeg.image_width) * jpeg.image_height > 100000000)
    {
        jpeg_destroy_decompress(&jpeg);
        return false;
    }
    jpeg_start_decompress(&jpeg);
    row.resize(std::size_t(jpeg.output_width) * jpeg.output_components);
    JSAMPROW line = row.data();
    while (jpeg.output_scanline < jpeg.output_height)
    {
        jpeg_read_scanlines(&jpeg, &line, 1);
    }
    jpeg_finish_decompress(&jpeg);
    jpeg_destroy_decompress(&jpeg);
    return errors.base.num_warnings == 0;
}

enum class Outcome
{
    Good,
    Degraded,
    Refused,
    Damaged,
    Unsupported
};

Outcome outcomeOf(const std::string& path, int reduction)
{
    ReadSettings settings;
    settings.reduction = reduction;
    try
    {
        const DecodedImage image = readImageFile(path, settings);
        EXPECT_EQ(image.degraded, !image.warning.empty());
        return image.degraded ? Outcome::Degraded : Outcome::Good;
    }
    catch (const ImageError& error)
    {
        EXPECT_EQ(std::string(error.what()).find("'" + path + "': "), 0u) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.getKind() == ImageError::Kind::Refused       ? Outcome::Refused
               : error.getKind() == ImageError::Kind::Unsupported ? Outcome::Unsupported
                                                                  : Outcome::Damaged;
    }
}

} // namespace

TEST(DamagedJpegTest, NoDamagedFilePassesForAGoodOne)
{
    const support::TemporaryFolder folder;
    const std::vector<std::string> seeds = seedFiles();
    const int mutants = std::getenv("OSGKITS_LONG") ? 100000 : 2500;
    std::mt19937 random(42);
    int counts[5] = {}, passed = 0;
    double slowest = 0.0;
    for (int i = 0; i < mutants; ++i)
    {
        const std::string& seed = seeds[random() % seeds.size()];
        const auto kind = static_cast<Damage>(i % 5);
        const std::string mutant = damage(seed, kind, random);
        const std::string path = folder.write("a.jpg", mutant);
        const bool faultless =
            mutant == seed || (kind != Damage::Truncated && kind != Damage::HeaderBomb &&
                               isFaultlessForLibjpeg(mutant));
        const auto start = std::chrono::steady_clock::now();
        for (int reduction = 3; reduction >= 0; --reduction)
        {
            const Outcome outcome = outcomeOf(path, reduction);
            passed += outcome == Outcome::Good && !faultless;
            ASSERT_FALSE(outcome == Outcome::Good && !faultless)
                << "mutant " << i << " of kind " << int(kind) << " at 1/" << (1 << reduction);
            ASSERT_TRUE(kind != Damage::HeaderBomb || outcome == Outcome::Refused) << i;
            counts[int(outcome)] += reduction == 0;
        }
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        slowest = std::max(slowest, seconds.count());
    }
    std::printf("%d mutants: %d damaged ones passed for good; %d decode without a fault in libjpeg "
                "too, %d degraded, %d refused, %d damaged, %d unsupported; slowest %.3f s\n",
                mutants, passed, counts[0], counts[1], counts[2], counts[3], counts[4], slowest);
    EXPECT_LT(slowest, 2.0);
    EXPECT_GT(counts[int(Outcome::Degraded)], mutants / 10) << "the mutants tell too little";
}

TEST(DamagedJpegTest, EveryTruncationIsNoticed)
{
    const support::TemporaryFolder folder;
    const std::string file = encodeJpeg(samplePicture(40, 24, 3));
    for (std::size_t size = 1; size < file.size(); ++size)
    {
        ASSERT_NE(outcomeOf(folder.write("a.jpg", file.substr(0, size)), 0), Outcome::Good) << size;
    }
    EXPECT_EQ(outcomeOf(folder.write("a.jpg", file), 0), Outcome::Good);
}
