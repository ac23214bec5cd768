// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/KeyPoints.h>
#include <osgMultiRender/MixWeights.h>
#include <osgMultiRender/Rendering.h>
#include <support/HeadlessViewer.h>

#include <osg/Node>
#include <osg/StateSet>

#include <functional>
#include <string>
#include <vector>

namespace precision
{

/// Renderings that fade into each other with the distance to key points.
struct MixTask
{
    /// The first `count` of eight built-in ones, each shown in a ring.
    explicit MixTask(std::size_t count);

    std::vector<osgMultiRender::Rendering> renderings;
    std::vector<osgMultiRender::MixRange> ranges;
    std::vector<glm::dvec3> places;
    osgMultiRender::KeyPoints points; ///< A polyline through the places.
    osgMultiRender::MixWeights weights;
};

enum class MixMethod
{
    Merged,  ///< The merged program, as a StateSet above the model.
    ByHand,  ///< A program written for these renderings, used in the same way.
    Passes,  ///< The model once for each rendering, added up by the framebuffer.
    Scene,   ///< A MixedScene with one program for all.
    Pruning, ///< A MixedScene that leaves out what a drawable does not show.
};

/// The model drawn by a method into a picture of `size` pixels a side, under a camera that looks
/// as `view` says. Throws std::runtime_error for renderings that can't be merged.
osg::ref_ptr<osg::Node> makeMixNode(MixMethod method, const MixTask& task, osg::Node* model,
                                    const osg::Matrixd& view, int size);

/// Values of a rendering's uniforms under the names that `nameOf` gives them; "" leaves one out.
void addMixUniforms(osg::StateSet& stateSet, const osgMultiRender::Rendering& rendering,
                    const std::function<std::string(const std::string&)>& nameOf);

} // namespace precision
