// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/ContextWords.h>
#include <osgLabels/FeatureTree.h>

#include <memory>
#include <utility>
#include <vector>

namespace osgLabels
{

/// How features lie in each other, for occluder.frag: by depth and number the first and the last
/// number of the feature of that depth around. Thread safe.
class MapNests
{
public:
    /// Uploads what the context, which is current, does not have already.
    osg::ref_ptr<BufferTexture> upload(osg::State& state,
                                       const std::shared_ptr<const FeatureTree::Nesting>& nesting,
                                       const std::vector<std::uint32_t>& depths);
    /// How many numbers each depth has, from 0 on.
    static int getNumbers(const FeatureTree::Nesting& nesting)
    {
        return int(FeatureTree::First + nesting.steps.size());
    }
    void releaseGLObjects(osg::State* state) { _words.releaseGLObjects(state); }

private:
    using Source =
        std::pair<std::shared_ptr<const FeatureTree::Nesting>, std::vector<std::uint32_t>>;
    ContextWords<Source> _words;
};

} // namespace osgLabels
