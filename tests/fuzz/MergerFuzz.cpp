// SPDX-License-Identifier: MIT
// Any bytes as renderings: they import, merge or are left out with a reason; nothing crashes.
// Byte 0 picks the options and the kind; 0xFF splits the rest into texts: vertex, fragment, …
#include "fuzz/Require.h"

#include <osgMultiRender/Import.h>
#include <osgMultiRender/Merger.h>

#include <cstdint>

using namespace osgMultiRender;

namespace
{

void checkMerged(const Merged& merged, std::size_t count)
{
    require(merged.renderings.size() == count, "a result an entry");
    std::size_t included = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
        bool reason = false;
        for (const MergeMessage& message : merged.messages)
        {
            reason = reason || (message.severity == MergeSeverity::Error &&
                                message.rendering == i && !message.text.empty());
        }
        included += merged.renderings[i].included ? 1 : 0;
        require(merged.renderings[i].included != reason, "left out with a reason");
    }
    require(merged.ok == (included > 0), "ok if something is in");
    require(merged.ok == !merged.fragment.empty(), "ok has a text");
    for (const MergedUniform& uniform : merged.uniforms)
    {
        require(uniform.rendering < count && !uniform.merged.empty(), "uniforms have names");
    }
}

constexpr char Lighting[] = R"(
void main()
{
    gl_FragColor = gl_FrontMaterial.diffuse * gl_LightSource[1].halfVector + gl_LightModel.ambient +
                   gl_BackMaterial.emission + gl_FrontLightModelProduct.sceneColor +
                   gl_BackLightProduct[0].specular;
}
)";

void importAll(const std::string& text)
{
    const Rendering project = importShaderDesigner(text, "folder/project.gdp");
    for (const RenderingMessage& message : project.messages)
    {
        require(message.text.find('\n') == std::string::npos, "a message is one line");
    }
    Rendering lit = project;
    lit.messages.clear();
    lit.shaders = {{GlslStage::Fragment, Lighting, "lit.frag"}};
    MergeOptions options;
    options.ownLighting = true;
    const Merged merged = mergeRenderings({{&lit, 1.0}}, options);
    checkMerged(merged, 1);
    require(merged.fragment.find("(inf") == std::string::npos &&
                merged.fragment.find(" inf") == std::string::npos &&
                merged.fragment.find("nan") == std::string::npos,
            "lights and materials are numbers");
    const Rendering image = importShadertoy(text, "image.frag");
    checkMerged(mergeRenderings({{&image, 1.0}}), 1);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0)
    {
        return 0;
    }
    std::vector<std::string> texts(1);
    for (std::size_t i = 1; i < size; ++i)
    {
        if (data[i] == 0xFF && texts.size() < 6)
        {
            texts.emplace_back();
            continue;
        }
        texts.back() += static_cast<char>(data[i]);
    }
    if ((data[0] & 7) == 7)
    {
        importAll(texts[0]);
        return 0;
    }
    std::vector<Rendering> renderings((texts.size() + 1) / 2);
    for (std::size_t i = 0; i < texts.size(); ++i)
    {
        Rendering& rendering = renderings[i / 2];
        rendering.name = "r" + std::to_string(i / 2);
        const GlslStage stage = i % 2 ? GlslStage::Vertex : GlslStage::Fragment;
        rendering.shaders.push_back(
            {stage, texts[i], rendering.name + (i % 2 ? ".vert" : ".frag")});
        rendering.state.twoSided = (data[0] & 8) != 0;
    }
    std::vector<MergeEntry> entries;
    for (const Rendering& rendering : renderings)
    {
        entries.push_back({&rendering, 1.0});
    }
    MergeOptions options;
    options.share = (data[0] & 16) == 0;
    options.outside = static_cast<MergeOutside>((data[0] >> 5) % 3);
    options.version.number = data[0] & 1 ? 450 : 330;
    const Merged merged = mergeRenderings(entries, options);
    checkMerged(merged, entries.size());
    merged.explain(texts[0]);
    return 0;
}
