// SPDX-License-Identifier: MIT
#include <osgPagedTexture/OiioTarget.h>

#include <osgPagedTexture/TileStore.h>

namespace osgPagedTexture::oiio
{

std::unique_ptr<OiioTarget> OiioTarget::lead(OIIO::ImageOutput& output, const std::string& path)
{
    if (!output.supports("ioproxy") || std::string(output.format_name()) == "tiff")
    {
        return nullptr;
    }
    std::unique_ptr<OiioTarget> target(new OiioTarget(path));
    output.set_ioproxy(target.get());
    return target;
}

void OiioTarget::check() const
{
    if (_failure)
    {
        std::rethrow_exception(_failure);
    }
}

bool OiioTarget::seek(std::int64_t place)
{
    m_pos = place;
    return place >= 0;
}

std::size_t OiioTarget::read(void* bytes, std::size_t count)
{
    const std::size_t done = _file.readSome(bytes, count, std::uint64_t(m_pos));
    m_pos += std::int64_t(done);
    return done;
}

std::size_t OiioTarget::write(const void* bytes, std::size_t count)
{
    try
    {
        if (!_failure)
        {
            _file.write(bytes, count, std::uint64_t(m_pos));
        }
    }
    catch (const TileStoreError&)
    {
        _failure = std::current_exception();
    }
    m_pos += std::int64_t(count);
    return count;
}

void checkWritten(const OiioTarget* target, const std::string& path)
{
    target ? target->check() : checkRoom(path);
}

} // namespace osgPagedTexture::oiio
