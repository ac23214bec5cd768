// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ChainSource.h>

#include <osgPagedTexture/FileBytes.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace osgPagedTexture
{

namespace
{

using Kind = ImageError::Kind;

/// The coarser of both where a preview is wanted; never beyond the last level.
int pickLevel(const ChainRequest& request, bool wantPreview, int width, int height)
{
    int level = std::max(request.firstLevel, 0);
    if (wantPreview && request.previewSide > 0)
    {
        while (levelSide(std::max(width, height), level) > request.previewSide)
        {
            ++level;
        }
    }
    return std::min(level, levelCount(width, height) - 1);
}

} // namespace

/// One call of load().
struct ChainSource::Job
{
    const ChainRequest& request;
    bool wantPreview;
    const std::atomic<bool>& cancelled;

    FileStamp stamp{};
    std::int64_t startedAt = wallClock();
    ContentHash content{}; ///< Of the file, once known.
    ImageInfo info{};
    std::string bytes{}; ///< Of the file.
    Result result{};

    ContentHash key() const { return chainKey(content, request.recipe->settings); }
    int levelFor(int width, int height) const
    {
        return pickLevel(request, wantPreview, width, height);
    }
    void take(MipChain&& chain)
    {
        result.memory.change(chain.bytes());
        result.preview = chain.firstLevel > pickLevel(request, false, chain.width, chain.height);
        result.chain = std::make_shared<const MipChain>(std::move(chain));
    }
};

ChainSource::ChainSource(const ChainLoaderSettings& settings, MemoryBudget& memory)
    : _settings(settings), _memory(memory), _cache(settings.cacheFolder, settings.cacheBytes),
      _index(settings.cacheFolder.empty()
                 ? std::string()
                 : (std::filesystem::path(settings.cacheFolder) / "sources.index").string())
{
}

void ChainSource::reserve(Job& job, std::uint64_t bytes)
{
    job.result.memory = MemoryBudget::Reservation(); // never two at once
    job.result.memory = _memory.reserve(bytes, job.cancelled);
    if (!job.result.memory)
    {
        throw ImageError(Kind::Cancelled, job.request.file, "no longer needed");
    }
}

bool ChainSource::readCached(Job& job)
{
    std::optional<MipChain> chain = _cache.find(job.key());
    const int level = chain ? job.levelFor(chain->width, chain->height) : 0;
    if (!chain || chain->firstLevel > level)
    {
        return false;
    }
    if (!job.result.memory)
    {
        reserve(job, chainBytes(chain->format, chain->width, chain->height, level));
    }
    chain = _cache.read(job.key(), level);
    if (chain)
    {
        job.take(std::move(*chain));
    }
    return chain.has_value();
}

/// The pixels of other files than JPEG are not made of the bytes that were hashed.
void ChainSource::checkUnchanged(const Job& job) const
{
    constexpr std::int64_t settled = 2000000000;
    const bool stampTells =
        std::max(job.stamp.modified, job.stamp.changed) + settled < job.startedAt;
    const bool same = stampOf(job.request.file) == job.stamp &&
                      (stampTells || hashFile(job.request.file).content == job.content);
    if (!same)
    {
        throw ImageError(Kind::Unreadable, job.request.file,
                         "changed while it was read; wait until it is written");
    }
}

void ChainSource::decode(Job& job)
{
    ReadSettings settings;
    settings.reduction = job.levelFor(job.info.width, job.info.height);
    settings.linearLight = job.request.recipe->linearLight;
    settings.limits = _settings.limits;
    settings.cancelled = &job.cancelled;
    const bool jpeg = job.info.format == "jpeg";
    DecodedImage image = jpeg ? readJpegBytes(job.bytes, job.request.file, settings)
                              : readImageFile(job.request.file, settings);
    job.bytes = std::string();
    ++_counters.filesDecoded;
    _counters.pixelsDecoded += std::uint64_t(image.pixels.width) * image.pixels.height;
    if (image.degraded && !_settings.showDegraded)
    {
        throw ImageError(Kind::Damaged, image.warning);
    }
    if (!jpeg)
    {
        checkUnchanged(job);
    }
    MipChain chain = job.request.recipe->make(std::move(image.pixels), settings.reduction,
                                              image.fullWidth, image.fullHeight);
    _counters.bytesEncoded += chain.bytes();
    if (!image.degraded)
    {
        _cache.write(job.key(), chain);
    }
    job.result.warning = image.warning;
    job.take(std::move(chain));
}

ChainSource::Result ChainSource::load(const ChainRequest& request, bool wantPreview,
                                      const std::atomic<bool>& cancelled)
{
    Job job{request, wantPreview, cancelled};
    const auto stamp = stampOf(request.file);
    job.stamp = stamp.value_or(FileStamp());
    if (const auto known = _index.find(request.file, job.stamp))
    {
        job.content = *known;
        if (readCached(job))
        {
            return std::move(job.result);
        }
    }
    job.info = readImageInfo(request.file, _settings.limits, false);
    const int level = job.levelFor(job.info.width, job.info.height);
    const std::uint64_t pixels = std::uint64_t(levelSide(job.info.width, level)) *
                                 levelSide(job.info.height, level) * job.info.channels;
    // File, picture, and a chain that is at most as large again as the picture and a third.
    reserve(job, job.info.fileBytes + job.info.decoderBytes + pixels + pixels * 4 / 3 + 4096);
    job.bytes = readFileBytes(request.file);
    _counters.bytesRead += job.bytes.size();
    job.content = hashText(job.bytes);
    _index.remember(request.file, job.stamp, job.content, job.startedAt);
    if (!readCached(job))
    {
        decode(job);
    }
    return std::move(job.result);
}

} // namespace osgPagedTexture
