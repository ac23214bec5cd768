// SPDX-License-Identifier: MIT
#include <osgPagedTexture/EmbeddedImages.h>

#include <osgPagedTexture/ContentHash.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

namespace osgPagedTexture
{

namespace
{

namespace fs = std::filesystem;

bool isBgr(GLenum format)
{
    return format == GL_BGR || format == GL_BGRA;
}

/// Channels of the TGA: 1, 3 or 4; grey with alpha becomes four.
int channelsOf(GLenum format)
{
    switch (format)
    {
    case GL_LUMINANCE:
    case GL_RED:
    case GL_INTENSITY:
        return 1;
    case GL_RGB:
    case GL_BGR:
        return 3;
    case GL_LUMINANCE_ALPHA:
    case GL_RGBA:
    case GL_BGRA:
        return 4;
    default:
        return 0;
    }
}

/// The picture as a TGA file, not compressed, bottom row first as in memory.
std::vector<unsigned char> tgaOf(const osg::Image& image)
{
    const int width = image.s(), height = image.t();
    const GLenum format = image.getPixelFormat();
    const int channels = channelsOf(format);
    std::vector<unsigned char> file = {0,
                                       0,
                                       static_cast<unsigned char>(channels == 1 ? 3 : 2),
                                       0,
                                       0,
                                       0,
                                       0,
                                       0,
                                       0,
                                       0,
                                       0,
                                       0,
                                       static_cast<unsigned char>(width),
                                       static_cast<unsigned char>(width >> 8),
                                       static_cast<unsigned char>(height),
                                       static_cast<unsigned char>(height >> 8),
                                       static_cast<unsigned char>(8 * channels),
                                       static_cast<unsigned char>(channels == 4 ? 8 : 0)};
    file.reserve(file.size() + std::size_t(width) * height * channels);
    for (int y = 0; y < height; ++y)
    {
        const unsigned char* texel = image.data(0, unsigned(y));
        const int step = int(osg::Image::computeNumComponents(format));
        for (int x = 0; x < width; ++x, texel += step)
        {
            if (channels == 1)
                file.push_back(texel[0]);
            else if (format == GL_LUMINANCE_ALPHA)
                file.insert(file.end(), {texel[0], texel[0], texel[0], texel[1]});
            else
            {
                const int first = isBgr(format) ? 0 : 2;
                file.insert(file.end(), {texel[first], texel[1], texel[2 - first]});
                if (channels == 4)
                    file.push_back(texel[3]);
            }
        }
    }
    return file;
}

/// A texel of tgaOf() as it was.
void unpack(const unsigned char* from, GLenum format, unsigned char* to)
{
    const int first = isBgr(format) ? 0 : 2;
    to[0] = channelsOf(format) == 1 || format == GL_LUMINANCE_ALPHA ? from[0] : from[first];
    if (format == GL_LUMINANCE_ALPHA)
        to[1] = from[3];
    else if (channelsOf(format) > 1)
    {
        to[1] = from[1];
        to[2] = from[2 - first];
        if (channelsOf(format) == 4)
            to[3] = from[3];
    }
}

std::string makeFolder()
{
    std::error_code error;
    const fs::path base = fs::temp_directory_path(error);
    // mkdtemp() puts letters of its own for six X at the end.
    const std::string name = "osgPagedTexture-" + std::string(6, 'X');
    std::string pattern = ((error ? fs::path(".") : base) / name).string();
    return mkdtemp(pattern.data()) ? pattern : std::string();
}

} // namespace

EmbeddedImages::~EmbeddedImages()
{
    std::error_code ignored;
    if (!_folder.empty())
        fs::remove_all(_folder, ignored);
}

std::string EmbeddedImages::obstacle(const osg::Image& image)
{
    if (image.isCompressed())
        return "it is compressed already";
    if (!image.data() || image.r() != 1 || image.getDataType() != GL_UNSIGNED_BYTE ||
        channelsOf(image.getPixelFormat()) == 0)
        return "its texels are not of 8 bits a channel";
    if (image.s() > 65535 || image.t() > 65535)
        return "it is larger than 65535 texels";
    if (image.s() * image.t() < LeastTexels)
        return "it is small";
    return {};
}

osg::ref_ptr<osg::Image> EmbeddedImages::read(const std::string& file, GLenum format)
{
    constexpr std::size_t head = 18;
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> text{std::istreambuf_iterator<char>(stream), {}};
    const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
    const std::size_t channels = std::size_t(channelsOf(format));
    if (text.size() < head || channels == 0)
        return nullptr;
    const int width = bytes[12] | bytes[13] << 8, height = bytes[14] | bytes[15] << 8;
    if (text.size() != head + std::size_t(width) * height * channels)
        return nullptr;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, format, GL_UNSIGNED_BYTE, 1);
    const std::size_t step = osg::Image::computeNumComponents(format);
    for (std::size_t i = 0; i < std::size_t(width) * height; ++i)
        unpack(bytes + head + i * channels, format, image->data() + i * step);
    return image;
}

std::string EmbeddedImages::keep(const osg::Image& image)
{
    const std::vector<unsigned char> bytes = tgaOf(image);
    const std::string name = hashBytes(bytes.data(), bytes.size()).text() + ".tga";
    std::lock_guard<std::mutex> lock(_mutex);
    if (_folder.empty())
        _folder = makeFolder();
    if (_folder.empty())
        return {};
    const std::string file = (fs::path(_folder) / name).string();
    std::error_code error;
    if (fs::file_size(file, error) == bytes.size() && !error)
        return file;
    std::ofstream stream(file, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    stream.close();
    if (stream)
        return file;
    fs::remove(file, error);
    return {};
}

} // namespace osgPagedTexture
