// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/VirtualPages.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace osgPagedTexture
{

/// What a view has asked for lately. A feedback picture sees but some of the pixels, other ones
/// each time; a page that it misses is not unneeded yet.
class OSGPAGEDTEXTURE_EXPORT PageMemory
{
public:
    /// `reports`: for how many of them a page counts after it was asked for, 1 or more.
    explicit PageMemory(int reports = 8) : _reports(reports) {}

    /// What the view asks for now. Where most of it is new, the view has jumped, and what it asked
    /// for before is forgotten.
    void add(const std::vector<PageNeed>& needs);

    /// Each page once, with the most pixels it had in any remembered report.
    const std::vector<PageNeed>& getNeeds() const { return _needs; }

private:
    struct Remembered
    {
        std::uint32_t pixels = 0;
        std::uint64_t report = 0;
    };
    int _reports;
    std::uint64_t _report = 0;
    std::unordered_map<PageKey, Remembered> _pages;
    std::vector<PageNeed> _needs;
};

/// Chooses what the physical texture should hold.
///
/// All pages asked for and the coarser ones above them, if they fit. Else all that is asked for is
/// made coarser by one and the same number of levels, the bias, until it fits; it goes back only
/// when what is asked for would fit with a tenth of the room to spare, so that it does not swing.
/// The same calls give the same result. Not for several threads at once.
class OSGPAGEDTEXTURE_EXPORT PageSelection
{
public:
    /// `coarsest` has the coarsest level of each texture. `room` pages may be chosen; where even
    /// the coarsest pages are more, those with the most pixels are.
    void choose(const std::vector<PageNeed>& needs, const std::vector<int>& coarsest, int room);

    /// The chosen pages, the coarser ones first; of one level those with the most pixels first.
    const std::vector<PageNeed>& getPages() const { return _pages; }

    int getBias() const { return _bias; }

    /// How many pages there would be without a bias.
    std::size_t getUnbiasedCount() const { return _unbiased; }

private:
    std::size_t collect(const std::vector<PageNeed>& needs, const std::vector<int>& coarsest,
                        int bias);

    int _bias = 0;
    int _collected = 0; ///< Bias of what the closure holds.
    std::size_t _unbiased = 0;
    std::unordered_map<PageKey, std::uint32_t> _closure;
    std::vector<PageNeed> _pages;
};

} // namespace osgPagedTexture
