// SPDX-License-Identifier: MIT
#include "LabelMethods.h"

#include <osg/Texture2DArray>

#include <algorithm>
#include <cmath>

namespace precision
{

namespace
{

using osgLabels::InkSpans;

/// Of a layer: a cell with margins about it, which keep mip levels of 1/16 size clean.
constexpr int Width = 64, Height = 128, Levels = 5;
constexpr float Scale = 88.0f;   ///< Texels an em.
constexpr int DistanceScale = 2; ///< Texels of coverage a texel of distance.
constexpr float Spread = 4.0f;   ///< Texels of distance that 0 and 1 stand for.

struct Layers
{
    int width, height;
    GLenum format, type, internalFormat;
};

/// em at the texel's lower left corner.
glm::vec2 getCorner(float cell, float x, float y)
{
    return {(x - 0.5f * Width) / Scale + 0.5f * cell, (y - 0.5f * Height) / Scale + 0.5f};
}

std::vector<float> makeCoverage(const osgLabels::GlyphSet& glyphs, std::uint32_t code)
{
    constexpr int Rows = 16; // a texel
    const InkSpans ink(glyphs.getGlyph(code)->outline, static_cast<int>(Scale) * Rows);
    std::vector<float> texels(Width * Height);
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
        {
            const glm::vec2 low =
                getCorner(glyphs.getCellAdvance(), static_cast<float>(x), static_cast<float>(y));
            const int row = static_cast<int>(std::floor(low.y * ink.getRowsPerEm() + 0.5f));
            float sum = 0.0f;
            for (int i = 0; i < Rows; ++i)
                sum += ink.getInk(row + i, low.x, low.x + 1.0f / Scale);
            texels[static_cast<std::size_t>(y * Width + x)] = sum * Scale / Rows;
        }
    return texels;
}

std::vector<float> halve(const std::vector<float>& texels, int width, int height)
{
    std::vector<float> half;
    for (int y = 0; y < height; y += 2)
        for (int x = 0; x < width; x += 2)
        {
            const auto i = static_cast<std::size_t>(y * width + x),
                       above = i + static_cast<std::size_t>(width);
            half.push_back(0.25f * (texels[i] + texels[i + 1] + texels[above] + texels[above + 1]));
        }
    return half;
}

osg::ref_ptr<osg::Image> makeImage(const Layers& layers)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(layers.width, layers.height, 1, layers.format, layers.type);
    image->setInternalTextureFormat(static_cast<GLint>(layers.internalFormat));
    return image;
}

void toBytes(const std::vector<float>& texels, unsigned char* bytes)
{
    std::transform(
        texels.begin(), texels.end(), bytes,
        [](float share)
        { return static_cast<unsigned char>(std::lrint(255.0f * std::min(share, 1.0f))); });
}

osg::ref_ptr<osg::Texture2DArray> makeTexture(const osgLabels::GlyphSet& glyphs,
                                              osg::Texture::FilterMode minify,
                                              osg::Texture::FilterMode magnify)
{
    osg::ref_ptr<osg::Texture2DArray> texture = new osg::Texture2DArray;
    texture->setTextureDepth(static_cast<int>(glyphs.getSize()));
    texture->setFilter(osg::Texture::MIN_FILTER, minify);
    texture->setFilter(osg::Texture::MAG_FILTER, magnify);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    texture->setResizeNonPowerOfTwoHint(false);
    return texture;
}

osg::ref_ptr<osg::Texture2DArray> makeCoverageTexture(const osgLabels::GlyphSet& glyphs,
                                                      osg::Texture::FilterMode minify,
                                                      osg::Texture::FilterMode magnify)
{
    const auto texture = makeTexture(glyphs, minify, magnify);
    const bool isMipmapped = minify == osg::Texture::LINEAR_MIPMAP_LINEAR;
    for (std::uint32_t code = 0; code < glyphs.getSize(); ++code)
    {
        std::vector<float> texels = makeCoverage(glyphs, code);
        const auto image = makeImage({Width, Height, GL_RED, GL_UNSIGNED_BYTE, 0x8229});
        osg::Image::MipmapDataType offsets;
        auto* const bytes = new unsigned char[2 * Width * Height];
        std::size_t offset = 0;
        for (int level = 0; level < (isMipmapped ? Levels : 1); ++level)
        {
            if (level)
            {
                texels = halve(texels, Width >> (level - 1), Height >> (level - 1));
                offsets.push_back(static_cast<unsigned int>(offset));
            }
            toBytes(texels, bytes + offset);
            offset += texels.size();
        }
        image->setImage(Width, Height, 1, 0x8229, GL_RED, GL_UNSIGNED_BYTE, bytes,
                        osg::Image::USE_NEW_DELETE);
        image->setMipmapLevels(offsets);
        texture->setImage(code, image);
    }
    return texture;
}

osg::ref_ptr<osg::Texture2DArray> makeSumTexture(const osgLabels::GlyphSet& glyphs)
{
    const auto texture = makeTexture(glyphs, osg::Texture::LINEAR, osg::Texture::LINEAR);
    for (std::uint32_t code = 0; code < glyphs.getSize(); ++code)
    {
        const std::vector<float> texels = makeCoverage(glyphs, code);
        const auto image = makeImage({Width + 1, Height + 1, GL_RED, GL_FLOAT, 0x822E});
        std::fill_n(reinterpret_cast<float*>(image->data()), (Width + 1) * (Height + 1), 0.0f);
        for (int y = 0; y < Height; ++y)
        {
            double row = 0.0;
            for (int x = 0; x < Width; ++x)
            {
                row += texels[static_cast<std::size_t>(y * Width + x)];
                const float below = *reinterpret_cast<const float*>(image->data(x + 1, y));
                *reinterpret_cast<float*>(image->data(x + 1, y + 1)) =
                    below + static_cast<float>(row);
            }
        }
        texture->setImage(code, image);
    }
    return texture;
}

float getDistance(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b)
{
    const glm::vec2 along = b - a, from = p - a;
    const float squared = along.x * along.x + along.y * along.y;
    const float t = squared > 0.0f
                        ? std::clamp((from.x * along.x + from.y * along.y) / squared, 0.0f, 1.0f)
                        : 0.0f;
    return std::hypot(from.x - t * along.x, from.y - t * along.y);
}

osg::ref_ptr<osg::Texture2DArray> makeDistanceTexture(const osgLabels::GlyphSet& glyphs)
{
    const auto texture = makeTexture(glyphs, osg::Texture::LINEAR, osg::Texture::LINEAR);
    constexpr float Range = Spread * DistanceScale / Scale;
    for (std::uint32_t code = 0; code < glyphs.getSize(); ++code)
    {
        const osgLabels::GlyphOutline& outline = glyphs.getGlyph(code)->outline;
        const InkSpans ink(outline, 2048);
        const auto image = makeImage(
            {Width / DistanceScale, Height / DistanceScale, GL_RED, GL_UNSIGNED_BYTE, 0x8229});
        for (int y = 0; y < image->t(); ++y)
            for (int x = 0; x < image->s(); ++x)
            {
                const glm::vec2 p = getCorner(glyphs.getCellAdvance(),
                                              DistanceScale * (static_cast<float>(x) + 0.5f),
                                              DistanceScale * (static_cast<float>(y) + 0.5f));
                float distance = Range;
                for (const std::vector<glm::vec2>& contour : outline.contours)
                    for (std::size_t i = 0; i < contour.size(); ++i)
                        distance =
                            std::min(distance,
                                     getDistance(p, contour[i], contour[(i + 1) % contour.size()]));
                const float sign = ink.contains(p.x, p.y) ? 1.0f : -1.0f;
                *image->data(x, y) = static_cast<unsigned char>(
                    std::lrint(127.5f + 127.5f * sign * distance / Range));
            }
        texture->setImage(code, image);
    }
    return texture;
}

/// What all share: from a place on the line to the letter's layer and texture coordinates.
std::string getHead(const osgLabels::GlyphSet& glyphs)
{
    const std::string cell = std::to_string(glyphs.getCellAdvance());
    return "uniform sampler2DArray images;\nconst float cell = " + cell + R"glsl(;
const vec2 toTexture = 88.0 / vec2(64.0, 128.0); // of an em
vec3 find(osgLabels_Text text, vec2 place)
{
    float index = floor(place.x / cell);
    vec2 from = vec2(place.x - (index + 0.5) * cell, place.y - 0.5);
    return vec3(from * toTexture + 0.5, float(osgLabels_code(text, int(index))));
}
float areaOf(mat2 m) { return abs(m[0].x * m[1].y - m[0].y * m[1].x); }
)glsl";
}

