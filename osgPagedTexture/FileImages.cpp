// SPDX-License-Identifier: MIT
#include <osgPagedTexture/FileImages.h>

#include <osgPagedTexture/StandInCallback.h>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <algorithm>
#include <cstring>
#include <mutex>

namespace osgPagedTexture
{

namespace
{

thread_local FileImages* threadImages = nullptr;

/// The Registry's callback while any thread has a FileImages.
class Registration
{
public:
    void enter()
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (_users++ > 0)
            return;
        osgDB::Registry* registry = osgDB::Registry::instance();
        _callback = new StandInCallback(registry->getReadFileCallback());
        registry->setReadFileCallback(_callback);
    }
    void leave()
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (--_users > 0)
            return;
        osgDB::Registry* registry = osgDB::Registry::instance();
        // Who has put another one there meanwhile keeps it; this one only hands on then.
        if (registry->getReadFileCallback() == _callback.get())
            registry->setReadFileCallback(_callback->getNext());
        _callback = nullptr;
    }
    static Registration& instance()
    {
        static Registration registration;
        return registration;
    }

private:
    std::mutex _mutex;
    int _users = 0;
    osg::ref_ptr<StandInCallback> _callback;
};

/// Formats that are on the GPU as they are in the file, that move, or that are no pictures.
bool isLeftAlone(const std::string& extension)
{
    static const char* const extensions[] = {"dds", "ktx",  "ktx2", "pvr", "gif", "avi",  "mp4",
                                             "mpg", "mpeg", "mov",  "ogv", "mkv", "webm", "flv"};
    return std::find(std::begin(extensions), std::end(extensions), extension) !=
           std::end(extensions);
}

/// The number of a stand-in in its texel, so that readers that copy pixels keep it.
void setNumber(osg::Image& image, std::size_t number)
{
    for (int channel = 0; channel < 3; ++channel)
        image.data()[channel] = static_cast<unsigned char>(number >> (8 * channel));
}

} // namespace

osg::ref_ptr<osg::Image> makeKeptStandIn(const std::string& name, bool translucent)
{
    // One block: the optimizer puts nothing that is compressed into an atlas of textures.
    constexpr GLenum Dxt1 = 0x83F0, Dxt5 = 0x83F3;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(4, 4, 1, translucent ? Dxt5 : Dxt1, GL_UNSIGNED_BYTE);
    image->setInternalTextureFormat(GLint(translucent ? Dxt5 : Dxt1));
    std::memset(image->data(), 0, image->getTotalSizeInBytes());
    if (translucent)
        image->data()[0] = image->data()[1] = 128; // Alpha of all texels.
    image->setFileName(name);
    image->setWriteHint(osg::Image::EXTERNAL_FILE);
    return image;
}

namespace
{

/// Of one grey texel, which readers can make a texture of.
osg::ref_ptr<osg::Image> makeStandIn(const std::string& name, bool translucent)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(1, 1, 1, translucent ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE);
    std::memset(image->data(), 128, image->getTotalSizeInBytes());
    image->setFileName(name);
    return image;
}

} // namespace

FileImages::FileImages() : _outer(threadImages)
{
    Registration::instance().enter();
    threadImages = this;
}

FileImages::~FileImages()
{
    threadImages = _outer;
    Registration::instance().leave();
}

FileImages* FileImages::current()
{
    return threadImages;
}

osg::ref_ptr<const osgDB::Options> FileImages::optionsFor(const osgDB::Options* options) const
{
    if (!options || !options->getReadFileCallback())
        return options;
    osg::ref_ptr<osgDB::Options> own = options->cloneOptions();
    own->setReadFileCallback(new StandInCallback(options->getReadFileCallback()));
    return own;
}

osg::ref_ptr<osg::Image> FileImages::standIn(const std::string& name, const osgDB::Options* options)
{
    if (isLeftAlone(osgDB::getLowerCaseFileExtension(name)))
        return nullptr;
    const std::string file = osgDB::findDataFile(name, options);
    if (file.empty())
        return nullptr;
    const auto known = _byName.find({name, file});
    if (known != _byName.end())
        return _found[known->second].image;
    Found found{name, file, {}, nullptr, options};
    try
    {
        found.info = readImageInfo(file);
    }
    catch (const ImageError& error)
    {
        // The readers of OSG may know the format, and warn as ever where they don't.
        OSG_INFO << "osgPagedTexture: " << error.what() << std::endl;
        return nullptr;
    }
    found.image = makeStandIn(name, found.info.translucent);
    setNumber(*found.image, _found.size());
    _byName[{name, file}] = _found.size();
    _found.push_back(found);
    return found.image;
}

const FileImages::Found* FileImages::find(const osg::Image& image) const
{
    if (image.s() != 1 || image.t() != 1 || image.r() != 1 || !image.data() ||
        image.getDataType() != GL_UNSIGNED_BYTE ||
        (image.getPixelFormat() != GL_RGB && image.getPixelFormat() != GL_RGBA))
        return nullptr;
    const unsigned char* texel = image.data();
    const std::size_t number = texel[0] | texel[1] << 8 | texel[2] << 16;
    if (number >= _found.size() || _found[number].name != image.getFileName())
        return nullptr;
    return &_found[number];
}

void FileImages::restore(osg::Image& image, const Found& found) const
{
    // As the thread would read it without this object.
    FileImages* const current = threadImages;
    threadImages = nullptr;
    osg::ref_ptr<const osgDB::Options> options = found.options;
    osgDB::ReaderWriter::ReadResult result =
        osgDB::Registry::instance()->readImage(found.file, options.get());
    threadImages = current;
    const osg::Image* read = result.validImage() ? result.getImage() : nullptr;
    if (!read || !read->data())
    {
        OSG_WARN << "osgPagedTexture: '" << found.file
                 << "' can't be read by OSG, so what is not a plain 2D texture is without it"
                 << std::endl;
        return;
    }
    const unsigned int bytes = read->getTotalSizeInBytesIncludingMipmaps();
    auto* data = new unsigned char[bytes];
    std::memcpy(data, read->data(), bytes);
    image.setImage(read->s(), read->t(), read->r(), read->getInternalTextureFormat(),
                   read->getPixelFormat(), read->getDataType(), data, osg::Image::USE_NEW_DELETE,
                   int(read->getPacking()));
    image.setMipmapLevels(read->getMipmapLevels());
    image.setOrigin(read->getOrigin());
    image.setWriteHint(read->getWriteHint());
}

void FileImages::restoreHeld() const
{
    for (const Found& found : _found)
        if (found.image->referenceCount() > 1)
            restore(*found.image, found);
}

} // namespace osgPagedTexture
