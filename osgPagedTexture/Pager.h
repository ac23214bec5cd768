// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ChainLoader.h>
#include <osgPagedTexture/EmbeddedImages.h>
#include <osgPagedTexture/FileWatch.h>
#include <osgPagedTexture/FrameTimes.h>
#include <osgPagedTexture/PagedSettings.h>
#include <osgPagedTexture/PagerStatistics.h>
#include <osgPagedTexture/Residency.h>
#include <osgPagedTexture/TexelNeed.h>
#include <osgPagedTexture/TextureUse.h>
#include <osgPagedTexture/UploadQueue.h>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// A texture that is paged, as its users know it.
struct PagedImage
{
    std::string file;
    int width = 1; ///< Texels of level 0.
    int height = 1;
    int channels = 3; ///< As Pixels::channels.
    bool translucent = false;
    TextureUse use = TextureUse::Color;
    double anisotropy = 1.0;
    double lodBias = 0.0;
};

/// What the draw thread asks of a texture.
struct PagedState
{
    std::atomic<bool> translucent{false};
    std::atomic<bool> failed{false};
};

/// Who needs how much of a texture in a view.
struct PagedDemand
{
    unsigned int texture = 0;
    double pixels = 0.0;     ///< See pixelsOfTexture(); 0: not in view.
    double soonPixels = 0.0; ///< The same where the eye will be.
};

/// Decides which levels of which texture are where, and has them loaded and uploaded.
///
/// Views report what they see while they are culled; once a frame, at the first of them, advance()
/// divides the memory and asks the workers. Any thread; only what has an osg::State belongs to the
/// draw thread of its context. Starts no thread before the first texture is needed.
class Pager
{
public:
    explicit Pager(const PagedSettings& settings);
    ~Pager();

    /// Takes effect with the next frame; cache and threads only before the first request.
    void setSettings(const PagedSettings& settings);
    PagedSettings getSettings() const;

    /// Numbers start at 0. Images of the same file are one, and one GL texture: what else users
    /// want of it, OSG sets with each use. The finest filter of all counts.
    unsigned int add(const PagedImage& image);

    /// For pictures without a file.
    EmbeddedImages& getEmbedded() { return _embedded; }

    /// One user less; the last one takes it with him.
    void remove(unsigned int texture);

    void report(const std::vector<PagedDemand>& demands, unsigned int frame);

    /// Does nothing in a frame that it has seen.
    void advance(unsigned int frame);

    /// Whether all that was in view in the last frame is there as fine as the memory allows.
    bool isAtRest() const;

    PagerStatistics getStatistics() const;

    /// A line for each texture: its file, what is there of it and why.
    struct Line
    {
        std::string file;
        int level = -1;
        int wanted = -1;
        double need = -1.0;
        bool failed = false;
        int width = 0;
        int height = 0;
        TextureUse use = TextureUse::Color;
        BlockFormat format = BlockFormat::RGBA8;
    };
    std::vector<Line> getLines() const;

    /// The queue of a context, made where there is none.
    std::shared_ptr<UploadQueue> getQueue(unsigned int contextID);

    std::shared_ptr<const PagedState> getState(unsigned int texture) const;

    /// The GL texture to show, in the draw thread.
    struct Shown
    {
        GLuint name = 0;
        BlockFormat format = BlockFormat::RGBA8;
    };
    Shown getShown(unsigned int texture, const PagedState& paged, osg::State& state);

    /// A frame's share of uploads. Returns whether any are left.
    bool upload(osg::State& state);

    /// Whether frames wait, see PagedSettings::wait.
    bool waits() const { return _waits; }

    /// Loads and uploads until isAtRest(), at most once a frame.
    void waitForAll(osg::State& state, unsigned int frame);

