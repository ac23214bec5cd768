// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ByteCost.h>
#include <osgPagedTexture/MipChain.h>
#include <osgPagedTexture/PagerStatistics.h>
#include <osgPagedTexture/PlainTextures.h>
#include <osgPagedTexture/TextureStorage.h>

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
    /// Where nothing of the texture is there this level comes first, before whatever takes longer;
    /// none where it is no coarser than `level`.
    int preview = 0;
};

/// What has become of one.
struct UploadEvent
{
    static constexpr int Gone = -1;

    unsigned int texture = 0;
    int level = Gone;       ///< The finest level now.
    bool isRefused = false; ///< GL had no memory; `level` is the one that was asked for.
    bool isPreview = false; ///< The level that was asked for is still on its way.
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
/// levels that are not used; it is filled over several frames in rows of blocks, through a pixel
/// buffer or from the finer one, and takes the place of the one before when it is complete. Memory
/// that would take too long in a frame is made in a StorageThread, and chains that are on the GPU
/// end there. What has an osg::State, and find(), belong to the draw thread, all else to any.
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
        TextureSize size;
    };
    /// Null while nothing of it is there.
    const Texture* find(unsigned int texture) const;

    PlainTextures& getPlain() { return _plain; }

private:
    struct Build
    {
        UploadJob job;
        Texture texture;
        bool isPreview = false;
        std::uint64_t ticket = 0; ///< Not 0: a StorageThread makes its memory.
        int level = 0;            ///< That goes on.
        int row = 0;              ///< Of blocks.
    };

    /// What the next step of a frame may take.
    struct Share
    {
        const UploadLimits& limits;
        std::uint64_t piece = 0; ///< Bytes.
        double left = 0.0;       ///< Milliseconds.
        bool isFirst = true;     ///< Nothing has been done in this frame.
    };

    void reset();
    void takeOrders();
    void take(UploadJob job);
    bool step(const Share& share);
    bool start(std::uint64_t limit);
    bool makeMemory(const Share& share);
    void refuse();
    void cancelBuild();
    bool fill(std::uint64_t piece);
    void uploadRows(int rows);
    void copyRows(int rows);
    void finish();
    void evictNow(unsigned int texture);
    void doom(const Texture& texture);
    bool deleteOne(const Share& share);
    void drop(UploadJob& job);
    void tell(const UploadEvent& event);
    void publish(std::uint64_t uploadedBefore, double milliseconds);

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
    PlainTextures _plain;
    GLuint _buffer = 0;
    std::deque<UploadJob> _coarser;  ///< These give memory back, so they are the first.
    std::deque<UploadJob> _previews; ///< Of textures that are still in `_jobs`, too.
    std::deque<UploadJob> _jobs;
    std::deque<Texture> _doomed; ///< Nobody names them any more.
    std::unique_ptr<Build> _build;
    ByteCost _costToMake{1.0}, _costToDelete{0.05};
    std::uint64_t _bytes = 0;
    std::uint64_t _uploaded = 0;
};

} // namespace osgPagedTexture
