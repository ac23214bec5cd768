// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <osg/Program>

#include <cstdint>
#include <string>

namespace osgMultiRender
{

/// A Program whose surfaces get colour, light and labels from the kits, like those of the fixed
/// function, while its own GLSL says where their vertices are. For what is drawn by instancing.
///
/// Below a SurfaceGroup its text takes part in the vertex stage of the surface functions:
/// `void osgmr_instance(inout vec4 vertex, inout vec3 normal, inout vec4 color)` gets what the
/// arrays have and returns what the surface functions use. Elsewhere it is an osg::Program with the
/// shaders that were added to it. GLSL 3.30 compatibility.
class OSGMULTIRENDER_EXPORT VertexSnippet : public osg::Program
{
public:
    explicit VertexSnippet(const std::string& text = {});
    VertexSnippet(const VertexSnippet& other,
                  const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);

    META_StateAttribute(osgMultiRender, VertexSnippet, PROGRAM);

    const std::string& getText() const { return _text; }
    /// A number for the text, never 0: equal texts share programs.
    std::uint64_t getContent() const { return _content; }

protected:
    ~VertexSnippet() override = default;

private:
    std::string _text;
    std::uint64_t _content;
};

} // namespace osgMultiRender
