// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualContext.h>

#include <osgPagedTexture/BlockEncoder.h>
#include <osgPagedTexture/ContextPace.h>
#include <osgPagedTexture/ThreadClock.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace osgPagedTexture
{

namespace
{

/// Views that were not drawn for so many draws of others are gone.
constexpr unsigned int usesUnused = 256;

/// Of all contexts and scenes: a pager is shared by contexts.
std::atomic<unsigned int> nextView{0};

} // namespace

SlotGrid SlotGrid::fit(std::uint64_t bytes, std::uint64_t pageBytes, int side, int maxSide)
{
    SlotGrid grid;
    grid.side = side;
    const int most = std::max(1, maxSide / side);
    const std::uint64_t wanted =
        std::clamp<std::uint64_t>(bytes / std::max<std::uint64_t>(1, pageBytes), 1,
                                  std::uint64_t(most) * std::uint64_t(most));
    grid.columns = std::min(most, int(std::ceil(std::sqrt(double(wanted)))));
    grid.rows = std::clamp(int(wanted / std::uint64_t(grid.columns)), 1, most);
    return grid;
}

VirtualContext::VirtualContext(unsigned int contextID, std::shared_ptr<VirtualPager> pager,
                               const SlotGrid& slots)
    : osg::Referenced(true), _contextID(contextID), _pager(std::move(pager)), _slots(slots),
      _tables(slots.count()),
      _pages(new UploadTexture(UploadTexture::formatOf(_pager->getSettings().format),
                               slots.columns * slots.side, slots.rows * slots.side)),
      _stateSet(new osg::StateSet)
{
    _stateSet->setTextureAttribute(PagesUnit, _pages);
}

VirtualContext::~VirtualContext()
{
    _pager->removeContext(_contextID);
    for (const auto& each : _views)
        _pager->removeView(each.second.number);
}

VirtualContext::View& VirtualContext::viewOf(const osg::Camera* camera)
{
    ++_uses;
    View& view = _views[camera];
    view.lastUse = _uses;
    if (!view.feedback)
    {
        view.feedback = std::make_unique<VirtualFeedback>(_contextID);
        view.number = nextView++;
    }
    for (auto each = _views.begin(); each != _views.end();)
        if (each->second.lastUse + usesUnused < _uses)
        {
            _pager->removeView(each->second.number);
            each = _views.erase(each);
        }
        else
            ++each;
    return view;
}

void VirtualContext::add(std::uint32_t number, const VirtualTexture& texture)
{
    const auto [found, isNew] = _shown.try_emplace(number);
    found->second.textures.insert(&texture);
    if (!isNew)
        return;
    found->second.grid = _pager->getGrid(number);
    _tables.add(number, found->second.grid);
}

bool VirtualContext::upload(osg::State& state, double milliseconds, double seconds)
{
    UploadPace& pace = ContextPace::of(state).begin(state, milliseconds);
    _lastUploaded = 0;
    _lastPages = 0;
    bool isComplete = false;
    double start = threadMilliseconds();
    for (std::uint64_t piece = pace.piece(); piece > 0 && !isComplete; piece = pace.piece())
    {
        const PageUploads uploads = _pager->takeUploads(_contextID, piece);
        apply(state, uploads, seconds);
        isComplete = uploads.isComplete;
        const double now = threadMilliseconds();
        pace.took(uploads.bytes, now - start);
        start = now;
    }
    showCoarsest(state);
    _tables.upload(state);
    _stateSet->setTextureAttribute(TableUnit, _tables.getTexture());
    return isComplete;
}

void VirtualContext::apply(osg::State& state, const PageUploads& uploads, double seconds)
{
    for (const PageUpload& page : uploads.pages)
    {
        const int x = page.slot % _slots.columns, y = page.slot / _slots.columns;
        _pages->upload(state, x * _slots.side, y * _slots.side, _slots.side, _slots.side,
                       page.texels->data(), page.texels->size());
        _tables.setTime(page.slot, page.isRefresh ? -1e9f : float(seconds));
        if (!page.isRefresh)
            _lastArrival = seconds;
        const auto shown = _shown.find(page.page.texture);
        if (shown != _shown.end() && page.page.level == pageLevels(shown->second.grid) - 1)
            _coarsest[page.slot] = page.texels;
        else
            _coarsest.erase(page.slot);
    }
    for (const TablePatch& patch : uploads.tables)
    {
        if (_shown.find(patch.texture) == _shown.end())
        {
            const TileGrid grid = _pager->getGrid(patch.texture);
            _shown[patch.texture].grid = grid;
            _tables.add(patch.texture, grid);
        }
        _tables.apply(patch);
    }
    _lastUploaded += uploads.bytes;
    _lastPages += uploads.pages.size();
}

/// What is coarser than a single page is the texture's image: it goes with the tables to another
/// state of the store.
void VirtualContext::showCoarsest(osg::State& state)
{
    for (auto& [number, shown] : _shown)
    {
        const std::uint32_t entry = _tables.coarsestOf(number);
        const auto found =
            entry == PageEntry::Empty ? _coarsest.end() : _coarsest.find(PageEntry::slotOf(entry));
        if (found == _coarsest.end() || found->second == shown.coarsest)
            continue;
        // The first one is what the image was made of.
        const bool isOther = shown.coarsest && *shown.coarsest != *found->second;
        shown.coarsest = found->second;
        for (const osg::observer_ptr<const VirtualTexture>& each : shown.textures)
            if (osg::ref_ptr<const VirtualTexture> texture; isOther && each.lock(texture))
                texture->showPicture(state, pictureOf(number, *shown.coarsest));
    }
}

Pixels VirtualContext::pictureOf(std::uint32_t number, const PageTexels& texels) const
{
    const TileGrid& grid = _shown.at(number).grid;
    const BlockFormat format = _pager->getSettings().format;
    const int side = _slots.side, border = grid.getBorder(), last = pageLevels(grid) - 1;
    Pixels page(side, side, 4);
    if (format == BlockFormat::RGBA8)
        page.bytes = texels;
    else
        page = decodeBlocks(texels, format, side, side);
    Pixels picture(int(grid.getWidth(last)), int(grid.getHeight(last)), page.channels);
    for (int y = 0; y < picture.height; ++y)
        std::copy_n(page.row(border + y) + border * page.channels, picture.width * picture.channels,
                    picture.row(picture.height - 1 - y));
    return picture;
}

void VirtualContext::releaseGLObjects(osg::State* state)
{
    _pages->releaseGLObjects(state);
    if (_tables.getTexture())
        _tables.getTexture()->releaseGLObjects(state);
    for (auto& each : _views)
        each.second.feedback->releaseGLObjects(state);
}

} // namespace osgPagedTexture
