// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/LabelTable.h>

#include <array>
#include <vector>

/// Keeps what a LabelTable sends and reads it as a shader does, by the documented layout alone.
class TableMirror : public osgLabels::LabelTable::Sink
{
public:
    using Codes = osgLabels::LabelTable::Codes;

    explicit TableMirror(osgLabels::LabelTable& table) : _table(table), _reader(table.makeReader())
    {
    }

    void take(std::size_t maxTextBytes = ~std::size_t(0))
    {
        sent = 0;
        calls = 0;
        layout = _table.take(*_reader, maxTextBytes, *this);
    }

    Codes codesOf(std::uint32_t identifier) const;
    /// Of the first 16 codes, of the first 32, …, of all; only with advances.
    std::vector<float> sumsOf(std::uint32_t identifier) const;
    std::uint32_t styleOf(std::uint32_t identifier) const;
    bool isSparse() const { return layout.probes != 0; }

    bool resize(osgLabels::TableBuffer buffer, std::size_t bytes, unsigned int words) override;
    void write(osgLabels::TableBuffer buffer, std::size_t offset, const void* data,
               std::size_t bytes) override;

    bool losesContent = false; ///< When a buffer grows.
    osgLabels::TableLayout layout;
    std::size_t sent = 0; ///< Bytes of the last take.
    std::size_t calls = 0;
    std::array<std::vector<std::uint32_t>, 3> buffers; ///< By TableBuffer.

private:
    std::uint32_t bitsAt(std::uint64_t at, unsigned int count) const;
    /// Slot and row.
    std::pair<std::size_t, std::uint32_t> find(std::uint32_t identifier) const;

    osgLabels::LabelTable& _table;
    std::shared_ptr<osgLabels::LabelTable::Reader> _reader;
};
