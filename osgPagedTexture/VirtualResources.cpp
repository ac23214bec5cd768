// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualResources.h>

#include <osgPagedTexture/PageTexels.h>

#include <osg/GLExtensions>
#include <osg/Notify>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

/// Views that were not drawn for so many frames no longer count.
constexpr unsigned int framesSeen = 8;

/// Of the pages of these stores, where GL has it: what the settings ask for.
BlockFormat formatOf(const VirtualSettings& settings, bool hasAlpha, unsigned int contextID)
{
    const auto has = [contextID](const char* extension)
    { return osg::isGLExtensionSupported(contextID, extension); };
    const bool s3tc = has("GL_EXT_texture_compression_s3tc");
    const bool bptc = has("GL_ARB_texture_compression_bptc");
    if (settings.compression == Compression::None || (!s3tc && !bptc))
        return BlockFormat::RGBA8;
    if (bptc && (settings.compression == Compression::Best || hasAlpha || !s3tc))
        return BlockFormat::BC7;
    return hasAlpha ? BlockFormat::BC3 : BlockFormat::BC1;
}

} // namespace

void VirtualResources::setSettings(const VirtualSettings& settings)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _settings = settings;
    if (_pager)
        _pager->setFrozen(settings.freeze);
}

VirtualSettings VirtualResources::getSettings() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _settings;
}

void VirtualResources::add(VirtualTexture& texture)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _stores[texture.getFile()].line.file = texture.getFile();
}

bool VirtualResources::hasTextures() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return !_stores.empty();
}

/// Its format and its number of slots follow from all stores and from what GL can do.
void VirtualResources::makePager(osg::State& state)
{
    int side = 0;
    bool hasAlpha = false;
    std::vector<TileGrid> grids;
    for (auto& [file, store] : _stores)
        try
        {
            const TileStoreSettings settings = openTileStore(file)->getSettings();
            hasAlpha = hasAlpha || pageFormatOf(settings) != BlockFormat::BC1;
            grids.push_back(settings.grid);
        }
        catch (const TileStoreError&)
        {
            // Said when it is opened.
        }
    if (grids.empty())
        return;
    VirtualPagerSettings settings;
    settings.format = formatOf(_settings, hasAlpha, state.getContextID());
    settings.quality = _settings.quality;
    settings.cacheBytes = _settings.cpuBytes();
    settings.threads = _settings.threads;
    settings.watchSeconds = _settings.watch ? 1.0 : 0.0;
    settings.rememberReports = _settings.wait ? int(VirtualContext::View::WaitingPictures)
                                              : int(VirtualContext::View::CalmPictures);
    side = pageSideOf(grids.front(), settings.format);
    GLint maxSide = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &maxSide);
    _slots =
        SlotGrid::fit(_settings.gpuBytes(), levelBytes(settings.format, side, side), side, maxSide);
    settings.slots = _slots.count();
    _pager = std::make_shared<VirtualPager>(settings);
    _pager->setFrozen(_settings.freeze);
}

osg::ref_ptr<VirtualContext> VirtualResources::contextOf(osg::State& state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_pager)
        makePager(state);
    if (!_pager)
    {
        for (auto& each : _stores)
            open(each.second);
        return nullptr;
    }
    osg::ref_ptr<VirtualContext>& context = _contexts[state.getContextID()];
    if (!context)
        context = new VirtualContext(state.getContextID(), _pager, _slots);
    return context;
}

void VirtualResources::open(Store& store)
{
    if (store.isTried)
        return;
    store.isTried = true;
    try
    {
        if (!_pager)
        {
            openTileStore(store.line.file);
            return;
        }
        store.number = int(_pager->addTexture(store.line.file));
        const TileGrid grid = _pager->getGrid(std::uint32_t(store.number));
        store.line.width = grid.getWidth();
        store.line.height = grid.getHeight();
        store.line.pages = 0;
        for (int level = 0; level < pageLevels(grid); ++level)
            store.line.pages += grid.getTileCount(level);
    }
    catch (const TileStoreError& error)
    {
        store.line.error = error.what();
        OSG_WARN << "osgPagedTexture::VirtualScene: " << error.what()
                 << "; its surfaces show one colour" << std::endl;
    }
}

int VirtualResources::numberOf(const VirtualTexture& texture)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _stores.find(texture.getFile());
    if (found == _stores.end() || !_pager)
        return -1;
    open(found->second);
    return found->second.number;
}

std::shared_ptr<VirtualPager> VirtualResources::getPager() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _pager;
}

unsigned int VirtualResources::step(unsigned int frame, bool isNew)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (isNew || !_hasFrame || frame != _lastFrame)
        ++_step;
    _hasFrame = true;
    _lastFrame = frame;
    return _step;
}

void VirtualResources::reload(Store& store)
{
    if (store.number >= 0)
        _pager->invalidate(std::uint32_t(store.number));
    else
        store.isTried = false;
}

void VirtualResources::reload()
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto& each : _stores)
        reload(each.second);
}

void VirtualResources::update()
{
    std::vector<std::string> files;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        for (const auto& each : _stores)
            files.push_back(each.first);
    }
    _update.start(files,
                  [this](const std::string& file)
                  {
                      std::lock_guard<std::mutex> lock(_mutex);
                      reload(_stores.at(file));
                  });
}

void VirtualResources::say(double seconds)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_pager)
        return;
    for (const std::string& line : _pager->takeMessages())
        OSG_WARN << line << std::endl;
    if (!_settings.graph || seconds < _saidAt + 1.0)
        return;
    _saidAt = seconds;
    const VirtualPagerStatistics s = _pager->getStatistics();
    OSG_NOTICE << "osgPagedTexture::VirtualScene: " << s.usedSlots << " of " << s.slots
               << " slots, " << s.neededPages << " pages needed, " << s.missingPages << " missing, "
               << s.loadingPages << " loading, " << s.uploadedPages << " uploaded ("
               << s.uploadedBytes / 1048576 << " MiB), cache hits " << s.cacheHits << " of "
               << s.cacheHits + s.cacheMisses << ", last sharp after " << s.secondsUntilSharp
               << " s" << std::endl;
}

void VirtualResources::setBusy(const osg::Camera* camera, unsigned int frame, bool isBusy)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _busy[camera] = {frame, isBusy};
    for (auto each = _busy.begin(); each != _busy.end();)
        each = each->second.frame + framesSeen < frame ? _busy.erase(each) : std::next(each);
}

bool VirtualResources::isAtRest() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (_stores.empty())
        return true;
    if (_update.isRunning())
        return false;
    if (!_pager || !_pager->isAtRest())
        return !_pager && std::all_of(_stores.begin(), _stores.end(),
                                      [](const auto& each) { return each.second.isTried; });
    return !_busy.empty() && std::none_of(_busy.begin(), _busy.end(),
                                          [](const auto& each) { return each.second.isBusy; });
}

std::vector<VirtualResources::Line> VirtualResources::getLines() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    std::vector<Line> lines;
    for (const auto& each : _stores)
        lines.push_back(each.second.line);
    return lines;
}

void VirtualResources::releaseGLObjects(osg::State* state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto each = _contexts.begin(); each != _contexts.end();)
    {
        if (state && each->first != state->getContextID())
        {
            ++each;
            continue;
        }
        each->second->releaseGLObjects(state);
        each = _contexts.erase(each);
    }
}

} // namespace osgPagedTexture
