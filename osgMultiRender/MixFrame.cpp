// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixFrame.h>

#include <osgMultiRender/DrawTarget.h>
#include <osgMultiRender/MixLights.h>

#include <osg/Camera>
#include <osg/DisplaySettings>
#include <osg/Notify>
#include <osg/PolygonMode>
#include <osg/Program>
#include <osg/Viewport>
#include <osgUtil/CullVisitor>

#include <atomic>

namespace osgMultiRender
{

namespace
{

/// Behind all that applications and the kits draw.
constexpr int LastBin = 1000000;

class MixFrame : public osg::Drawable
{
public:
    MixFrame(osg::StateSet& stateSet, std::shared_ptr<MixResources> resources,
             std::shared_ptr<const MixSnapshot> snapshot, const osg::Matrixd& keysToScene,
             const osg::Matrixd& sceneToEye, const osg::BoundingSphere& bound)
        : _leafState(&stateSet), _resources(std::move(resources)), _snapshot(std::move(snapshot)),
          _keysToScene(keysToScene), _keysToEye(keysToScene * sceneToEye), _bound(bound)
    {
        setUseDisplayList(false);
        setUseVertexBufferObjects(false);
    }

    void drawImplementation(osg::RenderInfo& renderInfo) const override
    {
        osg::State& state = *renderInfo.getState();
        const DrawTarget target = DrawTarget::current(state);
        MixDraw draw(_resources, _snapshot);
        Plan plan;
        std::string why = whyNot(state, target);
        if (why.empty() && isInterlaced(renderInfo))
            why = "the eyes share the picture's pixels; choose a kind of stereo that splits it";
        if (why.empty())
        {
            draw.begin(state, _keysToEye, [this] { return getParts(); });
            why = draw.getFrame().all ? drawMix(renderInfo, target, draw, plan)
                                      : "no rendering can be shown";
            draw.fillPlan(plan);
            if (draw.getFrame().all)
                _resources->programs.makeWanted({}, draw.shareSnapshot(), _keysToScene, state,
                                                [&] { return draw.getShares(); });
            draw.end();
        }
        plan.entries.insert(
            plan.entries.begin(),
            {"mix of the frame",
             why.empty() ? PlanEntry::Decision::Drawn : PlanEntry::Decision::Dropped,
             why.empty() ? "a second pass, " + std::to_string(target.samples) +
                               " samples a pixel become one"
                         : why});
        static std::atomic<bool> isSaid{false};
        if (!why.empty() && _snapshot->slots.size() && !isSaid.exchange(true))
            OSG_WARN << "osgMultiRender::MixedScene: input=frame is not shown: " << why
                     << std::endl;
        const osg::Camera* camera = renderInfo.getCurrentCamera();
        plan.view = camera && !camera->getName().empty() ? camera->getName() : "camera";
        _resources->setFramePlan(camera, std::move(plan));
    }

private:
    /// What the depths of the picture are of: the scene.
    std::vector<MixPart> getParts() const
    {
        if (!_bound.valid())
            return {};
        const osg::Matrixd toKeys = osg::Matrixd::inverse(_keysToScene);
        const osg::Vec3d center = osg::Vec3d(_bound.center()) * toKeys;
        MixPart part;
        part.box.center = {center.x(), center.y(), center.z()};
        for (std::size_t i = 0; i < 3; ++i)
            part.box.halfAxes[i] =
                double(_bound.radius()) *
                glm::dvec3(toKeys(int(i), 0), toKeys(int(i), 1), toKeys(int(i), 2));
        return {part};
    }

    /// Stereo where a stencil says which pixels an eye has.
    static bool isInterlaced(osg::RenderInfo& renderInfo)
    {
        const osg::Camera* camera = renderInfo.getCurrentCamera();
        const osg::DisplaySettings* settings = camera ? camera->getDisplaySettings() : nullptr;
        if (!settings)
            settings = osg::DisplaySettings::instance().get();
        const auto mode = settings->getStereoMode();
        return settings->getStereo() && (mode == osg::DisplaySettings::HORIZONTAL_INTERLACE ||
                                         mode == osg::DisplaySettings::VERTICAL_INTERLACE ||
                                         mode == osg::DisplaySettings::CHECKERBOARD);
    }

    static std::string whyNot(const osg::State& state, const DrawTarget& target)
    {
        if (state.get<osg::GLExtensions>()->glVersion < 3.3f)
            return "it needs OpenGL 3.3";
        if (!target.hasDepth)
            return "the target has no depth buffer, and distances come from it";
        if (target.several)
            return "the target has several colour buffers; draw the mix into one";
        if (!state.getCurrentViewport() || state.getCurrentViewport()->width() < 1.0 ||
            state.getCurrentViewport()->height() < 1.0)
            return "the viewport is empty";
        GLboolean writes[4] = {};
        glGetBooleanv(GL_COLOR_WRITEMASK, writes);
        if (!writes[0] || !writes[1] || !writes[2])
            return "it is drawn in some colours alone, as for red and cyan glasses, and renderings "
                   "read all of them; choose another kind of stereo";
        return {};
    }

