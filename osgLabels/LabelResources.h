// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/GlyphAtlas.h>
#include <osgLabels/GlyphSet.h>
#include <osgLabels/LabelBatches.h>
#include <osgLabels/LabelBuffers.h>
#include <osgLabels/LabelCollector.h>
#include <osgLabels/LabelObjects.h>
#include <osgLabels/LabelPrograms.h>
#include <osgLabels/LabelSettings.h>
#include <osgLabels/LabelTable.h>
#include <osgLabels/LabelTargets.h>

#include <osgMultiRender/ScreenTriangle.h>
#include <osgMultiRender/TargetPool.h>

#include <set>

namespace osgLabels
{

/// What a LabelScene with certain settings keeps from frame to frame for all its views. Thread
/// safe.
class LabelResources
{
public:
    /// Collects the labels of `group`, while nobody changes its subgraph. Where a setting names
    /// what is not there, says so and does without labels.
    LabelResources(const LabelSettings& settings, osg::Group& group);

    /// Why there are no labels; empty where there may be.
    const std::string& getError() const { return _error; }

    /// Looks at some of what is known of `group`, whether it is still there; to be called in each
    /// cull.
    void sweep(osg::Group& group);
    /// Fits shapes to the objects that the collector has found since the last call.
    void fitNew();
    /// Texts, glyphs and records on the GPU, as they are now; for the current context.
    void update(osg::State& state, osg::StateSet& into);

    /// What shaders depend on, as GLSL. `shapes`: bits of those that have to be known.
    std::string getDefines(bool isPaged, std::uint32_t shapes) const;
    bool hasOutlines() const;

    /// UTF-8. False for an identifier that no object has.
    bool setText(std::uint32_t identifier, const std::string& text);
    std::string getText(std::uint32_t identifier) const;
    /// False for an identifier that no object has and, with a warning, for an unknown style.
    bool setStyle(std::uint32_t identifier, const std::string& name);
    /// Its name.
    std::string getStyle(std::uint32_t identifier) const;
    std::string getPath(osg::Group& group, std::uint32_t identifier) const;

    /// What draws the subgraph with few large drawables; null where that is not asked for.
    osg::Node* getChunks() const { return _chunks.get(); }

    std::size_t getAtlasBytes() const { return _atlas ? _atlas->getBytes() : 0; }
    void releaseGLObjects(osg::State* state);

    const LabelSettings settings;
    const std::shared_ptr<LabelTable> table = std::make_shared<LabelTable>();
    const std::shared_ptr<LabelCollector::Shared> shared =
        std::make_shared<LabelCollector::Shared>();
    NumberSpace records; ///< Numbers all object records.
    LabelBuffers buffers{table};
    LabelBatches batches{{table, shared->identifiers, records, shared->frames}};
    LabelObjects objects{batches, records};
    std::unique_ptr<LabelCollector> collector; ///< Null where there is an error.
    osgMultiRender::TargetPool<LabelTargets> targets;
    LabelPrograms programs;
    const osg::ref_ptr<osg::Geometry> screen = osgMultiRender::makeScreenTriangle();

private:
    LabelTable::Codes encode(const std::string& text);
    void makeChunks(osg::Group& group);
    /// None for one that is not there, which is said once.
    std::optional<std::uint32_t> styleOf(const std::string& name);

    std::string _error;
    std::mutex _stylesMutex;
    std::set<std::string> _unknownStyles; ///< Those that were said.
    std::shared_ptr<GlyphSet> _glyphs;
    osg::ref_ptr<osg::Node> _chunks;
    std::mutex _atlasMutex;
    osg::ref_ptr<GlyphAtlas> _atlas;
};

} // namespace osgLabels
