// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileUpdate.h>

#include <osgPagedTexture/TileBuildText.h>
#include <osgPagedTexture/TileRefresh.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace osgPagedTexture
{

namespace
{

namespace fs = std::filesystem;
using nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& what)
{
    throw TileStoreError(TileStoreError::Kind::Refused, "osgPagedTexture::TileUpdate: " + what);
}

class Update
{
public:
    Update(const std::string& path, const TileUpdateSettings& settings)
        : _path(path), _settings(settings), _folder(fs::path(path).parent_path().string()),
          _layoutPath((fs::path(_folder) / readOrigin().layout).string()),
          _lock(_layoutPath, settings.pack.waitSeconds), _origin(readOrigin()),
          _layout(readAtlasLayout(_layoutPath))
    {
        _origin.settings.threads = settings.threads;
        _origin.settings.maxBytes = settings.maxBytes;
    }

    TileUpdateReport run()
    {
        const std::string storeHash = _origin.layoutHash;
        checkStore();
        const bool toWrite = takeChanges();
        if (_layout.pending.empty())
        {
            if (toWrite)
            {
                writeAtlasLayout(_layoutPath, _layout);
            }
            return std::move(_report);
        }
        // From here on, and until it is done, the layout says what is to be done.
        _layout.pendingSince = storeHash;
        writeAtlasLayout(_layoutPath, _layout);
        _origin.layoutHash = _layout.getContentHash();
        const std::vector<PhotoFailure> unread = makeTiles();
        if (_settings.afterwards)
        {
            _settings.afterwards(_layout, _folder);
        }
        for (const PhotoFailure& failure : unread)
        {
            _report.failures.push_back(failure.cause);
        }
        _layout.pending.clear();
        addPending(_layout, unread);
        _layout.pendingSince.clear();
        writeAtlasLayout(_layoutPath, _layout);
        return std::move(_report);
    }

private:
    TileStoreOrigin readOrigin() const
    {
        return TileStoreOrigin::parse(TilePackReader(_path).getSettings().description);
    }

    /// Whether the store is what the layout says, but for what is pending.
    void checkStore()
    {
        const bool known = _origin.layoutHash == _layout.getContentHash() ||
                           (!_layout.pending.empty() && _origin.layoutHash == _layout.pendingSince);
        if (!known)
        {
            _report.rebuilt = "the store was built from another state of its layout";
            _layout.pending.assign(1, {0, 0, _layout.width, _layout.height});
        }
    }

    bool takeChanges()
    {
        AtlasChanges changes = findChanges(_layout, _folder, findPhotosOf(_layout, _folder),
                                           _settings.lookInside, _settings.threads);
        if (_settings.keepMissing)
        {
            for (const std::string& path : changes.removed)
            {
                _report.notes.push_back("photograph '" + path +
                                        "' is not there; its tiles stay for now");
            }
            changes.removed.clear();
        }
        if (!_layout.photos.empty() && changes.removed.size() >= _layout.photos.size())
        {
            refuse("none of the photographs of '" + _layoutPath +
                   "' is where it was; mount their disk, or build the store anew");
        }
        for (const DescribedPhotos::Failure& failure : changes.failures)
        {
            _report.failures.push_back(failure.cause);
        }
        _report.changed = changes.changed.size();
        _report.added = changes.added.size();
        _report.removed = changes.removed.size();
        _report.moved = changes.moved.size();
        std::vector<std::string> notes = applyChanges(_layout, changes);
        _report.notes.insert(_report.notes.end(), notes.begin(), notes.end());
        return !changes.empty();
    }

    /// Returns the photographs that could not be read.
    std::vector<PhotoFailure> makeTiles()
    {
        TileRefresh refresh(_path, _layout, _origin, _settings.pack);
        if (_report.rebuilt.empty())
        {
            _report.rebuilt = refresh.whyImpossible();
        }
        if (_report.rebuilt.empty() && refresh.getShare() > _settings.rebuildShare)
        {
            _report.rebuilt = "most of the atlas has changed";
        }
        if (_report.rebuilt.empty())
        {
            refresh.run(_report);
            return refresh.getUnread();
        }
        const TileBuildReport built = buildTileStore(_path, _layout, _origin, _settings.pack);
        _report.touchedTiles = built.encodedTiles + built.uniformTiles;
        _report.changedTiles = _report.touchedTiles;
        return built.failures;
    }

    const std::string _path;
    const TileUpdateSettings _settings;
    const std::string _folder;
    const std::string _layoutPath;
    const AtlasLock _lock;
    TileStoreOrigin _origin;
    AtlasLayout _layout;
    TileUpdateReport _report;
};

} // namespace

std::string TileStoreOrigin::text() const
{
    ordered_json text = ordered_json::parse(describeBuild(settings));
    text["layout"] = layout;
    text["layoutHash"] = layoutHash;
    return text.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

TileStoreOrigin TileStoreOrigin::parse(const std::string& description)
{
    const ordered_json text = ordered_json::parse(description, nullptr, false);
    const auto word = [&](const char* name)
    {
        if (!text.is_object() || !text.contains(name) || !text[name].is_string())
        {
            refuse("the store does not say which layout it was built from; build it anew");
        }
        return text[name].get<std::string>();
    };
    TileStoreOrigin origin;
    origin.layout = word("layout");
    origin.layoutHash = word("layoutHash");
    origin.settings = parseBuild(description);
    return origin;
}

TileBuildReport buildTileStore(const std::string& path, const AtlasLayout& layout,
                               const TileStoreOrigin& origin,
                               const TilePackWriter::Options& options,
                               const TileBuilder::Progress& progress)
{
    TileBuilder builder(layout, fs::path(path).parent_path().string(), origin.settings);
    TileStoreSettings settings;
    settings.grid = builder.getGrid();
    settings.format = origin.settings.format.extension();
    settings.description = origin.text();
    TilePackWriter store(path, settings, options);
    TileStoreSettings keptSettings;
    std::unique_ptr<TilePackWriter> kept;
    if (builder.getKeptSettings(keptSettings))
    {
        keptSettings.description = settings.description;
        kept = std::make_unique<TilePackWriter>(keptPathOf(path), keptSettings, options);
    }
    const TileBuildReport report = builder.build(store, kept.get(), progress);
    if (kept)
    {
        kept->commit();
    }
    store.commit();
    return report;
}

TileUpdateReport updateTileStore(const std::string& path, const TileUpdateSettings& settings)
{
    return Update(path, settings).run();
}

} // namespace osgPagedTexture
