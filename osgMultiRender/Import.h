// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Rendering.h>

#include <string>

namespace osgMultiRender
{

/// Imports a rendering from a file, by what the file is; never throws but std::bad_alloc.
///
/// - `name.gdp`: a project of ShaderDesigner, with the shaders and textures it names.
/// - `name.vert`, `name.frag` (`.vs`, `.fs`): GLSL; the other stage is the file of the same name
///   beside it. See importGlsl() for what comments say.
/// - A fragment shader that defines `mainImage` and no `main`: see importShadertoy().
///
/// Where something is wrong, `messages` of the result has an error, and ok() is false.
OSGMULTIRENDER_EXPORT Rendering importRendering(const std::string& fileName);

/// Imports a project of ShaderDesigner (TyphoonLabs) from its text, in XML.
///
/// Files that it names are looked for beside `fileName`; those outside of its folder's parent are
/// refused. Counts need not agree with the elements that are there.
OSGMULTIRENDER_EXPORT Rendering importShaderDesigner(const std::string& text,
                                                     const std::string& fileName);

/// Imports a pair of GLSL files, of which one may be missing: without a vertex shader the
/// vertices, colours and texture coordinates are the fixed function's, without lights.
///
/// Comments behind a uniform give its values: `uniform vec3 Color; // = 1, 0.5, 0 min 0 max 1`.
/// Or, as the built-in renderings have it, `// = 1 0.5 0 [0, 1]`.
/// Those of samplers name a unit or a file: `uniform sampler2D Wood; // = "wood.png"`. Values in
/// `name.uniforms` beside the files, one `Color = 1, 0.5, 0` a line, win over those of comments.
OSGMULTIRENDER_EXPORT Rendering importGlsl(const std::string& vertexFile,
                                           const std::string& fragmentFile);

/// Imports an image shader in the form of Shadertoy: `void mainImage(out vec4 color, in vec2 at)`.
///
/// iResolution is the size in pixels that the texture coordinates 0 to 1 stand for, iTime is
/// osg_FrameTime, iChannel0 to 3 are texture units 0 to 3.
OSGMULTIRENDER_EXPORT Rendering importShadertoy(const std::string& text,
                                                const std::string& fileName);

/// A built-in rendering by its name, else the file, as importRendering().
OSGMULTIRENDER_EXPORT Rendering importNamed(const std::string& nameOrFile);

} // namespace osgMultiRender
