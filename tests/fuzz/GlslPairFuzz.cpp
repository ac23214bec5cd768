// SPDX-License-Identifier: MIT
// Any bytes as a pair of GLSL files with their side file: what comments and lines say of uniforms
// is finite, and the pair merges or is left out with a reason.
// 0xFF splits the bytes into vertex text, fragment text and side file.
#include "fuzz/Require.h"

#include <osgMultiRender/ImportFile.h>
#include <osgMultiRender/Merger.h>

#include <cmath>
#include <cstdint>
#include <set>

using namespace osgMultiRender;

namespace
{

void checkImported(const Rendering& rendering)
{
    std::set<std::string> names;
    for (const RenderingUniform& uniform : rendering.uniforms)
    {
        require(!uniform.name.empty(), "uniforms have names");
        require(names.insert(uniform.name).second, "a name has one uniform");
        for (const double value : uniform.values)
        {
            require(std::isfinite(value), "values are finite");
        }
        require(std::isfinite(uniform.minimum) && std::isfinite(uniform.maximum),
                "ranges are finite");
    }
    std::set<unsigned int> units;
    for (const RenderingTexture& texture : rendering.textures)
    {
        require(units.insert(texture.unit).second, "a unit has one texture");
    }
    for (const RenderingMessage& message : rendering.messages)
    {
        require(message.text.find('\n') == std::string::npos, "a message is one line");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::string texts[3];
    std::size_t at = 0;
    for (std::size_t i = 0; i < size; ++i)
    {
        if (data[i] == 0xFF && at < 2)
        {
            ++at;
            continue;
        }
        texts[at] += static_cast<char>(data[i]);
    }
    Rendering rendering;
    rendering.name = "pair";
    rendering.fileName = "folder/pair.frag";
    rendering.shaders = {{GlslStage::Vertex, texts[0], "folder/pair.vert"},
                         {GlslStage::Fragment, texts[1], "folder/pair.frag"}};
    readUniformComments(rendering);
    readUniformFile(rendering, texts[2], "folder/pair.uniforms");
    checkImported(rendering);
    const Merged merged = mergeRenderings({{&rendering, 1.0}, {&rendering, 0.5}});
    require(merged.renderings.size() == 2, "a result an entry");
    require(merged.ok == merged.renderings[0].included, "of two equal ones the first is in");
    for (const RenderingUniform& uniform : rendering.uniforms)
    {
        merged.nameOf(1, uniform.name);
    }
    return 0;
}
