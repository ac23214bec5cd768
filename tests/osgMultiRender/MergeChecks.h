// SPDX-License-Identifier: MIT
#pragma once

#include "osgMultiRender/MergeCases.h"

#include <osgMultiRender/GlslSource.h>
#include <osgMultiRender/Merger.h>

#include <algorithm>

/// What tests of merged programs ask.
namespace mergeChecks
{

using namespace osgMultiRender;

inline const std::string Head = "varying vec3 n; varying vec2 uv; varying vec3 eye;\n";
inline const std::string Plain = Head + "void main() { gl_FragColor = vec4(uv, 0.0, 1.0); }";

inline Merged merge(const std::vector<Rendering>& renderings, const MergeOptions& options = {})
{
    std::vector<MergeEntry> entries;
    for (const Rendering& one : renderings)
    {
        entries.push_back({&one, 1.0});
    }
    return mergeRenderings(entries, options);
}

inline std::string errorsOf(const Merged& merged)
{
    std::string text;
    for (const MergeMessage& message : merged.messages)
    {
        text += message.severity == MergeSeverity::Error ? message.text + "\n" : "";
    }
    return text;
}

inline std::size_t countOf(const std::string& text, const std::string& word)
{
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at)
    {
        ++count;
    }
    return count;
}

inline std::size_t definitionsOf(const std::string& text, const std::string& prefix)
{
    const GlslSource source = parseGlsl(text);
    return static_cast<std::size_t>(
        std::count_if(source.functions.begin(), source.functions.end(),
                      [&](const GlslFunction& function)
                      { return function.name.compare(0, prefix.size(), prefix) == 0; }));
}

} // namespace mergeChecks
