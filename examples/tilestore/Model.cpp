// SPDX-License-Identifier: MIT
#include "Model.h"

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/Registry>

#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace tilestore
{

namespace
{

class ToStandardError : public osg::NotifyHandler
{
public:
    void notify(osg::NotifySeverity, const char* message) override { std::fputs(message, stderr); }
};

} // namespace

void prepareOsg()
{
    osg::setNotifyHandler(new ToStandardError);
    std::error_code failure;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failure);
    if (failure)
        return;
    const std::filesystem::path folder = program.parent_path().parent_path();
    for (const char* name : {"lib", OSGTILESTORE_LIBRARY_FOLDER})
        osgDB::Registry::instance()->getLibraryFilePathList().push_back((folder / name).string());
}

osgPagedTexture::ModelPhotos readModel(const std::string& path, bool withPlaces)
{
    prepareOsg();
    osgPagedTexture::ModelPhotos model = osgPagedTexture::readModelPhotos(path, withPlaces);
    for (const osgPagedTexture::LeftSurface& left : model.left)
        std::fprintf(stderr, "'%s' is left out: %s\n", left.name.c_str(), left.reason.c_str());
    if (model.photos.empty())
        std::fprintf(stderr, "model '%s' shows no photograph\n", path.c_str());
    return model;
}

void requireFiles(const osgPagedTexture::ModelPhotos& model, const std::string& path)
{
    std::size_t inside = 0;
    std::string first;
    for (const osgPagedTexture::Photo& photo : model.photos)
        if (photo.file.empty() && inside++ == 0)
            first = photo.name;
    if (inside == 0)
        return;
    throw std::runtime_error("'" + first + "'" +
                             (inside > 1 ? " and " + grouped(inside - 1) + " more" : "") +
                             " are pictures inside of the model and no files; write them to files, "
                             "and name the new model: osgconv " +
                             path + " unpacked.osgb -O WriteImageHint=WriteOut");
}

Json leftOf(const osgPagedTexture::ModelPhotos& model)
{
    Json list = Json::array();
    for (const osgPagedTexture::LeftSurface& left : model.left)
        list.push_back({{"name", left.name}, {"reason", left.reason}});
    return list;
}

} // namespace tilestore
