// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ModelPhotos.h>

#include <osgPagedTexture/ArrayPoint.h>
#include <osgPagedTexture/FileImages.h>
#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/TextureState.h>

#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/ProxyNode>
#include <osg/Texture2D>
#include <osg/Transform>
#include <osg/TriangleIndexFunctor>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

namespace osgPagedTexture
{

namespace
{

bool isFinite(const osg::Vec3d& v)
{
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

/// Adds a geometry's triangles to a surface. osg::TriangleIndexFunctor makes its own object.
struct TriangleAdder
{
    PhotoSurface* surface = nullptr;
    const osg::Array* places = nullptr; ///< Null: not wanted.
    const osg::Array* coordinates = nullptr;
    const osg::Matrixd* toModel = nullptr;
    const osg::Matrixd* toTexture = nullptr; ///< Null: none.

    bool read(unsigned int index, glm::vec2& coordinate, glm::dvec3& place) const
    {
        const bool same = coordinates->getBinding() == osg::Array::BIND_OVERALL;
        const unsigned int element = same ? 0 : index;
        if (element >= coordinates->getNumElements() ||
            (places && index >= places->getNumElements()))
            return false;
        glm::dvec3 point = pointOf(*coordinates, element);
        if (toTexture)
        {
            const osg::Vec4d turned = osg::Vec4d(point.x, point.y, point.z, 1.0) * *toTexture;
            point = glm::dvec3(turned.x(), turned.y(), 0.0) / turned.w();
        }
        coordinate = glm::vec2(point);
        if (!std::isfinite(coordinate.x) || !std::isfinite(coordinate.y))
            return false;
        if (!places)
            return true;
        const glm::dvec3 local = pointOf(*places, index);
        const osg::Vec3d global = osg::Vec3d(local.x, local.y, local.z) * *toModel;
        place = {global.x(), global.y(), global.z()};
        return isFinite(global);
    }

    void operator()(unsigned int a, unsigned int b, unsigned int c) const
    {
        const unsigned int indices[3] = {a, b, c};
        glm::vec2 corners[3];
        glm::dvec3 points[3];
        for (int i = 0; i < 3; ++i)
        {
            if (!read(indices[i], corners[i], points[i]))
            {
                ++surface->skipped;
                return;
            }
        }
        surface->coordinates.insert(surface->coordinates.end(), corners, corners + 3);
        if (places)
            surface->places.insert(surface->places.end(), points, points + 3);
    }
};

class PhotoCollector : public TextureStateVisitor
{
public:
    PhotoCollector(ModelPhotos& result, bool withPlaces) : _result(result), _withPlaces(withPlaces)
    {
    }

    using TextureStateVisitor::apply;
    void apply(osg::Transform& node) override
    {
        _matrices.push_back(_matrices.back());
        node.computeLocalToWorldMatrix(_matrices.back(), this);
        apply(static_cast<osg::Node&>(node));
        _matrices.pop_back();
    }
    void apply(osg::PagedLOD& node) override { applyPaged(node, node.getNumFileNames()); }
    void apply(osg::ProxyNode& node) override { applyPaged(node, node.getNumFileNames()); }

protected:
    void visit(osg::Drawable& drawable, const TextureState& state) override
    {
        for (unsigned int unit = 0; unit < state.getUnits(); ++unit)
            add(drawable, unit, state.get(unit));
    }

private:
    using SurfaceKey = std::tuple<std::size_t, PhotoWrap, PhotoWrap>;

    void leave(const std::string& name, const std::string& reason)
    {
        if (_seenLeft.insert({name, reason}).second)
            _result.left.push_back({name, reason});
    }

    template <class Paged> void applyPaged(Paged& node, unsigned int files)
    {
        if (files > node.getNumChildren())
            leave(node.getName(), "parts of the model that are in files of their own are not read");
        apply(static_cast<osg::Node&>(node));
    }

    void add(osg::Drawable& drawable, unsigned int unit, const TextureUnit& state)
    {
        if (!state.texture || state.isOff)
            return;
        const osg::Image* image = state.texture->getImage(0);
        if (!image)
            return;
        if (!dynamic_cast<const osg::Texture2D*>(state.texture.get()))
            return leave(image->getFileName(), "it is not a 2D texture");
        if (state.isGenerated)
            return leave(image->getFileName(), "its coordinates are generated");
        const osg::Geometry* geometry = drawable.asGeometry();
        const osg::Array* coordinates = geometry ? geometry->getTexCoordArray(unit) : nullptr;
        if (!isReadable(coordinates, false) || !isReadable(geometry->getVertexArray(), true))
            return leave(image->getFileName(), "a drawable has no coordinates for it");
        PhotoSurface& surface = surfaceOf(*state.texture);
        osg::TriangleIndexFunctor<TriangleAdder> triangles;
        triangles.surface = &surface;
        triangles.places = _withPlaces ? geometry->getVertexArray() : nullptr;
        triangles.coordinates = coordinates;
        triangles.toModel = &_matrices.back();
        const osg::Matrixd matrix = state.matrix ? state.matrix->getMatrix() : osg::Matrixd();
        triangles.toTexture = matrix.isIdentity() ? nullptr : &matrix;
        geometry->accept(triangles);
    }

    PhotoSurface& surfaceOf(const osg::Texture& texture)
    {
        const std::size_t photo = photoOf(texture);
        std::vector<PhotoSurface>& surfaces = _result.photos[photo].surfaces;
        const PhotoWrap s = wrapOf(texture, osg::Texture::WRAP_S);
        const PhotoWrap t = wrapOf(texture, osg::Texture::WRAP_T);
        for (PhotoSurface& surface : surfaces)
            if (surface.wrapS == s && surface.wrapT == t)
                return surface;
        surfaces.emplace_back();
        surfaces.back().wrapS = s;
        surfaces.back().wrapT = t;
        return surfaces.back();
    }

    std::size_t photoOf(const osg::Texture& texture)
    {
        const osg::Image& image = *texture.getImage(0);
        const auto known = _ofImage.find(&image);
        if (known != _ofImage.end())
            return known->second;
        Photo photo;
        photo.file = photoFileOf(texture, _result.images.get());
        photo.name = image.getFileName();
        photo.width = image.s();
        photo.height = image.t();
        if (_result.images)
        {
            if (const FileImages::Found* found = _result.images->find(image))
            {
                photo.width = found->info.width;
                photo.height = found->info.height;
            }
        }
        auto place = _ofFile.end();
        if (!photo.file.empty())
            place = _ofFile.find(photo.file);
        const std::size_t number = place == _ofFile.end() ? _result.photos.size() : place->second;
        if (place == _ofFile.end())
        {
            if (!photo.file.empty())
                _ofFile[photo.file] = number;
            _result.photos.push_back(photo);
        }
        return _ofImage[&image] = number;
    }

    ModelPhotos& _result;
    const bool _withPlaces;
    std::vector<osg::Matrixd> _matrices{osg::Matrixd()};
    std::map<const osg::Image*, std::size_t> _ofImage;
    std::map<std::string, std::size_t> _ofFile;
    std::set<std::pair<std::string, std::string>> _seenLeft;
};

} // namespace

PhotoWrap wrapOf(const osg::Texture& texture, osg::Texture::WrapParameter side)
{
    switch (texture.getWrap(side))
    {
    case osg::Texture::REPEAT:
        return PhotoWrap::Repeat;
    case osg::Texture::MIRROR:
        return PhotoWrap::Mirror;
    default:
        return PhotoWrap::Clamp;
    }
}

namespace
{

/// Whether a picture that a model has inside may be the file of its name.
bool hasSize(const std::string& file, const osg::Image& image)
{
    try
    {
        ImageLimits any;
        any.maxPixels = any.maxBytes = std::numeric_limits<std::uint64_t>::max();
        const ImageInfo info = readImageInfo(file, any, false);
        return info.width == image.s() && info.height == image.t();
    }
    catch (const ImageError&)
    {
        return false;
    }
}

} // namespace

std::string photoFileOf(const osg::Texture& texture, const FileImages* images)
{
    const osg::Image* image = texture.getImage(0);
    if (!image)
        return {};
    const FileImages::Found* found = images ? images->find(*image) : nullptr;
    const std::string file = found ? found->file : osgDB::findDataFile(image->getFileName());
    if (file.empty() || (!found && !hasSize(file, *image)))
        return {};
    std::error_code failure;
    const auto path = std::filesystem::weakly_canonical(file, failure);
    return failure ? file : path.string();
}

void collectPhotos(ModelPhotos& photos, bool withPlaces)
{
    photos.photos.clear();
    photos.left.clear();
    PhotoCollector collector(photos, withPlaces);
    photos.model->accept(collector);
}

ModelPhotos readModelPhotos(const std::string& path, bool withPlaces)
{
    ModelPhotos photos;
    const auto images = std::make_shared<FileImages>();
    osgDB::Registry* registry = osgDB::Registry::instance();
    // Textures are named from the model's folder.
    osg::ref_ptr<osgDB::Options> options =
        registry->getOptions() ? registry->getOptions()->cloneOptions() : new osgDB::Options;
    options->getDatabasePathList().push_front(osgDB::getFilePath(path));
    osgDB::ReaderWriter::ReadResult result =
        registry->readNode(path, const_cast<osgDB::Options*>(images->optionsFor(options).get()));
    photos.model = result.takeNode();
    photos.images = images;
    if (!photos.model)
    {
        const std::string extension = osgDB::getLowerCaseFileExtension(path);
        std::string cause = !result.message().empty() ? result.message()
                            : result.notFound()       ? "it is not there"
                            : !registry->getReaderWriterForExtension(extension)
                                ? "no plugin of OSG reads '." + extension + "'"
                                : "its plugin does not understand it";
        throw ModelError("model '" + path + "' can't be read: " + cause);
    }
    collectPhotos(photos, withPlaces);
    return photos;
}

} // namespace osgPagedTexture
