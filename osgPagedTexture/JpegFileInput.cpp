// SPDX-License-Identifier: MIT
#include <osgPagedTexture/JpegDecoder.h>

#include <memory>

#include <jerror.h>

namespace osgPagedTexture
{

namespace
{

constexpr std::size_t PieceBytes = 64 << 10;
constexpr std::size_t Failed = ~std::size_t(0);

} // namespace

JpegFileInput::JpegFileInput(const std::string& path) : _path(path)
{
    _source.self = this;
    _source.base.init_source = [](j_decompress_ptr) {};
    _source.base.term_source = [](j_decompress_ptr) {};
    _source.base.fill_input_buffer = fill;
    _source.base.skip_input_data = skip;
    _source.base.resync_to_restart = jpeg_resync_to_restart;
}

std::size_t JpegFileInput::readPiece()
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(_path.c_str(), "rb"),
                                                               std::fclose);
    if (!file || std::fseek(file.get(), _place, SEEK_SET) != 0)
    {
        return Failed;
    }
    std::setvbuf(file.get(), nullptr, _IONBF, 0);
    _piece.resize(PieceBytes);
    const std::size_t count = std::fread(_piece.data(), 1, PieceBytes, file.get());
    return std::ferror(file.get()) ? Failed : count;
}

boolean JpegFileInput::fill(j_decompress_ptr jpeg)
{
    JpegFileInput& self = *reinterpret_cast<Source*>(jpeg->src)->self;
    const std::size_t count = self.readPiece();
    if (count == Failed)
    {
        ERREXIT(jpeg, JERR_FILE_READ);
    }
    if (count == 0)
    {
        // As libjpeg's own sources do: a file that ends early shows what it has.
        static const JOCTET end[] = {0xff, JPEG_EOI};
        WARNMS(jpeg, JWRN_JPEG_EOF);
        self._source.base.next_input_byte = end;
        self._source.base.bytes_in_buffer = sizeof end;
        return TRUE;
    }
    self._place += static_cast<long>(count);
    self._source.base.next_input_byte = self._piece.data();
    self._source.base.bytes_in_buffer = count;
    return TRUE;
}

void JpegFileInput::skip(j_decompress_ptr jpeg, long count)
{
    jpeg_source_mgr& source = *jpeg->src;
    while (count > static_cast<long>(source.bytes_in_buffer))
    {
        count -= static_cast<long>(source.bytes_in_buffer);
        fill(jpeg);
    }
    if (count > 0)
    {
        source.next_input_byte += count;
        source.bytes_in_buffer -= static_cast<std::size_t>(count);
    }
}

} // namespace osgPagedTexture
