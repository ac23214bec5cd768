// SPDX-License-Identifier: MIT
// The half of MapPass that draws what may stand before labels.
#include <osgLabels/MapPass.h>

#include <osgLabels/LabelExtensions.h>
#include <osgLabels/LabelPrograms.h>
#include <osgLabels/LabelUnits.h>
#include <osgLabels/Shaders.h>

#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/FrontFace>
#include <osg/Scissor>
#include <osg/Viewport>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgLabels
{

using osgMultiRender::SurfaceFrame;
using osgMultiRender::SurfaceItem;
using osgMultiRender::SurfaceKey;
using osgMultiRender::SurfaceState;

namespace
{

constexpr auto Over = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
constexpr auto Never = osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE;

/// Sides of a mesh as the rasterizer sees them.
enum Side
{
    BothSides,
    Counterclockwise, ///< What is so in the picture is seen from outside.
    Clockwise,
    NumSides
};

double determinant(const osg::Vec3d& a, const osg::Vec3d& b, const osg::Vec3d& c)
{
    return a * (b ^ c);
}

/// Whether the picture of a leaf shows triangles as they wind in local coordinates, seen from the
/// side from which they are counterclockwise.
bool keepsWinding(const osgUtil::RenderLeaf& leaf)
{
    const osg::Matrixd m = leaf._modelview ? osg::Matrixd(*leaf._modelview) : osg::Matrixd();
    const osg::Matrixd p = leaf._projection ? osg::Matrixd(*leaf._projection) : osg::Matrixd();
    const auto column = [&p](int j) { return osg::Vec3d(p(0, j), p(1, j), p(2, j)); };
    const osg::Vec3d w = column(3);
    // Rays run along -z where they are parallel.
    const osg::Vec3d along = w == osg::Vec3d() ? osg::Vec3d(0.0, 0.0, -1.0) : w;
    const double turn = determinant({m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)},
                                    {m(2, 0), m(2, 1), m(2, 2)});
    return turn * determinant(column(0), column(1), along) < 0.0;
}

Side sideOf(const osgUtil::RenderLeaf& leaf, MeshSides sides)
{
    if (sides == MeshSides::Open)
        return BothSides;
    return keepsWinding(leaf) == (sides == MeshSides::Outward) ? Counterclockwise : Clockwise;
}

/// Whether it can stand before anything: not skies, not what is painted over all.
bool isSolid(const SurfaceState& state)
{
    return state.isOn(SurfaceState::Blend) ? state.isOn(SurfaceState::DepthTest) : state.isOpaque();
}

void setState(osg::StateSet& over, const GLint (&viewport)[4], const PixelBox& box)
{
    over.setAttribute(new osg::Viewport(viewport[0], viewport[1], viewport[2], viewport[3]), Over);
    const int left = std::max(viewport[0], int(std::floor(box.left)));
    const int bottom = std::max(viewport[1], int(std::floor(box.bottom)));
    const int right = std::min(viewport[0] + viewport[2], int(std::ceil(box.right)));
    const int top = std::min(viewport[1] + viewport[3], int(std::ceil(box.top)));
    over.setAttributeAndModes(
        new osg::Scissor(left, bottom, std::max(0, right - left), std::max(0, top - bottom)), Over);
    over.setAttribute(new osg::ColorMask, Over);
    over.setAttributeAndModes(new osg::Depth, Over);
    for (GLenum mode :
         {GL_BLEND, GL_STENCIL_TEST, GL_COLOR_LOGIC_OP, GL_SAMPLE_ALPHA_TO_COVERAGE_ARB})
        over.setMode(mode, Never);
}

} // namespace

osgMultiRender::SurfaceSnippet MapPass::makeSnippet(const SurfaceKey& key)
{
    osgMultiRender::SurfaceSnippet snippet;
    if (key.output & MapNext)
        snippet.fragment = "#define OSGLABELS_NEXT\n";
    snippet.fragment +=
        LabelSources::file(osg::Shader::FRAGMENT, "occluder.frag", shaders::occluder_frag);
    if (key.output & MapOpaque)
        snippet.statements = "    if (osgmr_out0.a < 0.5)\n        discard;\n";
    snippet.statements += "    osgLabels_writeOccluder(uint(osgLabels_feature));\n";
    return snippet;
}