    /// Milliseconds of CPU time of each frame's uploads, and bytes, newest last.
    FrameTimes getUploadTimes() const;
    FrameTimes getUploadBytes() const;

private:
    struct Entry
    {
        // Those that plan() reads of each texture in view, which may be many, lie together.
        const std::vector<std::uint64_t>* bytes = nullptr; ///< Null: not known before GL is.
        double pixels = 0.0;
        double soonPixels = 0.0;
        double soonBefore = 0.0; ///< A frame earlier: views look at two times ahead in turns.
        double need = ResidencyWish::None;
        double onePixel = 0.0;        ///< See levelOnOnePixel().
        std::uint64_t wholeBytes = 0; ///< Its share of `_wholeBytes`.
        std::uint32_t lastUsed = 0;
        int target = -1;
        int finest = 0; ///< Of what GL and the file allow.
        unsigned int users = 1;
        bool failed = false;   ///< As in `state`.
        bool isActive = false; ///< It is one of `_active` or `_awake`.
        bool isCalm = false;   ///< All contexts have its target, and nothing is on its way.
        bool isWatched = false;
        bool isOld = false; ///< What contexts show is of a file that has changed.

        PagedImage image;
        BlockFormat format = BlockFormat::RGBA8;
        RequestId request = 0;
        int requested = -1;
        double urgency = 0.0; ///< The request's priority.
        std::shared_ptr<PagedState> state = std::make_shared<PagedState>();
    };
    struct Context
    {
        std::shared_ptr<UploadQueue> queue;
        std::vector<int> resident;
        std::vector<int> queued; ///< Level on its way; None: nothing is.
    };
    static constexpr int None = -2;
    static constexpr int MostAsked = 512, MostTaken = 512; ///< A frame; each 1 ms or so.

    void advanceLocked();
    void meetContexts();
    bool learnAbilities();
    void takeEvents();
    void takeChanges();
    void loadAgain(unsigned int texture, const ImageInfo& info);
    void setFormat(Entry& entry);
    static void findOnePixel(Entry& entry);
    void takeResults();
    void accept(const ChainResult& result);
    void wake(unsigned int texture);
    void stir(unsigned int texture);
    static void setFailed(Entry& entry, bool failed);
    void meetAwake();
    void rest();
    bool isIdle(unsigned int texture) const;
    void countWhole(Entry& entry);
    void plan();
    void carryOut();
    ResidencyWish wishOf(unsigned int texture);
    void moveTo(unsigned int texture);
    bool orderIn(Context& context, unsigned int texture, int target);
    void ask(unsigned int texture);
    void cancel(unsigned int texture);
    void give(const ChainResult& result, unsigned int texture);
    void pushToAll(unsigned int texture, const std::shared_ptr<const MipChain>& chain);
    int coarsest(unsigned int texture) const;
    double priority(const Entry& entry, int there) const;
    std::uint64_t backlog() const;
    ChainLoader& loader();
    bool isAtRestIn(unsigned int contextID) const;

    EmbeddedImages _embedded;
    mutable std::mutex _queueMutex; ///< Of `_queues` alone, taken after the other one.
    std::map<unsigned int, std::shared_ptr<UploadQueue>> _queues;
    std::atomic<bool> _showsLevels{false};
    std::atomic<bool> _waits{false};

    mutable std::mutex _mutex; ///< Of all that follows.
    PagedSettings _settings;
    std::vector<Entry> _entries;
    std::map<unsigned int, Context> _contexts;
    ContextAbilities _abilities; ///< What all contexts can do.
    std::map<std::pair<std::string, TextureUse>, unsigned int> _byFile;
    std::map<RequestId, std::vector<unsigned int>> _requests; ///< Equal ones share a number.
    std::map<std::string, std::shared_ptr<const ChainRecipe>> _recipes;
    std::map<std::tuple<int, int, BlockFormat>, std::vector<std::uint64_t>> _sizes;
    std::unique_ptr<ChainLoader> _loader;
    std::unique_ptr<FileWatch> _watch;
    std::vector<unsigned int> _active;  ///< Textures that something is to be decided of, in order.
    std::vector<unsigned int> _awake;   ///< Those that have come to be so, in any order.
    bool _hasNew = false;               ///< Textures whose format is not known.
    std::uint64_t _wholeBytes = 0;      ///< Of all textures at full size.
    std::vector<ResidencyWish> _wishes; ///< Of the active ones.
    ResidencyPlan _plan;
    unsigned int _frame = ~0u;
    unsigned int _waited = ~0u;
    unsigned int _reported = ~0u;
    double _planMilliseconds = 0.0;
    std::size_t _changing = 0;
    int _asked = 0; ///< In this frame.
    FrameTimes _times, _bytes;
};

} // namespace osgPagedTexture
