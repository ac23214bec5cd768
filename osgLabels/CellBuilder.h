// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/PrimitiveBatch.h>

namespace osgLabels
{

/// Sorts the objects that were added to a batch into cells, pages and runs.
class CellBuilder
{
public:
    /// At most `cellObjects` objects a cell.
    CellBuilder(const std::vector<PrimitiveBatch::Added>& added, const NameList& names,
                unsigned int cellObjects);

    PrimitiveBatch::Content build();

private:
    using Index = std::uint32_t;

    void split(Index* first, Index* last);
    void addCell(Index* first, Index* last);
    void fillPages();

    const std::vector<PrimitiveBatch::Added>& _added;
    const NameList& _addedNames;
    unsigned int _cellObjects;
    std::vector<Index> _order;
    PrimitiveBatch::Content _content;
};

} // namespace osgLabels
