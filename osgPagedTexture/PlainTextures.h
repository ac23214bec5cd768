// SPDX-License-Identifier: MIT
// Textures that stand for others. Not installed.
#pragma once

#include <osg/State>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace osgPagedTexture
{

/// Of a context, made when they are asked for, in its draw thread.
class PlainTextures
{
public:
    /// A texture of one colour, RGBA8.
    GLuint nameOf(osg::State& state, std::uint32_t rgba);

    /// The picture for what can't be read: squares of magenta and grey.
    GLuint faultName(osg::State& state);

    /// All of them, for whoever deletes them.
    std::vector<GLuint> getNames() const;

    /// They have become void.
    void forget();

private:
    std::unordered_map<std::uint32_t, GLuint> _plain;
    GLuint _fault = 0;
};

} // namespace osgPagedTexture
