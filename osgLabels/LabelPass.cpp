// SPDX-License-Identifier: MIT
#include <osgLabels/LabelPass.h>

#include <osgLabels/ChunkMesh.h>
#include <osgLabels/LabelExtensions.h>
#include <osgLabels/MapPass.h>
#include <osgLabels/PrimitiveRun.h>

#include <osgMultiRender/PassState.h>

#include <osg/GLExtensions>
#include <osg/Geometry>
#include <osg/Viewport>

#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

using osgMultiRender::ForcedOn;
using osgMultiRender::SurfaceItem;
using osgMultiRender::SurfaceKey;

namespace
{

constexpr unsigned int indexAttribute = ChunkMesh::ObjectAttribute;

bool isParallel(const osg::Matrixd& projection)
{
    return projection(0, 3) == 0.0 && projection(1, 3) == 0.0 && projection(2, 3) == 0.0;
}

osg::Vec3d axisOf(LabelUp up)
{
    switch (up)
    {
    case LabelUp::X:
        return {1.0, 0.0, 0.0};
    case LabelUp::Y:
        return {0.0, 1.0, 0.0};
    case LabelUp::Z:
        return {0.0, 0.0, 1.0};
    case LabelUp::Screen:
        break;
    }
    return {};
}

osg::Vec3d rotated(const osg::Vec3d& v, const osg::Matrixd& m)
{
    return osg::Matrixd::transform3x3(v, m);
}

/// Of the directions; a product of two such lengths bounds how far one matrix stretches what the
/// other squeezes.
double lengthOf(const osg::Matrixd& m)
{
    double squares = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            squares += m(i, j) * m(i, j);
    return std::sqrt(squares);
}

/// The inverse of a modelview matrix. Zero where it squeezes a direction so much that eye
/// coordinates, in single precision, do not say where a point is: then nothing has a label.
osg::Matrixd inverseOf(const osg::Matrixd& modelview)
{
    constexpr double most = 1e11;
    const osg::Matrixd inverse = osg::Matrixd::inverse(modelview);
    const bool isExact = lengthOf(modelview) * lengthOf(inverse) < most; // false for NaN, too
    return isExact ? inverse : osg::Matrixd::scale(0.0, 0.0, 0.0);
}

} // namespace

LabelPass::LabelPass(std::shared_ptr<LabelResources> resources, std::shared_ptr<LabelPicks> picks,
                     const LabelSettings& settings)
    : _resources(std::move(resources)), _picks(std::move(picks))
{
    if (_resources && _resources->map)
        _map = std::make_unique<MapPass>(*_resources, settings);
}

LabelPass::~LabelPass()
{
    for (std::size_t i = 0; i < _asked.size(); ++i)
        if (_asked[i].question) // the picture was not drawn
            _picks->of[i].giveBack(*_asked[i].question);
    if (_targets)
        _resources->targets.release(_contextID, _targets);
}

void LabelPass::begin(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceFrame& frame)
{
    osg::State& state = *renderInfo.getState();
    _contextID = state.getContextID();
    _target = osgMultiRender::DrawTarget::current(state);
    if (!_resources || !_resources->getError().empty())
        _reason = _resources ? _resources->getError() : "they are not shown";
    else if (!_resources->hasSurfaceLabels())
        _reason = "those of surfaces are off";
    else if (_objects.empty())
        _reason = "nothing labelled is in view";
    else if (_target.several)
        _reason = "the view writes several color buffers";
    glGetIntegerv(GL_VIEWPORT, _viewport);
    if (_reason.empty() && (_viewport[2] <= 0 || _viewport[3] <= 0))
        _reason = "the viewport is empty";
    _languageVersion = state.get<osg::GLExtensions>()->glslLanguageVersion;
    _isPaged = _resources && _resources->buffers.isPaged(state);
    if (_map)
        _map->begin(renderInfo, frame.getStage().getCamera(), _viewport, _isPaged);
    if (!_reason.empty())
        return;
    const osg::Matrixd* view =
        const_cast<osgUtil::RenderStage&>(frame.getStage()).getInitialViewMatrix();
    const osg::Vec3d up = axisOf(_resources->settings.up);
    _up = view ? rotated(up, *view) : up;
    makeUnder(state);
    _targets = _resources->targets.acquire(
        _contextID, {_viewport[0] + _viewport[2], _viewport[1] + _viewport[3],
                     _resources->settings.texCoord >= 0, _target});
    _reason = whyIncomplete(state);
}

