// SPDX-License-Identifier: MIT
#include "FeatureSubject.h"

#include <osg/StateSet>
#include <osg/TexEnv>
#include <osg/TexEnvFilter>
#include <osg/TexMat>
#include <osg/Texture1D>
#include <osg/Texture3D>
#include <osg/TextureCubeMap>
#include <osg/TextureRectangle>

namespace feature
{

namespace
{

void makeSmooth(osg::Texture& texture)
{
    texture.setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
    texture.setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    for (auto axis : {osg::Texture::WRAP_S, osg::Texture::WRAP_T, osg::Texture::WRAP_R})
        texture.setWrap(axis, osg::Texture::REPEAT);
}

osg::ref_ptr<osg::Texture> texture1D()
{
    osg::ref_ptr<osg::Image> row = new osg::Image;
    row->allocateImage(16, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    const osg::ref_ptr<osg::Image> source = pattern(GL_RGB, 1);
    for (int x = 0; x < 16; ++x)
        row->setColor(source->getColor(x, 5), x, 0);
    osg::ref_ptr<osg::Texture1D> texture = new osg::Texture1D(row);
    makeSmooth(*texture);
    return texture;
}

osg::ref_ptr<osg::Texture> texture3D()
{
    osg::ref_ptr<osg::Image> block = new osg::Image;
    block->allocateImage(16, 16, 4, GL_RGB, GL_UNSIGNED_BYTE, 1);
    for (unsigned int layer = 0; layer < 4; ++layer)
    {
        const osg::ref_ptr<osg::Image> source = pattern(GL_RGB, layer);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                block->setColor(source->getColor(x, y), x, y, layer);
    }
    osg::ref_ptr<osg::Texture3D> texture = new osg::Texture3D(block);
    makeSmooth(*texture);
    return texture;
}

osg::ref_ptr<osg::Texture> textureCube()
{
    osg::ref_ptr<osg::TextureCubeMap> texture = new osg::TextureCubeMap;
    for (unsigned int face = 0; face < 6; ++face)
        texture->setImage(face, pattern(GL_RGB, face));
    makeSmooth(*texture);
    for (auto axis : {osg::Texture::WRAP_S, osg::Texture::WRAP_T, osg::Texture::WRAP_R})
        texture->setWrap(axis, osg::Texture::CLAMP_TO_EDGE);
    return texture;
}

void setTexture(osg::Group& root, unsigned int unit, osg::Texture* texture,
                osg::TexEnv::Mode mode = osg::TexEnv::MODULATE)
{
    osg::StateSet* state = root.getOrCreateStateSet();
    state->setTextureAttributeAndModes(unit, texture);
    if (mode != osg::TexEnv::MODULATE)
        state->setTextureAttributeAndModes(unit, new osg::TexEnv(mode));
}

void setMatrix(osg::Group& root, unsigned int unit, const osg::Matrix& matrix)
{
    root.getOrCreateStateSet()->setTextureAttributeAndModes(unit, new osg::TexMat(matrix));
}

void addTargets(Family& family)
{
    family.add("1D", [](osg::Group& root) { setTexture(root, 0, texture1D()); });
    family.add("2D", [](osg::Group& root) { setTexture(root, 0, texture2D()); });
    family.add("3D", [](osg::Group& root) { setTexture(root, 0, texture3D()); });
    family.add("cube", [](osg::Group& root) { setTexture(root, 0, textureCube()); });
    family.add("rectangle",
               [](osg::Group& root)
               {
                   setTexture(root, 0, new osg::TextureRectangle(pattern(GL_RGB)));
                   setMatrix(root, 0, osg::Matrix::scale(8, 8, 1));
               });
    family.add("1DOnUnit3", [](osg::Group& root) { setTexture(root, 3, texture1D()); });
    family.add("cubeAnd3D",
               [](osg::Group& root)
               {
                   setTexture(root, 1, textureCube());
                   setTexture(root, 2, texture3D(), osg::TexEnv::ADD);
               });
}

void addUnits(Family& family)
{
    for (unsigned int unit = 1; unit < 4; ++unit)
        family.add("2DOnUnit" + std::to_string(unit),
                   [unit](osg::Group& root) { setTexture(root, unit, texture2D(GL_RGB, unit)); });
    family.add("units01",
               [](osg::Group& root)
               {
                   setTexture(root, 0, texture2D());
                   setTexture(root, 1, texture2D(GL_RGB, 1));
               });
    family.add("units02Decal",
               [](osg::Group& root)
               {
                   setTexture(root, 0, texture2D());
                   setTexture(root, 2, texture2D(GL_RGBA, 1), osg::TexEnv::DECAL);
               });
    const auto several = [](unsigned int count)
    {
        return [count](osg::Group& root)
        {
            const osg::TexEnv::Mode modes[] = {osg::TexEnv::REPLACE, osg::TexEnv::ADD,
                                               osg::TexEnv::DECAL, osg::TexEnv::MODULATE,
                                               osg::TexEnv::DECAL};
            for (unsigned int unit = 0; unit < count; ++unit)
                setTexture(root, unit, texture2D(GL_RGBA, unit), modes[unit]);
        };
    };
    family.add("units0123", several(4));
    family.add("units01234", several(5)).beyond = true;
    family.add("sameTextureOnTwoUnits",
               [](osg::Group& root)
               {
                   const auto texture = texture2D(GL_RGB, 3);
                   setTexture(root, 0, texture);
                   setTexture(root, 1, texture, osg::TexEnv::ADD);
               });
    family.add("unlit",
               [](osg::Group& root)
               {
                   setTexture(root, 0, texture2D());
                   root.getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
               });
}

void addMatrices(Family& family)
{
    const auto with = [](const osg::Matrix& matrix)
    {
        return [matrix](osg::Group& root)
        {
            setTexture(root, 0, texture2D());
            setMatrix(root, 0, matrix);
        };
    };
    family.add("matrixScale", with(osg::Matrix::scale(0.5, 2, 1)));
    family.add("matrixRotation", with(osg::Matrix::rotate(0.7, osg::Vec3d(0, 0, 1))));
    family.add("matrixTranslation", with(osg::Matrix::translate(0.3, 0.4, 0)));
    family.add("matrixProjective",
               with(osg::Matrix(1, 0, 0, 0.3, 0, 1, 0, 0.2, 0, 0, 1, 0, 0, 0, 0, 1)));
    family.add("matrixOnUnit1",
               [](osg::Group& root)
               {
                   setTexture(root, 0, texture2D());
                   setTexture(root, 1, texture2D(GL_RGB, 1));
                   setMatrix(root, 1, osg::Matrix::rotate(1.1, osg::Vec3d(0, 0, 1)));
               });
}

void addSampling(Family& family)
{
    const auto lodBias = [](float bias)
    {
        return [bias](osg::Group& root)
        {
            const auto texture = texture2D(GL_RGB, 2);
            texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
            setTexture(root, 0, texture);
            setMatrix(root, 0, osg::Matrix::scale(4, 4, 1));
            root.getOrCreateStateSet()->setTextureAttributeAndModes(0, new osg::TexEnvFilter(bias));
        };
    };
    family.add("mipmaps", lodBias(0.0f));
    family.add("mipmapsLodBias", lodBias(2.0f));
    using T = osg::Texture;
    const std::vector<std::pair<std::string, T::WrapMode>> wraps = {
        {"Repeat", T::REPEAT},
        {"Mirror", T::MIRROR},
        {"ClampToEdge", T::CLAMP_TO_EDGE},
        {"ClampToBorder", T::CLAMP_TO_BORDER}};
    for (const auto& [name, wrap] : wraps)
    {
        family.add("wrap" + name,
                   [wrap = wrap](osg::Group& root)
                   {
                       const auto texture = texture2D(GL_RGB, 2);
                       texture->setWrap(T::WRAP_S, wrap);
                       texture->setWrap(T::WRAP_T, wrap);
                       texture->setBorderColor(osg::Vec4d(1, 0, 1, 1));
                       setTexture(root, 0, texture);
                       setMatrix(root, 0, osg::Matrix::scale(1.3, 1.3, 1));
                   });
    }
    family.add("withoutImage", [](osg::Group& root) { setTexture(root, 0, new osg::Texture2D); });
    // a depth texture compares in the fixed function, with r as the reference
    family
        .add("depthComparison",
             [](osg::Group& root)
             {
                 osg::ref_ptr<osg::Image> depth = new osg::Image;
                 depth->allocateImage(16, 16, 1, GL_DEPTH_COMPONENT, GL_UNSIGNED_BYTE, 1);
                 for (int i = 0; i < 256; ++i)
                     depth->data()[i] = i;
                 osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(depth);
                 texture->setInternalFormat(GL_DEPTH_COMPONENT);
                 texture->setShadowComparison(true);
                 makeSmooth(*texture);
                 texture->setFilter(T::MIN_FILTER, T::NEAREST);
                 texture->setFilter(T::MAG_FILTER, T::NEAREST);
                 setTexture(root, 0, texture);
                 setMatrix(root, 0, osg::Matrix::scale(1, 1, 0.4));
             })
        .beyond = true;
}

} // namespace

void addTextureScenes(std::vector<FeatureScene>& scenes)
{
    Family texture(scenes, "texture");
    addTargets(texture);
    addUnits(texture);
    addMatrices(texture);
    Family sampling(scenes, "sampling");
    addSampling(sampling);
}

void addTexEnvScenes(std::vector<FeatureScene>& scenes)
{
    const std::vector<std::pair<std::string, osg::TexEnv::Mode>> modes = {
        {"Modulate", osg::TexEnv::MODULATE},
        {"Replace", osg::TexEnv::REPLACE},
        {"Decal", osg::TexEnv::DECAL},
        {"Blend", osg::TexEnv::BLEND},
        {"Add", osg::TexEnv::ADD}};
    const std::vector<std::pair<std::string, GLenum>> formats = {
        {"alpha", GL_ALPHA},
        {"luminance", GL_LUMINANCE},
        {"luminanceAlpha", GL_LUMINANCE_ALPHA},
        {"intensity", GL_INTENSITY},
        {"rgb", GL_RGB},
        {"rgba", GL_RGBA}};
    Subject colored;
    colored.colors = Subject::Colors::PerVertex;
    Family family(scenes, "texEnv");
    for (const auto& [formatName, format] : formats)
    {
        for (const auto& [modeName, mode] : modes)
        {
            // OpenGL defines DECAL for textures of RGB and RGBA alone
            if (mode == osg::TexEnv::DECAL && format != GL_RGB && format != GL_RGBA)
                continue;
            FeatureScene& scene = family.add(
                formatName + modeName,
                [format = format, mode = mode](osg::Group& root)
                {
                    const auto texture = texture2D(format == GL_INTENSITY ? GL_LUMINANCE : format);
                    if (format == GL_INTENSITY)
                        texture->setInternalFormat(GL_INTENSITY);
                    osg::ref_ptr<osg::TexEnv> env = new osg::TexEnv(mode);
                    env->setColor(osg::Vec4(0.9f, 0.3f, 0.6f, 0.4f));
                    osg::StateSet* state = root.getOrCreateStateSet();
                    state->setTextureAttributeAndModes(0, texture);
                    state->setTextureAttributeAndModes(0, env);
                    state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
                },
                colored);
            // of alpha alone these three make the same; RGB is opaque, so it decals as it replaces
            if (format == GL_ALPHA && (mode == osg::TexEnv::BLEND || mode == osg::TexEnv::ADD))
                scene.twin = "alphaModulate";
            if (format == GL_RGB && mode == osg::TexEnv::DECAL)
                scene.twin = "rgbReplace";
        }
    }
}

} // namespace feature
