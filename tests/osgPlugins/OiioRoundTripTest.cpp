// SPDX-License-Identifier: MIT
#include <osgPlugins/OiioImages.h>
#include <support/TemporaryFolder.h>

#include <osg/Texture>
#include <osgDB/Options>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace
{

enum Type
{
    Byte,
    Short,
    Half,
    Float
};
constexpr GLenum DataTypes[] = {GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT, GL_HALF_FLOAT, GL_FLOAT};

/// What a format makes of an image.
struct Format
{
    const char* extension;
    const char* stored; ///< By the type written, the type that is read: b, s, h or f.
    const char* kept;   ///< By the number of channels written, the number read; 0: refused.
    double loss = 0.0;  ///< Of full scale, of any channel, beyond the rounding to the type stored.
    bool ramps = false; ///< Written with ramps, as lossy coders want; else with noise.
    const char* options = "";
};

const Format Formats[] = {
    {"exr", "hfhf", "1234"},
    {"tif", "bsff", "1234"},
    {"bmp", "bbbb", "1434"},
    {"dpx", "bsff", "1434"},
    {"fits", "bfff", "1234"},
    {"ico", "bbbb", "1234"},
    {"iff", "bsbb", "0404"},
    {"jp2", "bsbb", "1434"},
    {"j2k", "bsbb", "1434"},
    {"png", "bsbb", "1234"},
    {"ppm", "bbbb", "1133"},
    {"rla", "ffff", "1234"},
    {"sgi", "bsbb", "1234"},
    {"tga", "bbbb", "1234"},
    {"zfile", "ffff", "1100"},
    // A palette of 256 for about 1500 colours; one bit of alpha, on from a half.
    {"gif", "bbbb", "4444", 0.1, true},
    // 8 bits of mantissa under the exponent of the largest channel, cut, not rounded.
    {"hdr", "ffff", "3333", 1.0 / 128.0},
    // Lossless, but OpenImageIO brings RGBA to linear light and back in 8 bits: half a step there,
    // divided by an alpha of a half, after another half step, is 12.92 times that in dark colours.
    {"webp", "bbbb", "3434", 22.0 / 255.0, true, "oiio.compression=lossless"},
    // Cosine transforms with subsampled colour: what they lose on ramps at their default quality.
    {"jpg", "bbbb", "1133", 8.0 / 255.0, true},
    {"heic", "bbbb", "3434", 14.0 / 255.0, true},
    {"avif", "bbbb", "3434", 16.0 / 255.0, true},
};

/// Half a step of the stored type at values up to 1; a whole one of floats, since OpenImageIO
/// scales integers by a rounded factor.
double rounding(GLenum dataType)
{
    switch (dataType)
    {
    case GL_UNSIGNED_BYTE:
        return 0.5 / 255.0;
    case GL_UNSIGNED_SHORT:
        return 0.5 / 65535.0;
    case GL_HALF_FLOAT:
        return std::ldexp(1.0, -12);
    default:
        return std::ldexp(1.0, -23);
    }
}

GLenum storedType(const Format& format, int type)
{
    switch (format.stored[type])
    {
    case 'b':
        return GL_UNSIGNED_BYTE;
    case 's':
        return GL_UNSIGNED_SHORT;
    case 'h':
        return GL_HALF_FLOAT;
    default:
        return GL_FLOAT;
    }
}

/// What channel of the image as read must hold, given the image as written.
double expectedValue(const osg::Image& written, const osg::Image& read, int column, int row,
                     int channel)
{
    const int from = countChannels(written);
    const int to = countChannels(read);
    if (to % 2 == 0 && channel == to - 1)
    {
        return from % 2 == 0 ? getValue(written, column, row, from - 1) : 1.0;
    }
    return getValue(written, column, row, from < 3 ? 0 : channel);
}

/// The largest difference of a channel.
double worstDifference(const osg::Image& written, const osg::Image& read, const Format& format)
{
    const bool oneBitAlpha = std::string("gif") == format.extension;
    double worst = 0.0;
    for (int row = 0; row < written.t(); ++row)
    {
        for (int column = 0; column < written.s(); ++column)
        {
            for (int channel = 0; channel < countChannels(read); ++channel)
            {
                double expected = expectedValue(written, read, column, row, channel);
                if (oneBitAlpha && channel == 3)
                {
                    expected = expected >= 0.5 ? 1.0 : 0.0;
                }
                const double off = std::fabs(getValue(read, column, row, channel) - expected);
                worst = off >= worst || std::isnan(off) ? off : worst;
            }
        }
    }
    return worst;
}

class OiioRoundTripTest : public testing::TestWithParam<Format>
{
protected:
    osg::ref_ptr<osgDB::Options> _options = new osgDB::Options(GetParam().options);
    support::TemporaryFolder _folder;

    osg::ref_ptr<osg::Image> makeWritten(int channels, int type) const
    {
        const Format& format = GetParam();
        // Odd, so that rows are not aligned to 4 bytes.
        osg::ref_ptr<osg::Image> image = makeImage(37, 41, channels, DataTypes[type]);
        format.ramps ? fillWithRamps(*image) : fillWithNoise(*image);
        return image;
    }

    void expectKept(const osg::Image& written, osgDB::ReaderWriter::ReadResult result, int type)
    {
        const Format& format = GetParam();
        ASSERT_TRUE(result.validImage()) << result.statusMessage();
        const osg::Image& read = *result.getImage();
        EXPECT_EQ(read.s(), written.s());
        EXPECT_EQ(read.t(), written.t());
        EXPECT_EQ(read.getPacking(), 1u);
        EXPECT_EQ(countChannels(read), format.kept[countChannels(written) - 1] - '0');
        ASSERT_EQ(read.getDataType(), storedType(format, type));
        EXPECT_LE(worstDifference(written, read, format),
                  format.loss + rounding(read.getDataType()) * (1.0 + 1e-6));
    }
};

TEST_P(OiioRoundTripTest, filesKeepAllPixelTypesAndChannels)
{
    for (int channels = 1; channels <= 4; ++channels)
    {
        for (int type = Byte; type <= Float; ++type)
        {
            SCOPED_TRACE(testing::Message() << channels << " channels of type " << type);
            const osg::ref_ptr<osg::Image> written = makeWritten(channels, type);
            const std::string name = _folder.file(std::string("image.") + GetParam().extension);
            const auto result = oiioPlugin()->writeImage(*written, name, _options.get());
            if (GetParam().kept[channels - 1] == '0')
            {
                EXPECT_TRUE(result.error());
                continue;
            }
            ASSERT_TRUE(result.success()) << result.statusMessage();
            expectKept(*written, oiioPlugin()->readImage(name, _options.get()), type);
        }
    }
}

TEST_P(OiioRoundTripTest, streamsKeepTheImage)
{
    const osg::ref_ptr<osg::Image> written = makeWritten(GetParam().kept[3] == '0' ? 1 : 4, Byte);
    written->setFileName(std::string("image.") + GetParam().extension);
    std::stringstream stream;
    const auto result = oiioPlugin()->writeImage(*written, stream, _options.get());
    ASSERT_TRUE(result.success()) << result.statusMessage();
    expectKept(*written, oiioPlugin()->readImage(stream, _options.get()), Byte);
}

INSTANTIATE_TEST_SUITE_P(Formats, OiioRoundTripTest, testing::ValuesIn(Formats),
                         [](const auto& format) { return std::string(format.param.extension); });

} // namespace
