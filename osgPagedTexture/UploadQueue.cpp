// SPDX-License-Identifier: MIT
#include <osgPagedTexture/UploadQueue.h>

#include <osgPagedTexture/ContextPace.h>
#include <osgPagedTexture/ContextTextures.h>
#include <osgPagedTexture/GlFormat.h>
#include <osgPagedTexture/ThreadClock.h>

#include <osg/GLExtensions>

#include <algorithm>
#include <iterator>

namespace osgPagedTexture
{

namespace
{

constexpr GLenum UnpackBuffer = 0x88EC, StreamDraw = 0x88E0, MaxLevel = 0x813D;
constexpr GLenum MaxTextureSize = 0x0D33;

/// Until its end GL reads pixels as they lie in memory.
class UnpackScope
{
public:
    explicit UnpackScope(osg::State& state) : _state(state)
    {
        _state.unbindPixelBufferObject();
        glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        for (const GLenum name : {GLenum(GL_UNPACK_SWAP_BYTES), GLenum(GL_UNPACK_LSB_FIRST),
                                  GLenum(GL_UNPACK_ROW_LENGTH), GLenum(GL_UNPACK_SKIP_ROWS),
                                  GLenum(GL_UNPACK_SKIP_PIXELS)})
            glPixelStorei(name, 0);
    }
    ~UnpackScope()
    {
        _state.get<osg::GLExtensions>()->glBindBuffer(UnpackBuffer, 0);
        glPopClientAttrib();
        _state.haveAppliedTextureAttribute(_state.getActiveTextureUnit(),
                                           osg::StateAttribute::TEXTURE);
    }
    UnpackScope(const UnpackScope&) = delete;
    UnpackScope& operator=(const UnpackScope&) = delete;

private:
    osg::State& _state;
};

int blockRows(BlockFormat format, int height)
{
    return isBlocked(format) ? (height + 3) / 4 : height;
}

} // namespace

UploadQueue::UploadQueue(unsigned int contextID) : _contextID(contextID) {}

UploadQueue::~UploadQueue()
{
    if (!isOpen())
        return;
    std::vector<GLuint> textures;
    for (const auto& each : _textures)
        textures.push_back(each.second.name);
    for (const auto& each : _plain)
        textures.push_back(each.second);
    if (_fault)
        textures.push_back(_fault);
    if (_build)
        textures.push_back(_build->texture.name);
    osg::get<ContextTextures>(_contextID)
        ->doom(textures, _buffer ? std::vector<GLuint>{_buffer} : std::vector<GLuint>());
}

void UploadQueue::push(UploadJob job)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _ordered.push_back(std::move(job));
}

void UploadQueue::evict(unsigned int texture)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _ordered.push_back({texture, UploadEvent::Gone, nullptr});
}

bool UploadQueue::isOpen() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _validity && *_validity;
}

ContextAbilities UploadQueue::getAbilities() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _abilities;
}

std::vector<UploadEvent> UploadQueue::takeEvents()
{
    std::lock_guard<std::mutex> lock(_mutex);
    return std::exchange(_events, {});
}

UploadStatistics UploadQueue::getStatistics() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    UploadStatistics statistics = _statistics;
    for (const UploadJob& job : _ordered)
    {
        ++statistics.waiting;
        statistics.waitingBytes += job.chain ? job.chain->bytes() : 0;
    }
    return statistics;
}

void UploadQueue::tell(unsigned int texture, int level, bool refused)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _events.push_back({texture, level, refused});
}

/// The context is a new one, or its names are void.
void UploadQueue::reset()
{
    for (const auto& each : _textures)
        tell(each.first, UploadEvent::Gone);
    if (_build)
        tell(_build->job.texture, UploadEvent::Gone);
    for (const UploadJob& job : _jobs)
        tell(job.texture, UploadEvent::Gone);
    _textures.clear();
    _plain.clear();
    _fault = _buffer = 0;
    _jobs.clear();
    _build.reset();
    _bytes = 0;
}

