// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PageContext.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace osgPagedTexture
{

void PageContext::addTexture(std::uint32_t texture, const TileGrid& grid, int finestAllowed)
{
    _tables.emplace(texture, Table{PageTable(grid, finestAllowed), 0});
}

void PageContext::removeTexture(std::uint32_t texture)
{
    _tables.erase(texture);
    for (auto order = _orders.begin(); order != _orders.end();)
    {
        const bool isOfIt = order->isSwitch ? order->change.texture == texture
                                            : order->upload.content.page.page.texture == texture;
        if (!isOfIt)
        {
            ++order;
            continue;
        }
        if (!order->isSwitch)
        {
            _queuedBytes -= order->upload.texels->size();
            _waiting.erase(order->upload.slot);
        }
        for (const Upload& upload : order->change.uploads)
        {
            _queuedBytes -= upload.texels->size();
        }
        order = _orders.erase(order);
    }
    for (std::size_t slot = 0; slot < _shown.size(); ++slot)
    {
        if (_shown[slot].content.page.page.texture == texture)
        {
            _shown[slot] = {};
        }
        const auto waiting = _waiting.find(int(slot));
        _expected[slot] = waiting == _waiting.end() ? serialOf(int(slot))
                                                    : waiting->second->upload.content.serial;
    }
}

void PageContext::order(const Upload& upload)
{
    const auto waiting = _waiting.find(upload.slot);
    if (waiting != _waiting.end())
    {
        _queuedBytes -= waiting->second->upload.texels->size();
        _orders.erase(waiting->second);
    }
    _orders.push_back({false, upload, {}});
    _waiting[upload.slot] = std::prev(_orders.end());
    _queuedBytes += upload.texels->size();
    _expected[std::size_t(upload.slot)] = upload.content.serial;
}

void PageContext::order(Switch change)
{
    for (const Upload& upload : change.uploads)
    {
        _queuedBytes += upload.texels->size();
        _expected[std::size_t(upload.slot)] = upload.content.serial;
    }
    _orders.push_back({true, {}, std::move(change)});
}

void PageContext::setMapped(int slot, bool isMapped)
{
    Shown& shown = _shown[std::size_t(slot)];
    const PageKey& page = shown.content.page.page;
    const auto table = _tables.find(page.texture);
    if (shown.isMapped != isMapped && table != _tables.end())
    {
        isMapped ? table->second.table.map(page, slot) : table->second.table.unmap(page, slot);
    }
    shown.isMapped = isMapped;
}

void PageContext::carryOut(const Upload& upload, PageUploads& uploads)
{
    setMapped(upload.slot, false);
    _shown[std::size_t(upload.slot)].content = upload.content;
    setMapped(upload.slot, upload.isShown);
    _queuedBytes -= upload.texels->size();
    uploads.bytes += upload.texels->size();
    uploads.pages.push_back(
        {upload.slot, upload.content.page.page, upload.texels, upload.isRefresh});
}

void PageContext::carryOut(const Switch& change, PageUploads& uploads)
{
    for (const Carried& carried : change.carried)
    {
        if (serialOf(carried.slot) == carried.serial)
        {
            _shown[std::size_t(carried.slot)].content.page.generation = change.generation;
        }
    }
    for (const Upload& upload : change.uploads)
    {
        carryOut(upload, uploads);
    }
    const auto forEach = [&](bool isNew, bool isMapped)
    {
        for (std::size_t slot = 0; slot < _shown.size(); ++slot)
        {
            const Content& content = _shown[slot].content;
            if (content.serial != 0 && content.page.page.texture == change.texture &&
                (content.page.generation == change.generation) == isNew)
            {
                setMapped(int(slot), isMapped);
            }
        }
    };
    forEach(true, true);
    forEach(false, false);
}

PageUploads PageContext::take(std::uint64_t maxBytes)
{
    PageUploads uploads;
    while (!_orders.empty() && maxBytes > 0)
    {
        Order& order = _orders.front();
        if (order.isSwitch)
        {
            carryOut(order.change, uploads);
        }
        else
        {
            if (uploads.bytes > 0 && uploads.bytes + order.upload.texels->size() > maxBytes)
            {
                break;
            }
            carryOut(order.upload, uploads);
            _waiting.erase(order.upload.slot);
        }
        _orders.pop_front();
    }
    uploads.isComplete = _orders.empty();
    takePatches(uploads);
    return uploads;
}

void PageContext::takePatches(PageUploads& uploads)
{
    for (auto& [texture, each] : _tables)
    {
        PageTable& table = each.table;
        std::shared_ptr<const PageTableLayout> layout;
        if (each.sentVersion != table.getLayoutVersion())
        {
            each.sentVersion = table.getLayoutVersion();
            layout = std::make_shared<const PageTableLayout>(table.getLayout());
        }
        for (const TableRect& rect : table.takeChanges())
        {
            TablePatch patch{texture, layout, rect, {}};
            patch.entries.reserve(std::size_t(rect.width) * rect.height);
            for (int y = rect.y; y < rect.y + rect.height; ++y)
            {
                const auto row = table.getEntries().begin() +
                                 std::ptrdiff_t(y) * table.getLayout().width + rect.x;
                patch.entries.insert(patch.entries.end(), row, row + rect.width);
            }
            uploads.tables.push_back(std::move(patch));
        }
    }
}

} // namespace osgPagedTexture
