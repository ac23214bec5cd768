// SPDX-License-Identifier: MIT
#include <osgPagedTexture/SavedImages.h>

#include <osgPagedTexture/EmbeddedImages.h>
#include <osgPagedTexture/PagedSubload.h>

#include <osg/NodeVisitor>
#include <osg/Notify>
#include <osgDB/Registry>

#include <algorithm>
#include <map>
#include <mutex>

namespace osgPagedTexture
{

namespace
{

using Result = osgDB::ReaderWriter::WriteResult;

class PagedTextureFinder : public osg::NodeVisitor
{
public:
    PagedTextureFinder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override
    {
        if (osg::StateSet* stateSet = node.getStateSet())
            for (unsigned int unit = 0; unit < stateSet->getNumTextureAttributeLists(); ++unit)
            {
                osg::Texture2D* texture = dynamic_cast<osg::Texture2D*>(
                    stateSet->getTextureAttribute(unit, osg::StateAttribute::TEXTURE));
                const auto* paged =
                    texture ? dynamic_cast<const PagedSubload*>(texture->getSubloadCallback())
                            : nullptr;
                if (paged)
                    found[texture] = paged;
            }
        traverse(node);
    }
    void apply(osg::Drawable& drawable) override { apply(static_cast<osg::Node&>(drawable)); }

    std::map<osg::ref_ptr<osg::Texture2D>, const PagedSubload*> found;
};

/// Whether the file is to hold pictures that have files of their own.
bool takesPixels(const osgDB::Options* options)
{
    if (!options)
        return false;
    const std::string text =
        options->getOptionString() + " " + options->getPluginStringData("WriteImageHint") + " ";
    constexpr const char* words[] = {"IncludeData", "WriteOut", "OutputTextureFiles",
                                     "inlineImages", "inlineTexturesInIVEFile"};
    return std::any_of(std::begin(words), std::end(words),
                       [&](const char* word) { return text.find(word) != std::string::npos; });
}

osg::ref_ptr<osg::Image> pictureOf(const PagedOrigin& origin)
{
    osg::ref_ptr<osg::Image> image;
    if (origin.format)
    {
        image = EmbeddedImages::read(origin.file, origin.format);
        if (image)
            image->setInternalTextureFormat(origin.internalFormat);
    }
    else
    {
        osgDB::ReaderWriter::ReadResult result =
            osgDB::Registry::instance()->readImage(origin.file, nullptr);
        image = result.validImage() ? result.getImage() : nullptr;
    }
    if (image)
        image->setFileName(origin.name);
    else
        OSG_WARN << "osgPagedTexture::SavedImages: '" << origin.file
                 << "' can't be read, so what is written has the name of the picture alone"
                 << std::endl;
    return image;
}

/// While it lives, textures of a graph have their pictures.
class Pictures
{
public:
    Pictures(const osg::Node& node, const osgDB::Options* options)
    {
        PagedTextureFinder finder;
        const_cast<osg::Node&>(node).accept(finder);
        for (const auto& [texture, paged] : finder.found)
        {
            const PagedOrigin& origin = paged->getOrigin();
            const bool isNeeded = origin.format || takesPixels(options);
            const osg::ref_ptr<osg::Image> picture = isNeeded ? pictureOf(origin) : nullptr;
            if (!picture)
                continue;
            picture->setWriteHint(origin.format ? origin.hint : osg::Image::NO_PREFERENCE);
            _standIns.emplace_back(texture, texture->getImage());
            texture->setImage(picture);
        }
    }
    ~Pictures()
    {
        for (const auto& [texture, standIn] : _standIns)
            texture->setImage(standIn);
    }
    Pictures(const Pictures&) = delete;
    Pictures& operator=(const Pictures&) = delete;

private:
    std::vector<std::pair<osg::ref_ptr<osg::Texture2D>, osg::ref_ptr<osg::Image>>> _standIns;
};

/// Hands all on to another callback, or to the Registry.
class PictureCallback : public osgDB::WriteFileCallback
{
public:
    explicit PictureCallback(osgDB::WriteFileCallback* next)
        : _next(next ? next : new osgDB::WriteFileCallback), _former(next)
    {
    }

    Result writeNode(const osg::Node& node, const std::string& name,
                     const osgDB::Options* options) override
    {
        const std::lock_guard<std::recursive_mutex> lock(_mutex);
        const Pictures pictures(node, options);
        return _next->writeNode(node, name, options);
    }
    Result writeObject(const osg::Object& object, const std::string& name,
                       const osgDB::Options* options) override
    {
        const osg::Node* node = dynamic_cast<const osg::Node*>(&object);
        if (!node)
            return _next->writeObject(object, name, options);
        const std::lock_guard<std::recursive_mutex> lock(_mutex);
        const Pictures pictures(*node, options);
        return _next->writeObject(object, name, options);
    }
    Result writeImage(const osg::Image& image, const std::string& name,
                      const osgDB::Options* options) override
    {
        return _next->writeImage(image, name, options);
    }
    Result writeHeightField(const osg::HeightField& field, const std::string& name,
                            const osgDB::Options* options) override
    {
        return _next->writeHeightField(field, name, options);
    }
    Result writeShader(const osg::Shader& shader, const std::string& name,
                       const osgDB::Options* options) override
    {
        return _next->writeShader(shader, name, options);
    }
    Result writeScript(const osg::Script& script, const std::string& name,
                       const osgDB::Options* options) override
    {
        return _next->writeScript(script, name, options);
    }

    osgDB::WriteFileCallback* getFormer() const { return _former.get(); }

private:
    const osg::ref_ptr<osgDB::WriteFileCallback> _next, _former;
    std::recursive_mutex _mutex; ///< Files within files.
};

struct Registration
{
    std::mutex mutex;
    int users = 0;
    osg::ref_ptr<PictureCallback> callback;
};

Registration& registration()
{
    static Registration one;
    return one;
}

} // namespace

SavedImages::SavedImages()
{
    Registration& one = registration();
    const std::lock_guard<std::mutex> lock(one.mutex);
    if (one.users++ > 0)
        return;
    osgDB::Registry* registry = osgDB::Registry::instance();
    one.callback = new PictureCallback(registry->getWriteFileCallback());
    registry->setWriteFileCallback(one.callback);
}

SavedImages::~SavedImages()
{
    Registration& one = registration();
    const std::lock_guard<std::mutex> lock(one.mutex);
    if (--one.users > 0)
        return;
    // The Registry may be gone at the end of a process.
    osgDB::Registry* registry = osgDB::Registry::instance();
    if (registry && registry->getWriteFileCallback() == one.callback.get())
        registry->setWriteFileCallback(one.callback->getFormer());
    one.callback = nullptr;
}

} // namespace osgPagedTexture
