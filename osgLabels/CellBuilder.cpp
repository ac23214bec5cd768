// SPDX-License-Identifier: MIT
#include "CellBuilder.h"

#include <osgLabels/UnitMesh.h>

#include <osg/BoundingBox>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace osgLabels
{

CellBuilder::CellBuilder(const std::vector<PrimitiveBatch::Added>& added, const NameList& names,
                         unsigned int cellObjects)
    : _added(added), _addedNames(names), _cellObjects(cellObjects), _order(added.size())
{
    std::iota(_order.begin(), _order.end(), 0u);
}

PrimitiveBatch::Content CellBuilder::build()
{
    if (_order.empty())
        return {};
    split(_order.data(), _order.data() + _order.size());
    fillPages();
    _content.names.reserve(_order.size(), _addedNames.block().size());
    for (Index index : _order)
        _content.names.add(_addedNames[index]);
    return std::move(_content);
}

/// Halves at the median along the longest axis, until a cell is small enough.
void CellBuilder::split(Index* first, Index* last)
{
    if (last - first <= std::ptrdiff_t(_cellObjects))
        return addCell(first, last);
    osg::BoundingBoxd box;
    for (const Index* i = first; i != last; ++i)
        box.expandBy(_added[*i].position);
    const osg::Vec3d size = box._max - box._min;
    const int axis = size.x() >= size.y() && size.x() >= size.z() ? 0
                     : size.y() >= size.z()                       ? 1
                                                                  : 2;
    Index* middle = first + (last - first) / 2;
    // The index decides between equals, so that the order is that of any machine.
    std::nth_element(first, middle, last,
                     [&](Index a, Index b)
                     {
                         const double x = _added[a].position[axis], y = _added[b].position[axis];
                         return x != y ? x < y : a < b;
                     });
    split(first, middle);
    split(middle, last);
}

void CellBuilder::addCell(Index* first, Index* last)
{
    const auto keyOf = [this](Index i)
    {
        const PrimitiveBatch::Added& added = _added[i];
        return std::make_tuple(added.color.a() < 255, kindOf(added.record).number(),
                               -reachOf(added.record), i);
    };
    std::sort(first, last, [&](Index a, Index b) { return keyOf(a) < keyOf(b); });
    osg::BoundingBoxd box;
    for (const Index* i = first; i != last; ++i)
        box.expandBy(_added[*i].position);
    PrimitiveBatch::Cell cell;
    cell.center = box.center();
    cell.firstObject = static_cast<unsigned int>(first - _order.data());
    for (const Index* i = first; i != last; ++i)
    {
        const bool transparent = _added[*i].color.a() < 255;
        if (i == first ||
            kindOf(_added[i[-1]].record).number() != kindOf(_added[*i].record).number() ||
            (_added[i[-1]].color.a() < 255) != transparent)
            _content.runs.push_back(
                {static_cast<unsigned int>(_content.cells.size()), 0, transparent});
        ++_content.runs.back().count;
    }
    _content.cells.push_back(cell);
}

void CellBuilder::fillPages()
{
    const std::vector<PrimitiveBatch::Cell>& cells = _content.cells;
    const auto startOf = [&](std::size_t cell)
    {
        return cell < cells.size() ? cells[cell].firstObject
                                   : static_cast<unsigned int>(_order.size());
    };
    for (std::size_t first = 0, last = 0; first < cells.size(); first = last)
    {
        while (last < cells.size() && startOf(last + 1) - startOf(first) <= RecordPage::MaxObjects)
            ++last;
        const unsigned int start = startOf(first);
        osg::ref_ptr<RecordPage> page = new RecordPage(startOf(last) - start);
        std::size_t cell = first;
        for (unsigned int i = 0; i < page->size(); ++i)
        {
            while (startOf(cell + 1) <= start + i)
                ++cell;
            const PrimitiveBatch::Added& added = _added[_order[start + i]];
            const osg::Vec3d origin = added.position - cells[cell].center;
            ObjectRecord record = added.record;
            record.origin = glm::vec3(origin.x(), origin.y(), origin.z());
            page->setRecord(i, record);
            page->setColor(i, added.color);
        }
        _content.pages.push_back(page);
    }
}

} // namespace osgLabels
