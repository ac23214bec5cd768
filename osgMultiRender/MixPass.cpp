// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixPass.h>

#include <osgMultiRender/MixBounds.h>
#include <osgMultiRender/SurfaceFrame.h>

#include <osg/GLExtensions>
#include <osg/Viewport>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderLeaf>

#include <algorithm>

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
    : _draw(std::move(resources), std::move(snapshot)), _keysToScene(toScene), _keysToEye(toScene)
{
}

void MixPass::cull(osgUtil::CullVisitor& visitor, SurfaceGroup&, const osg::StateSet*)
{
    // One group in several places has its key points in the first one of them.
    if (!_isCulled && visitor.getModelViewMatrix())
        _keysToEye.postMult(*visitor.getModelViewMatrix());
    _isCulled = true;
}

void MixPass::begin(osg::RenderInfo& renderInfo, const SurfaceFrame& frame)
{
    _eyeToKeys = osg::Matrixd::inverse(_keysToEye);
    _draw.begin(*renderInfo.getState(), _keysToEye, [this, &frame] { return partsOf(frame); });
}

/// In the frame of the key points; not finite for a leaf without a bound.
MixBox MixPass::boxOf(const osgUtil::RenderLeaf& leaf, double& margin) const
{
    const osg::BoundingBox& bounds = leaf._drawable->getBoundingBox();
    osg::Matrixd toEye;
    if (leaf._modelview)
        toEye = *leaf._modelview;
    MixBox box;
    box.center = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    margin = 0.0;
    if (bounds.valid())
    {
        box = MixBox::from(toGlm(osg::Vec3d(bounds._min)), toGlm(osg::Vec3d(bounds._max)),
                           toGlm(toEye * _eyeToKeys));
        const double scale = _eyeToKeys.getScale().length();
        margin = PositionError * scale *
                 ((osg::Vec3d(bounds.center()) * toEye).length() +
                  bounds.radius() * toEye.getScale().length());
    }
    return box;
}

/// The leaves with the solid angles of spheres around them.
std::vector<MixPart> MixPass::partsOf(const SurfaceFrame& frame) const
{
    std::vector<MixPart> parts;
    const osg::Vec3d eye = osg::Vec3d() * _eyeToKeys;
    frame.forEachLeaf(*this,
                      [&](const osgUtil::RenderLeaf& leaf, bool)
                      {
                          double margin = 0.0;
                          const MixBox box = boxOf(leaf, margin);
                          const double away = glm::length(box.center - toGlm(eye));
                          const double share = std::min(1.0, box.radius() / away);
                          parts.push_back({box, share * share});
                      });
    return parts;
}

/// Those whose weight is not 0 all over the leaf.
MixSet MixPass::setOf(const osgUtil::RenderLeaf& leaf) const
{
    double margin = 0.0;
    const MixBox box = boxOf(leaf, margin); // not finite: everything
    const std::vector<MixWeights::Bounds> weights =
        weightsOver(*_draw.getSnapshot().points, _draw.getWeights(), box, margin, MaxDistances);
    MixSet set;
    for (std::size_t i = 0; i + 1 < weights.size(); ++i)
        if (!weights[i].isZero() && _draw.getFrame().isShown[i])
        {
            set.members.push_back({std::uint16_t(i), _draw.getSnapshot().slots[i].id});
            set.isWhole = weights[i].isOne();
        }
    set.isWhole = set.isWhole && set.members.size() == 1;
    set.isTransparent = _draw.getSnapshot().isTransparent && !set.isWhole;
    set.ownLighting = _draw.getSnapshot().ownLighting;
    return set;
}

/// Where no rendering asks for them all lights are the same.
int MixPass::lightsOf(const SurfaceState& state, const MixSet& set) const
{
    const std::vector<MixSlot>& slots = _draw.getSnapshot().slots;
    if (std::none_of(set.members.begin(), set.members.end(),
                     [&](const MixSet::Member& member)
                     { return slots[member.slot].rendering->findUniform("osg_EnabledLights"); }))
        return MergeOptions::AnyLights;
    int lights = 0;
    for (unsigned int number = 0; number < SurfaceState::MaxGLLights; ++number)
        lights |= state.isLightOn(number) << number;
    return lights;
}

SurfaceLook* MixPass::look(const SurfaceState& state, const osgUtil::RenderLeaf& leaf)
{
    if (!_draw.getFrame().all)
        return nullptr;
    const bool prunes = _draw.getSnapshot().prunes;
    MixSet set = prunes ? setOf(leaf) : _draw.getFrame().all->getSet();
    if (set.members.empty()) // the background: any program draws it
        set = _draw.getFrame().all->getSet();
    else if (prunes)
        set.lights = lightsOf(state, set);
    const auto [found, isNew] = _sets.try_emplace(set);
    if (isNew)
        found->second.program = _draw.getResources().programs.find(set);
    ++found->second.leaves;
    MixProgram* program =
        found->second.program ? found->second.program.get() : _draw.getFrame().all.get();
    auto& values = _values[program];
    if (!values)
        values = program->valuesOf(_draw.getSnapshot());
    return program;
}

void MixPass::end(osg::RenderInfo& renderInfo)
{
    if (!_draw.getFrame().all)
        return;
    std::map<MixSet, unsigned int> missing;
    for (const auto& [set, shown] : _sets)
        if (!shown.program && (set.lights != MergeOptions::AnyLights ||
                               set.members != _draw.getFrame().all->getSet().members))
            missing[set] = shown.leaves;
    _draw.getResources().programs.makeWanted(missing, _draw.shareSnapshot(), _keysToScene,
                                             *renderInfo.getState(),
                                             [this] { return _draw.getShares(); });
}

void MixPass::drawn(osg::RenderInfo&)
{
    _draw.end();
}

const osg::StateSet* MixPass::startRun()
{
    _variant = nullptr;
    _sent.clear();
    return _draw.getStateSet();
}

void MixPass::apply(osg::RenderInfo& renderInfo, const SurfaceVariant& variant,
                    const osgUtil::RenderLeaf& leaf, std::uint32_t)
{
    osg::State& state = *renderInfo.getState();
    const osg::Viewport* viewport = state.getCurrentViewport();
    if (viewport && (_variant != &variant || _viewport != viewport))
        startVariant(state, variant, *viewport);
    _lights.send(state, leaf._parent);
}

/// What all leaves of a program have in common.
void MixPass::startVariant(osg::State& state, const SurfaceVariant& variant,
                           const osg::Viewport& viewport)
{
    static const unsigned int name = osg::Uniform::getNameID("osgmr_mixViewport");
    const osg::Program::PerContextProgram& program = *state.getLastAppliedProgramObject();
    _variant = &variant;
    _viewport = &viewport;
    _lights.setProgram(program);
    auto* gl = state.get<osg::GLExtensions>();
    gl->glUniform4f(program.getUniformLocation(name), GLfloat(viewport.x()), GLfloat(viewport.y()),
                    GLfloat(2.0 / viewport.width()), GLfloat(2.0 / viewport.height()));
    const auto values = _values.find(variant.getLook());
    if (values != _values.end() && _sent.insert(&variant).second)
        values->second->send(program, state);
}

std::string MixPass::nameOf(const MixSet& set) const
{
    std::string name = set.isWhole ? "only" : "mix";
    for (const MixSet::Member& member : set.members)
        name +=
            (name.size() > 4 ? "+" : " ") + _draw.getSnapshot().slots[member.slot].rendering->name;
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
    _draw.fillPlan(plan);
}

} // namespace osgMultiRender
