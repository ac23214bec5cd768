// SPDX-License-Identifier: MIT
#include <osgPlugins/OiioImages.h>
#include <support/ChildProcess.h>
#include <support/NotifyCapture.h>
#include <support/TemporaryFolder.h>

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <osg/Texture>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>

namespace
{

using ReadResult = osgDB::ReaderWriter::ReadResult;
using WriteResult = osgDB::ReaderWriter::WriteResult;

osg::ref_ptr<osgDB::Options> withOptions(const std::string& text)
{
    return new osgDB::Options(text);
}

class OiioTest : public testing::Test
{
protected:
    support::TemporaryFolder _folder;
    osgDB::ReaderWriter* const _plugin = oiioPlugin();

    /// Writes a file by OpenImageIO itself: what this suite reads is not only what it wrote.
    std::string writeFile(const std::string& name, const OIIO::ImageSpec& spec,
                          const std::vector<float>& values) const
    {
        const std::string path = _folder.file(name);
        const auto output = OIIO::ImageOutput::create(path);
        EXPECT_TRUE(output->open(path, spec)) << output->geterror();
        EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()))
            << output->geterror();
        EXPECT_TRUE(output->close());
        return path;
    }
};

TEST_F(OiioTest, everyExtensionOfOpenImageIOHasAModuleOfOursOrOfOsg)
{
    osgDB::Registry* const registry = osgDB::Registry::instance();
    int extensions = 0;
    for (const std::string& format :
         OIIO::Strutil::splits(OIIO::get_string_attribute("extension_list"), ";"))
    {
        const auto parts = OIIO::Strutil::splits(format, ":");
        // Not pictures: OpenImageIO's own test formats.
        if (parts[0] == "null" || parts[0] == "term")
        {
            continue;
        }
        for (const std::string& extension : OIIO::Strutil::splits(parts[1], ","))
        {
            // Sound without pictures.
            if (extension != "m4a")
            {
                const std::string module = registry->createLibraryNameForExtension(extension);
                EXPECT_FALSE(osgDB::findLibraryFile(module).empty()) << module;
                ++extensions;
            }
        }
    }
    EXPECT_GT(extensions, 20);
}

TEST_F(OiioTest, preloadedItIsAskedBeforeThePluginsThatAreThere)
{
    osgDB::Registry* const registry = osgDB::Registry::instance();
    registry->loadLibrary(registry->createLibraryNameForExtension("png"));
    // The test may have loaded it before the other: again, as -e oiio does.
    registry->closeLibrary(registry->createLibraryNameForExtension("oiio"));
    registry->loadLibrary(registry->createLibraryNameForExtension("oiio"));
    EXPECT_STREQ(registry->getReaderWriterForExtension("png")->className(),
                 "OpenImageIO reader and writer");
}

TEST_F(OiioTest, orientationsOneToEightStandUpright)
{
    // Seen upright, 3 x 2: rows 1 2 3 and 4 5 6; by EXIF orientation how that is stored.
    const std::vector<float> upright = {1, 2, 3, 4, 5, 6};
    const std::vector<std::vector<float>> stored = {
        {1, 2, 3, 4, 5, 6}, {3, 2, 1, 6, 5, 4}, {6, 5, 4, 3, 2, 1}, {4, 5, 6, 1, 2, 3},
        {1, 4, 2, 5, 3, 6}, {3, 6, 2, 5, 1, 4}, {6, 3, 5, 2, 4, 1}, {4, 1, 5, 2, 6, 3}};
    for (int orientation = 1; orientation <= 8; ++orientation)
    {
        SCOPED_TRACE(orientation);
        const bool transposed = orientation > 4;
        for (const char* name : {"o.tif", "o.exr"})
        {
            OIIO::ImageSpec spec(transposed ? 2 : 3, transposed ? 3 : 2, 1, OIIO::TypeDesc::FLOAT);
            spec.attribute("Orientation", orientation);
            const ReadResult result = ReadResult(
                _plugin->readImage(writeFile(name, spec, stored[orientation - 1]), nullptr));
            const osg::Image* const image = ReadResult(result).getImage();
            ASSERT_TRUE(image) << result.statusMessage();
            ASSERT_EQ(image->s(), 3);
            ASSERT_EQ(image->t(), 2);
            for (int i = 0; i < 6; ++i)
            {
                // OSG's first row is the bottom one.
                EXPECT_EQ(getValue(*image, i % 3, 1 - i / 3, 0), upright[i]) << name << i;
            }
        }
    }
}

