// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixPass.h>

#include <osgMultiRender/MixBounds.h>
#include <osgMultiRender/SurfaceFrame.h>

#include <osg/BlendFunc>
#include <osg/GLExtensions>
#include <osg/Viewport>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderLeaf>

namespace osgMultiRender
{

namespace
{

/// How often a box is halved at most to find which renderings it needs.
constexpr int MaxDistances = 24;

/// How far off a fragment's position may be, as a share of its distance from the eye: that of
/// single precision after a projection and its inverse.
constexpr double PositionError = 4e-6;

glm::dmat4 toGlm(const osg::Matrixd& matrix)
{
    glm::dmat4 result;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            result[row][column] = matrix(row, column);
    return result;
}

glm::dvec3 toGlm(const osg::Vec3d& v)
{
    return {v.x(), v.y(), v.z()};
}

} // namespace

MixPass::MixPass(std::shared_ptr<MixResources> resources,
                 std::shared_ptr<const MixSnapshot> snapshot, const osg::Matrixd& toScene)
    : _resources(std::move(resources)), _snapshot(std::move(snapshot)), _keysToEye(toScene)
{
}

void MixPass::cull(osgUtil::CullVisitor& visitor, SurfaceGroup&, const osg::StateSet*)
{
    // One group in several places has its key points in the first one of them.
    if (!_isCulled && visitor.getModelViewMatrix())
        _keysToEye.postMult(*visitor.getModelViewMatrix());
    _isCulled = true;
}

void MixPass::begin(osg::RenderInfo& renderInfo, const SurfaceFrame&)
{
    osg::State& state = *renderInfo.getState();
    _contextID = state.getContextID();
    _eyeToKeys = osg::Matrixd::inverse(_keysToEye);
    _frame = _resources->programs.begin(_snapshot, state);
    _weights = weightsOf(*_snapshot);
    {
        std::lock_guard<std::mutex> lock(_resources->mutex);
        auto& free = _resources->free[_contextID];
        if (!free.empty())
        {
            _state = free.back();
            free.pop_back();
        }
    }
    if (!_state)
        _state = new MixState(MixUnit);
    _state->update(*_snapshot->points, _weights, _keysToEye);
    osg::StateSet& stateSet = *_state->getStateSet();
    const auto mode = osg::StateAttribute::OVERRIDE;
    if (_snapshot->isTransparent)
        stateSet.setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA),
                                      mode | osg::StateAttribute::ON);
    else
        stateSet.removeAttribute(osg::StateAttribute::BLENDFUNC);
}

/// Renderings that are not shown have no range, so that the rules do not count them.
MixWeights MixPass::weightsOf(const MixSnapshot& snapshot) const
{
    std::vector<MixRange> ranges;
    for (std::size_t i = 0; i < snapshot.slots.size(); ++i)
    {
        constexpr double never = std::numeric_limits<double>::infinity();
        ranges.push_back(_frame.isShown[i] ? snapshot.slots[i].range
                                           : MixRange{never, never, never, never});
    }
    MixRules rules = snapshot.rules;
    if (rules.base >= int(ranges.size()) || (rules.base >= 0 && !_frame.isShown[rules.base]))
        rules.base = -1;
    return MixWeights(ranges, rules);
}

/// Those whose weight is not 0 all over the leaf.
MixSet MixPass::setOf(const osgUtil::RenderLeaf& leaf) const
{
    const osg::BoundingBox& bounds = leaf._drawable->getBoundingBox();
    osg::Matrixd toEye;
    if (leaf._modelview)
        toEye = *leaf._modelview;
    MixBox box; // not finite: everything
    box.center = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    double margin = 0.0;
    if (bounds.valid())
    {
        box = MixBox::from(toGlm(osg::Vec3d(bounds._min)), toGlm(osg::Vec3d(bounds._max)),
                           toGlm(toEye * _eyeToKeys));
        const double scale = _eyeToKeys.getScale().length();
        margin = PositionError * scale *
                 ((osg::Vec3d(bounds.center()) * toEye).length() +
                  bounds.radius() * toEye.getScale().length());
    }
    const std::vector<MixWeights::Bounds> weights =
        weightsOver(*_snapshot->points, _weights, box, margin, MaxDistances);
    MixSet set;
    for (std::size_t i = 0; i + 1 < weights.size(); ++i)
        if (!weights[i].isZero() && _frame.isShown[i])
        {
            set.members.push_back({std::uint16_t(i), _snapshot->slots[i].id});
            set.isWhole = weights[i].isOne();
        }
    set.isWhole = set.isWhole && set.members.size() == 1;
    set.isTransparent = _snapshot->isTransparent && !set.isWhole;
    return set;
}