void UploadQueue::begin(osg::State& state)
{
    ContextTextures* names = state.get<ContextTextures>();
    if (!isOpen())
    {
        reset();
        _gl = state.get<osg::GLExtensions>();
        osg::setGLExtensionFuncPtr(
            _copyImage, "glCopyImageSubData", "glCopyImageSubDataEXT",
            _gl->glVersion >= 4.3f || osg::isGLExtensionSupported(_contextID, "GL_ARB_copy_image"));
        GLint side = 0;
        glGetIntegerv(MaxTextureSize, &side);
        std::lock_guard<std::mutex> lock(_mutex);
        _validity = names->getValidity();
        _abilities.known = true;
        _abilities.s3tc =
            osg::isGLExtensionSupported(_contextID, "GL_EXT_texture_compression_s3tc");
        _abilities.rgtc = _gl->isTextureCompressionRGTCSupported || _gl->glVersion >= 3.0f;
        _abilities.bptc =
            osg::isGLExtensionSupported(_contextID, "GL_ARB_texture_compression_bptc");
        _abilities.copies = _copyImage != nullptr;
        _abilities.maxSide = side;
    }
    names->flush();
}

/// What other threads have asked for since the last run: the newest order for a texture counts.
/// What takes longer than a frame's time, such as many copies at once, waits for the next ones.
void UploadQueue::takeOrders(double milliseconds)
{
    const double start = threadMilliseconds();
    std::vector<UploadJob> ordered;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        ordered.swap(_ordered);
    }
    std::unordered_map<unsigned int, const UploadJob*> newest;
    for (const UploadJob& job : ordered)
        newest[job.texture] = &job;
    std::vector<UploadJob> late;
    const auto isReplaced = [&](const UploadJob& job) { return newest.count(job.texture) > 0; };
    _jobs.erase(std::remove_if(_jobs.begin(), _jobs.end(), isReplaced), _jobs.end());
    for (UploadJob& job : ordered)
    {
        const unsigned int texture = job.texture;
        if (newest[texture] != &job)
            continue;
        if (threadMilliseconds() - start > milliseconds)
        {
            late.push_back(std::move(job));
            continue;
        }
        if (_build && _build->job.texture == texture)
        {
            glDeleteTextures(1, &_build->texture.name);
            _bytes -= _build->texture.bytes();
            _build.reset();
        }
        if (job.level == UploadEvent::Gone)
            evictNow(texture);
        else if (job.chain)
            _jobs.push_back(std::move(job));
        else if (!coarsen(job))
            tell(texture, find(texture) ? find(texture)->level : UploadEvent::Gone);
    }
    if (late.empty())
        return;
    std::lock_guard<std::mutex> lock(_mutex);
    _ordered.insert(_ordered.begin(), std::make_move_iterator(late.begin()),
                    std::make_move_iterator(late.end()));
}

void UploadQueue::evictNow(unsigned int texture)
{
    const auto found = _textures.find(texture);
    if (found != _textures.end())
    {
        _bytes -= found->second.bytes();
        glDeleteTextures(1, &found->second.name);
        _textures.erase(found);
    }
    tell(texture, UploadEvent::Gone);
}

bool UploadQueue::allocate(Texture& texture) const
{
    const GlFormat format = glFormatOf(texture.format);
    const int levels = levelCount(texture.width, texture.height) - texture.level;
    const int width = levelSide(texture.width, texture.level);
    const int height = levelSide(texture.height, texture.level);
    glGenTextures(1, &texture.name);
    glBindTexture(GL_TEXTURE_2D, texture.name);
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i)
        continue; // Errors before are not ours.
    if (_gl->isTextureStorageEnabled && _gl->glTexStorage2D)
        _gl->glTexStorage2D(GL_TEXTURE_2D, levels, format.internal, width, height);
    else
    {
        glTexParameteri(GL_TEXTURE_2D, MaxLevel, levels - 1);
        const std::vector<std::uint8_t> nothing(levelBytes(texture.format, width, height));
        for (int level = 0; level < levels; ++level)
        {
            const int w = levelSide(width, level), h = levelSide(height, level);
            if (isBlocked(texture.format))
                _gl->glCompressedTexImage2D(GL_TEXTURE_2D, level, format.internal, w, h, 0,
                                            GLsizei(levelBytes(texture.format, w, h)),
                                            nothing.data());
            else
                glTexImage2D(GL_TEXTURE_2D, level, GLint(format.internal), w, h, 0, format.layout,
                             GL_UNSIGNED_BYTE, nothing.data());
        }
    }
    if (glGetError() == GL_NO_ERROR)
        return true;
    glDeleteTextures(1, &texture.name);
    texture.name = 0;
    return false;
}

