// SPDX-License-Identifier: MIT
#include "Facades.h"

#include "CityRandom.h"

#include <osg/AlphaFunc>
#include <osg/Texture2D>

#include <algorithm>
#include <cmath>

namespace
{

constexpr int Size = 64;

template <class Pixel> osg::ref_ptr<osg::Texture2D> paint(Pixel pixel)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(Size, Size, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < Size; ++y)
        for (int x = 0; x < Size; ++x)
        {
            const osg::Vec4ub color = pixel(x, y);
            std::copy_n(color.ptr(), 4, image->data(x, y));
        }
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
    return texture;
}

} // namespace

osg::ref_ptr<osg::StateSet> makeFacadeState()
{
    const auto window = [](int x, int y)
    {
        if (x < 18 || x > 45 || y < 16 || y > 50)
            return osg::Vec4ub(255, 255, 255, 255);
        if (x < 20 || x > 43 || y < 18 || y > 48 || x == 31 || x == 32)
            return osg::Vec4ub(226, 222, 214, 255); // the frame
        const auto sky = static_cast<unsigned char>(70 + y);
        return osg::Vec4ub(static_cast<unsigned char>(sky - 22), sky,
                           static_cast<unsigned char>(sky + 18), 255);
    };
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    state->setTextureAttributeAndModes(0, paint(window));
    return state;
}

osg::ref_ptr<osg::StateSet> makeLeafState()
{
    // Blobs of leaves, densest in the middle of the crown.
    CityRandom random(5);
    bool leaves[Size][Size] = {};
    for (int blob = 0; blob < 170; ++blob)
    {
        const double turn = random(0.0, 2.0 * osg::PI), reach = 27.0 * std::sqrt(random(0.0, 1.0));
        const double x = 32.0 + reach * std::cos(turn), y = 32.0 + reach * std::sin(turn);
        for (int j = 0; j < Size; ++j)
            for (int i = 0; i < Size; ++i)
                leaves[j][i] |= std::hypot(i + 0.5 - x, j + 0.5 - y) < 2.6;
    }
    const auto leaf = [&](int x, int y)
    {
        const bool isStem = y < 34 && (x == 31 || x == 32);
        const auto green = static_cast<unsigned char>(90 + random.choice(60) + y / 2);
        return leaves[y][x] ? osg::Vec4ub(static_cast<unsigned char>(green / 2), green, 40, 255)
                            : osg::Vec4ub(92, 70, 48, isStem ? 255 : 0);
    };
    const osg::ref_ptr<osg::Texture2D> texture = paint(leaf);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    state->setTextureAttributeAndModes(0, texture);
    state->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    return state;
}
