// SPDX-License-Identifier: MIT
#include <osgMultiRender/BuiltInRenderings.h>

#include <osgMultiRender/Shaders.h>

#include <algorithm>

namespace osgMultiRender
{

const std::vector<BuiltInRendering>& getBuiltInRenderings()
{
    using namespace shaders;
    static const std::vector<BuiltInRendering> renderings = {
        {"material", false, material_vert, material_frag},
        {"phong", false, phong_vert, phong_frag},
        {"textured", false, textured_vert, textured_frag},
        {"toon", false, toon_vert, toon_frag},
        {"hatching", false, hatching_vert, hatching_frag},
        {"gooch", false, gooch_vert, gooch_frag},
        {"wood", false, wood_vert, wood_frag},
        {"bump", false, bump_vert, bump_frag},
        {"bricks", false, bricks_vert, bricks_frag},
        {"checker", false, checker_vert, checker_frag},
        {"edges", false, edges_vert, edges_frag},
        {"wireframe", false, wireframe_vert, wireframe_frag},
        {"distance", false, distance_vert, distance_frag},
        {"xray", false, xray_vert, xray_frag},
        {"luminance", true, luminance_vert, luminance_frag},
        {"sepia", true, sepia_vert, sepia_frag},
        {"sobel", true, sobel_vert, sobel_frag},
        {"dilation", true, dilation_vert, dilation_frag},
        {"erosion", true, erosion_vert, erosion_frag},
        {"blur", true, blur_vert, blur_frag},
        {"sharpen", true, sharpen_vert, sharpen_frag},
    };
    return renderings;
}

const BuiltInRendering* findBuiltInRendering(const std::string& name)
{
    const std::vector<BuiltInRendering>& all = getBuiltInRenderings();
    const auto found =
        std::find_if(all.begin(), all.end(),
                     [&](const BuiltInRendering& rendering) { return rendering.name == name; });
    return found == all.end() ? nullptr : &*found;
}

} // namespace osgMultiRender