/// Leaves the finer levels out; all on the GPU.
bool UploadQueue::coarsen(const UploadJob& job)
{
    const auto found = _textures.find(job.texture);
    if (found == _textures.end() || found->second.level >= job.level || !_copyImage)
        return false;
    const Texture& from = found->second;
    Texture to = from;
    to.level = job.level;
    if (!allocate(to))
    {
        evictNow(job.texture);
        return true;
    }
    const int levels = levelCount(to.width, to.height);
    for (int level = to.level; level < levels; ++level)
        _copyImage(from.name, GL_TEXTURE_2D, level - from.level, 0, 0, 0, to.name, GL_TEXTURE_2D,
                   level - to.level, 0, 0, 0, levelSide(to.width, level),
                   levelSide(to.height, level), 1);
    _bytes += to.bytes();
    count();
    finish(to, job.texture);
    return true;
}

/// Makes the texture that the job will fill, if it fits: what it replaces does not count, since
/// that goes when the new one is complete.
bool UploadQueue::start(const UploadJob& job, const UploadLimits& limits)
{
    Texture texture;
    texture.level = std::max(job.level, job.chain->firstLevel);
    texture.format = job.chain->format;
    texture.width = job.chain->width;
    texture.height = job.chain->height;
    const std::uint64_t bytes =
        chainBytes(texture.format, texture.width, texture.height, texture.level);
    const Texture* before = find(job.texture);
    if (_bytes + bytes - (before ? before->bytes() : 0) > limits.bytes)
    {
        tell(job.texture, before ? before->level : UploadEvent::Gone);
        return true;
    }
    if (!allocate(texture))
    {
        tell(job.texture, texture.level, true);
        return true;
    }
    _bytes += texture.bytes();
    count();
    _build = std::make_unique<Build>();
    _build->job = job;
    _build->texture = texture;
    _build->index = std::size_t(texture.level - job.chain->firstLevel);
    return true;
}

void UploadQueue::uploadRows(const std::vector<std::uint8_t>& bytes, int level, int first, int rows)
{
    const Texture& texture = _build->texture;
    const GlFormat format = glFormatOf(texture.format);
    const int width = levelSide(texture.width, level), height = levelSide(texture.height, level);
    const std::size_t rowBytes = std::size_t(levelBytes(texture.format, width, 1));
    const int tall = isBlocked(texture.format) ? 4 : 1;
    const int y = first * tall;
    const int h = std::min(rows * tall, height - y);
    const GLsizei size = GLsizei(rowBytes * rows);
    _gl->glBufferData(UnpackBuffer, size, bytes.data() + rowBytes * first, StreamDraw);
    if (isBlocked(texture.format))
        _gl->glCompressedTexSubImage2D(GL_TEXTURE_2D, level - texture.level, 0, y, width, h,
                                       format.internal, size, nullptr);
    else
        glTexSubImage2D(GL_TEXTURE_2D, level - texture.level, 0, y, width, h, format.layout,
                        GL_UNSIGNED_BYTE, nullptr);
    _uploaded += std::uint64_t(size);
}

/// Uploads about `piece` bytes. Returns whether the texture is complete.
bool UploadQueue::goOn(std::uint64_t piece)
{
    const MipChain& chain = *_build->job.chain;
    glBindTexture(GL_TEXTURE_2D, _build->texture.name);
    std::uint64_t done = 0;
    while (_build->index < chain.levels.size())
    {
        const int level = chain.firstLevel + int(_build->index);
        const int width = levelSide(chain.width, level), height = levelSide(chain.height, level);
        const std::uint64_t rowBytes = levelBytes(chain.format, width, 1);
        const int left = blockRows(chain.format, height) - _build->row;
        const int rows = int(std::clamp<std::uint64_t>((piece - std::min(piece, done)) / rowBytes,
                                                       done ? 0 : 1, std::uint64_t(left)));
        if (rows == 0)
            return false;
        uploadRows(chain.levels[_build->index], level, _build->row, rows);
        done += rowBytes * rows;
        _build->row += rows;
        if (rows < left)
            return false;
        _build->row = 0;
        ++_build->index;
    }
    return true;
}