void LabelPass::makeUnder(osg::State& state)
{
    _under = new osg::StateSet;
    _resources->update(state, *_under);
    const auto add = [this](osg::Uniform* uniform) { _under->addUniform(uniform, ForcedOn); };
    add(new osg::Uniform("osgLabels_line",
                         osg::Vec2(_resources->settings.size, _resources->settings.gap)));
    osg::ref_ptr<osg::Uniform> looks = new osg::Uniform(osg::Uniform::FLOAT_VEC4, "osgLabels_looks",
                                                        3 * int(LabelStyle::MaxStyles));
    for (unsigned int i = 0; i < LabelStyle::MaxStyles; ++i)
    {
        const LabelStyle& style =
            _resources->settings.styles[i < _resources->settings.styles.size() ? i : 0];
        looks->setElement(3 * i, style.ink);
        looks->setElement(3 * i + 1, style.plate);
        looks->setElement(3 * i + 2, osg::Vec4(style.outline, style.outlineWidth));
    }
    add(looks);
}

void LabelPass::classify(const osgMultiRender::SurfaceState& state, const osgUtil::RenderLeaf& leaf,
                         bool ordered, SurfaceKey& key, std::uint32_t& number)
{
    if (!_reason.empty())
        return;
    const auto found = _objects.find(&leaf);
    number = found == _objects.end() ? 0 : found->second;
    // A program of the model's own hides texture coordinates.
    if (key.program && _resources->settings.texCoord >= 0)
        number = 0;
    if (!ordered && _target.hasDepth && state.isCopyable() && isInView(state))
        key.output = Diverted | (_resources->settings.texCoord >= 0 ? Textured : 0u);
    if (number)
    {
        key.output |= Labelled;
        _direct += !(key.output & Diverted);
    }
    const osg::Geometry* geometry = leaf._drawable->asGeometry();
    const bool hasOther =
        geometry && geometry->getVertexAttribArray(indexAttribute) && !ChunkMesh::isOne(*geometry);
    const bool isOneObject =
        key.instance && !dynamic_cast<const PrimitiveRun*>(leaf._drawable.get());
    if ((key.output & Labelled) && (key.program || hasOther || isOneObject))
        key.output |= IndexUniform;
    if (number && !key.program && _resources->settings.texCoord >= 0)
        key.output |= TexCoords | std::uint32_t(_resources->settings.texCoord) << UnitShift;
    if (!(key.output & Labelled) || (key.output & Diverted))
        return;
    // The label is part of the variant's program.
    if (_isPaged)
        key.output |= Paged;
    if (_resources->settings.proportional)
        key.output |= Proportional;
    if (_resources->hasOutlines())
        key.output |= Outlined;
}

bool LabelPass::isInView(const osgMultiRender::SurfaceState& state) const
{
    using osgMultiRender::SurfaceState;
    const auto* viewport = static_cast<const osg::Viewport*>(state.get(SurfaceState::Viewport));
    return !viewport ||
           (GLint(viewport->x()) == _viewport[0] && GLint(viewport->y()) == _viewport[1] &&
            GLint(viewport->width()) == _viewport[2] && GLint(viewport->height()) == _viewport[3]);
}

void LabelPass::end(osg::RenderInfo&) {}

void LabelPass::drawBefore(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame)
{
    if (_map)
        _map->drawOccluders(renderInfo, frame);
}

const osg::StateSet* LabelPass::startRun()
{
    _applied.clear();
    return _under.get();
}

