// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PictureFile.h>

#include <osgPagedTexture/ImageFile.h>

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <filesystem>

namespace osgPagedTexture
{

namespace
{

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& cause)
{
    throw ImageError(ImageError::Kind::Unreadable, path,
                     "it can't be written: " + OIIO::Strutil::replace(cause, "\n", " ", true));
}

void write(const std::string& path, const Pixels& pixels, int quality, const fs::path& name)
{
    auto output = OIIO::ImageOutput::create(path);
    if (!output)
        fail(name.string(), OIIO::geterror());
    OIIO::ImageSpec spec(pixels.width, pixels.height, pixels.channels, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("Compression", "jpeg:" + std::to_string(quality));
    const std::string format = output->format_name();
    if (format == "png")
        spec.attribute("png:compressionLevel", 3);
    else if (format != "jpeg")
        spec.attribute("Compression", "zip");
    if (format == "jpeg" && quality >= 90)
        spec.attribute("jpeg:subsampling", "4:4:4");
    const auto stride = OIIO::stride_t(pixels.width) * pixels.channels;
    if (!output->open(path, spec) ||
        !output->write_image(OIIO::TypeUInt8, pixels.row(pixels.height - 1), OIIO::AutoStride,
                             -stride) ||
        !output->close())
        fail(name.string(), output->geterror());
}

void writePages(const std::string& path, const std::vector<PictureLayer>& layers,
                const fs::path& name)
{
    auto output = OIIO::ImageOutput::create("tiff");
    if (!output)
        fail(name.string(), OIIO::geterror());
    auto mode = OIIO::ImageOutput::Create;
    for (const PictureLayer& layer : layers)
    {
        const Pixels& pixels = layer.pixels;
        OIIO::ImageSpec spec(pixels.width, pixels.height, pixels.channels, OIIO::TypeUInt8);
        spec.attribute("tiff:PageName", layer.name);
        spec.attribute("oiio:UnassociatedAlpha", 1);
        spec.attribute("Compression", "zip");
        const auto stride = OIIO::stride_t(pixels.width) * pixels.channels;
        if (!output->open(path, spec, mode) ||
            !output->write_image(OIIO::TypeUInt8, pixels.row(pixels.height - 1), OIIO::AutoStride,
                                 -stride))
            fail(name.string(), output->geterror());
        mode = OIIO::ImageOutput::AppendSubimage;
    }
    if (!output->close())
        fail(name.string(), output->geterror());
}

/// Lets `writeTo` make a file beside, which then takes the place of the wanted one.
template <class Write> void replaceFile(const std::string& path, const Write& writeTo)
{
    const fs::path file(path);
    std::error_code failure;
    if (file.has_parent_path())
        fs::create_directories(file.parent_path(), failure);
    if (failure)
        fail(path, failure.message());
    // The extension says the format.
    const fs::path half =
        file.parent_path() / (file.stem().string() + ".part" + file.extension().string());
    try
    {
        writeTo(half.string());
    }
    catch (...)
    {
        fs::remove(half, failure);
        throw;
    }
    fs::rename(half, file, failure);
    if (failure)
        fail(path, failure.message());
}

} // namespace

void writePictureFile(const std::string& path, const Pixels& pixels, int quality)
{
    if (pixels.empty())
        fail(path, "it has no pixels");
    replaceFile(path, [&](const std::string& half) { write(half, pixels, quality, path); });
}

void writeLayers(const std::string& path, const std::vector<PictureLayer>& layers)
{
    if (layers.empty())
        fail(path, "it has no layers");
    replaceFile(path, [&](const std::string& half) { writePages(half, layers, path); });
}

} // namespace osgPagedTexture
