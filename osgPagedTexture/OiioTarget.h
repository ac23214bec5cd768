// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/StoreFile.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <exception>
#include <memory>
#include <string>

namespace osgPagedTexture::oiio
{

/// The file that OpenImageIO writes a picture into. With a file of its own, its writer of PNG takes
/// no notice of a full disk, and that of JPEG ends the process.
class OiioTarget : public OIIO::Filesystem::IOProxy
{
public:
    /// To be called before `output` is opened, which it must outlive. Null for the few formats that
    /// cannot be led elsewhere, and TIFF: its writer reads again what it has written, which it can
    /// in a file of its own only (OpenImageIO 2.4). Throws TileStoreError.
    static std::unique_ptr<OiioTarget> lead(OIIO::ImageOutput& output, const std::string& path);

    /// Throws the TileStoreError of the first write that failed.
    void check() const;

    const char* proxytype() const override { return "osgPagedTexture"; }
    bool seek(std::int64_t place) override;
    std::size_t read(void* bytes, std::size_t count) override;
    /// Says that all went well, whatever happens.
    std::size_t write(const void* bytes, std::size_t count) override;
    std::size_t size() const override { return std::size_t(_file.getBytes()); }

private:
    explicit OiioTarget(const std::string& path)
        : IOProxy(path, Write), _file(path, StoreFile::Mode::Create)
    {
    }

    StoreFile _file;
    std::exception_ptr _failure;
};

/// Throws TileStoreError where the disk was full; to be called when an output is closed or failed.
void checkWritten(const OiioTarget* target, const std::string& path);

} // namespace osgPagedTexture::oiio
