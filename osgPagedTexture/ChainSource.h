// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ChainLoader.h>
#include <osgPagedTexture/MemoryBudget.h>
#include <osgPagedTexture/SourceIndex.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>

namespace osgPagedTexture
{

/// Makes one chain, in the calling thread: from the disk cache, else from the file. What it holds
/// counts against a budget.
class ChainSource
{
public:
    struct Result
    {
        std::shared_ptr<const MipChain> chain;
        MemoryBudget::Reservation memory; ///< Of the chain.
        std::string warning;              ///< Of a damaged file that is shown all the same.
        bool preview = false;             ///< Coarser than the request's own level.
    };
    struct Counters
    {
        std::atomic<std::uint64_t> filesDecoded{0}, bytesRead{0}, pixelsDecoded{0}, bytesEncoded{0};
    };

    ChainSource(const ChainLoaderSettings& settings, MemoryBudget& memory);

    /// `wantPreview`: the coarse chain, where the request's is larger than its preview side.
    /// Throws ImageError; what the recipe throws passes through.
    Result load(const ChainRequest& request, bool wantPreview, const std::atomic<bool>& cancelled);

    ChainCache& getCache() { return _cache; }
    const ChainCache& getCache() const { return _cache; }
    const Counters& getCounters() const { return _counters; }

private:
    struct Job;
    bool readCached(Job& job);
    void decode(Job& job);
    void checkUnchanged(const Job& job) const;
    void reserve(Job& job, std::uint64_t bytes);

    const ChainLoaderSettings _settings;
    MemoryBudget& _memory;
    ChainCache _cache;
    SourceIndex _index;
    Counters _counters;
};

} // namespace osgPagedTexture