TEST_F(OiioTest, floatExrKeepsValuesThatNoDisplayShows)
{
    const float infinity = std::numeric_limits<float>::infinity();
    const float values[] = {1000.5f, -3.25f, infinity, -infinity, 1e-30f, std::nanf("")};
    const osg::ref_ptr<osg::Image> image = makeImage(2, 1, 3, GL_FLOAT);
    std::copy(std::begin(values), std::end(values), reinterpret_cast<float*>(image->data()));
    ASSERT_TRUE(_plugin->writeImage(*image, _folder.file("a.exr"), nullptr).success());
    ReadResult result = _plugin->readImage(_folder.file("a.exr"), nullptr);
    ASSERT_TRUE(result.validImage()) << result.statusMessage();
    const auto* const read = reinterpret_cast<const float*>(result.getImage()->data());
    for (int i = 0; i < 5; ++i)
    {
        EXPECT_EQ(read[i], values[i]);
    }
    EXPECT_TRUE(std::isnan(read[5]));
    EXPECT_EQ(result.getImage()->getInternalTextureFormat(), GL_RGB32F_ARB);
}

TEST_F(OiioTest, rowsWithGapsAndTopDownRowsAndBgraAreWrittenAsTheyAreSeen)
{
    // Two pixels seen of rows of three, packed to 8 bytes: a row takes 16.
    unsigned char bytes[32] = {};
    std::iota(std::begin(bytes), std::end(bytes), static_cast<unsigned char>(1));
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->setImage(2, 2, 1, GL_RGBA, GL_BGRA, GL_UNSIGNED_BYTE, bytes, osg::Image::NO_DELETE, 8,
                    3);
    image->setOrigin(osg::Image::TOP_LEFT);
    ASSERT_EQ(image->getRowStepInBytes(), 16u);
    ASSERT_TRUE(_plugin->writeImage(*image, _folder.file("a.png"), nullptr).success());
    ReadResult result = _plugin->readImage(_folder.file("a.png"), nullptr);
    ASSERT_TRUE(result.validImage()) << result.statusMessage();
    const unsigned char expected[] = {19, 18, 17, 20, 23, 22, 21, 24, 3, 2, 1, 4, 7, 6, 5, 8};
    for (int i = 0; i < 16; ++i)
    {
        EXPECT_EQ(result.getImage()->data()[i], expected[i]) << i;
    }
}

TEST_F(OiioTest, imagesThatCannotBeWrittenAreRefusedWithTheReason)
{
    const std::string path = _folder.file("a.exr");
    const std::string head = "osgdb_oiio: '" + path + "': ";
    osg::ref_ptr<osg::Image> image = new osg::Image;
    EXPECT_EQ(_plugin->writeImage(*image, path, nullptr).message(),
              head + "the image has no pixels");
    image->allocateImage(4, 4, 3, GL_RGB, GL_UNSIGNED_BYTE);
    EXPECT_EQ(_plugin->writeImage(*image, path, nullptr).message(),
              head + "a volume of 3 slices; write its slices one by one");
    image->allocateImage(4, 4, 1, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, GL_UNSIGNED_BYTE);
    EXPECT_EQ(
        _plugin->writeImage(*image, path, nullptr).message(),
        head + "the pixels are compressed for the GPU; write .dds, or decompress the image first");
    image->allocateImage(4, 4, 1, GL_RGB, GL_UNSIGNED_SHORT_5_6_5);
    EXPECT_EQ(_plugin->writeImage(*image, path, nullptr).message(),
              head +
                  "pixel format 0x1907 of type 0x8363 cannot be written; convert the image to RGB "
                  "or RGBA first");
    EXPECT_FALSE(std::filesystem::exists(path));
    image->allocateImage(4, 4, 1, GL_RGB, GL_UNSIGNED_BYTE);
    EXPECT_EQ(_plugin->writeImage(*image, _folder.file("a.psd"), nullptr).message(),
              "osgdb_oiio: '" + _folder.file("a.psd") +
                  "': OpenImageIO reads but does not write psd");
    EXPECT_TRUE(_plugin->writeImage(*image, _folder.file("none/a.exr"), nullptr).error());
}

TEST_F(OiioTest, filesThatAreNotThereAndNotOursAreToldApart)
{
    EXPECT_TRUE(_plugin->readImage("none.exr", nullptr).notFound());
    EXPECT_TRUE(_plugin->readImage(_folder.write("a.unknown", "x"), nullptr).notHandled());
    EXPECT_TRUE(_plugin->readObject("", nullptr).notHandled());
    EXPECT_EQ(_plugin->readImage(_folder.write("a.exr", "no picture"), nullptr).status(),
              ReadResult::ERROR_IN_READING_FILE);
}

