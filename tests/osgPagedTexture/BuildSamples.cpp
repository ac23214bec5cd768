// SPDX-License-Identifier: MIT
#include "BuildSamples.h"

#include <filesystem>

namespace osgPagedTexture
{

namespace
{

AtlasPhoto photoOf(const std::string& name, const Pixels& pixels)
{
    AtlasPhoto photo;
    photo.path = name;
    photo.width = pixels.width;
    photo.height = pixels.height;
    return photo;
}

} // namespace

void PhotoWall::add(const std::string& name, int width, int height, int channels)
{
    photos.push_back(samplePicture(width, height, channels, unsigned(photos.size() + 1)));
    std::filesystem::create_directories(std::filesystem::path(file(name)).parent_path());
    writePicture(file(name), photos.back());
    _placed.push_back(photoOf(name, photos.back()));
}

void PhotoWall::addFile(const std::string& name, const std::string& bytes, Pixels pixels)
{
    _folder.write(name, bytes);
    _placed.push_back(photoOf(name, pixels));
    photos.push_back(std::move(pixels));
}

void PhotoWall::place(const AtlasSettings& settings)
{
    layout = packAtlas(_placed, settings);
}

TileBuildSettings smallTiles()
{
    TileBuildSettings settings;
    settings.tileSide = 32;
    settings.border = 3;
    settings.format.coding = TileCoding::Png;
    settings.format.compression = 1;
    settings.threads = 2;
    return settings;
}

TileBuildReport buildInto(const PhotoWall& wall, const TileBuildSettings& settings,
                          const std::string& name, const std::string& kept)
{
    TileBuilder builder(wall.layout, wall.folder(), settings);
    TilePackWriter::Options options;
    options.durable = false;
    TileStoreSettings storeSettings, keptSettings;
    storeSettings.grid = builder.getGrid();
    storeSettings.format = settings.format.extension();
    TilePackWriter store(wall.file(name), storeSettings, options);
    std::unique_ptr<TilePackWriter> keptStore;
    if (!kept.empty() && builder.getKeptSettings(keptSettings))
    {
        keptStore = std::make_unique<TilePackWriter>(wall.file(kept), keptSettings, options);
    }
    const TileBuildReport report = builder.build(store, keptStore.get());
    store.commit();
    if (keptStore)
    {
        keptStore->commit();
    }
    return report;
}

} // namespace osgPagedTexture
