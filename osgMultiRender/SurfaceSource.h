// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>
#include <osgMultiRender/SurfaceKey.h>

#include <string>

namespace osgMultiRender
{

/// GLSL texts that make the surface function of a key. Free of GL and of any scene: what a key
/// gives can be printed and tested.
struct SurfaceSource
{
    std::string vertex;   ///< Defines osgmr_vertex() and main().
    std::string fragment; ///< Defines vec4 osgmr_surface(); no main.
};

/// "#version 450 compatibility\n" for the language version of a context, such as 4.5f; at
/// least 3.30.
OSGMULTIRENDER_EXPORT std::string glslVersionLine(float languageVersion);

/// GLSL that others add to the vertex stage.
struct VertexParts
{
    std::string instance;   ///< Defines osgmr_instance(), see VertexSnippet; empty for none.
    std::string text;       ///< Declarations before main().
    std::string statements; ///< In main(), after gl_Position.
};

/// The surface function of `key`. Samplers are named osgmr_texture<unit>. Units with
/// TextureKey::sampled call vec4 osgmr_sample(int unit, sampler2D own, vec2 coord), which the
/// snippet of the texture pass defines; `own` is what is bound there. The texts have no #version.
OSGMULTIRENDER_EXPORT SurfaceSource makeSurfaceSource(const SurfaceKey& key,
                                                      const VertexParts& parts = {});

} // namespace osgMultiRender
