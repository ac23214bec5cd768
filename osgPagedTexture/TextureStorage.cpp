// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TextureStorage.h>

#include <osgPagedTexture/GlFormat.h>

#include <vector>

namespace osgPagedTexture
{

namespace
{

constexpr GLenum MaxLevel = 0x813D;

void makeEachLevel(const osg::GLExtensions& gl, const TextureSize& size)
{
    const GlFormat format = glFormatOf(size.format);
    const int width = levelSide(size.width, size.level),
              height = levelSide(size.height, size.level);
    glTexParameteri(GL_TEXTURE_2D, MaxLevel, size.levels() - 1);
    const std::vector<std::uint8_t> nothing(levelBytes(size.format, width, height));
    for (int level = 0; level < size.levels(); ++level)
    {
        const int w = levelSide(width, level), h = levelSide(height, level);
        if (isBlocked(size.format))
            gl.glCompressedTexImage2D(GL_TEXTURE_2D, level, format.internal, w, h, 0,
                                      GLsizei(levelBytes(size.format, w, h)), nothing.data());
        else
            glTexImage2D(GL_TEXTURE_2D, level, GLint(format.internal), w, h, 0, format.layout,
                         GL_UNSIGNED_BYTE, nothing.data());
    }
}

} // namespace

GLuint makeStorage(const osg::GLExtensions& gl, const TextureSize& size)
{
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i)
        continue; // Errors before are not ours.
    if (gl.isTextureStorageEnabled && gl.glTexStorage2D)
        gl.glTexStorage2D(GL_TEXTURE_2D, size.levels(), glFormatOf(size.format).internal,
                          levelSide(size.width, size.level), levelSide(size.height, size.level));
    else
        makeEachLevel(gl, size);
    if (glGetError() == GL_NO_ERROR)
        return name;
    glDeleteTextures(1, &name);
    return 0;
}

} // namespace osgPagedTexture
