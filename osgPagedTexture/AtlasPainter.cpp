// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasPainter.h>

#include <osgPagedTexture/PhotoPainter.h>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

bool meet(const PixelRect& a, const PixelRect& b)
{
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
           b.y < a.y + a.height;
}

/// What both would paint would depend on which comes last.
[[noreturn]] void refuseOverlap(const AtlasPhoto& a, const AtlasPhoto& b)
{
    throw TileStoreError(TileStoreError::Kind::Damaged,
                         "osgPagedTexture::TileBuilder: the photographs '" + a.path + "' and '" +
                             b.path +
                             "' lie closer to each other than their padding; make the layout anew");
}

} // namespace

void fillPixels(std::uint8_t* pixels, std::int64_t count, int channels, const TileColor& color)
{
    for (std::int64_t i = 0; i < count; ++i, pixels += channels)
    {
        std::copy_n(color.begin(), channels, pixels);
    }
}

AtlasPainter::AtlasPainter(const AtlasLayout& layout, const Settings& settings)
    : _layout(layout), _settings(settings)
{
    for (std::size_t i = 0; i < layout.photos.size(); ++i)
    {
        if (meet(layout.getCovered(layout.photos[i]), settings.window))
        {
            _order.push_back(i);
        }
    }
    std::stable_sort(
        _order.begin(), _order.end(),
        [&](std::size_t a, std::size_t b)
        { return layout.getCovered(layout.photos[a]).y < layout.getCovered(layout.photos[b]).y; });
}

AtlasPainter::~AtlasPainter() = default;

std::size_t AtlasPainter::begin(std::int64_t y, std::int64_t endY)
{
    _y = y;
    _endY = endY;
    _begun.clear();
    _open.erase(std::remove_if(_open.begin(), _open.end(),
                               [y](const std::unique_ptr<PhotoPainter>& photo)
                               {
                                   const PixelRect& covered = photo->getCovered();
                                   return covered.y + covered.height <= y;
                               }),
                _open.end());
    for (; _nextPhoto < _order.size(); ++_nextPhoto)
    {
        const AtlasPhoto& photo = _layout.photos[_order[_nextPhoto]];
        const PixelRect covered = _layout.getCovered(photo);
        if (covered.y >= endY)
        {
            break;
        }
        _begun.push_back(_order[_nextPhoto]);
        _open.push_back(std::make_unique<PhotoPainter>(
            photo, covered,
            PhotoPainter::Settings{_settings.folder, _settings.channels, _settings.background,
                                   _settings.cut},
            _begun.back()));
    }
    if (!_begun.empty())
    {
        std::sort(_open.begin(), _open.end(),
                  [](const std::unique_ptr<PhotoPainter>& a, const std::unique_ptr<PhotoPainter>& b)
                  { return a->getCovered().x < b->getCovered().x; });
    }
    return _open.size() + 1;
}

void AtlasPainter::paint(std::size_t part, LevelRows& rows)
{
    if (part == _open.size())
    {
        fillGaps(rows);
        return;
    }
    PhotoPainter& photo = *_open[part];
    photo.paint(_y, _endY, rows);
    if (std::string cause = photo.takeFailure(); !cause.empty())
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _failures.push_back({photo.getIndex(), std::move(cause)});
    }
}

/// What no photograph covers: between two rows where one begins or ends it is the same columns.
void AtlasPainter::fillGaps(LevelRows& rows) const
{
    std::vector<std::int64_t> edges{_y, _endY};
    for (const auto& photo : _open)
    {
        const PixelRect& covered = photo->getCovered();
        edges.push_back(std::clamp(covered.y, _y, _endY));
        edges.push_back(std::clamp(covered.y + covered.height, _y, _endY));
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    {
        const auto fill = [&](std::int64_t x, std::int64_t endX)
        {
            for (std::int64_t y = edges[i]; y < edges[i + 1] && x < endX; ++y)
            {
                fillPixels(rows.at(x, y), endX - x, rows.getChannels(), _settings.background);
            }
        };
        if (edges[i] == edges[i + 1])
        {
            continue;
        }
        const std::int64_t end = rows.getX() + rows.getWidth();
        std::int64_t x = rows.getX();
        const PhotoPainter* left = nullptr;
        for (const auto& photo : _open)
        {
            const PixelRect& covered = photo->getCovered();
            if (covered.y <= edges[i] && covered.y + covered.height > edges[i])
            {
                if (left && covered.x < left->getCovered().x + left->getCovered().width)
                {
                    refuseOverlap(_layout.photos[left->getIndex()],
                                  _layout.photos[photo->getIndex()]);
                }
                fill(x, std::min(covered.x, end));
                x = std::max(x, covered.x + covered.width);
                left = photo.get();
            }
        }
        fill(x, end);
    }
}

std::shared_ptr<JpegCutter> AtlasPainter::findCutter(const PixelRect& inAtlas,
                                                     PixelRect& inPhoto) const
{
    for (const auto& photo : _open)
    {
        if (auto cutter = photo->findCutter(inAtlas, inPhoto))
        {
            return cutter;
        }
    }
    return nullptr;
}

std::vector<PhotoFailure> AtlasPainter::getFailures() const
{
    const std::lock_guard<std::mutex> lock(_mutex);
    std::vector<PhotoFailure> failures = _failures;
    std::stable_sort(failures.begin(), failures.end(),
                     [](const PhotoFailure& a, const PhotoFailure& b)
                     { return a.photo < b.photo; });
    return failures;
}

} // namespace osgPagedTexture
