// SPDX-License-Identifier: MIT
#include "Painter.h"
#include "PictureFile.h"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include <jpeglib.h>

namespace
{

constexpr int BandRows = 32;

struct Failure
{
    jpeg_error_mgr manager;
    std::jmp_buf end;
    char text[JMSG_LENGTH_MAX];
};

[[noreturn]] void stop(j_common_ptr compressor)
{
    Failure* const failure = reinterpret_cast<Failure*>(compressor->err);
    compressor->err->format_message(compressor, failure->text);
    std::longjmp(failure->end, 1);
}

void choose(jpeg_compress_struct& compressor, const Picture& picture, int quality)
{
    jpeg_set_defaults(&compressor);
    jpeg_set_quality(&compressor, quality, TRUE);
    const unsigned int kind = picture.seed >> 8 & 15;
    if (!picture.grey && kind < 3)
        compressor.comp_info[0].h_samp_factor = compressor.comp_info[0].v_samp_factor = 1;
    // Keeps its coefficients in memory.
    if (kind == 15 && picture.getPixels() < 4.5e6)
        jpeg_simple_progression(&compressor);
}

/// No object with a destructor may live here: errors jump out. False where one has.
bool compress(jpeg_compress_struct& compressor, Failure& failure, const Picture& picture,
              const Painter& painter, int rows, int every, int quality, std::uint8_t* row,
              unsigned char** bytes, unsigned long* size)
{
    compressor.err = jpeg_std_error(&failure.manager);
    failure.manager.error_exit = stop;
    if (setjmp(failure.end))
        return false;
    jpeg_create_compress(&compressor);
    jpeg_mem_dest(&compressor, bytes, size);
    compressor.image_width = JDIMENSION(picture.columns);
    compressor.image_height = JDIMENSION(rows);
    compressor.input_components = picture.grey ? 1 : 3;
    compressor.in_color_space = picture.grey ? JCS_GRAYSCALE : JCS_RGB;
    choose(compressor, picture, quality);
    jpeg_start_compress(&compressor, TRUE);
    for (int y = 0; y < rows; ++y)
    {
        painter.paint(y / BandRows * BandRows * every + y % BandRows, row);
        jpeg_write_scanlines(&compressor, &row, 1);
    }
    jpeg_finish_compress(&compressor);
    return true;
}

} // namespace

std::vector<std::uint8_t> encodeJpeg(const Picture& picture, const std::vector<Source>& sources,
                                     int quality, int everyRows)
{
    const Painter painter(picture, sources);
    std::vector<std::uint8_t> row(std::size_t(picture.columns) * 3);
    const int bands = picture.rows / (BandRows * everyRows);
    const int rows = everyRows == 1 ? picture.rows : BandRows * bands;
    jpeg_compress_struct compressor{};
    Failure failure{};
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    const bool done = compress(compressor, failure, picture, painter, rows, everyRows, quality,
                               row.data(), &bytes, &size);
    jpeg_destroy_compress(&compressor);
    std::vector<std::uint8_t> result;
    if (done)
        result.assign(bytes, bytes + size);
    std::free(bytes);
    if (!done)
        throw std::runtime_error("cannot compress '" + picture.file + "': " + failure.text);
    return result;
}
