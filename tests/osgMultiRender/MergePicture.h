// SPDX-License-Identifier: MIT
#pragma once

#include "osgMultiRender/PlainGL.h"

#include <osgMultiRender/Merger.h>

#include <string>
#include <vector>

using osgMultiRender::Merged;
using osgMultiRender::MergeEntry;
using osgMultiRender::Rendering;

/// What a program draws, in floats.
struct MergePicture
{
    static constexpr int Size = 64;
    static constexpr float Empty = -1000.0f; ///< The alpha of pixels that nothing wrote.

    bool ok = false;
    std::string log;
    std::vector<float> colors; ///< RGBA, row 0 at the bottom.
    std::vector<float> depths;

    bool covered(std::size_t pixel) const { return colors[pixel * 4 + 3] != Empty; }
};

/// How far a merged picture is from the blend of the single ones.
struct MergeDifference
{
    double worst = 0.0; ///< Of any component of any pixel that is compared.
    double worstDepth = 0.0;
    std::size_t covered = 0; ///< Pixels with a colour.
    std::size_t beside = 0;  ///< Pixels that are drawn in one picture only.
};

/// Draws renderings alone and merged, with the same uniforms, textures, attributes and lights.
///
/// A curved sheet in perspective under one light, into a float target. The values of uniforms are
/// those of the rendering, else they follow from the name. Needs a current context.
class MergeStudio
{
public:
    MergeStudio();
    ~MergeStudio();

    /// The rendering's own program, as its author wrote it.
    MergePicture drawAlone(const Rendering& rendering);

    /// The same under the lights and materials of its description.
    MergePicture drawUnderOwnLighting(const Rendering& rendering);

    /// The merged program; `entries` are those that it was made of.
    MergePicture drawMerged(const Merged& merged, const std::vector<MergeEntry>& entries);

    /// GLSL of weights that are 0 and 1 in places and add up to 1, for `count` renderings.
    static std::string weights(std::size_t count);

    /// What weights() is at a column of the picture.
    static double weight(std::size_t rendering, std::size_t count, int column);

    /// Compares with the sum of weight times colour over the renderings that cover a pixel.
    static MergeDifference compare(const MergePicture& merged,
                                   const std::vector<MergePicture>& alone);

private:
    MergePicture draw(const PlainProgram& program,
                      const std::vector<std::pair<int, unsigned int>>& attributes);
    void setUniforms(const PlainProgram& program, const Rendering& rendering, std::size_t index,
                     const Merged* merged);
    void setTextures(const Rendering& rendering, const Merged* merged,
                     const std::vector<MergeEntry>& entries);

    unsigned int _frame = 0, _color = 0, _depth = 0;
    const osgMultiRender::RenderingState* _lighting = nullptr; ///< Null: the studio's.
    std::vector<unsigned int> _textures;
};
