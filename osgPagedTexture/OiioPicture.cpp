// SPDX-License-Identifier: MIT
#include <osgPagedTexture/OiioFile.h>

#include <osgPagedTexture/OiioTarget.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <filesystem>
#include <vector>

namespace osgPagedTexture::oiio
{

namespace
{

using Kind = TileStoreError::Kind;

[[noreturn]] void fail(Kind kind, const std::string& what)
{
    throw TileStoreError(kind, "osgPagedTexture::TileStore: " + what);
}

std::string oneLine(const std::string& text)
{
    return OIIO::Strutil::replace(OIIO::Strutil::strip(text), "\n", " ", true);
}

class Writer : public PictureWriter
{
public:
    Writer(const std::string& path, int width, int height, int channels)
        : _path(path), _spec(width, height, channels, OIIO::TypeUInt8),
          _output(OIIO::ImageOutput::create(path))
    {
        _spec.attribute("oiio:UnassociatedAlpha", 1);
        _spec.attribute("oiio:ColorSpace", "sRGB");
        check(_output != nullptr);
    }
    ~Writer() override
    {
        if (_finished || !_started)
        {
            return;
        }
        // Else libpng complains on the terminal about a picture that ends early.
        const std::vector<std::uint8_t> blank(std::size_t(_spec.width) * _spec.nchannels);
        while (_open && _y < _spec.height &&
               _output->write_scanline(_y, 0, OIIO::TypeUInt8, blank.data()))
        {
            ++_y;
        }
        _output.reset();
        std::error_code error;
        std::filesystem::remove(_path, error);
    }

    void write(const std::uint8_t* row) override
    {
        // Not before there is something to write: no file comes of a damaged store.
        if (_y == 0)
        {
            _target = OiioTarget::lead(*_output, _path);
            _started = true;
            _open = _output->open(_path, _spec);
            check(_open);
        }
        check(_output->write_scanline(_y++, 0, OIIO::TypeUInt8, row));
    }
    void finish() override
    {
        check(_output->close());
        checkWritten(_target.get(), _path);
        _finished = true;
    }

private:
    void check(bool good) const
    {
        if (_target)
        {
            _target->check();
        }
        if (!good)
        {
            if (_started)
            {
                checkWritten(_target.get(), _path);
            }
            const std::string cause = oneLine(_output ? _output->geterror() : OIIO::geterror());
            fail(Kind::Unwritable, "'" + _path + "' cannot be written (" + cause +
                                       "); name a file like region.png where there is room");
        }
    }

    const std::string _path;
    OIIO::ImageSpec _spec;
    std::unique_ptr<OiioTarget> _target; ///< Or null.
    std::unique_ptr<OIIO::ImageOutput> _output;
    int _y = 0;
    bool _started = false; ///< There is a file.
    bool _open = false, _finished = false;
};

} // namespace

std::unique_ptr<PictureWriter> openWriter(const std::string& path, int width, int height,
                                          int channels)
{
    return std::make_unique<Writer>(path, width, height, channels);
}

Pixels decodeTile(const std::string& bytes, const std::string& name)
{
    const bool dds = bytes.compare(0, 4, "DDS ") == 0;
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::create(dds ? "dds" : "png");
    if (!input || !input->set_ioproxy(&memory) || !input->open("tile", spec, config))
    {
        const std::string cause = oneLine(input ? input->geterror() : OIIO::geterror());
        fail(Kind::Damaged, name + " is no picture (" + cause + "); build the store anew");
    }
    // A tile's side is some hundred pixels: more is a damaged header that would take memory.
    constexpr int maxSide = 1 << 15;
    if (input->spec().width > maxSide || input->spec().height > maxSide ||
        input->spec().nchannels > 4)
    {
        fail(Kind::Damaged, name + " is no tile; build the store anew");
    }
    input->threads(1);
    Pixels pixels(input->spec().width, input->spec().height, input->spec().nchannels);
    const auto stride = static_cast<OIIO::stride_t>(pixels.width) * pixels.channels;
    if (!input->read_image(0, 0, 0, pixels.channels, OIIO::TypeUInt8, pixels.row(pixels.height - 1),
                           OIIO::AutoStride, -stride))
    {
        fail(Kind::Damaged,
             name + " is damaged (" + oneLine(input->geterror()) + "); build the store anew");
    }
    return pixels;
}

} // namespace osgPagedTexture::oiio