const osg::Matrixd* LabelPass::scaleOf(const osgUtil::RenderLeaf& leaf) const
{
    const auto found = _scales.find(&leaf);
    return found == _scales.end() ? nullptr : found->second.get();
}

LabelPass::Frame LabelPass::frameOf(const osgUtil::RenderLeaf& leaf) const
{
    const osg::Matrixd modelview =
        leaf._modelview ? osg::Matrixd(*leaf._modelview) : osg::Matrixd();
    const osg::Matrixd projection =
        leaf._projection ? osg::Matrixd(*leaf._projection) : osg::Matrixd();
    // Clip coordinates x, y and w, or z where rays are parallel, of eye coordinates.
    const int columns[3] = {0, 1, isParallel(projection) ? 2 : 3};
    osg::Matrixd clip;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 4; ++i)
            clip(i, j) = projection(i, columns[j]);
    osg::Matrixd toLocal = inverseOf(modelview);
    if (const osg::Matrixd* scale = scaleOf(leaf)) // the label's coordinates are scaled ones
        toLocal = toLocal * *scale;
    const osg::Matrixd toEye = osg::Matrixd::inverse(clip);
    osg::Vec3d rows[9];
    for (int i = 0; i < 3; ++i)
        rows[i] = rotated(osg::Vec3d(toEye(i, 0), toEye(i, 1), toEye(i, 2)), toLocal);
    rows[3] = rotated(toEye.getTrans(), toLocal);
    rows[4] = toLocal.getTrans();
    rows[5] = rotated({1.0, 0.0, 0.0}, toLocal);
    rows[6] = rotated({0.0, 1.0, 0.0}, toLocal);
    rows[7] = rotated({0.0, 0.0, 1.0}, toLocal);
    rows[8] = rotated(_up, toLocal);
    Frame frame{};
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 3; ++j)
            frame[3 * i + j] = std::isfinite(rows[i][j]) ? float(rows[i][j]) : 0.0f;
    return frame;
}

int LabelPass::numberOf(const osgUtil::RenderLeaf& leaf)
{
    const auto [found, isNew] = _frameNumbers.emplace(
        std::make_tuple(leaf._modelview.get(), leaf._projection.get(), scaleOf(leaf)),
        int(_frames.size()));
    if (isNew)
        _frames.push_back(frameOf(leaf));
    const bool parallel = leaf._projection && isParallel(*leaf._projection);
    return parallel ? -1 - found->second : found->second;
}

void LabelPass::apply(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceVariant& variant,
                      const osgUtil::RenderLeaf& leaf, std::uint32_t number)
{
    const std::uint32_t bits = variant.getKey().output;
    if (bits & MapOccluder)
        _map->apply(*renderInfo.getState(), variant, leaf);
    if (!(bits & Labelled))
        return;
    // osg::Program trims "[0]" off the names of arrays.
    static const unsigned int frameName = osg::Uniform::getNameID("osgLabels_frame");
    static const unsigned int valuesName = osg::Uniform::getNameID("osgLabels_frameValues");
    static const unsigned int indexName = osg::Uniform::getNameID("osgLabels_index");
    static const unsigned int baseName = osg::Uniform::getNameID("osgLabels_recordBase");
    osg::State& state = *renderInfo.getState();
    const auto& program = *state.getLastAppliedProgramObject();
    const auto* gl = state.get<osg::GLExtensions>();
    const Index index = indexOf(leaf, number);
    if (bits & IndexUniform)
        gl->glUniform1i(program.getUniformLocation(indexName), index.object);
    else
        LabelExtensions::instance().vertexAttribI1i(indexAttribute, index.object);
    Applied& applied = _applied[&variant];
    if (!applied.isSet || applied.recordBase != index.base)
        gl->glUniform1i(program.getUniformLocation(baseName), index.base);
    const osg::Viewport* viewport = state.getCurrentViewport();
    const bool sameFrame = applied.isSet && applied.modelview == leaf._modelview.get() &&
                           applied.projection == leaf._projection.get() &&
                           applied.scale == scaleOf(leaf);
    if (!(bits & Diverted) && (!applied.isSet || applied.viewport != viewport))
        setViewport(*gl, program, viewport);
    applied = {
        leaf._modelview.get(), leaf._projection.get(), scaleOf(leaf), viewport, index.base, true};
    if (sameFrame)
        return;
    const int frame = numberOf(leaf);
    gl->glUniform1i(program.getUniformLocation(frameName), frame);
    if (!(bits & Diverted))
        gl->glUniform3fv(program.getUniformLocation(valuesName), 9,
                         _frames[frame < 0 ? -1 - frame : frame].data());
}