std::string shade(const std::string& body)
{
    return "float shade(osgLabels_Text text, vec2 place, mat2 footprint)\n{\n" + body + "}\n";
}

std::string getDistanceBody(int side)
{
    const std::string n = std::to_string(side);
    return R"glsl(
    float perPixel = 2.0 * 4.0 * 2.0 / 88.0 * )glsl" +
           n + ".0 / sqrt(areaOf(footprint));\n" +
           "    float ink = 0.0;\n    for (int j = 0; j < " + n +
           "; ++j)\n        for (int i = 0; i < " + n + R"glsl(; ++i)
        {
            vec2 p = place + footprint * ((vec2(i, j) + 0.5) / )glsl" +
           n + R"glsl(.0 - 0.5);
            float distance = textureLod(images, find(text, p), 0.0).r - 0.5;
            ink += clamp(distance * perPixel + 0.5, 0.0, 1.0);
        }
    return ink / )glsl" +
           std::to_string(side * side) + ".0;\n";
}

const char SumBody[] = R"glsl(
    vec2 reach = 0.5 * (abs(footprint[0]) + abs(footprint[1]));
    float first = floor((place.x - reach.x) / cell), last = floor((place.x + reach.x) / cell);
    float ink = 0.0;
    for (float index = first; index <= last; index += 1.0)
    {
        float left = index * cell;
        vec2 low = vec2(max(place.x - reach.x, left), place.y - reach.y),
             high = vec2(min(place.x + reach.x, left + cell), place.y + reach.y);
        float layer = float(osgLabels_code(text, int(index)));
        vec2 middle = vec2(left + 0.5 * cell, 0.5);
        vec2 size = vec2(65.0, 129.0);
        vec2 a = ((low - middle) * 88.0 + vec2(32.5, 64.5)) / size,
             b = ((high - middle) * 88.0 + vec2(32.5, 64.5)) / size;
        ink += textureLod(images, vec3(b, layer), 0.0).r -
               textureLod(images, vec3(a.x, b.y, layer), 0.0).r -
               textureLod(images, vec3(b.x, a.y, layer), 0.0).r +
               textureLod(images, vec3(a, layer), 0.0).r;
    }
    return ink / (4.0 * reach.x * reach.y * 88.0 * 88.0);
)glsl";

} // namespace

