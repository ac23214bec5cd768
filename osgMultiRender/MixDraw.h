// SPDX-License-Identifier: MIT
// What one view of one frame draws a mix with. Not installed.
#pragma once

#include <osgMultiRender/MixFrameTargets.h>
#include <osgMultiRender/MixPrograms.h>
#include <osgMultiRender/MixShares.h>
#include <osgMultiRender/MixState.h>
#include <osgMultiRender/Plan.h>
#include <osgMultiRender/TargetPool.h>

#include <functional>
#include <mutex>

namespace osgMultiRender
{

/// What the views of a scene share.
struct MixResources
{
    MixPrograms programs;
    TargetPool<MixFrameTargets> frames; ///< Empty where the input is the surfaces.
    std::mutex mutex;
    std::map<unsigned int, std::vector<osg::ref_ptr<MixState>>> free; ///< By context.
    /// Of passes over the frame; those of cameras that are gone go with the next one.
    std::map<osg::observer_ptr<const osg::Camera>, Plan> framePlans;

    /// `camera` may be null.
    void setFramePlan(const osg::Camera* camera, Plan plan);
};

/// Key points, weights and programs as a view has them. Lives in the draw thread.
class MixDraw
{
public:
    MixDraw(std::shared_ptr<MixResources> resources, std::shared_ptr<const MixSnapshot> snapshot);

    /// What is seen, in the frame of the key points.
    using GetParts = std::function<std::vector<MixPart>()>;
    /// At the head of the frame, with the context current. `getParts` lives until end().
    void begin(osg::State& state, const osg::Matrixd& keysToEye, GetParts getParts);
    /// Gives back what begin() has taken.
    void end();

    const MixSnapshot& getSnapshot() const { return *_snapshot; }
    const std::shared_ptr<const MixSnapshot>& shareSnapshot() const { return _snapshot; }
    MixResources& getResources() const { return *_resources; }
    const MixPrograms::Frame& getFrame() const { return _frame; }
    const MixWeights& getWeights() const { return _weights; }
    /// Null outside of begin() and end().
    osg::StateSet* getStateSet() const { return _state ? _state->getStateSet() : nullptr; }
    /// How much each rendering counts in the picture, whether it is shown or not.
    MixSlotShares getShares() const;
    /// What is left out, and the counts of the programs.
    void fillPlan(Plan& plan) const;

private:
    MixWeights weightsOf(const MixSnapshot& snapshot, const std::vector<bool>& isShown) const;

    std::shared_ptr<MixResources> _resources;
    std::shared_ptr<const MixSnapshot> _snapshot;
    std::vector<std::size_t> _replaced; ///< Slots that show what they had before.
    MixPrograms::Frame _frame;
    MixWeights _weights;
    GetParts _getParts;
    osg::ref_ptr<MixState> _state;
    unsigned int _contextID = 0;
};

} // namespace osgMultiRender
