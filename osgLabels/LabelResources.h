// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphAtlas.h>
#include <osgLabels/GlyphSet.h>
#include <osgLabels/LabelBuffers.h>
#include <osgLabels/LabelObjects.h>
#include <osgLabels/LabelPrograms.h>
#include <osgLabels/LabelSettings.h>
#include <osgLabels/LabelTable.h>
#include <osgLabels/LabelTargets.h>

#include <osgMultiRender/ScreenTriangle.h>
#include <osgMultiRender/TargetPool.h>

namespace osgLabels
{

/// What a LabelScene with certain settings keeps from frame to frame for all its views. Thread
/// safe.
class LabelResources
{
public:
    explicit LabelResources(const LabelSettings& settings);

    /// False without a font, or for an identifier out of range.
    bool setText(std::uint32_t identifier, const std::string& text);
    /// Texts, glyphs and records on the GPU, as they are now; for the current context.
    void update(osg::State& state, osg::StateSet& into);

    void releaseGLObjects(osg::State* state);

    const LabelSettings settings;
    const std::shared_ptr<GlyphSet> glyphs; ///< Null without any font.
    const std::shared_ptr<LabelTable> table = std::make_shared<LabelTable>();
    LabelBuffers buffers{table};
    LabelObjects objects;
    osgMultiRender::TargetPool<LabelTargets> targets;
    LabelPrograms programs;
    const osg::ref_ptr<osg::Geometry> screen = osgMultiRender::makeScreenTriangle();

private:
    std::mutex _atlasMutex;
    const osg::ref_ptr<GlyphAtlas> _atlas;
};

} // namespace osgLabels
