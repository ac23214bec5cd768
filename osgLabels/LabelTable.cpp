// SPDX-License-Identifier: MIT
#include <osgLabels/LabelTable.h>

#include <osgLabels/PackedBits.h>

#include <algorithm>

namespace osgLabels
{

namespace
{

constexpr unsigned int saidLong = 1, saidIdentifier = 2, saidCode = 4, saidFull = 8;

/// Units that may wait for readers, beside a quarter of all.
constexpr std::uint64_t retiredLimit = 1 << 18;

/// Holes are worth packing everything anew when they are more than the rest and than this.
constexpr std::uint64_t holesLimit = 1 << 20;

} // namespace

class LabelTable::Reader
{
public:
    DirtyRanges texts, rows, styles;
    bool all = true;         ///< Nothing that it has is of use.
    bool allRows = true;     ///< Rows and styles have moved.
    bool atOnce = true;      ///< Texts may not be sent in parts.
    std::uint64_t clean = 0; ///< Retired blocks under this number are out of its sight.
    std::size_t sentRows = 0, sentStyles = 0; ///< Words: what lies beyond was never sent.
    TableLayout layout;                       ///< Of what it has.
};

LabelTable::LabelTable() = default;
LabelTable::~LabelTable() = default;

void LabelTable::setMessage(Message message)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _message = std::move(message);
}

void LabelTable::setAdvances(AdvanceOf advanceOf)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _texts.setAdvances(std::move(advanceOf));
}

template <typename F> void LabelTable::forEachReader(F f)
{
    for (std::size_t i = 0; i < _readers.size();)
        if (const auto reader = _readers[i].lock())
        {
            f(*reader);
            ++i;
        }
        else
        {
            _readers[i] = _readers.back();
            _readers.pop_back();
        }
}

bool LabelTable::sayOnce(unsigned int bit)
{
    const bool isFirst = !(_said & bit);
    _said |= bit;
    return isFirst;
}

bool LabelTable::setCodes(std::uint32_t identifier, const std::uint32_t* codes, std::size_t length)
{
    std::string text;
    bool result;
    Message message;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        result = setCodesLocked(identifier, codes, length, text);
        if (!text.empty())
            message = _message;
    }
    if (message)
        message("osgLabels::LabelTable: " + text);
    return result;
}

bool LabelTable::setCodesLocked(std::uint32_t identifier, const std::uint32_t* codes,
                                std::size_t length, std::string& message)
{
    if (!identifier || identifier > MaxIdentifier)
    {
        if (sayOnce(saidIdentifier))
            message = "identifier " + std::to_string(identifier) +
                      " is not within 1..2147483647, so its object has no label";
        return false;
    }
    if (length > MaxLength)
    {
        if (sayOnce(saidLong))
            message = "the text of identifier " + std::to_string(identifier) + " has " +
                      std::to_string(length) + " glyphs, the first 1024 are shown; longer texts " +
                      "are cut without further messages";
        length = MaxLength;
    }
    const TextStore::Row old = _rows.getRow(identifier);
    if (_texts.equals(old, codes, length))
        return true;

    TextStore::Row row = 0;
    if (length)
    {
        const std::uint32_t largest = *std::max_element(codes, codes + length);
        const unsigned int bits = bitsFor(largest);
        if (bits > TextStore::MaxBits)
        {
            if (sayOnce(saidCode))
                message = "glyph code " + std::to_string(largest) +
                          " is over 1048575, the text of identifier " + std::to_string(identifier) +
                          " stays as it was";
            return false;
        }
        if (bits > _texts.getBits())
            repack(bits, _texts.getShift());
        if (!makeRoom(length))
        {
            if (sayOnce(saidFull))
                message = "512 MiB of texts are stored, no more fit; the text of identifier " +
                          std::to_string(identifier) + " stays as it was";
            return false;
        }
        TextStore::Words written;
        row = _texts.add(codes, length, TextStore::hash(codes, length), written);
        forEachReader(
            [&](Reader& reader)
            {
                if (!reader.all)
                    reader.texts.add(written.begin, written.end);
            });
    }
    bool isMoved = false;
    // Before repack() could change it: the row in the table, not `old`, is the one let go.
    const TextStore::Row gone = _rows.getRow(identifier);
    const std::size_t slot = _rows.setRow(identifier, row, isMoved);
    markRow(slot, isMoved);
    release(gone);
    return true;
}