TEST_F(OiioTest, headersThatPromiseTooMuchAreRefusedBeforeMemoryIsTaken)
{
    // An 18-byte Targa header: true colour, 65500 x 65500 of 32 bits, and not one pixel.
    std::string header(18, '\0');
    header[2] = 2;
    header[12] = header[14] = static_cast<char>(0xdc);
    header[13] = header[15] = static_cast<char>(0xff);
    header[16] = 32;
    const std::string path = _folder.write("bomb.tga", header);
    EXPECT_EQ(_plugin->readImage(path, nullptr).message(),
              "osgdb_oiio: '" + path +
                  "': 65500x65500 pixels of 4 bytes are more than the limit of "
                  "2047 MiB; set oiio.maxMegabytes");
    const osg::ref_ptr<osg::Image> image = makeImage(600, 600, 3, GL_UNSIGNED_BYTE);
    fillWithRamps(*image);
    ASSERT_TRUE(_plugin->writeImage(*image, _folder.file("a.png"), nullptr).success());
    EXPECT_TRUE(_plugin->readImage(_folder.file("a.png"), withOptions("oiio.maxMegabytes=1").get())
                    .error());
    EXPECT_TRUE(_plugin->readImage(_folder.file("a.png"), withOptions("oiio.maxMegabytes=2").get())
                    .success());
}

TEST_F(OiioTest, optionsWithMistakesAreNamed)
{
    const std::string path =
        writeFile("a.tif", OIIO::ImageSpec(2, 2, 1, OIIO::TypeDesc::UINT8), {0, 0, 0, 0});
    const auto message = [&](const char* text)
    { return _plugin->readImage(path, withOptions(text).get()).message(); };
    EXPECT_EQ(
        message("labels.size=3 oiio.qualty=3"),
        "osgdb_oiio: unknown option 'oiio.qualty=3'; 'osgconv --format exr' lists the options");
    EXPECT_EQ(message("oiio.subimage=-1"),
              "osgdb_oiio: bad value in option 'oiio.subimage=-1': =N: "
              "part, page, layer or frame to read, from 0");
    EXPECT_EQ(message("oiio.subimage=7"), "osgdb_oiio: '" + path + "': there is no subimage 7");
    for (const char* bad : {"oiio.quality=101", "oiio.quality=", "oiio.quality", "oiio.type=int",
                            "oiio.maxMegabytes=4096", "oiio.subimage=1x", "oiio."})
    {
        EXPECT_NE(message(bad).find("option"), std::string::npos) << bad;
    }
    EXPECT_EQ(message("labels.size=3"), "");
}

TEST_F(OiioTest, optionsChooseSubimageTypeAndQuality)
{
    const std::string path = _folder.file("pages.tif");
    const auto output = OIIO::ImageOutput::create(path);
    for (int page = 0; page < 3; ++page)
    {
        const OIIO::ImageSpec spec(page + 1, 1, 1, OIIO::TypeDesc::UINT8);
        ASSERT_TRUE(output->open(
            path, spec, page ? OIIO::ImageOutput::AppendSubimage : OIIO::ImageOutput::Create));
        const unsigned char pixels[3] = {255, 255, 255};
        ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, pixels));
    }
    output->close();
    EXPECT_EQ(_plugin->readImage(path, nullptr).getImage()->s(), 1);
    ReadResult page =
        _plugin->readImage(path, withOptions("oiio.subimage=2 oiio.type=float").get());
    EXPECT_EQ(page.getImage()->s(), 3);
    EXPECT_EQ(page.getImage()->getDataType(), static_cast<GLenum>(GL_FLOAT));
    EXPECT_EQ(getValue(*page.getImage(), 2, 0, 0), 1.0);

    const osg::ref_ptr<osg::Image> noise = makeImage(64, 64, 3, GL_UNSIGNED_BYTE);
    fillWithNoise(*noise);
    ASSERT_TRUE(
        _plugin->writeImage(*noise, _folder.file("10.jpg"), withOptions("oiio.quality=10").get())
            .success());
    ASSERT_TRUE(
        _plugin->writeImage(*noise, _folder.file("95.jpg"), withOptions("oiio.quality=95").get())
            .success());
    EXPECT_LT(2 * std::filesystem::file_size(_folder.file("10.jpg")),
              std::filesystem::file_size(_folder.file("95.jpg")));
}