std::vector<LabelMethod> makeLabelMethods(const osgLabels::GlyphSet& glyphs)
{
    using osg::Texture;
    const std::string head = getHead(glyphs);
    const auto nearest = makeCoverageTexture(glyphs, Texture::NEAREST, Texture::NEAREST),
               bilinear = makeCoverageTexture(glyphs, Texture::LINEAR, Texture::LINEAR),
               trilinear =
                   makeCoverageTexture(glyphs, Texture::LINEAR_MIPMAP_LINEAR, Texture::LINEAR),
               distances = makeDistanceTexture(glyphs);
    const char one[] = "    return textureLod(images, find(text, place), 0.0).r;\n";
    const char test[] = "    return step(0.5, textureLod(images, find(text, place), 0.0).r);\n";
    const char gradients[] = "    return textureGrad(images, find(text, place), "
                             "footprint[0] * toTexture, footprint[1] * toTexture).r;\n";
    const char level[] = "    float level = 0.5 * log2(areaOf(footprint) * 88.0 * 88.0);\n"
                         "    return textureLod(images, find(text, place), level).r;\n";
    return {{"nearest", head + shade(one), nearest},
            {"alpha test", head + shade(test), bilinear},
            {"bilinear", head + shade(one), bilinear},
            {"trilinear", head + shade(gradients), trilinear},
            {"trilinear, level by area", head + shade(level), trilinear},
            {"distance", head + shade(getDistanceBody(1)), distances},
            {"distance 2x2", head + shade(getDistanceBody(2)), distances},
            {"distance 4x4", head + shade(getDistanceBody(4)), distances},
            {"summed area", head + shade(SumBody), makeSumTexture(glyphs)}};
}

} // namespace precision
