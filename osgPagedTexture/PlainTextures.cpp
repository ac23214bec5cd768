// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PlainTextures.h>

#include <osgPagedTexture/UnpackScope.h>

namespace osgPagedTexture
{

namespace
{

constexpr GLenum MaxLevel = 0x813D;

} // namespace

std::vector<GLuint> PlainTextures::getNames() const
{
    std::vector<GLuint> names;
    for (const auto& each : _plain)
        names.push_back(each.second);
    if (_fault)
        names.push_back(_fault);
    return names;
}

void PlainTextures::forget()
{
    _plain.clear();
    _fault = 0;
}

GLuint PlainTextures::nameOf(osg::State& state, std::uint32_t rgba)
{
    GLuint& name = _plain[rgba];
    if (name)
        return name;
    const UnpackScope scope(state);
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexParameteri(GL_TEXTURE_2D, MaxLevel, 0);
    const std::uint8_t texel[] = {std::uint8_t(rgba >> 24), std::uint8_t(rgba >> 16),
                                  std::uint8_t(rgba >> 8), std::uint8_t(rgba)};
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
    return name;
}

GLuint PlainTextures::faultName(osg::State& state)
{
    if (_fault)
        return _fault;
    const UnpackScope scope(state);
    glGenTextures(1, &_fault);
    glBindTexture(GL_TEXTURE_2D, _fault);
    // Squares of magenta and grey; one level each, so that they show from far away, too.
    for (int level = 0, side = 8; side > 0; ++level, side /= 2)
    {
        std::vector<std::uint8_t> texels;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
            {
                const bool isMarked = side < 4 || ((x * 8 / side / 2 + y * 8 / side / 2) & 1);
                for (const int value :
                     {isMarked ? 255 : 96, isMarked ? 0 : 96, isMarked ? 255 : 96, 255})
                    texels.push_back(std::uint8_t(value));
            }
        glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA, side, side, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     texels.data());
    }
    glTexParameteri(GL_TEXTURE_2D, MaxLevel, 3);
    return _fault;
}

} // namespace osgPagedTexture
