// SPDX-License-Identifier: MIT
// The settings of a MixedScene as text, and its files.
#include <osgMultiRender/MixedScene.h>

#include <osgMultiRender/Import.h>
#include <osgMultiRender/MixFile.h>
#include <osgMultiRender/MixPass.h>
#include <osgMultiRender/MixWatch.h>

#include <osg/Notify>
#include <osgDB/Registry>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

constexpr std::chrono::milliseconds WatchPeriod(1000);

std::vector<std::string> filesOf(const RenderingTexture& texture)
{
    std::vector<std::string> files = texture.faces;
    if (!texture.fileName.empty())
        files.push_back(texture.fileName);
    return files;
}

std::vector<std::string> filesOf(const Rendering& rendering)
{
    std::vector<std::string> files;
    if (rendering.fileName.empty())
        return files;
    files.push_back(rendering.fileName);
    for (const RenderingShader& shader : rendering.shaders)
        if (!shader.fileName.empty())
            files.push_back(shader.fileName);
    for (const RenderingTexture& texture : rendering.textures)
        for (const std::string& file : filesOf(texture))
            files.push_back(file);
    return files;
}

/// What replaces a rendering of the same file, or of the same name where there is none.
bool isSameSource(const Rendering& a, const Rendering& b)
{
    return a.fileName == b.fileName && (!a.fileName.empty() || a.name == b.name);
}

/// Images are kept by OSG: one that has changed is to be read anew.
void forgetImage(const std::string& file)
{
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setObjectCacheHint(osgDB::Options::CACHE_IMAGES);
    osgDB::Registry::instance()->removeFromObjectCache(file, options);
}

} // namespace

void MixedScene::setMixText(const std::string& text)
{
    std::string error;
    const osg::ref_ptr<MixedScene> other = new MixedScene;
    if (!applyMix(*other, text, {}, error))
    {
        OSG_WARN << "osgMultiRender::MixedScene: " << error << std::endl;
        return;
    }
    takeSettings(*other);
    setWatching(other->isWatching());
}

std::string MixedScene::getMixText() const
{
    return formatMix(*this);
}

osg::ref_ptr<MixedScene> MixedScene::cloneSettings() const
{
    osg::ref_ptr<MixedScene> settings = new MixedScene;
    settings->takeSettings(*this);
    return settings;
}

void MixedScene::takeSettings(const MixedScene& other)
{
    if (this == &other)
        return;
    const std::shared_ptr<const MixSnapshot> from = other.getSnapshot();
    const std::vector<osg::Vec3d> points = other.getKeyPoints();
    const MixMarks marks = other.getMarks();
    const bool answersKeys = other.getAnswersKeys();
    std::lock_guard<std::mutex> lock(_settings);
    const bool keepsLimits = !_snapshot->limits && !from->limits;
    if (_snapshot->isOfFrame != from->isOfFrame || !keepsLimits)
        _resources = std::make_shared<MixResources>();
    auto snapshot = std::make_shared<MixSnapshot>(*from);
    snapshot->mixRevision = _snapshot->mixRevision + 1;
    snapshot->uniformRevision = _snapshot->uniformRevision + 1;
    // A broken one leaves what the same file has shown.
    for (MixSlot& slot : snapshot->slots)
        for (const MixSlot& old : _snapshot->slots)
            if (slot.rendering && old.rendering && slot.id != old.id && !slot.before &&
                isSameSource(*slot.rendering, *old.rendering))
                slot.before = beforeOf(old);
    _snapshot = std::move(snapshot);
    _points = points;
    _marks = marks;
    _answersKeys = answersKeys;
    _drawnMarks = nullptr;
}

void MixedScene::setMixFile(const std::string& fileName)
{
    std::lock_guard<std::mutex> lock(_settings);
    _mixFile = fileName;
}

std::string MixedScene::getMixFile() const
{
    std::lock_guard<std::mutex> lock(_settings);
    return _mixFile;
}

void MixedScene::setWatching(bool watches)
{
    if (watches == isWatching())
        return;
    std::unique_ptr<MixWatch> watch; // made and ended without the lock, which its thread takes
    if (watches)
        watch = std::make_unique<MixWatch>(
            [this] { return getWatchedFiles(); },
            [this](const std::vector<std::string>& files) { reimport(files, false); }, WatchPeriod);
    std::lock_guard<std::mutex> lock(_watching);
    std::swap(_watch, watch);
}

bool MixedScene::isWatching() const
{
    std::lock_guard<std::mutex> lock(_watching);
    return _watch != nullptr;
}

std::vector<std::string> MixedScene::getWatchedFiles() const
{
    std::vector<std::string> files;
    if (const std::string mix = getMixFile(); !mix.empty())
        files.push_back(mix);
    for (const unsigned int number : getRenderings())
        if (const std::shared_ptr<const Rendering> rendering = getRendering(number))
            for (const std::string& file : filesOf(*rendering))
                files.push_back(file);
    return files;
}

void MixedScene::readFilesAgain()
{
    reimport({}, true);
}

void MixedScene::reimport(const std::vector<std::string>& files, bool all)
{
    const auto isChanged = [&](const std::string& file)
    { return all || std::find(files.begin(), files.end(), file) != files.end(); };
    if (const std::string mix = getMixFile(); !mix.empty() && isChanged(mix))
    {
        const osg::ref_ptr<MixedScene> settings = cloneSettings();
        for (const unsigned int number : getRenderings())
            settings->removeRendering(number);
        std::string error;
        if (readMixFile(*settings, mix, error))
            return takeSettings(*settings);
        OSG_WARN << "osgMultiRender::MixedScene: " << error << "; the mix stays as it was"
                 << std::endl;
    }
    for (const unsigned int number : getRenderings())
    {
        const std::shared_ptr<const Rendering> rendering = getRendering(number);
        if (!rendering)
            continue;
        const std::vector<std::string> own = filesOf(*rendering);
        if (std::none_of(own.begin(), own.end(), isChanged))
            continue;
        for (const RenderingTexture& texture : rendering->textures)
            for (const std::string& file : filesOf(texture))
                forgetImage(file);
        setRendering(number, importRendering(rendering->fileName));
    }
}

} // namespace osgMultiRender
