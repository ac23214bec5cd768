// SPDX-License-Identifier: MIT
// The half of MapPass that draws what may stand before labels.
#include <osgLabels/MapPass.h>

#include <osgLabels/LabelExtensions.h>
#include <osgLabels/LabelPass.h>
#include <osgLabels/LabelPrograms.h>
#include <osgLabels/LabelUnits.h>
#include <osgLabels/Shaders.h>

#include <osgMultiRender/PassState.h>

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

using osgMultiRender::ForcedOff;
using osgMultiRender::ForcedOn;
using osgMultiRender::SurfaceFrame;
using osgMultiRender::SurfaceItem;
using osgMultiRender::SurfaceKey;
using osgMultiRender::SurfaceState;

namespace
{

/// Sides of a mesh as the rasterizer sees them.
enum Side
{
    BothSides,
    Counterclockwise, ///< What is so in the picture is seen from outside.
    Clockwise,
    ManyCounterclockwise, ///< All sides are drawn, and the program looks at each object's.
    ManyClockwise,
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

Side sideOf(const osgUtil::RenderLeaf& leaf, MeshSides sides, bool isMany)
{
    if (sides == MeshSides::Open)
        return BothSides;
    const bool isCounterclockwise = keepsWinding(leaf) == (sides == MeshSides::Outward);
    if (isMany)
        return isCounterclockwise ? ManyCounterclockwise : ManyClockwise;
    return isCounterclockwise ? Counterclockwise : Clockwise;
}

/// Whether it can stand before anything: not skies, not what is painted over all.
bool isSolid(const SurfaceState& state)
{
    return state.isOn(SurfaceState::Blend) ? state.isOn(SurfaceState::DepthTest) : state.isOpaque();
}

/// Whether it is drawn into the viewport, not into that of an inset.
bool isHere(const SurfaceState& state, const GLint (&viewport)[4])
{
    const auto* own = static_cast<const osg::Viewport*>(state.get(SurfaceState::Viewport));
    return !own || (GLint(own->x()) == viewport[0] && GLint(own->y()) == viewport[1] &&
                    GLint(own->width()) == viewport[2] && GLint(own->height()) == viewport[3]);
}

void setState(osg::StateSet& over, const GLint (&viewport)[4], const PixelBox& box)
{
    over.setAttribute(new osg::Viewport(viewport[0], viewport[1], viewport[2], viewport[3]),
                      ForcedOn);
    const int left = std::max(viewport[0], int(std::floor(box.left)));
    const int bottom = std::max(viewport[1], int(std::floor(box.bottom)));
    const int right = std::min(viewport[0] + viewport[2], int(std::ceil(box.right)));
    const int top = std::min(viewport[1] + viewport[3], int(std::ceil(box.top)));
    over.setAttributeAndModes(
        new osg::Scissor(left, bottom, std::max(0, right - left), std::max(0, top - bottom)),
        ForcedOn);
    over.setAttribute(new osg::ColorMask, ForcedOn);
    over.setAttributeAndModes(new osg::Depth, ForcedOn);
    for (GLenum mode :
         {GL_BLEND, GL_STENCIL_TEST, GL_COLOR_LOGIC_OP, GL_SAMPLE_ALPHA_TO_COVERAGE_ARB})
        over.setMode(mode, ForcedOff);
}

} // namespace

osgMultiRender::SurfaceSnippet MapPass::makeSnippet(const SurfaceKey& key)
{
    osgMultiRender::SurfaceSnippet snippet;
    const bool isMany = key.output & MapMany;
    if (key.output & MapNext)
        snippet.fragment += "#define OSGLABELS_NEXT\n";
    if (key.output & MapNested)
        snippet.fragment += "#define OSGLABELS_NESTED\n";
    if (isMany)
        snippet.fragment += "#define OSGLABELS_RECORDS\n";
    if (key.output & Paged)
        snippet.fragment += "#define OSGLABELS_PAGED\n";
    snippet.fragment +=
        LabelSources::file(osg::Shader::FRAGMENT, "occluder.frag", shaders::occluder_frag);
    if (isMany)
        LabelPass::addIndex(key, snippet);
    if (key.output & MapOpaque)
        snippet.statements = "    if (osgmr_out0.a < 0.5)\n        discard;\n";
    snippet.statements += "    osgLabels_writeOccluder(";
    snippet.statements +=
        isMany ? "osgLabels_featureOf(osgLabels_index));\n" : "uint(osgLabels_feature));\n";
    return snippet;
}

void MapPass::apply(osg::State& state, const osgMultiRender::SurfaceVariant& variant,
                    const osgUtil::RenderLeaf& leaf) const
{
    static const unsigned int featureName = osg::Uniform::getNameID("osgLabels_feature");
    static const unsigned int baseName = osg::Uniform::getNameID("osgLabels_recordBase");
    const auto found = _occluders.find(&leaf);
    if (found == _occluders.end())
        return;
    const auto& program = *state.getLastAppliedProgramObject();
    const auto* gl = state.get<osg::GLExtensions>();
    if (variant.getKey().output & MapMany)
        gl->glUniform1i(program.getUniformLocation(baseName), found->second.recordBase);
    else
        gl->glUniform1i(program.getUniformLocation(featureName), GLint(found->second.number));
}

/// Of the leaf's bound in the picture; false where it has none or comes near the eye.
bool MapPass::boxOf(const osgUtil::RenderLeaf& leaf, PixelBox& box, double& nearest) const
{
    const osg::BoundingBox& bound = leaf._drawable->getBoundingBox();
    if (!bound.valid())
        return false;
    const osg::Matrixd modelview =
        leaf._modelview ? osg::Matrixd(*leaf._modelview) : osg::Matrixd();
    const MapFrame frame(leaf._projection ? osg::Matrixd(*leaf._projection) : osg::Matrixd(), _view,
                         _isByDepth);
    const double inf = std::numeric_limits<double>::infinity();
    nearest = inf;
    box = {inf, inf, -inf, -inf};
    for (unsigned int i = 0; i < 8; ++i)
    {
        const osg::Vec3d eye = osg::Vec3d(bound.corner(i)) * modelview;
        const osg::Vec4d clip = osg::Vec4d(eye, 1.0) * frame.projection;
        if (!std::isfinite(clip.length2()) || !(clip.w() > 0.0))
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

/// Where some rays are parallel and some are not, depth in the window says what is before what.
void MapPass::findProjections(SurfaceFrame& frame)
{
    const auto isParallel = [](const osg::RefMatrix* projection) // none: clip coordinates
    { return !projection || MapFrame(osg::Matrixd(*projection), {}).isParallel; };
    _isByDepth = std::any_of(_groups.begin(), _groups.end(),
                             [&](const Group& group) { return isParallel(group.projection); });
    const osg::RefMatrix* last = nullptr;
    frame.forEachItem(
        [&](const SurfaceItem& item)
        {
            if (_isByDepth || item.leaf->_projection == last || !_occluders.count(item.leaf) ||
                !item.state || !isSolid(*item.state) || !isHere(*item.state, _viewport))
                return;
            last = item.leaf->_projection.get();
            _isByDepth = isParallel(last);
        });
}

void MapPass::select(SurfaceFrame& frame)
{
    _coverage = std::make_unique<MapCoverage>(_view);
    const bool isBack = _settings.mapDepth == MapDepth::Back;
    for (const PlacedLabel& label : _placed)
    {
        const FeatureTree::Range& own = label.label->own;
        const bool hasOwn = own.first <= own.last;
        // Where the depth is that of the own back faces, these take part: nothing is its own.
        _coverage->add(label.box,
                       isBack && hasOwn ? std::numeric_limits<double>::infinity() : label.distance,
                       own);
    }
    std::uint32_t used = 0;
    frame.forEachItem(
        [&](const SurfaceItem& item)
        {
            const auto found = _occluders.find(item.leaf);
            if (found == _occluders.end())
                return;
            Occluder& occluder = found->second;
            const std::uint32_t actions = actionsOf(occluder);
            if (!actions || !item.state || !isSolid(*item.state) || !isHere(*item.state, _viewport))
                return;
            PixelBox box = _view;
            double nearest = -1.0;
            const bool isMoved = item.variant && item.variant->getKey().program;
            if (isMoved || !boxOf(*item.leaf, box, nearest))
            {
                box = _view;
                nearest = -1.0;
            }
            const std::uint32_t number = occluder.isMany ? 0 : occluder.number;
            occluder.isDrawn = _coverage->mayHide(box, nearest, isBack ? 0 : number);
            ++(occluder.isDrawn ? _drawn : _leftOut);
            if (!occluder.isDrawn)
                return;
            occluder.side = sideOf(*item.leaf, occluder.sides, occluder.isMany);
            used |= actions;
            for (unsigned int action = 0; action < NumMapActions; ++action)
                if (actions & (1u << action))
                    _needsNext[action] = _needsNext[action] || _coverage->mayOwn(box, number);
        });
    for (unsigned int action = 0; action < NumMapActions; ++action)
        if (used & (1u << action))
            _actions.push_back(MapAction(action));
}

std::uint32_t MapPass::actionsOf(const Occluder& occluder) const
{
    const std::uint32_t all = (1u << NumMapActions) - 1u, own = 1u << unsigned(_settings.mapAction);
    if (!occluder.isMany)
        return (1u << unsigned(occluder.action)) & all;
    const std::uint32_t actions = _words->actions;
    return (actions | (actions >> (NumMapActions + 1) & 1u ? own : 0u)) & all;
}

void MapPass::drawOccluders(osg::RenderInfo& renderInfo, SurfaceFrame& frame)
{
    findProjections(frame);
    place();
    if (_placed.empty())
        return;
    findDepths();
    select(frame);
    if (!_actions.empty())
        drawLayers(renderInfo, frame);
    findShown(renderInfo);
}

void MapPass::drawLayers(osg::RenderInfo& renderInfo, SurfaceFrame& frame)
{
    osg::State& state = *renderInfo.getState();
    const bool any = std::any_of(_needsNext.begin(), _needsNext.end(), [](bool b) { return b; });
    const int next = any ? 1 + int(_depths.size()) : 0;
    _targets = _scene.targets.acquire(
        _contextID,
        {_viewport[0] + _viewport[2], _viewport[1] + _viewport[3], int(_actions.size()), next});
    _records = _scene.records.upload(state, _words);
    if (next > 1)
        _nests = _scene.nests.upload(state, _nesting, _depths);
    osgMultiRender::FramebufferVisit visit(state);
    for (std::size_t layer = 0; layer < _actions.size(); ++layer)
        drawLayer(renderInfo, frame, int(layer), 0);
    for (int behind = 1; behind <= next; ++behind)
        for (std::size_t layer = 0; layer < _actions.size(); ++layer)
            drawLayer(renderInfo, frame, int(layer), behind);
}

void MapPass::drawLayer(osg::RenderInfo& renderInfo, SurfaceFrame& frame, int layer, int next)
{
    osg::State& state = *renderInfo.getState();
    osg::ref_ptr<osg::StateSet> base = new osg::StateSet;
    setState(*base, _viewport, _coverage->getBox());
    {
        const osgMultiRender::PassState pushed(state, *base);
        state.apply();
        _targets->bind(state, layer, next);
        const GLuint nothing[4] = {};
        const GLfloat farthest = 1.0f;
        LabelExtensions::instance().clearBufferuiv(GL_COLOR, 1, nothing);
        LabelExtensions::instance().clearBufferfv(GL_DEPTH, 0, &farthest);
    }
    if (next && !_needsNext[unsigned(_actions[std::size_t(layer)])])
        return;
    const MapAction action = _actions[std::size_t(layer)];
    for (int side = 0; side < NumSides; ++side)
        _refused += frame.drawAs(renderInfo, *stateOf(layer, next, side),
                                 [&](const SurfaceItem& item, SurfaceKey& key)
                                 { return rekey(item, action, next, side, key); });
}

osg::ref_ptr<osg::StateSet> MapPass::stateOf(int layer, int next, int side) const
{
    osg::ref_ptr<osg::StateSet> over = new osg::StateSet;
    setState(*over, _viewport, _coverage->getBox());
    const bool isMany = side == ManyCounterclockwise || side == ManyClockwise;
    if (side == BothSides || isMany)
        over->setMode(GL_CULL_FACE, ForcedOff);
    else
        over->setAttributeAndModes(new osg::CullFace(osg::CullFace::FRONT), ForcedOn);
    const bool isClockwise = side == Clockwise || side == ManyClockwise;
    over->setAttribute(new osg::FrontFace(isClockwise ? osg::FrontFace::CLOCKWISE
                                                      : osg::FrontFace::COUNTER_CLOCKWISE),
                       ForcedOn);
    const auto add = [&](osg::Uniform* uniform) { over->addUniform(uniform, ForcedOn); };
    add(new osg::Uniform("osgLabels_isByDepth", int(_isByDepth)));
    const auto texture = [&](unsigned int unit, const osg::StateAttribute* attribute)
    { over->setTextureAttribute(unit, const_cast<osg::StateAttribute*>(attribute), ForcedOn); };
    if (isMany)
    {
        texture(TextsUnit, _records.get());
        add(new osg::Uniform("osgLabels_features", int(TextsUnit)));
        add(new osg::Uniform("osgLabels_action", int(_actions[std::size_t(layer)]),
                             int(_settings.mapAction)));
    }
    if (next)
    {
        texture(RowsUnit, _targets->getNear());
        add(new osg::Uniform("osgLabels_nearest", int(RowsUnit)));
        add(new osg::Uniform("osgLabels_layer0", layer));
        if (next > 1)
        {
            const int numbers = MapNests::getNumbers(*_nesting);
            texture(GlyphsUnit, _nests.get());
            add(new osg::Uniform("osgLabels_nests", int(GlyphsUnit)));
            add(new osg::Uniform("osgLabels_nestAt", 2 * numbers * (next - 2), numbers));
        }
    }
    return over;
}

bool MapPass::rekey(const SurfaceItem& item, MapAction action, int next, int side, SurfaceKey& key)
{
    const auto found = _occluders.find(item.leaf);
    if (found == _occluders.end() || !found->second.isDrawn || found->second.side != side ||
        !(actionsOf(found->second) & (1u << unsigned(action))))
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
    const auto bit = [](bool is, std::uint32_t value) { return is ? value : 0u; };
    const bool isMany = found->second.isMany;
    key.output = MapOccluder | bit(next > 0, MapNext) | bit(next > 1, MapNested) |
                 bit(isSheer, MapOpaque) | bit(isMany, MapMany) |
                 bit((isMany || next > 1) && _isPaged, Paged);
    _drawnNext += next > 0;
    return true;
}

} // namespace osgLabels
