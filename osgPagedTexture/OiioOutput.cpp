// SPDX-License-Identifier: MIT
#include <osgPagedTexture/OiioFile.h>

#include <osgPagedTexture/OiioTarget.h>

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

namespace osgPagedTexture::oiio
{

namespace
{

[[noreturn]] void fail(const std::string& cause)
{
    throw std::runtime_error(OIIO::Strutil::replace(cause, "\n", " ", true));
}

std::unique_ptr<OIIO::ImageOutput> createOutput(const std::string& name)
{
    auto output = OIIO::ImageOutput::create(name);
    if (!output)
    {
        fail(OIIO::geterror());
    }
    return output;
}

OIIO::ImageSpec specOf(const Pixels& pixels)
{
    OIIO::ImageSpec spec(pixels.width, pixels.height, pixels.channels, OIIO::TypeUInt8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    return spec;
}

void write(OIIO::ImageOutput& output, const OiioTarget* target, const std::string& path,
           const OIIO::ImageSpec& spec, OIIO::ImageOutput::OpenMode mode, const Pixels& pixels)
{
    const auto stride = OIIO::stride_t(pixels.width) * pixels.channels;
    if (!output.open(path, spec, mode) ||
        !output.write_image(OIIO::TypeUInt8, pixels.row(pixels.height - 1), OIIO::AutoStride,
                            -stride))
    {
        checkWritten(target, path);
        fail(output.geterror());
    }
}

void close(OIIO::ImageOutput& output, const OiioTarget* target, const std::string& path)
{
    const bool good = output.close();
    checkWritten(target, path);
    if (!good)
    {
        fail(output.geterror());
    }
}

} // namespace

void writePicture(const std::string& path, const Pixels& pixels, int quality)
{
    std::unique_ptr<OiioTarget> target; // outlives the output
    const auto output = createOutput(path);
    target = OiioTarget::lead(*output, path);
    OIIO::ImageSpec spec = specOf(pixels);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("Compression", "jpeg:" + std::to_string(quality));
    const std::string format = output->format_name();
    if (format == "png")
    {
        spec.attribute("png:compressionLevel", 3);
    }
    else if (format != "jpeg")
    {
        spec.attribute("Compression", "zip");
    }
    if (format == "jpeg" && quality >= 90)
    {
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
    write(*output, target.get(), path, spec, OIIO::ImageOutput::Create, pixels);
    close(*output, target.get(), path);
}

void writePages(const std::string& path, const std::vector<PictureLayer>& layers)
{
    std::unique_ptr<OiioTarget> target; // outlives the output
    const auto output = createOutput("tiff");
    target = OiioTarget::lead(*output, path);
    auto mode = OIIO::ImageOutput::Create;
    for (const PictureLayer& layer : layers)
    {
        OIIO::ImageSpec spec = specOf(layer.pixels);
        spec.attribute("tiff:PageName", layer.name);
        spec.attribute("Compression", "zip");
        write(*output, target.get(), path, spec, mode, layer.pixels);
        mode = OIIO::ImageOutput::AppendSubimage;
    }
    close(*output, target.get(), path);
}

} // namespace osgPagedTexture::oiio
