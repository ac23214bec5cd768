// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ChainCache.h>
#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/MipChain.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// How pixels become a chain.
struct ChainRecipe
{
    /// Names all that decides the texels, in the key of the cache.
    std::string settings;

    /// Of the pixels of level `firstLevel` of a picture of `fullWidth` x `fullHeight`. Called in
    /// the workers, several at once; may throw std::exception.
    std::function<MipChain(Pixels pixels, int firstLevel, int fullWidth, int fullHeight)> make;

    /// Reduced pictures are means of light, as colours want; false for data and normal maps.
    bool linearLight = true;
};

struct ChainRequest
{
    std::string file;
    std::shared_ptr<const ChainRecipe> recipe;
    int firstLevel = 0;    ///< The finest level that is wanted; coarser than there is: the last.
    double priority = 0.0; ///< The higher the sooner.
    int previewSide = 0; ///< Of a picture that has larger sides than this, a chain whose sides are
                         ///< not larger comes first, before every request's finer one; 0: none.
};

using RequestId = std::uint64_t;

/// What became of a request.
struct ChainResult
{
    enum class State
    {
        Preview,  ///< The chain of previewSide; the request goes on.
        Complete, ///< The chain that was asked for, and the end.
        Failed    ///< There is none; show a placeholder. The end.
    };
    RequestId id = 0;
    State state = State::Failed;
    std::shared_ptr<const MipChain> chain;
    std::string error; ///< Of Failed: one line with file, cause and remedy.
};

struct ChainLoaderSettings
{
    unsigned int threads = 0; ///< 0: one less than the machine has.
    std::string cacheFolder;  ///< Empty: no disk cache.
    std::uint64_t cacheBytes = std::uint64_t(4) << 30;
    std::uint64_t memoryBytes = std::uint64_t(256) << 20; ///< See ChainLoader.
    ImageLimits limits;
    std::vector<double> retrySeconds = {1.0, 4.0, 16.0};
    bool showDegraded = false; ///< Take what could be decoded of damaged files; not cached.
};

/// Reads textures in the background: a file and a mip level in, a chain of levels out, from the
/// disk cache where it has them, else by decoding and encoding.
///
/// All calls return at once; results are taken by poll(), once a frame. A request for what already
/// waits or runs gets the id of that one. Decoded pictures, chains at work and results that wait
/// for poll() are held within `memoryBytes`: a job that does not fit waits; one that is larger than
/// all of it runs alone.
///
/// A file that cannot be read (missing, no rights, disk error, changed meanwhile) is tried again
/// after 1, 4 and 16 s. One that is damaged and was written less than 10 s ago may still be on its
/// way: it is tried again as long as it changes, so that one that stays as it is takes 1 s. Then
/// the request fails. Other failures are final at once. Each file's failure is told once by
/// takeMessages(), also where several requests meet it. No thread exists before the first request;
/// the destructor waits for the jobs at work, which end at the next rows of their picture. Any
/// thread.
class OSGPAGEDTEXTURE_EXPORT ChainLoader
{
public:
    struct Statistics
    {
        std::uint64_t requests = 0;
        std::uint64_t completed = 0;
        std::uint64_t cancelled = 0;
        std::uint64_t failed = 0;
        std::uint64_t retried = 0;
        std::uint64_t filesDecoded = 0;
        std::uint64_t bytesRead = 0;       ///< Of source files.
        std::uint64_t pixelsDecoded = 0;   ///< At the size that was asked for.
        std::uint64_t bytesEncoded = 0;    ///< Of chains made.
        std::uint64_t memoryBytes = 0;     ///< Held now.
        std::uint64_t peakMemoryBytes = 0; ///< The most that was held.
        std::size_t waiting = 0;           ///< Requests that have no complete result yet.
        ChainCache::Statistics cache;
    };

    explicit ChainLoader(ChainLoaderSettings settings = {});
    ~ChainLoader();
    ChainLoader(const ChainLoader&) = delete;
    ChainLoader& operator=(const ChainLoader&) = delete;

    /// Asks for a chain. Ids start at 1. A request equal to one that has not ended (file, settings
    /// and level) returns its id, raises its priority to the higher of both and counts one more
    /// cancel().
    RequestId request(const ChainRequest& request);

    void setPriority(RequestId id, double priority);

    /// Takes a request back. No result of it comes from poll() any more, once each of its callers
    /// has cancelled.
    void cancel(RequestId id);

    /// Takes the results that are there, at most `count`, in the order in which they were made.
    std::vector<ChainResult> poll(std::size_t count = SIZE_MAX);

    Statistics getStatistics() const;

    /// Lines for the user: files that failed, each once; trouble with the cache.
    std::vector<std::string> takeMessages();

private:
    class State;
    std::unique_ptr<State> _state;
};

} // namespace osgPagedTexture
