// SPDX-License-Identifier: MIT
#include <osgPagedTexture/JpegCutter.h>

#include <osgPagedTexture/JpegFile.h>
#include <osgPagedTexture/TileStore.h>

#include <cstdlib>
#include <cstring>

namespace osgPagedTexture
{

namespace
{

struct CutErrors
{
    jpeg_error_mgr base; ///< First: libjpeg gives back a pointer to it.
    std::jmp_buf jump;
    char text[JMSG_LENGTH_MAX];
};

void fail(j_common_ptr jpeg)
{
    auto* errors = reinterpret_cast<CutErrors*>(jpeg->err);
    errors->base.format_message(jpeg, errors->text);
    std::longjmp(errors->jump, 1);
}

/// Of a component, in blocks.
struct BlockPart
{
    JDIMENSION x, y, width, height;
};

BlockPart blocksOf(const PixelRect& part, const jpeg_component_info& component,
                   const jpeg_decompress_struct& from)
{
    const auto scale = [](std::int64_t pixels, int factor, int most)
    { return static_cast<JDIMENSION>(pixels / DCTSIZE * factor / most); };
    return {scale(part.x, component.h_samp_factor, from.max_h_samp_factor),
            scale(part.y, component.v_samp_factor, from.max_v_samp_factor),
            scale(part.width, component.h_samp_factor, from.max_h_samp_factor),
            scale(part.height, component.v_samp_factor, from.max_v_samp_factor)};
}

/// libjpeg's errors are jumps: nothing with a destructor may live in here. The result belongs to
/// the caller, also where it failed.
bool write(jpeg_decompress_struct& from, jvirt_barray_ptr* coefficients, const PixelRect& part,
           CutErrors& errors, unsigned char** bytes, unsigned long* count)
{
    jpeg_compress_struct to{};
    to.err = jpeg_std_error(&errors.base);
    errors.base.error_exit = fail;
    if (setjmp(errors.jump))
    {
        jpeg_destroy_compress(&to);
        return false;
    }
    jpeg_create_compress(&to);
    jpeg_mem_dest(&to, bytes, count);
    jpeg_copy_critical_parameters(&from, &to);
    to.image_width = static_cast<JDIMENSION>(part.width);
    to.image_height = static_cast<JDIMENSION>(part.height);
    jvirt_barray_ptr arrays[MAX_COMPONENTS];
    for (int i = 0; i < to.num_components; ++i)
    {
        const BlockPart blocks = blocksOf(part, from.comp_info[i], from);
        arrays[i] = to.mem->request_virt_barray(
            reinterpret_cast<j_common_ptr>(&to), JPOOL_IMAGE, FALSE, blocks.width, blocks.height,
            static_cast<JDIMENSION>(to.comp_info[i].v_samp_factor));
    }
    jpeg_write_coefficients(&to, arrays); // makes room for the arrays; they are read at the end
    for (int i = 0; i < to.num_components; ++i)
    {
        const BlockPart blocks = blocksOf(part, from.comp_info[i], from);
        for (JDIMENSION y = 0; y < blocks.height; ++y)
        {
            const JBLOCKARRAY source = from.mem->access_virt_barray(
                reinterpret_cast<j_common_ptr>(&from), coefficients[i], blocks.y + y, 1, FALSE);
            const JBLOCKARRAY target = to.mem->access_virt_barray(
                reinterpret_cast<j_common_ptr>(&to), arrays[i], y, 1, TRUE);
            std::memcpy(target[0], source[0] + blocks.x, blocks.width * sizeof(JBLOCK));
        }
    }
    jpeg_finish_compress(&to);
    jpeg_destroy_compress(&to);
    return true;
}

} // namespace

std::shared_ptr<JpegCutter> JpegCutter::open(std::shared_ptr<JpegDecoder> decoder,
                                             const std::string& name)
{
    const jpeg_decompress_struct& jpeg = decoder->info();
    const bool grey = jpeg.jpeg_color_space == JCS_GRAYSCALE && jpeg.num_components == 1;
    const bool color = jpeg.jpeg_color_space == JCS_YCbCr && jpeg.num_components == 3;
    if ((!grey && !color) || jpeg.data_precision != 8)
    {
        return nullptr;
    }
    jvirt_barray_ptr* const coefficients = decoder->startWithCoefficients();
    if (!coefficients)
    {
        throw damagedJpeg(name, decoder->getError());
    }
    return std::shared_ptr<JpegCutter>(new JpegCutter(std::move(decoder), coefficients));
}

bool JpegCutter::canCut(const PixelRect& part) const
{
    const jpeg_decompress_struct& jpeg = _decoder->info();
    const int stepX = DCTSIZE * jpeg.max_h_samp_factor, stepY = DCTSIZE * jpeg.max_v_samp_factor;
    return part.x >= 0 && part.y >= 0 && part.x + part.width <= jpeg.image_width &&
           part.y + part.height <= jpeg.image_height && part.x % stepX == 0 &&
           part.y % stepY == 0 && part.width % stepX == 0 && part.height % stepY == 0;
}

std::string JpegCutter::cut(const PixelRect& part) const
{
    CutErrors errors;
    unsigned char* bytes = nullptr;
    unsigned long count = 0;
    const bool good = write(_decoder->info(), _coefficients, part, errors, &bytes, &count);
    const std::unique_ptr<unsigned char, void (*)(void*)> freed(bytes, std::free);
    if (!good)
    {
        throw TileStoreError(TileStoreError::Kind::Refused,
                             std::string("osgPagedTexture::JpegCutter: a part of a photograph "
                                         "cannot be cut (") +
                                 errors.text + "); build without lossless cuts");
    }
    return {reinterpret_cast<const char*>(bytes), count};
}

} // namespace osgPagedTexture
