// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasModel.h>

#include <osgPagedTexture/FileImages.h>
#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/PictureFile.h>
#include <osgPagedTexture/StoreFile.h>
#include <osgPagedTexture/TileStore.h>
#include <osgPagedTexture/VirtualScene.h>

#include <osg/NodeVisitor>
#include <osg/ValueObject>
#include <osgDB/FileNameUtils>
#include <osgDB/Registry>

#include <cstring>
#include <filesystem>
#include <set>

namespace osgPagedTexture
{

namespace
{

namespace fs = std::filesystem;

/// All textures below a node.
class TextureVisitor : public osg::NodeVisitor
{
public:
    TextureVisitor() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override
    {
        const osg::StateSet* stateSet = node.getStateSet();
        for (unsigned int unit = 0; stateSet && unit < stateSet->getNumTextureAttributeLists();
             ++unit)
        {
            const osg::StateAttribute* attribute =
                stateSet->getTextureAttribute(unit, osg::StateAttribute::TEXTURE);
            if (attribute)
                textures.insert(const_cast<osg::Texture*>(attribute->asTexture()));
        }
        traverse(node);
    }
    void apply(osg::Drawable& drawable) override { apply(static_cast<osg::Node&>(drawable)); }

    std::set<osg::Texture*> textures;
};

bool hasPicturesInside(const std::string& path)
{
    const std::string extension = osgDB::getLowerCaseFileExtension(path);
    for (const char* each : {"osgb", "osgt", "osgx", "ive"})
        if (extension == each)
            return true;
    return false;
}

std::string relativeTo(const fs::path& folder, const std::string& file)
{
    std::error_code failure;
    const fs::path near = fs::relative(file, folder, failure);
    return failure || near.empty() ? file : near.generic_string();
}

Pixels pixelsOf(const osg::Image& image)
{
    Pixels pixels(image.s(), image.t(), 3);
    for (int y = 0; y < image.t(); ++y)
        std::memcpy(pixels.row(y), image.data(0, y), std::size_t(image.s()) * 3);
    return pixels;
}

/// The overview is inside of the model or beside it, photographs stay where they are.
void prepareImage(osg::Texture& texture, const ModelPhotos& model, const fs::path& path)
{
    osg::Image* image = texture.getImage(0);
    if (!image)
        return;
    std::string store;
    if (texture.getUserValue("osgPagedTexture.store", store))
    {
        const std::string name = path.stem().string() + ".overview.png";
        image->setFileName(name);
        const bool inside = hasPicturesInside(path.string());
        image->setWriteHint(inside ? osg::Image::STORE_INLINE : osg::Image::EXTERNAL_FILE);
        if (!inside)
            writePictureFile((path.parent_path() / name).string(), pixelsOf(*image));
        return;
    }
    const std::string file = photoFileOf(texture, model.images.get());
    if (file.empty())
        return;
    image->setFileName(relativeTo(path.parent_path().empty() ? "." : path.parent_path(), file));
    image->setWriteHint(osg::Image::EXTERNAL_FILE);
}

bool hasClassesOfKits(const std::string& extension)
{
    return extension == "osgb" || extension == "osgt" || extension == "osgx";
}

/// Its textures that name a store become virtual ones.
osg::ref_ptr<osg::Node> virtualSceneOf(osg::Node& model, const std::string& path)
{
    // Without it the file would be written, without the model.
    if (!osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper(
            "osgPagedTexture::VirtualScene"))
        throw ModelError("model '" + path +
                         "' can't be written: the plugin osgdb_serializers_osgpagedtexture is not "
                         "found; set OSG_LIBRARY_PATH, or write it for plain viewers");
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->getDatabasePathList().push_back(osgDB::getFilePath(path));
    const osg::ref_ptr<VirtualScene> scene = new VirtualScene;
    scene->addChild(&model);
    scene->install(options);
    return scene;
}

/// A folder beside a model that is written, with all the files that the plugin makes, and removed
/// at its end: a full disk spares the model that was there.
class ModelFolder
{
public:
    explicit ModelFolder(const std::string& model)
        : _model(model), _folder(model + ".part"), _file((_folder / _model.filename()).string())
    {
        std::error_code error;
        fs::create_directories(_folder, error);
        if (error)
            throw ModelError("model '" + model + "' can't be written: folder '" + _folder.string() +
                             "' can't be made: " + error.message());
    }
    ~ModelFolder()
    {
        std::error_code ignored;
        fs::remove_all(_folder, ignored);
    }
    ModelFolder(const ModelFolder&) = delete;
    ModelFolder& operator=(const ModelFolder&) = delete;

    const std::string& getFile() const { return _file; }

    void checkFiles() const
    {
        for (const auto& entry : fs::directory_iterator(_folder))
            if (entry.is_regular_file())
                checkRoom(entry.path().string());
    }

    /// The model itself comes last.
    void moveOut() const
    {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(_folder))
            if (entry.path() != _file)
                files.push_back(entry.path());
        files.emplace_back(_file);
        for (const fs::path& file : files)
        {
            std::error_code error;
            const fs::path place = _model.parent_path() / file.filename();
            fs::rename(file, place, error);
            if (error)
                throw ModelError("'" + place.string() + "' can't be replaced: " + error.message());
        }
    }

private:
    const fs::path _model, _folder;
    const std::string _file;
};

} // namespace

void writeAtlasModel(const ModelPhotos& model, const std::string& path, AtlasModelViewer viewer)
{
    TextureVisitor visitor;
    model.model->accept(visitor);
    for (osg::Texture* texture : visitor.textures)
        prepareImage(*texture, model, path);
    osgDB::Registry* registry = osgDB::Registry::instance();
    const std::string extension = osgDB::getLowerCaseFileExtension(path);
    if (!registry->getReaderWriterForExtension(extension))
        throw ModelError("model '" + path + "' can't be written: no plugin of OSG knows '." +
                         extension + "'; use .osgb");
    const osg::ref_ptr<osg::Node> written =
        viewer == AtlasModelViewer::Kit && hasClassesOfKits(extension)
            ? virtualSceneOf(*model.model, path)
            : model.model;
    const ModelFolder folder(path);
    const osgDB::ReaderWriter::WriteResult result =
        registry->writeNode(*written, folder.getFile(), registry->getOptions());
    folder.checkFiles();
    if (!result.success())
    {
        const std::string cause = !result.message().empty() ? result.message()
                                  : result.notHandled() ? "OSG reads this format only; use .osgb"
                                                        : "its plugin failed";
        throw ModelError("model '" + path + "' can't be written: " + cause);
    }
    folder.moveOut();
}

} // namespace osgPagedTexture
