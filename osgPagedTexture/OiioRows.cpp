// SPDX-License-Identifier: MIT
#include <osgPagedTexture/OiioFile.h>
#include <osgPagedTexture/OiioReader.h>

namespace osgPagedTexture::oiio
{

namespace
{

class OiioRows : public PhotoRows
{
public:
    OiioRows(const std::string& path, std::uint64_t fileBytes, const ImageLimits& limits,
             const PhotoRowsSettings& settings)
        : _settings(settings), _reader(path, fileBytes, limits)
    {
    }

    bool fits() const
    {
        return _reader.orientation() == 1 && _reader.spec().width == _settings.width &&
               _reader.spec().height == _settings.height;
    }
    void read(std::uint8_t* row) override
    {
        const int inBand = _y % _reader.bandRows();
        const int channels = _reader.channels();
        if (!_band || inBand == 0)
        {
            _band = _reader.readBand(_y - inBand, 0, channels);
        }
        convertRow(_band + std::size_t(inBand) * _settings.width * channels, channels, _settings,
                   row);
        ++_y;
    }
    void skip(int rows) override
    {
        if (_y / _reader.bandRows() != (_y + rows) / _reader.bandRows())
        {
            _band = nullptr;
        }
        _y += rows;
    }

private:
    const PhotoRowsSettings _settings;
    OiioReader _reader;
    const std::uint8_t* _band = nullptr;
    int _y = 0;
};

} // namespace

std::unique_ptr<PhotoRows> openRows(const std::string& path, std::uint64_t fileBytes,
                                    const PhotoRowsSettings& settings)
{
    ImageLimits limits;
    limits.maxPixels = limits.maxBytes = std::uint64_t(1) << 40; // rows come some at a time
    auto rows = std::make_unique<OiioRows>(path, fileBytes, limits, settings);
    return rows->fits() ? std::move(rows) : nullptr;
}

} // namespace osgPagedTexture::oiio