SurfaceLook* MixPass::look(const SurfaceState&, const osgUtil::RenderLeaf& leaf)
{
    if (!_frame.all)
        return nullptr;
    MixSet set = _snapshot->prunes ? setOf(leaf) : _frame.all->getSet();
    if (set.members.empty()) // the background: any program draws it
        set = _frame.all->getSet();
    const auto [found, isNew] = _sets.try_emplace(set);
    if (isNew)
        found->second.program = _resources->programs.find(set);
    ++found->second.leaves;
    MixProgram* program = found->second.program ? found->second.program.get() : _frame.all.get();
    auto& values = _values[program];
    if (!values)
        values = program->valuesOf(*_snapshot);
    return program;
}

void MixPass::end(osg::RenderInfo& renderInfo)
{
    if (!_frame.isSettled || !_frame.all)
        return;
    // One a frame, the one that most leaves wait for.
    const MixSet* wanted = nullptr;
    unsigned int most = 0;
    for (const auto& [set, shown] : _sets)
        if (!shown.program && shown.leaves > most && set.members != _frame.all->getSet().members)
        {
            wanted = &set;
            most = shown.leaves;
        }
    if (wanted)
        _resources->programs.make(*wanted, _snapshot, *renderInfo.getState(),
                                  _snapshot->settleFrames == 0);
}

void MixPass::drawn(osg::RenderInfo&)
{
    if (!_state)
        return;
    std::lock_guard<std::mutex> lock(_resources->mutex);
    _resources->free[_contextID].push_back(_state);
    _state = nullptr;
}

const osg::StateSet* MixPass::startRun()
{
    _variant = nullptr;
    _sent.clear();
    return _state ? _state->getStateSet() : nullptr;
}

void MixPass::apply(osg::RenderInfo& renderInfo, const SurfaceVariant& variant,
                    const osgUtil::RenderLeaf&, std::uint32_t)
{
    static const unsigned int name = osg::Uniform::getNameID("osgmr_mixViewport");
    osg::State& state = *renderInfo.getState();
    const osg::Viewport* viewport = state.getCurrentViewport();
    const auto* program = state.getLastAppliedProgramObject();
    if (!viewport || (_variant == &variant && _viewport == viewport))
        return;
    _variant = &variant;
    _viewport = viewport;
    auto* gl = state.get<osg::GLExtensions>();
    gl->glUniform4f(program->getUniformLocation(name), GLfloat(viewport->x()),
                    GLfloat(viewport->y()), GLfloat(2.0 / viewport->width()),
                    GLfloat(2.0 / viewport->height()));
    // Past osg::State, whose values of these names would be the last frame's.
    const auto values = _values.find(variant.getLook());
    if (values != _values.end() && _sent.insert(&variant).second)
        for (const osg::ref_ptr<osg::Uniform>& uniform : values->second->uniforms)
            if (const GLint place = program->getUniformLocation(uniform->getNameID()); place >= 0)
                uniform->apply(gl, place);
}

std::string MixPass::nameOf(const MixSet& set) const
{
    std::string name = set.isWhole ? "only" : "mix";
    for (const MixSet::Member& member : set.members)
        name += (name.size() > 4 ? "+" : " ") + _snapshot->slots[member.slot].rendering->name;
    return name;
}

void MixPass::fillPlan(Plan& plan) const
{
    using Decision = PlanEntry::Decision;
    for (const auto& [set, shown] : _sets)
        plan.entries.push_back(
            {nameOf(set), shown.program ? Decision::Drawn : Decision::Folded,
             std::to_string(shown.leaves) + " drawables, " +
                 (shown.program ? set.isWhole ? "wholly within its maximum"
                                              : "the weights of these are not 0 there"
                                : "by the program of all, until nothing moves")});
    for (const auto& [slot, why] : _frame.leftOut)
        plan.entries.push_back({"rendering " + std::to_string(slot) + " '" +
                                    _snapshot->slots[slot].rendering->name + "'",
                                Decision::Dropped, why});
    if (_frame.all)
        for (const MergeMessage& message : _frame.all->getMerged().messages)
            if (message.severity != MergeSeverity::Error)
                plan.entries.push_back({"merged program", Decision::Drawn, message.text});
    const MixPrograms::Counts counts = _resources->programs.getCounts();
    plan.counts["mix.programs"] = counts.kept;
    plan.counts["mix.programs.merged"] = counts.merged;
    plan.counts["mix.programs.linked"] = counts.linked;
    plan.counts["mix.programs.tried"] = counts.tried;
    plan.counts["mix.programs.evicted"] = counts.evicted;
    plan.counts["mix.mergeMilliseconds"] = counts.mergeMilliseconds;
    plan.counts["mix.linkMilliseconds"] = counts.linkMilliseconds;
    plan.counts["mix.keyPoints"] = static_cast<double>(_snapshot->points->getNumPoints());
}

} // namespace osgMultiRender
