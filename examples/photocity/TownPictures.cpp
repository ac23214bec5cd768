// SPDX-License-Identifier: MIT
#include "TownPictures.h"

#include <osg/AlphaFunc>
#include <osg/Texture2D>
#include <osg/Uniform>

#include <algorithm>
#include <cstdio>

namespace
{

constexpr unsigned int FacadesPerNormalMap = 40, MostNormalMaps = 40;

const char* nameOf(PictureUse use)
{
    constexpr const char* names[] = {"facade", "roof", "ground", "street",
                                     "fence",  "tree", "normals"};
    return names[int(use)];
}

osg::ref_ptr<osg::Texture2D> textureOf(const std::string& file, bool repeats)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->setFileName(file);
    image->setWriteHint(osg::Image::EXTERNAL_FILE);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    const auto wrap = repeats ? osg::Texture::REPEAT : osg::Texture::CLAMP_TO_EDGE;
    texture->setWrap(osg::Texture::WRAP_S, wrap);
    texture->setWrap(osg::Texture::WRAP_T, wrap);
    texture->setMaxAnisotropy(8.0f);
    texture->setResizeNonPowerOfTwoHint(false);
    return texture;
}

} // namespace

TownPictures::TownPictures(unsigned int textures, std::uint32_t seed, const std::string& folder)
    : _textures(textures), _random(seed), _folder(folder)
{
    for (int i = 0; i < 3; ++i)
        _fences.push_back(add(PictureUse::Fence, 4.0, 2.0, true));
    for (int i = 0; i < 6; ++i)
        _trees.push_back(add(PictureUse::Tree, 8.0, 8.0, false));
    for (auto* states : {&_fences, &_trees})
        for (osg::StateSet* state : *states)
        {
            state->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
            state->setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
        }
}

osg::ref_ptr<osg::StateSet> TownPictures::add(PictureUse use, double width, double height,
                                              bool repeats)
{
    Picture picture;
    picture.use = use;
    picture.width = width;
    picture.height = height;
    picture.seed = std::uint32_t(_random(0.0, 4294967296.0));
    picture.grey = picture.isJpeg() && use != PictureUse::Street && _random(0.0, 1.0) < 0.08;
    char name[48];
    std::snprintf(name, sizeof name, "/%s-%05zu.%s", nameOf(use), _pictures.size(),
                  picture.isJpeg() ? "jpg" : "png");
    picture.file = _folder + name;
    _pictures.push_back(picture);

    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    state->setTextureAttributeAndModes(0, textureOf(picture.file, repeats));
    return state;
}

void TownPictures::addNormalMap(osg::StateSet& state, double width, double height)
{
    const auto map = add(PictureUse::NormalMap, width, height, true);
    state.setTextureAttribute(1, map->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
    state.addUniform(new osg::Uniform("normalMap", 1));
}

osg::StateSet* TownPictures::take(PictureUse use, double width, double height, bool repeats)
{
    if (isExhausted())
        return takeAgain(use, repeats);
    _given.push_back({add(use, width, height, repeats), _pictures.size() - 1, repeats});
    osg::StateSet* const state = _given.back().state;
    if (use == PictureUse::Facade && _facades++ % FacadesPerNormalMap == 0 &&
        _facades <= FacadesPerNormalMap * MostNormalMaps)
        addNormalMap(*state, width, height);
    return state;
}

osg::StateSet* TownPictures::takeAgain(PictureUse use, bool repeats)
{
    const std::size_t start = _random.choice(unsigned(_given.size()));
    std::size_t at = start;
    for (std::size_t i = 0; i < _given.size(); ++i)
        if (const std::size_t other = (start + i) % _given.size();
            _pictures[_given[other].picture].use == use)
        {
            at = other;
            break;
        }
    if (repeats && !_given[at].repeats)
    {
        osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
        const std::string& file = _pictures[_given[at].picture].file;
        state->setTextureAttributeAndModes(0, textureOf(file, true));
        _given.push_back({state, _given[at].picture, true});
        at = _given.size() - 1;
    }
    return _given[at].state;
}