void MapPass::apply(osg::State& state, const osgUtil::RenderLeaf& leaf) const
{
    static const unsigned int featureName = osg::Uniform::getNameID("osgLabels_feature");
    const auto found = _occluders.find(&leaf);
    const auto& program = *state.getLastAppliedProgramObject();
    state.get<osg::GLExtensions>()->glUniform1i(
        program.getUniformLocation(featureName),
        found == _occluders.end() ? 0 : GLint(found->second.number));
}

/// Of the leaf's bound in the picture; false where it has none or comes near the eye.
bool MapPass::boxOf(const osgUtil::RenderLeaf& leaf, PixelBox& box, double& nearest) const
{
    const osg::BoundingBox& bound = leaf._drawable->getBoundingBox();
    if (!bound.valid())
        return false;
    const osg::Matrixd modelview =
        leaf._modelview ? osg::Matrixd(*leaf._modelview) : osg::Matrixd();
    const MapFrame frame(leaf._projection ? osg::Matrixd(*leaf._projection) : osg::Matrixd(),
                         _view);
    const double inf = std::numeric_limits<double>::infinity();
    nearest = inf;
    box = {inf, inf, -inf, -inf};
    for (unsigned int i = 0; i < 8; ++i)
    {
        const osg::Vec3d eye = osg::Vec3d(bound.corner(i)) * modelview;
        const osg::Vec4d clip = osg::Vec4d(eye, 1.0) * frame.projection;
        if (!clip.valid() || !(clip.w() > 0.0))
            return false;
        const double x =
            _view.left + (0.5 + 0.5 * clip.x() / clip.w()) * (_view.right - _view.left);
        const double y =
            _view.bottom + (0.5 + 0.5 * clip.y() / clip.w()) * (_view.top - _view.bottom);
        box = {std::min(box.left, x), std::min(box.bottom, y), std::max(box.right, x),
               std::max(box.top, y)};
        nearest = std::min(nearest, frame.distanceOf(eye));
    }
    return true;
}

void MapPass::select(SurfaceFrame& frame)
{
    _coverage = std::make_unique<MapCoverage>(_view);
    const bool isBack = _scene.settings.mapDepth == MapDepth::Back;
    for (const PlacedLabel& label : _placed)
    {
        const FeatureTree::Range& own = label.label->own;
        const bool hasOwn = own.first <= own.last;
        // Where the depth is that of the own back faces, these take part: nothing is its own.
        _coverage->add(label.box,
                       isBack && hasOwn ? std::numeric_limits<double>::infinity() : label.distance,
                       own);
    }
    std::array<bool, NumMapActions> used{};
    frame.forEachItem(
        [&](const SurfaceItem& item)
        {
            const auto found = _occluders.find(item.leaf);
            if (found == _occluders.end())
                return;
            Occluder& occluder = found->second;
            if (occluder.action == MapAction::Ignore || !item.state || !isSolid(*item.state))
                return;
            PixelBox box = _view;
            double nearest = -1.0;
            const bool isMoved = item.variant && item.variant->getKey().program;
            if (isMoved || !boxOf(*item.leaf, box, nearest))
            {
                box = _view;
                nearest = -1.0;
            }
            const std::uint32_t number = isBack ? 0 : occluder.number;
            occluder.isDrawn = _coverage->mayHide(box, nearest, number);
            ++(occluder.isDrawn ? _drawn : _leftOut);
            if (!occluder.isDrawn)
                return;
            const auto action = unsigned(occluder.action);
            used[action] = true;
            _needsNext[action] = _needsNext[action] || _coverage->mayOwn(box, occluder.number);
        });
    for (unsigned int action = 0; action < NumMapActions; ++action)
        if (used[action])
            _actions.push_back(MapAction(action));
}

