// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/DirtyRanges.h>
#include <osgLabels/Export.h>
#include <osgLabels/LabelRows.h>
#include <osgLabels/TextStore.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace osgLabels
{

/// The buffers of a LabelTable on the GPU.
enum class TableBuffer
{
    Texts, ///< 32-bit words of packed codes.
    Rows,  ///< One word an identifier, or two a slot where identifiers are sparse.
    Styles ///< One word an identifier or slot; empty unless a style was set.
};

/// What shaders must know to read a LabelTable's buffers.
struct TableLayout
{
    unsigned int bits = 1;    ///< Of a code.
    unsigned int shift = 0;   ///< Offsets count 2^shift codes.
    unsigned int log2 = 0;    ///< Of the slots of the sparse index.
    unsigned int probes = 0;  ///< Slots to look at, at most; 0: identifiers are dense.
    std::uint32_t rows = 0;   ///< Identifiers under it have a row, where they are dense.
    std::uint32_t styles = 0; ///< Slots under it have a style.
};

/// Which text each object of a scene carries, packed for the GPU: identifier → glyph codes.
///
/// Identifiers are 1..2^31-1. A row of 4 bytes an identifier names its text; texts are packed at
/// the fewest bits that the largest code needs, equal ones stored once, freed space is used again.
/// All functions may be called from any thread. Needs no graphics context: a LabelBuffers sends
/// what changed.
class OSGLABELS_EXPORT LabelTable
{
public:
    using Codes = TextStore::Codes;
    using Message = std::function<void(const std::string&)>;

    static constexpr std::uint32_t MaxIdentifier = 0x7fffffffu;
    static constexpr std::size_t MaxLength = TextStore::MaxLength;

    using AdvanceOf = TextStore::AdvanceOf;

    LabelTable();
    ~LabelTable();
    LabelTable(const LabelTable&) = delete;
    LabelTable& operator=(const LabelTable&) = delete;

    /// For texts in proportional fonts, before the first one: how far each code reaches, in em. The
    /// width of a text of 32 codes and more and sums of its advances are then stored with it, as
    /// TextStore tells: about 4 bytes for each 16 codes. `advanceOf` is called while the table is
    /// locked, from the thread that sets, and must not use the table.
    void setAdvances(AdvanceOf advanceOf);

    /// Gives an identifier a text; an empty one is none. Longer texts than MaxLength are cut, which
    /// is said once. False, said once too, for an identifier out of range, a code over 2^20 - 1,
    /// and when 512 MiB of texts are full: then the old text stays.
    bool setCodes(std::uint32_t identifier, const std::uint32_t* codes, std::size_t length);
    bool setCodes(std::uint32_t identifier, const Codes& codes)
    {
        return setCodes(identifier, codes.data(), codes.size());
    }
    /// Any number that means something to what draws the labels; 0 is the style of all others.
    bool setStyle(std::uint32_t identifier, std::uint32_t style);
    /// Takes its text and style away.
    void remove(std::uint32_t identifier);
    /// Codes up to `largest` will come: spares packing all texts again each time that one needs
    /// another bit.
    void reserveCodes(std::uint32_t largest);

    /// Empty without a text.
    Codes getCodes(std::uint32_t identifier) const;
    std::uint32_t getStyle(std::uint32_t identifier) const;

    /// Where one-line messages go; none at first. Called in the thread that sets, without a lock.
    void setMessage(Message message);

    struct Sizes
    {
        std::size_t labels = 0;    ///< Identifiers with a text or a style.
        std::size_t texts = 0;     ///< Different ones.
        unsigned int bits = 0;     ///< Of a code.
        std::size_t textBytes = 0; ///< On the GPU, before what a buffer holds in reserve.
        std::size_t rowBytes = 0;
        std::size_t styleBytes = 0;
        std::size_t mainBytes = 0; ///< Of main memory.
    };
    Sizes getSizes() const;

    /// Receives changes. Offsets and sizes are in bytes and multiples of 4, of 8 for sparse rows.
    class Sink
    {
    public:
        virtual ~Sink() = default;
        /// The buffer must hold `bytes`. Returns whether its content is still there.
        virtual bool resize(TableBuffer buffer, std::size_t bytes, unsigned int wordsPerTexel) = 0;
        virtual void write(TableBuffer buffer, std::size_t offset, const void* data,
                           std::size_t bytes) = 0;
    };

    /// What one receiver of changes, such as a graphics context, has not seen yet.
    class Reader;
    std::shared_ptr<Reader> makeReader();

    /// Sends `sink` all that changed since `reader`'s last take, and returns the layout that is
    /// true of what it has received. Where more than `maxTextBytes` of texts have changed, only so
    /// many of them are sent and no rows, so that each label shows its old text or its new one and
    /// never another's; that is given up, and all sent, rather than let freed space pile up or a
    /// changed layout wait. Setters wait meanwhile.
    TableLayout take(Reader& reader, std::size_t maxTextBytes, Sink& sink);

private:
    bool setCodesLocked(std::uint32_t identifier, const std::uint32_t* codes, std::size_t length,
                        std::string& message);
    bool makeRoom(std::size_t length);
    void release(TextStore::Row row);
    void reclaim();
    void repack(unsigned int bits, unsigned int shift);
    void markRow(std::size_t slot, bool isMoved);
    void markStyle(std::size_t slot, bool isMoved);
    template <typename F> void forEachReader(F f);
    bool sayOnce(unsigned int bit);
    TableLayout layout() const;

    mutable std::mutex _mutex;
    TextStore _texts;
    LabelRows _rows;
    std::vector<std::weak_ptr<Reader>> _readers;
    /// Space that readers may still look at through rows which they have not taken yet.
    std::deque<TextStore::Block> _retired;
    std::uint64_t _firstRetired = 0; ///< Number of _retired.front().
    std::uint64_t _retiredUnits = 0;
    unsigned int _said = 0;
    Message _message;
};

} // namespace osgLabels