TEST_F(OiioTest, moreThanFourChannelsGiveThoseNamedRedGreenBlueAndAlpha)
{
    OIIO::ImageSpec spec(1, 1, 6, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"N.x", "R", "Z", "A", "B", "G"};
    const std::string path = writeFile("a.tif", spec, {1, 2, 3, 4, 5, 6});
    // TIFF does not keep names: a file of OpenEXR does, sorted in its own way.
    const std::string exr = writeFile("a.exr", spec, {1, 2, 3, 4, 5, 6});
    support::NotifyCapture capture(osg::NOTICE);
    ReadResult result = _plugin->readImage(exr, nullptr);
    ASSERT_TRUE(result.validImage()) << result.statusMessage();
    ASSERT_EQ(countChannels(*result.getImage()), 4);
    const double expected[] = {2, 6, 5, 4};
    for (int channel = 0; channel < 4; ++channel)
    {
        EXPECT_EQ(getValue(*result.getImage(), 0, 0, channel), expected[channel]);
    }
    EXPECT_EQ(capture.takeMessages(),
              support::NotifyCapture::Lines{"osgdb_oiio: '" + exr +
                                            "' has 6 channels, taking R, G, B, A"});
    ReadResult unnamed = _plugin->readImage(path, nullptr);
    ASSERT_TRUE(unnamed.validImage()) << unnamed.statusMessage();
    EXPECT_EQ(getValue(*unnamed.getImage(), 0, 0, 0), 1.0);
    EXPECT_EQ(getValue(*unnamed.getImage(), 0, 0, 2), 3.0);
}

TEST_F(OiioTest, alphaThatAFormatLacksIsLeftOutAndSaidSo)
{
    const osg::ref_ptr<osg::Image> image = makeImage(8, 8, 4, GL_UNSIGNED_BYTE);
    fillWithRamps(*image);
    support::NotifyCapture capture(osg::NOTICE);
    const std::string path = _folder.file("a.ppm");
    ASSERT_TRUE(_plugin->writeImage(*image, path, nullptr).success());
    EXPECT_EQ(capture.takeMessages(),
              support::NotifyCapture::Lines{"osgdb_oiio: '" + path +
                                            "': pnm has no alpha, which is left out"});
}

TEST_F(OiioTest, ofMipMappedFilesTheLargestLevelIsRead)
{
    for (const char* name : {"a.tx", "a.exr"})
    {
        const std::string path = _folder.file(name);
        const OIIO::ImageBuf picture(OIIO::ImageSpec(64, 48, 3, OIIO::TypeDesc::FLOAT));
        ASSERT_TRUE(OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, picture,
                                                     path, OIIO::ImageSpec()));
        ReadResult result = _plugin->readImage(path, nullptr);
        ASSERT_TRUE(result.validImage()) << result.statusMessage();
        EXPECT_EQ(result.getImage()->s(), 64);
        EXPECT_EQ(result.getImage()->t(), 48);
    }
}

TEST_F(OiioTest, cmykBecomesRgb)
{
    OIIO::ImageSpec spec(2, 1, 4, OIIO::TypeDesc::UINT8);
    spec.channelnames = {"C", "M", "Y", "K"};
    spec.attribute("tiff:ColorSpace", "CMYK");
    ReadResult result =
        _plugin->readImage(writeFile("a.tif", spec, {0, 1, 1, 0, 0, 0, 0, 1}), nullptr);
    ASSERT_TRUE(result.validImage()) << result.statusMessage();
    ASSERT_EQ(countChannels(*result.getImage()), 3);
    const unsigned char expected[] = {255, 0, 0, 0, 0, 0};
    EXPECT_EQ(0, std::memcmp(result.getImage()->data(), expected, sizeof expected));
}

TEST_F(OiioTest, osgconvFindsTheModulesByExtensionAndWritesWhatWasRead)
{
    const osg::ref_ptr<osg::Image> image = makeImage(24, 16, 3, GL_FLOAT);
    fillWithRamps(*image);
    ASSERT_TRUE(_plugin->writeImage(*image, _folder.file("in.exr"), nullptr).success());
    const std::vector<std::vector<std::string>> ways = {
        {"osgconv", "-O", "oiio.type=uint8", _folder.file("in.exr"), _folder.file("out.png")},
        {"osgconv", "-e", "oiio", _folder.file("in.exr"), _folder.file("out.png")}};
    for (const auto& arguments : ways)
    {
        std::filesystem::remove(_folder.file("out.png"));
        support::ChildProcess osgconv;
        osgconv.arguments = arguments;
        const support::ProcessResult ended = osgconv.run();
        EXPECT_EQ(ended.exitCode, 0) << ended.errors;
        ReadResult result = _plugin->readImage(_folder.file("out.png"), nullptr);
        ASSERT_TRUE(result.validImage()) << result.statusMessage() << ended.errors;
        EXPECT_EQ(result.getImage()->getDataType(), static_cast<GLenum>(GL_UNSIGNED_BYTE));
        for (int i = 0; i < 24 * 16; ++i)
        {
            for (int channel = 0; channel < 3; ++channel)
            {
                EXPECT_NEAR(getValue(*result.getImage(), i % 24, i / 24, channel),
                            getValue(*image, i % 24, i / 24, channel), 0.5001 / 255.0);
            }
        }
    }
    support::ChildProcess lister;
    lister.arguments = {"osgconv", "--format", "exr"};
    EXPECT_NE(lister.run().output.find("oiio.maxMegabytes"), std::string::npos);
}

} // namespace