/// A leaf drawn in the view may have a viewport of its own.
void LabelPass::setViewport(const osg::GLExtensions& gl,
                            const osg::Program::PerContextProgram& program,
                            const osg::Viewport* viewport) const
{
    static const unsigned int name = osg::Uniform::getNameID("osgLabels_viewport");
    GLint v[4] = {_viewport[0], _viewport[1], _viewport[2], _viewport[3]};
    if (viewport)
        glGetIntegerv(GL_VIEWPORT, v);
    gl.glUniform4f(program.getUniformLocation(name), float(v[0]), float(v[1]),
                   2.0f / float(std::max(1, v[2])), 2.0f / float(std::max(1, v[3])));
}

LabelPass::Index LabelPass::indexOf(const osgUtil::RenderLeaf& leaf, std::uint32_t number)
{
    // The drawable sets the attribute, or has an array of it.
    if (dynamic_cast<const PrimitiveRun*>(leaf._drawable.get()))
        return {0, GLint(number)};
    if (ChunkMesh::isOne(*leaf._drawable))
        return {0, -GLint(number)}; // see addIndex()
    return {GLint(number), 0};
}

bool LabelPass::diverts(const SurfaceItem& item) const
{
    return item.variant->getKey().output & Diverted;
}

void LabelPass::drawn(osg::RenderInfo& renderInfo)
{
    if (_map)
        _map->draw(renderInfo);
    for (Asked& asked : _asked)
        if (asked.question && _map)
            if (const std::uint32_t onTop =
                    _map->pick(*renderInfo.getState(), asked.question->x, asked.question->y))
                asked.identifier = onTop;
    answer();
}

void LabelPass::fillPlan(osgMultiRender::Plan& plan) const
{
    using Decision = osgMultiRender::PlanEntry::Decision;
    if (_map)
        _map->fillPlan(plan);
    if (!_reason.empty())
    {
        plan.entries.push_back({"labels", Decision::Dropped, _reason});
        return;
    }
    plan.entries.push_back({"labels", Decision::Drawn,
                            std::to_string(_objects.size()) + " drawables, " +
                                std::to_string(_direct) +
                                " of them blended or sorted, labelled as they are drawn"});
    plan.counts["labels.drawables"] = double(_objects.size());
    plan.counts["labels.direct"] = _direct;
    const LabelTable::Sizes sizes = _resources->table->getSizes();
    plan.counts["labels.count"] = double(sizes.labels);
    plan.counts["labels.texts"] = double(sizes.texts);
    plan.counts["labels.bitsPerGlyph"] = sizes.bits;
    plan.counts["labels.bytes.texts"] = double(sizes.textBytes);
    plan.counts["labels.bytes.rows"] = double(sizes.rowBytes);
    plan.counts["labels.bytes.styles"] = double(sizes.styleBytes);
    plan.counts["labels.bytes.records"] = double(_resources->objects.getBytes());
    plan.counts["labels.bytes.batches"] = double(_resources->batches.getBytes());
    plan.counts["labels.bytes.glyphs"] = double(_resources->getAtlasBytes());
    plan.counts["labels.bytes.targets"] = double(_targets->getBytes());
}

} // namespace osgLabels