bool LabelTable::makeRoom(std::size_t length)
{
    if (_texts.fits(length))
        return true;
    if (_texts.getFreeCodes() > _texts.getEndCodes() / 8)
        repack(_texts.getBits(), _texts.getShift());
    while (!_texts.fits(length))
    {
        if ((_texts.getEndCodes() + 4 * MaxLength) * _texts.getBits() > TextStore::CapacityBits)
            return false;
        repack(_texts.getBits(), _texts.getShift() + 1);
    }
    return true;
}

void LabelTable::release(TextStore::Row row)
{
    TextStore::Block block;
    if (!row || !_texts.release(row, block))
        return;
    _retired.push_back(block);
    _retiredUnits += block.size;
    if ((_retiredUnits << _texts.getShift()) > retiredLimit + _texts.getEndCodes() / 4)
        forEachReader(
            [this](Reader& reader)
            {
                reader.clean = _firstRetired + _retired.size();
                reader.atOnce = true;
            });
    reclaim();
}

void LabelTable::reclaim()
{
    std::uint64_t clean = _firstRetired + _retired.size();
    forEachReader(
        [&](const Reader& reader)
        {
            if (!reader.all)
                clean = std::min(clean, reader.clean);
        });
    for (; _firstRetired < clean; ++_firstRetired)
    {
        _retiredUnits -= _retired.front().size;
        _texts.free(_retired.front());
        _retired.pop_front();
    }
    if (_texts.getFreeCodes() > holesLimit && _texts.getFreeCodes() * 2 > _texts.getEndCodes())
        repack(_texts.getBits(), _texts.getShift());
}

void LabelTable::repack(unsigned int bits, unsigned int shift)
{
    _rows.replace(_texts.repack(bits, shift));
    _firstRetired += _retired.size();
    _retired.clear();
    _retiredUnits = 0;
    forEachReader(
        [this](Reader& reader)
        {
            reader.all = true;
            reader.texts.clear();
            reader.rows.clear();
            reader.styles.clear();
            reader.clean = _firstRetired;
        });
}

void LabelTable::markRow(std::size_t slot, bool isMoved)
{
    const std::size_t stride = _rows.wordsPerSlot();
    forEachReader(
        [&](Reader& reader)
        {
            reader.allRows |= isMoved;
            if (slot != LabelRows::None && !reader.allRows && !reader.all)
                reader.rows.add(slot * stride, (slot + 1) * stride);
        });
}

void LabelTable::markStyle(std::size_t slot, bool isMoved)
{
    markRow(slot, isMoved); // the slot may be new
    forEachReader(
        [&](Reader& reader)
        {
            if (slot != LabelRows::None && !reader.allRows && !reader.all)
                reader.styles.add(slot, slot + 1);
        });
}

bool LabelTable::setStyle(std::uint32_t identifier, std::uint32_t style)
{
    if (!identifier || identifier > MaxIdentifier)
        return false;
    std::lock_guard<std::mutex> lock(_mutex);
    if (_rows.getStyle(identifier) == style)
        return true;
    bool isMoved = false;
    const std::size_t slot = _rows.setStyle(identifier, style, isMoved);
    markStyle(slot, isMoved);
    return true;
}

void LabelTable::remove(std::uint32_t identifier)
{
    setStyle(identifier, 0);
    if (identifier && identifier <= MaxIdentifier)
        setCodes(identifier, nullptr, 0);
}

void LabelTable::reserveCodes(std::uint32_t largest)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const unsigned int bits = std::min(bitsFor(largest), TextStore::MaxBits);
    if (bits > _texts.getBits())
        repack(bits, _texts.getShift());
}

LabelTable::Codes LabelTable::getCodes(std::uint32_t identifier) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    const TextStore::Row row = _rows.getRow(identifier);
    return row ? _texts.codesOf(row) : Codes();
}

std::uint32_t LabelTable::getStyle(std::uint32_t identifier) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _rows.getStyle(identifier);
}

