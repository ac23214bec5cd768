// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/MipChain.h>
#include <osgPagedTexture/PagerStatistics.h>

#include <osg/State>

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace osgPagedTexture
{

/// What a context can do.
struct ContextAbilities
{
    bool known = false;  ///< False before the first run of the queue; the rest is void then.
    bool s3tc = false;   ///< BC1, BC3.
    bool rgtc = false;   ///< BC4, BC5.
    bool bptc = false;   ///< BC7.
    bool copies = false; ///< Levels from texture to texture.
    int maxSide = 0;     ///< Texels of the largest texture.
};

/// A texture that is to be there from a level on.
struct UploadJob
{
    unsigned int texture = 0;
    int level = 0; ///< Finest level.
    /// Holds them; null: what is there loses its finer levels.
    std::shared_ptr<const MipChain> chain;
};

/// What has become of one.
struct UploadEvent
{
    static constexpr int Gone = -1;

    unsigned int texture = 0;
    int level = Gone;       ///< The finest level now.
    bool isRefused = false; ///< GL had no memory; `level` is the one that was asked for.
};

/// What one run may take.
struct UploadLimits
{
    double milliseconds = 2.0;
    std::uint64_t bytes = 0; ///< On the GPU, of all textures.
};

/// The textures of one context and what they are to become.
///
/// A texture that changes is made anew at its other size, since drivers give no memory back for
/// levels that are not used; it is filled over several frames through a pixel buffer, in rows of
/// blocks, and takes the place of the one before when it is complete. run() and nameOf() belong to
/// the draw thread, all else to any.
class UploadQueue
{
public:
    explicit UploadQueue(unsigned int contextID);
    ~UploadQueue();

    /// Replaces what has been asked of the texture before.
    void push(UploadJob job);
    void evict(unsigned int texture);

    /// False before the first frame of the context and when the context is closed.
    bool isOpen() const;

    ContextAbilities getAbilities() const;
    std::vector<UploadEvent> takeEvents();
    UploadStatistics getStatistics() const;

    /// Before anything else of the draw thread in a frame: names may have become void.
    void begin(osg::State& state);

    /// Goes on with the jobs. Returns false when there are none left. Leaves `state` right.
    bool run(osg::State& state, const UploadLimits& limits);

    /// Bytes of one in the making may be over the limit by one texture.
    struct Texture
    {
        GLuint name = 0;
        int level = UploadEvent::Gone;
        BlockFormat format = BlockFormat::RGBA8;
        int width = 0; ///< Of level 0.
        int height = 0;
        std::uint64_t bytes() const { return name ? chainBytes(format, width, height, level) : 0; }
    };
    /// Null while nothing of it is there.
    const Texture* find(unsigned int texture) const;

    /// A texture of one colour, RGBA8, or the picture for what can't be read.
    GLuint plainName(osg::State& state, std::uint32_t rgba);
    GLuint faultName(osg::State& state);

private:
    struct Build
    {
        UploadJob job;
        Texture texture;
        std::size_t index = 0; ///< Of the level in the chain that goes on.
        int row = 0;           ///< Of blocks.
    };

    void reset();
    void takeOrders(double milliseconds);
    void evictNow(unsigned int texture);
    bool coarsen(const UploadJob& job);
    bool start(const UploadJob& job, const UploadLimits& limits);
    bool allocate(Texture& texture) const;
    bool goOn(std::uint64_t piece);
    void uploadRows(const std::vector<std::uint8_t>& bytes, int level, int first, int rows);
    void finish(const Texture& texture, unsigned int id);
    void tell(unsigned int texture, int level, bool refused = false);
    void count();

    const unsigned int _contextID;
    mutable std::mutex _mutex; ///< Guards what other threads see.
    std::vector<UploadJob> _ordered;
    std::vector<unsigned int> _evicted;
    std::vector<UploadEvent> _events;
    std::shared_ptr<const std::atomic<bool>> _validity; ///< Of the context's names.
    ContextAbilities _abilities;
    UploadStatistics _statistics;

    // The draw thread's.
    osg::ref_ptr<osg::GLExtensions> _gl;
    void(GL_APIENTRY* _copyImage)(GLuint, GLenum, GLint, GLint, GLint, GLint, GLuint, GLenum, GLint,
                                  GLint, GLint, GLint, GLsizei, GLsizei, GLsizei) = nullptr;
    std::unordered_map<unsigned int, Texture> _textures;
    std::unordered_map<std::uint32_t, GLuint> _plain;
    GLuint _fault = 0;
    GLuint _buffer = 0;
    std::deque<UploadJob> _jobs;
    std::unique_ptr<Build> _build;
    std::uint64_t _bytes = 0;
    std::uint64_t _uploaded = 0;
};

} // namespace osgPagedTexture
