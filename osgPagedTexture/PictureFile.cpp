// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PictureFile.h>

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/OiioModule.h>
#include <osgPagedTexture/TileStore.h>

#include <filesystem>

namespace osgPagedTexture
{

namespace
{

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& cause)
{
    throw ImageError(ImageError::Kind::Unreadable, path, "it can't be written: " + cause);
}

/// Lets `writeTo` make a file beside, which then takes the place of the wanted one.
template <class Write> void replaceFile(const std::string& path, const Write& writeTo)
{
    const fs::path file(path);
    std::error_code failure;
    if (file.has_parent_path())
    {
        fs::create_directories(file.parent_path(), failure);
    }
    if (failure)
    {
        fail(path, failure.message());
    }
    // The extension says the format.
    const fs::path half =
        file.parent_path() / (file.stem().string() + ".part" + file.extension().string());
    const OiioFunctions& functions = oiioFunctions();
    try
    {
        writeTo(functions, half.string());
    }
    catch (const TileStoreError&) // says the file and why
    {
        fs::remove(half, failure);
        throw;
    }
    catch (const std::exception& error)
    {
        fs::remove(half, failure);
        fail(path, error.what());
    }
    fs::rename(half, file, failure);
    if (failure)
    {
        fail(path, failure.message());
    }
}

} // namespace

void writePictureFile(const std::string& path, const Pixels& pixels, int quality)
{
    if (pixels.empty())
    {
        fail(path, "it has no pixels");
    }
    replaceFile(path, [&](const OiioFunctions& functions, const std::string& half)
                { functions.writePicture(half, pixels, quality); });
}

void writeLayers(const std::string& path, const std::vector<PictureLayer>& layers)
{
    if (layers.empty())
    {
        fail(path, "it has no layers");
    }
    replaceFile(path, [&](const OiioFunctions& functions, const std::string& half)
                { functions.writePages(half, layers); });
}

} // namespace osgPagedTexture