TableLayout LabelTable::layout() const
{
    TableLayout result;
    result.bits = _texts.getBits();
    result.shift = _texts.getShift();
    result.log2 = _rows.getLog2();
    result.probes = _rows.getProbes();
    result.rows = static_cast<std::uint32_t>(_rows.words().size() / _rows.wordsPerSlot());
    result.styles = static_cast<std::uint32_t>(_rows.styles().size());
    return result;
}

LabelTable::Sizes LabelTable::getSizes() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    Sizes sizes;
    sizes.labels = _rows.getCount();
    sizes.texts = _texts.getTextCount();
    sizes.bits = _texts.getBits();
    sizes.textBytes = _texts.words().size() * 4;
    sizes.rowBytes = _rows.words().size() * 4;
    sizes.styleBytes = _rows.styles().size() * 4;
    sizes.mainBytes =
        _texts.getBytes() + _rows.getBytes() + _retired.size() * sizeof(TextStore::Block);
    for (const auto& entry : _readers)
        if (const auto reader = entry.lock())
            sizes.mainBytes +=
                reader->texts.getBytes() + reader->rows.getBytes() + reader->styles.getBytes();
    return sizes;
}

std::shared_ptr<LabelTable::Reader> LabelTable::makeReader()
{
    auto reader = std::make_shared<Reader>();
    std::lock_guard<std::mutex> lock(_mutex);
    _readers.push_back(reader);
    return reader;
}

namespace
{

/// Sends ranges of words from the back on until `budget` words are gone; false if some are left.
bool send(TableBuffer buffer, const std::vector<std::uint32_t>& words, DirtyRanges& dirty,
          std::size_t budget, LabelTable::Sink& sink)
{
    auto& ranges = dirty.joined();
    while (!ranges.empty() && budget)
    {
        DirtyRanges::Range& range = ranges.back();
        const std::size_t end = std::min(range.end, words.size());
        const std::size_t count = end > range.begin ? std::min(end - range.begin, budget) : 0;
        range.end = end - std::min(count, end);
        if (count)
            sink.write(buffer, (end - count) * 4, &words[end - count], count * 4);
        budget -= count;
        if (range.end <= range.begin)
            ranges.pop_back();
    }
    return ranges.empty();
}

void sendAll(TableBuffer buffer, const std::vector<std::uint32_t>& words, DirtyRanges& dirty,
             unsigned int wordsPerTexel, bool isLost, LabelTable::Sink& sink)
{
    if (!sink.resize(buffer, words.size() * 4, wordsPerTexel))
        isLost = true;
    if (isLost)
    {
        dirty.clear();
        if (!words.empty())
            sink.write(buffer, 0, words.data(), words.size() * 4);
    }
    else
        send(buffer, words, dirty, ~std::size_t(0), sink);
}

} // namespace

TableLayout LabelTable::take(Reader& reader, std::size_t maxTextBytes, Sink& sink)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto& texts = _texts.words();
    const bool isLost = !sink.resize(TableBuffer::Texts, texts.size() * 4, 1) || reader.all;
    if (!isLost && !reader.atOnce &&
        !send(TableBuffer::Texts, texts, reader.texts, maxTextBytes / 4, sink))
        return reader.layout;
    sendAll(TableBuffer::Texts, texts, reader.texts, 1, isLost, sink);
    const bool all = reader.all || reader.allRows;
    reader.rows.add(std::min(reader.sentRows, _rows.words().size()), _rows.words().size());
    reader.styles.add(std::min(reader.sentStyles, _rows.styles().size()), _rows.styles().size());
    sendAll(TableBuffer::Rows, _rows.words(), reader.rows,
            static_cast<unsigned int>(_rows.wordsPerSlot()), all, sink);
    if (!_rows.styles().empty())
        sendAll(TableBuffer::Styles, _rows.styles(), reader.styles, 1, all, sink);
    reader.all = reader.allRows = reader.atOnce = false;
    reader.sentRows = _rows.words().size();
    reader.sentStyles = _rows.styles().size();
    reader.layout = layout();
    reader.clean = _firstRetired + _retired.size();
    reclaim();
    return reader.layout;
}

} // namespace osgLabels
