// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixOptions.h>
#include <osgMultiRender/MixedScene.h>
#include <osgMultiRender/PseudoLoader.h>

#include <osg/Geometry>
#include <osg/Texture2D>
#include <osgDB/Registry>

using osgMultiRender::MixedScene;

namespace
{

/// The size in texels that image renderings want, as a user value of the quad.
const char* const ImageSize = "osgMultiRender.imageSize";

/// A quad 1 high and as wide as the image's ratio says, in x and z from the origin.
osg::ref_ptr<osg::Node> makeQuad(osg::Image& image)
{
    const float ratio =
        image.t() > 0 ? float(image.s()) * image.getPixelAspectRatio() / float(image.t()) : 1.0f;
    const bool isTopFirst = image.getOrigin() == osg::Image::TOP_LEFT;
    osg::ref_ptr<osg::Geometry> quad = osg::createTexturedQuadGeometry(
        {0.0f, 0.0f, 0.0f}, {ratio, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, 0.0f, isTopFirst ? 1.0f : 0.0f,
        1.0f, isTopFirst ? 0.0f : 1.0f);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(&image);
    texture->setResizeNonPowerOfTwoHint(false);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
    osg::StateSet& stateSet = *quad->getOrCreateStateSet();
    stateSet.setTextureAttributeAndModes(0, texture);
    stateSet.setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    quad->setUserValue(ImageSize, osg::Vec2d(image.s(), image.t()));
    return quad;
}

/// Image renderings that do not know the size of the image get it.
void setImageSize(MixedScene& scene, const osg::Vec2d& size)
{
    for (const unsigned int number : scene.getRenderings())
        if (scene.getRendering(number)->findUniform("imageSize"))
            if (const std::vector<double> known = scene.getUniform(number, "imageSize");
                known.size() < 2 || known[0] <= 0.0 || known[1] <= 0.0)
                scene.setUniform(number, "imageSize", {size.x(), size.y()});
}

} // namespace

/// "model.osg.(mix=street.mix).multirender", "photo.jpg.(renderings=sepia).multirender": shows a
/// model or an image as a mix of renderings.
class ReaderWriterMultiRender : public osgMultiRender::PseudoLoader
{
public:
    ReaderWriterMultiRender()
        : PseudoLoader("multirender", "Renderings mixed by distance: model.ext.[(settings).]"
                                      "multirender")
    {
        const osg::ref_ptr<MixedScene> defaults = new MixedScene;
        for (const osgMultiRender::MixOption& option : osgMultiRender::mixOptions())
        {
            const std::string value = option.format(*defaults);
            supportsOption("multirender." + option.name + "=" + option.values,
                           option.help + (value.empty() ? "" : " (default " + value + ")"));
        }
    }

    const char* className() const override { return "osgMultiRender pseudo-loader"; }

protected:
    ReadResult readModel(const std::string& file, const Options* options) const override
    {
        ReadResult result = PseudoLoader::readModel(file, options);
        if (result.validNode())
            return result;
        ReadResult image = osgDB::Registry::instance()->readImage(file, options);
        return image.validImage() ? ReadResult(makeQuad(*image.getImage()).get()) : result;
    }

    osg::ref_ptr<osg::Node> wrap(osg::Node& model, const osgMultiRender::Settings& settings,
                                 std::string& error) const override
    {
        osg::ref_ptr<MixedScene> scene = new MixedScene;
        // The viewer's optimizer must not remove or merge the group.
        scene->setDataVariance(osg::Object::DYNAMIC);
        if (!setMixOptions(*scene, settings, error))
            return nullptr;
        if (scene->getRenderings().empty())
        {
            error = "no rendering is named; say mix=<file> or renderings=<name>";
            return nullptr;
        }
        osg::Vec2d size;
        if (model.getUserValue(ImageSize, size))
            setImageSize(*scene, size);
        scene->addChild(&model);
        return scene;
    }
};

REGISTER_OSGPLUGIN(multirender, ReaderWriterMultiRender)