void UploadQueue::finish(const Texture& texture, unsigned int id)
{
    Texture& place = _textures[id];
    if (place.name)
    {
        _bytes -= place.bytes();
        glDeleteTextures(1, &place.name);
    }
    place = texture;
    tell(id, texture.level);
}

void UploadQueue::count()
{
    std::lock_guard<std::mutex> lock(_mutex);
    _statistics.peakBytes = std::max(_statistics.peakBytes, _bytes);
}

bool UploadQueue::run(osg::State& state, const UploadLimits& limits)
{
    begin(state);
    const UnpackScope scope(state);
    const std::uint64_t before = _uploaded;
    UploadPace& pace = ContextPace::of(state).begin(state, limits.milliseconds);
    const double spent = pace.getSpent();
    double start = threadMilliseconds();
    takeOrders(limits.milliseconds);
    if (!_buffer)
        _gl->glGenBuffers(1, &_buffer);
    _gl->glBindBuffer(UnpackBuffer, _buffer);
    const double ordered = threadMilliseconds();
    pace.took(0, ordered - start); // Says nothing about the rate.
    start = ordered;
    while (_build || !_jobs.empty())
    {
        const std::uint64_t piece = pace.piece();
        if (piece == 0)
            break;
        const std::uint64_t had = _uploaded;
        if (!_build)
        {
            const UploadJob job = std::move(_jobs.front());
            _jobs.pop_front();
            this->start(job, limits);
        }
        else if (goOn(piece))
        {
            finish(_build->texture, _build->job.texture);
            _build.reset();
        }
        const double now = threadMilliseconds();
        pace.took(_uploaded - had, now - start);
        start = now;
    }
    std::lock_guard<std::mutex> lock(_mutex);
    _statistics.bytes = _bytes;
    _statistics.uploaded = _uploaded;
    _statistics.lastUploaded = _uploaded - before;
    _statistics.lastMilliseconds = pace.getSpent() - spent;
    _statistics.waiting = _jobs.size() + (_build ? 1 : 0);
    _statistics.waitingBytes = _build ? _build->job.chain->bytes() : 0;
    for (const UploadJob& job : _jobs)
        _statistics.waitingBytes += job.chain->bytes();
    return _statistics.waiting > 0 || !_ordered.empty();
}

const UploadQueue::Texture* UploadQueue::find(unsigned int texture) const
{
    const auto found = _textures.find(texture);
    return found == _textures.end() ? nullptr : &found->second;
}

GLuint UploadQueue::plainName(osg::State& state, std::uint32_t rgba)
{
    GLuint& name = _plain[rgba];
    if (name)
        return name;
    const UnpackScope scope(state);
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexParameteri(GL_TEXTURE_2D, MaxLevel, 0);
    const std::uint8_t texel[] = {std::uint8_t(rgba >> 24), std::uint8_t(rgba >> 16),
                                  std::uint8_t(rgba >> 8), std::uint8_t(rgba)};
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
    return name;
}

GLuint UploadQueue::faultName(osg::State& state)
{
    if (_fault)
        return _fault;
    const UnpackScope scope(state);
    glGenTextures(1, &_fault);
    glBindTexture(GL_TEXTURE_2D, _fault);
    // Squares of magenta and grey; one level each, so that they show from far away, too.
    for (int level = 0, side = 8; side > 0; ++level, side /= 2)
    {
        std::vector<std::uint8_t> texels;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
            {
                const bool isMarked = side < 4 || ((x * 8 / side / 2 + y * 8 / side / 2) & 1);
                for (const int value :
                     {isMarked ? 255 : 96, isMarked ? 0 : 96, isMarked ? 255 : 96, 255})
                    texels.push_back(std::uint8_t(value));
            }
        glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA, side, side, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     texels.data());
    }
    glTexParameteri(GL_TEXTURE_2D, MaxLevel, 3);
    return _fault;
}

} // namespace osgPagedTexture
