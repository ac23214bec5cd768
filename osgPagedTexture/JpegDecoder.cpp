// SPDX-License-Identifier: MIT
#include <osgPagedTexture/JpegDecoder.h>

#include <algorithm>
#include <cstring>

namespace osgPagedTexture
{

namespace
{

/// Encoders write some ten scans. A file may hold thousands of tiny ones, each of which takes the
/// time of the whole picture.
constexpr int maxScans = 200;

} // namespace

void JpegDecoder::fail(j_common_ptr info)
{
    auto* errors = reinterpret_cast<Errors*>(info->err);
    errors->base.format_message(info, errors->error);
    std::longjmp(errors->jump, 1);
}

void JpegDecoder::note(j_common_ptr info, int level)
{
    if (level >= 0) // a trace
    {
        return;
    }
    auto* errors = reinterpret_cast<Errors*>(info->err);
    if (errors->base.num_warnings++ == 0)
    {
        errors->base.format_message(info, errors->warning);
    }
}

void JpegDecoder::watch(j_common_ptr info)
{
    if (info->is_decompressor &&
        reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > maxScans)
    {
        auto* errors = reinterpret_cast<Errors*>(info->err);
        std::strcpy(errors->error, "more than 200 scans");
        std::longjmp(errors->jump, 1);
    }
}

JpegDecoder::JpegDecoder(const std::string& bytes) : _bytes(&bytes)
{
    setUp();
}

JpegDecoder::JpegDecoder(JpegFileInput& input) : _input(&input)
{
    setUp();
}

void JpegDecoder::setUp()
{
    _info.err = jpeg_std_error(&_errors.base);
    _errors.base.error_exit = fail;
    _errors.base.emit_message = note;
    _progress.progress_monitor = watch;
}

JpegDecoder::~JpegDecoder()
{
    jpeg_destroy_decompress(&_info);
}

bool JpegDecoder::readHeader()
{
    if (setjmp(_errors.jump))
    {
        return false;
    }
    jpeg_create_decompress(&_info);
    _info.progress = &_progress;
    jpeg_save_markers(&_info, JPEG_APP0 + 1, 0xffff);
    if (_input)
    {
        _info.src = _input->source();
    }
    else
    {
        jpeg_mem_src(&_info, reinterpret_cast<const unsigned char*>(_bytes->data()),
                     static_cast<unsigned long>(_bytes->size()));
    }
    return jpeg_read_header(&_info, TRUE) == JPEG_HEADER_OK;
}

bool JpegDecoder::start()
{
    if (setjmp(_errors.jump))
    {
        return false;
    }
    return jpeg_start_decompress(&_info);
}

jvirt_barray_ptr* JpegDecoder::startWithCoefficients()
{
    if (setjmp(_errors.jump))
    {
        return nullptr;
    }
    _info.buffered_image = TRUE;
    jpeg_start_decompress(&_info);
    while (!jpeg_input_complete(&_info))
    {
        if (jpeg_consume_input(&_info) == JPEG_SUSPENDED)
        {
            return nullptr; // no source of ours does that
        }
    }
    jvirt_barray_ptr* const coefficients = jpeg_read_coefficients(&_info);
    jpeg_start_output(&_info, _info.input_scan_number);
    return coefficients;
}

bool JpegDecoder::readRow(JSAMPROW row)
{
    if (setjmp(_errors.jump))
    {
        return false;
    }
    return jpeg_read_scanlines(&_info, &row, 1) == 1;
}

bool JpegDecoder::skipRows(unsigned int count)
{
    if (setjmp(_errors.jump))
    {
        return false;
    }
    return jpeg_skip_scanlines(&_info, count) == count;
}

bool JpegDecoder::finish()
{
    if (setjmp(_errors.jump))
    {
        return false;
    }
    return jpeg_finish_decompress(&_info);
}

std::string JpegDecoder::getExif() const
{
    for (jpeg_saved_marker_ptr marker = _info.marker_list; marker; marker = marker->next)
    {
        std::string data(reinterpret_cast<const char*>(marker->data), marker->data_length);
        if (marker->marker == JPEG_APP0 + 1 && data.compare(0, 4, "Exif") == 0)
        {
            return data;
        }
    }
    return {};
}

} // namespace osgPagedTexture
