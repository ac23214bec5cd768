// SPDX-License-Identifier: MIT
#include <osgMultiRender/Import.h>

#include <osgMultiRender/BuiltInRenderings.h>
#include <osgMultiRender/ImportFile.h>

namespace osgMultiRender
{

Rendering importNamed(const std::string& nameOrFile)
{
    const BuiltInRendering* builtIn = findBuiltInRendering(nameOrFile);
    if (!builtIn)
        return importRendering(nameOrFile);
    Rendering rendering;
    rendering.name = builtIn->name;
    rendering.shaders.push_back({GlslStage::Vertex, builtIn->vertex, builtIn->name + ".vert"});
    rendering.shaders.push_back({GlslStage::Fragment, builtIn->fragment, builtIn->name + ".frag"});
    readUniformComments(rendering);
    return rendering;
}

} // namespace osgMultiRender
