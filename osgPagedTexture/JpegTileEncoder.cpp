// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileEncoder.h>

#include <osgPagedTexture/TileStore.h>

#include <csetjmp>
#include <cstdio>
#include <vector>

#include <jpeglib.h>

namespace osgPagedTexture
{

namespace
{

/// libjpeg's errors are jumps: nothing with a destructor may live in the functions that call it.
class JpegTileEncoder : public TileEncoder
{
public:
    JpegTileEncoder(int quality, ChromaSampling chroma) : _quality(quality), _chroma(chroma)
    {
        _jpeg.err = jpeg_std_error(&_errors.base);
        _errors.base.error_exit = fail;
        _jpeg.client_data = this;
        _target.init_destination = start;
        _target.empty_output_buffer = grow;
        _target.term_destination = [](j_compress_ptr) {};
        _buffer.resize(64 << 10);
    }
    ~JpegTileEncoder() override { jpeg_destroy_compress(&_jpeg); }

    std::string encode(const TileRows& tile) override
    {
        if (!compress(tile))
        {
            // What was set up is half used: the next tile starts anew.
            jpeg_destroy_compress(&_jpeg);
            _channels = 0;
            throw TileStoreError(TileStoreError::Kind::Refused,
                                 std::string("osgPagedTexture::TileEncoder: a tile of ") +
                                     std::to_string(tile.width) + " x " +
                                     std::to_string(tile.height) + " pixels is no JPEG (" +
                                     _errors.text + "); choose another format");
        }
        return {reinterpret_cast<const char*>(_buffer.data()),
                _buffer.size() - _target.free_in_buffer};
    }

private:
    struct Errors
    {
        jpeg_error_mgr base; ///< First: libjpeg gives back a pointer to it.
        std::jmp_buf jump;
        char text[JMSG_LENGTH_MAX];
    };

    static void fail(j_common_ptr jpeg)
    {
        auto* errors = reinterpret_cast<Errors*>(jpeg->err);
        errors->base.format_message(jpeg, errors->text);
        std::longjmp(errors->jump, 1);
    }
    static void start(j_compress_ptr jpeg)
    {
        auto& self = *static_cast<JpegTileEncoder*>(jpeg->client_data);
        self._target.next_output_byte = self._buffer.data();
        self._target.free_in_buffer = self._buffer.size();
    }
    static boolean grow(j_compress_ptr jpeg)
    {
        auto& self = *static_cast<JpegTileEncoder*>(jpeg->client_data);
        const std::size_t before = self._buffer.size();
        self._buffer.resize(2 * before);
        self._target.next_output_byte = self._buffer.data() + before;
        self._target.free_in_buffer = before;
        return TRUE;
    }

    bool compress(const TileRows& tile)
    {
        if (setjmp(_errors.jump))
        {
            return false;
        }
        if (_channels != tile.channels)
        {
            setUp(tile.channels);
        }
        _jpeg.image_width = static_cast<JDIMENSION>(tile.width);
        _jpeg.image_height = static_cast<JDIMENSION>(tile.height);
        jpeg_start_compress(&_jpeg, TRUE);
        while (_jpeg.next_scanline < _jpeg.image_height)
        {
            jpeg_write_scanlines(&_jpeg, const_cast<JSAMPARRAY>(tile.rows + _jpeg.next_scanline),
                                 _jpeg.image_height - _jpeg.next_scanline);
        }
        jpeg_finish_compress(&_jpeg);
        return true;
    }

    void setUp(int channels)
    {
        jpeg_destroy_compress(&_jpeg);
        jpeg_create_compress(&_jpeg);
        _jpeg.dest = &_target;
        _jpeg.input_components = channels;
        _jpeg.in_color_space = channels == 1   ? JCS_GRAYSCALE
                               : channels == 3 ? JCS_RGB
                                               : JCS_EXT_RGBX;
        jpeg_set_defaults(&_jpeg);
        jpeg_set_quality(&_jpeg, _quality, TRUE);
        if (channels > 1)
        {
            _jpeg.comp_info[0].h_samp_factor = _chroma == ChromaSampling::Full ? 1 : 2;
            _jpeg.comp_info[0].v_samp_factor = _chroma == ChromaSampling::Quarter ? 2 : 1;
        }
        _channels = channels;
    }

    const int _quality;
    const ChromaSampling _chroma;
    int _channels = 0; ///< That it is set up for.
    Errors _errors{};
    jpeg_destination_mgr _target{};
    jpeg_compress_struct _jpeg{};
    std::vector<JOCTET> _buffer;
};

} // namespace

std::unique_ptr<TileEncoder> makeJpegTileEncoder(int quality, ChromaSampling chroma)
{
    return std::make_unique<JpegTileEncoder>(quality, chroma);
}

} // namespace osgPagedTexture