    std::string drawMix(osg::RenderInfo& renderInfo, const DrawTarget& target, MixDraw& draw,
                        Plan& plan) const
    {
        osg::State& state = *renderInfo.getState();
        // A copy: osg::State forgets which one it has applied when other targets are visited.
        const osg::ref_ptr<osg::Viewport> place = new osg::Viewport(*state.getCurrentViewport());
        const osg::Viewport& viewport = *place;
        const unsigned int contextID = state.getContextID();
        osg::ref_ptr<MixFrameTargets> targets = _resources->frames.acquire(
            contextID, {int(viewport.width()), int(viewport.height()), target.colorFormat,
                        MixFrameTargets::depthFormatOf()});
        const std::string why = targets->copy(state, int(viewport.x()), int(viewport.y()));
        plan.counts["mix.frameBytes"] = double(targets->getBytes());
        if (why.empty())
            drawTriangle(renderInfo, *targets, draw, *place);
        _resources->frames.release(contextID, targets);
        return why;
    }

    void drawTriangle(osg::RenderInfo& renderInfo, MixFrameTargets& targets, MixDraw& draw,
                      osg::Viewport& viewport) const
    {
        osg::State& state = *renderInfo.getState();
        MixProgram& program = *draw.getFrame().all;
        osg::StateSet& own = targets.getStateSet();
        own.setAttribute(const_cast<osg::Program*>(program.getProgram()),
                         osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE |
                             osg::StateAttribute::PROTECTED);
        own.setAttribute(&viewport, osg::StateAttribute::OVERRIDE);
        own.getOrCreateUniform("osgmr_mixViewport", osg::Uniform::FLOAT_VEC4)
            ->set(osg::Vec4f(float(viewport.x()), float(viewport.y()),
                             float(2.0 / viewport.width()), float(2.0 / viewport.height())));
        // Renderings place vertices by both matrices, distances are by the projection alone.
        const osg::ref_ptr<osg::RefMatrix> place =
            new osg::RefMatrix(osg::Matrixd::inverse(state.getProjectionMatrix()));
        const osg::ref_ptr<osg::RefMatrix> before = new osg::RefMatrix(state.getModelViewMatrix());
        state.applyModelViewMatrix(place.get());
        // A leaf's own is applied, but does not lie on the stack.
        state.pushStateSet(_leafState);
        state.pushStateSet(draw.getStateSet());
        state.pushStateSet(program.getStateSet());
        state.pushStateSet(&own);
        state.apply();
        if (const auto* applied = state.getLastAppliedProgramObject())
        {
            program.valuesOf(draw.getSnapshot())->send(*applied, state);
            MixLights lights;
            lights.setProgram(*applied);
            lights.send(state, this);
        }
        if (state.getUseModelViewAndProjectionUniforms())
            state.applyModelViewAndProjectionUniformsIfRequired();
        targets.getTriangle().draw(renderInfo);
        for (int i = 0; i < 4; ++i)
            state.popStateSet();
        state.apply();
        state.applyAttribute(&viewport);
        state.applyModelViewMatrix(before.get());
    }

    osg::ref_ptr<osg::StateSet> _leafState;
    std::shared_ptr<MixResources> _resources;
    std::shared_ptr<const MixSnapshot> _snapshot;
    osg::Matrixd _keysToScene, _keysToEye;
    osg::BoundingSphere _bound;
};

} // namespace

osg::ref_ptr<osg::StateSet> makeMixFrameState()
{
    osg::ref_ptr<osg::StateSet> stateSet = new osg::StateSet;
    stateSet->setRenderBinDetails(LastBin, "RenderBin", osg::StateSet::PROTECTED_RENDERBIN_DETAILS);
    stateSet->setNestRenderBins(false);
    const auto off = osg::StateAttribute::OFF | osg::StateAttribute::PROTECTED;
    for (const GLenum mode :
         {GL_DEPTH_TEST, GL_CULL_FACE, GL_ALPHA_TEST, GL_LIGHTING, GL_FOG, GL_STENCIL_TEST})
        stateSet->setMode(mode, off);
    stateSet->setMode(GL_BLEND, osg::StateAttribute::OFF);
    const auto isKept = osg::StateAttribute::ON | osg::StateAttribute::PROTECTED;
    stateSet->setAttribute(new osg::PolygonMode, isKept);
    // Other kits leave alone what has one.
    stateSet->setAttribute(new osg::Program, isKept);
    return stateSet;
}

void addMixFrame(osgUtil::CullVisitor& visitor, osg::StateSet& stateSet,
                 const osg::BoundingSphere& bound, std::shared_ptr<MixResources> resources,
                 std::shared_ptr<const MixSnapshot> snapshot, const osg::Matrixd& keysToScene)
{
    osg::ref_ptr<MixFrame> frame = new MixFrame(stateSet, std::move(resources), std::move(snapshot),
                                                keysToScene, *visitor.getModelViewMatrix(), bound);
    frame->setInitialBound(osg::BoundingBox(bound.center(), bound.center()));
    visitor.pushStateSet(&stateSet);
    // Past the tests for what is in view.
    visitor.addDrawableAndDepth(frame, visitor.getModelViewMatrix(), 0.0f);
    visitor.popStateSet();
}

} // namespace osgMultiRender