void MapPass::drawOccluders(osg::RenderInfo& renderInfo, SurfaceFrame& frame)
{
    if (_placed.empty())
        return;
    select(frame);
    if (_actions.empty())
        return;
    osg::State& state = *renderInfo.getState();
    const bool next = std::any_of(_needsNext.begin(), _needsNext.end(), [](bool b) { return b; });
    _targets = _scene.targets.acquire(
        _contextID,
        {_viewport[0] + _viewport[2], _viewport[1] + _viewport[3], int(_actions.size()), next});
    osgMultiRender::FramebufferVisit visit(state);
    for (std::size_t layer = 0; layer < _actions.size(); ++layer)
        drawLayer(renderInfo, frame, int(layer), false);
    for (std::size_t layer = 0; next && layer < _actions.size(); ++layer)
        drawLayer(renderInfo, frame, int(layer), true);
}

void MapPass::drawLayer(osg::RenderInfo& renderInfo, SurfaceFrame& frame, int layer, bool next)
{
    osg::State& state = *renderInfo.getState();
    osg::ref_ptr<osg::StateSet> base = new osg::StateSet;
    setState(*base, _viewport, _coverage->getBox());
    state.pushStateSet(base);
    state.apply();
    _targets->bind(state, layer, next);
    const GLuint nothing[4] = {};
    const GLfloat farthest = 1.0f;
    LabelExtensions::instance().clearBufferuiv(GL_COLOR, 1, nothing);
    LabelExtensions::instance().clearBufferfv(GL_DEPTH, 0, &farthest);
    state.popStateSet();
    if (next && !_needsNext[unsigned(_actions[std::size_t(layer)])])
        return;
    for (int side = 0; side < NumSides; ++side)
        drawSide(renderInfo, frame, layer, next, side);
}

void MapPass::drawSide(osg::RenderInfo& renderInfo, SurfaceFrame& frame, int layer, bool next,
                       int side)
{
    osg::ref_ptr<osg::StateSet> over = new osg::StateSet;
    setState(*over, _viewport, _coverage->getBox());
    if (side == BothSides)
        over->setMode(GL_CULL_FACE, Never);
    else
    {
        over->setAttributeAndModes(new osg::CullFace(osg::CullFace::FRONT), Over);
        over->setAttribute(new osg::FrontFace(side == Counterclockwise
                                                  ? osg::FrontFace::COUNTER_CLOCKWISE
                                                  : osg::FrontFace::CLOCKWISE),
                           Over);
    }
    over->addUniform(new osg::Uniform("osgLabels_isParallel", int(_isParallel)), Over);
    if (next)
    {
        over->addUniform(new osg::Uniform("osgLabels_nearest", int(RowsUnit)), Over);
        over->addUniform(new osg::Uniform("osgLabels_layer0", layer), Over);
        over->setTextureAttribute(RowsUnit, const_cast<osg::StateAttribute*>(_targets->getNear()),
                                  Over);
    }
    const MapAction action = _actions[std::size_t(layer)];
    _refused += frame.drawAs(
        renderInfo, *over,
        [&](const SurfaceItem& item, SurfaceKey& key)
        {
            const auto found = _occluders.find(item.leaf);
            if (found == _occluders.end() || !found->second.isDrawn ||
                found->second.action != action || sideOf(*item.leaf, found->second.sides) != side)
                return false;
            const SurfaceState& state = *item.state;
            const bool isSheer =
                state.isOn(SurfaceState::Blend) || state.isOn(SurfaceState::AlphaToCoverage);
            if (!key.program && !isSheer && !state.isOn(SurfaceState::AlphaTest))
            {
                // Nothing of its colour is needed.
                SurfaceKey plain;
                plain.clip = key.clip;
                plain.instance = key.instance;
                key = plain;
            }
            key.output = MapOccluder | (next ? std::uint32_t(MapNext) : 0u) |
                         (isSheer ? std::uint32_t(MapOpaque) : 0u);
            _drawnNext += next;
            return true;
        });
}

} // namespace osgLabels
