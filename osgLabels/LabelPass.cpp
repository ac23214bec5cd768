// SPDX-License-Identifier: MIT
#include <osgLabels/LabelPass.h>

#include <osgLabels/LabelUnits.h>
#include <osgLabels/PrimitiveRun.h>

#include <osg/BlendFunc>
#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/GLExtensions>
#include <osg/Geometry>
#include <osg/Viewport>

#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

using osgMultiRender::SurfaceItem;
using osgMultiRender::SurfaceKey;
using osgMultiRender::SurfaceSnippet;

namespace
{

constexpr auto Over = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
constexpr auto Never = osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE;

/// The object index' vertex attribute: free beside those of the fixed function on all drivers.
constexpr unsigned int indexAttribute = 6;

/// What OSG does not load.
struct Extensions
{
    void(GL_APIENTRY* vertexAttribI1i)(GLuint, GLint) = nullptr;
    void(GL_APIENTRY* clearBufferuiv)(GLenum, GLint, const GLuint*) = nullptr;
    void(GL_APIENTRY* clearBufferfv)(GLenum, GLint, const GLfloat*) = nullptr;

    static const Extensions& instance()
    {
        static const Extensions extensions = []
        {
            Extensions e;
            osg::setGLExtensionFuncPtr(e.vertexAttribI1i, "glVertexAttribI1i");
            osg::setGLExtensionFuncPtr(e.clearBufferuiv, "glClearBufferuiv");
            osg::setGLExtensionFuncPtr(e.clearBufferfv, "glClearBufferfv");
            return e;
        }();
        return extensions;
    }
};

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

void forEachLeaf(osgUtil::RenderBin& bin, const std::function<void(const osgUtil::RenderLeaf&)>& f)
{
    for (const osgUtil::StateGraph* graph : bin.getStateGraphList())
        for (const auto& leaf : graph->_leaves)
            f(*leaf);
    for (const auto& [number, inner] : bin.getRenderBinList())
        forEachLeaf(*inner, f);
}

/// Points have no surface to write on.
bool isPoints(const osg::Drawable& drawable)
{
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry || geometry->getNumPrimitiveSets() == 0)
        return false;
    const osg::Geometry::PrimitiveSetList& sets = geometry->getPrimitiveSetList();
    return std::all_of(sets.begin(), sets.end(),
                       [](const auto& primitives) { return primitives->getMode() == GL_POINTS; });
}

osg::Vec3d rotated(const osg::Vec3d& v, const osg::Matrixd& m)
{
    return osg::Matrixd::transform3x3(v, m);
}

} // namespace

LabelPass::LabelPass(std::shared_ptr<LabelResources> resources) : _resources(std::move(resources))
{
}

LabelPass::~LabelPass()
{
    if (_targets)
        _resources->targets.release(_contextID, _targets);
}

void LabelPass::cull(osgUtil::CullVisitor& visitor, osgMultiRender::SurfaceGroup& group)
{
    if (!_resources || !_resources->collector)
        return;
    bool isEmpty = true;
    {
        LabelCollector::View view(*_resources->collector, group, *visitor.getModelViewMatrix());
        forEachLeaf(*visitor.getCurrentRenderBin()->getStage(),
                    [&](const osgUtil::RenderLeaf& leaf)
                    {
                        isEmpty = false;
                        const std::uint32_t object = objectOf(leaf, view);
                        if (object)
                            _objects.emplace(&leaf, object);
                    });
    }
    _resources->fitNew();
    if (isEmpty && _resources->pick.takeQuestion()) // nothing will be drawn
        _resources->pick.answer(0);
}

std::uint32_t LabelPass::objectOf(const osgUtil::RenderLeaf& leaf, LabelCollector::View& view)
{
    const osg::Drawable& drawable = *leaf._drawable;
    if (dynamic_cast<const PrimitiveRun*>(&drawable)) // it says itself which
        return _resources->batches.getCount() ? 1 : 0;
    if (isPoints(drawable))
        return 0;
    return view.find(drawable, leaf._modelview ? osg::Matrixd(*leaf._modelview) : osg::Matrixd());
}

void LabelPass::begin(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceFrame& frame)
{
    osg::State& state = *renderInfo.getState();
    _contextID = state.getContextID();
    _target = osgMultiRender::DrawTarget::current(state);
    if (!_resources || !_resources->getError().empty())
        _reason = _resources ? _resources->getError() : "they are not shown";
    else if (_objects.empty())
        _reason = "nothing labelled is in view";
    else if (_target.several)
        _reason = "the view writes several color buffers";
    if (!_reason.empty())
        return;
    const auto* gl = state.get<osg::GLExtensions>();
    _languageVersion = gl->glslLanguageVersion;
    _isPaged = _resources->buffers.isPaged(state);
    glGetIntegerv(GL_VIEWPORT, _viewport);
    const osg::Matrixd* view =
        const_cast<osgUtil::RenderStage&>(frame.getStage()).getInitialViewMatrix();
    const osg::Vec3d up = axisOf(_resources->settings.up);
    _up = view ? rotated(up, *view) : up;
    makeUnder(state);
    _asked = _resources->pick.takeQuestion();
    _targets = _resources->targets.acquire(
        _contextID, {_viewport[0] + _viewport[2], _viewport[1] + _viewport[3], _target});
}

void LabelPass::makeUnder(osg::State& state)
{
    _under = new osg::StateSet;
    _resources->update(state, *_under);
    const auto add = [this](osg::Uniform* uniform) { _under->addUniform(uniform, Over); };
    add(new osg::Uniform("osgLabels_layoutOfText",
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
    if (!ordered && _target.hasDepth && state.isCopyable() && isInView(state))
        key.output = Diverted;
    if (number)
    {
        key.output |= Labelled;
        _direct += !(key.output & Diverted);
    }
    const osg::Geometry* geometry = leaf._drawable->asGeometry();
    if ((key.output & Labelled) &&
        (key.program || (geometry && geometry->getVertexAttribArray(indexAttribute))))
        key.output |= IndexUniform;
    if (key.output && _isPaged)
        key.output |= Paged;
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

SurfaceSnippet LabelPass::makeSnippet(const SurfaceKey& key) const
{
    SurfaceSnippet snippet;
    const bool diverted = key.output & Diverted, labelled = key.output & Labelled;
    if (diverted)
        snippet.fragment = "layout(location = 1) out uint osgLabels_outIdentifier;\n"
                           "layout(location = 2) out vec2 osgLabels_outPlace;\n"
                           "layout(location = 3) out vec4 osgLabels_outFootprint;\n";
    if (!labelled)
    {
        if (diverted)
            snippet.statements = "    osgLabels_outIdentifier = 0u;\n"
                                 "    osgLabels_outPlace = vec2(-1.0);\n"
                                 "    osgLabels_outFootprint = vec4(0.0);\n";
        return snippet;
    }
    if (key.output & IndexUniform)
        snippet.fragment += "uniform int osgLabels_index;\n";
    else
    {
        // A PrimitiveBatch' VertexSnippet has the attribute already.
        snippet.vertex = "#ifndef OSGLABELS_OBJECT\n"
                         "#define OSGLABELS_OBJECT\n"
                         "layout(location = 6) in int osgLabels_object;\n"
                         "#endif\n"
                         "flat out int osgLabels_index;\n";
        snippet.vertexStatements = "    osgLabels_index = osgLabels_object + gl_InstanceID;\n";
        snippet.fragment += "flat in int osgLabels_index;\n";
    }
    // Its records lie in a texture buffer of its own.
    snippet.fragment += LabelSources::locate(key.output & Paged, key.instance == 0);
    if (!diverted)
        snippet.fragment += LabelSources::ink();
    snippet.statements = "    osgLabels_Text osgLabels_text;\n"
                         "    vec2 osgLabels_place;\n"
                         "    mat2 osgLabels_footprint;\n"
                         "    uint osgLabels_identifier = osgLabels_locate(osgLabels_text, "
                         "osgLabels_place, osgLabels_footprint);\n";
    snippet.statements += diverted
                              ? "    osgLabels_outIdentifier = osgLabels_identifier;\n"
                                "    osgLabels_outPlace = osgLabels_place;\n"
                                "    osgLabels_outFootprint = vec4(osgLabels_footprint[0], "
                                "osgLabels_footprint[1]);\n"
                              : "    if (osgLabels_place.x >= 0.0)\n"
                                "        osgmr_out0 = osgLabels_over(osgmr_out0, osgLabels_text, "
                                "osgLabels_place, osgLabels_footprint, "
                                "osgLabels_styleOf(osgLabels_identifier));\n";
    return snippet;
}

const osg::StateSet* LabelPass::startRun()
{
    _applied.clear();
    return _under.get();
}

LabelPass::Frame LabelPass::frameOf(const osgUtil::RenderLeaf& leaf) const
{
    const osg::Matrixd modelview =
        leaf._modelview ? osg::Matrixd(*leaf._modelview) : osg::Matrixd();
    const osg::Matrixd projection =
        leaf._projection ? osg::Matrixd(*leaf._projection) : osg::Matrixd();
    // Clip coordinates x, y and w, or z where rays are parallel, of eye coordinates.
    const bool parallel = isParallel(projection);
    const int columns[3] = {0, 1, parallel ? 2 : 3};
    osg::Matrixd clip;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 4; ++i)
            clip(i, j) = projection(i, columns[j]);
    const osg::Matrixd toLocal = osg::Matrixd::inverse(modelview);
    const osg::Matrixd toEye = osg::Matrixd::inverse(clip);
    osg::Vec3d rows[10];
    for (int i = 0; i < 3; ++i)
        rows[i] = rotated(osg::Vec3d(toEye(i, 0), toEye(i, 1), toEye(i, 2)), toLocal);
    rows[3] = rotated(toEye.getTrans(), toLocal);
    rows[4] = toLocal.getTrans();
    rows[5] = rotated({1.0, 0.0, 0.0}, toLocal);
    rows[6] = rotated({0.0, 1.0, 0.0}, toLocal);
    rows[7] = rotated({0.0, 0.0, 1.0}, toLocal);
    rows[8] = rotated(_up, toLocal);
    rows[9] = parallel ? osg::Vec3d(-1.0, 2.0, 0.0) : osg::Vec3d();
    Frame frame{};
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 3; ++j)
            frame[3 * i + j] = std::isfinite(rows[i][j]) ? float(rows[i][j]) : 0.0f;
    return frame;
}

void LabelPass::apply(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceVariant& variant,
                      const osgUtil::RenderLeaf& leaf, std::uint32_t number)
{
    const std::uint32_t bits = variant.getKey().output;
    if (!(bits & Labelled))
        return;
    // osg::Program trims "[0]" off the names of arrays.
    static const unsigned int frameName = osg::Uniform::getNameID("osgLabels_frame");
    static const unsigned int indexName = osg::Uniform::getNameID("osgLabels_index");
    static const unsigned int viewportName = osg::Uniform::getNameID("osgLabels_viewport");
    osg::State& state = *renderInfo.getState();
    const auto& program = *state.getLastAppliedProgramObject();
    const auto* gl = state.get<osg::GLExtensions>();
    if (bits & IndexUniform)
        gl->glUniform1i(program.getUniformLocation(indexName), GLint(number));
    else
        Extensions::instance().vertexAttribI1i(indexAttribute, GLint(number));
    Applied& applied = _applied[&variant];
    const osg::Viewport* viewport = state.getCurrentViewport();
    if (applied.isSet && applied.modelview == leaf._modelview.get() &&
        applied.projection == leaf._projection.get() && applied.viewport == viewport)
        return;
    if (!applied.isSet || applied.viewport != viewport)
    {
        GLint v[4] = {_viewport[0], _viewport[1], _viewport[2], _viewport[3]};
        if (viewport)
            glGetIntegerv(GL_VIEWPORT, v);
        gl->glUniform4f(program.getUniformLocation(viewportName), float(v[0]), float(v[1]),
                        2.0f / float(std::max(1, v[2])), 2.0f / float(std::max(1, v[3])));
    }
    applied = {leaf._modelview.get(), leaf._projection.get(), viewport, true};
    gl->glUniform3fv(program.getUniformLocation(frameName), 10, frameOf(leaf).data());
}

bool LabelPass::diverts(const SurfaceItem& item) const
{
    return item.variant->getKey().output & Diverted;
}

void LabelPass::divert(osg::RenderInfo& renderInfo, const std::function<void()>& draw)
{
    osg::State& state = *renderInfo.getState();
    {
        osgMultiRender::FramebufferVisit visit(state);
        osg::ref_ptr<osg::StateSet> base = new osg::StateSet;
        base->setAttribute(
            new osg::Viewport(_viewport[0], _viewport[1], _viewport[2], _viewport[3]), Over);
        base->setAttribute(new osg::ColorMask, Over);
        base->setMode(GL_BLEND, Never);
        state.pushStateSet(base);
        _targets->bind(state);
        clear(state);
        draw();
        state.popStateSet();
        readPicked(state);
    }
    composite(renderInfo);
    ++_passes;
}

void LabelPass::clear(osg::State& state) const
{
    osg::ref_ptr<osg::StateSet> writes = new osg::StateSet;
    writes->setAttributeAndModes(new osg::Depth, Over);
    state.pushStateSet(writes);
    state.apply();
    const auto& gl = Extensions::instance();
    const GLuint nothing[4] = {LabelTargets::Nothing, 0, 0, 0};
    gl.clearBufferuiv(GL_COLOR, 1, nothing);
    // Depths stay: what an earlier bin has drawn hides what comes later, but is in the view
    // already.
    const GLfloat far = 1.0f;
    if (_passes == 0)
        gl.clearBufferfv(GL_DEPTH, 0, &far);
    state.popStateSet();
}

void LabelPass::readPicked(osg::State& state)
{
    if (!_asked)
        return;
    const auto pixel = [](double at, int first, int size)
    { return first + std::clamp(int((0.5 + 0.5 * at) * size), 0, std::max(0, size - 1)); };
    const unsigned int identifier =
        _targets->readIdentifier(state, pixel(_asked->x, _viewport[0], _viewport[2]),
                                 pixel(_asked->y, _viewport[1], _viewport[3]));
    if (identifier != LabelTargets::Nothing)
        _picked = identifier;
}

void LabelPass::composite(osg::RenderInfo& renderInfo)
{
    osg::State& state = *renderInfo.getState();
    const int samples = _target.samples;
    osg::ref_ptr<osg::StateSet> pass =
        new osg::StateSet(*_resources->programs.getComposite(_languageVersion, samples, _isPaged));
    pass->merge(*_targets->getStateSet());
    pass->addUniform(new osg::Uniform("osgLabels_flippedHeight",
                                      _target.flipped ? _targets->getLayout().height : 0));
    pass->setAttribute(new osg::Viewport(_viewport[0], _viewport[1], _viewport[2], _viewport[3]),
                       Over);
    osg::ref_ptr<osg::Uniform> sample = new osg::Uniform("osgLabels_sample", 0);
    if (samples > 1)
        pass->addUniform(sample);
    state.pushStateSet(_under);
    state.pushStateSet(pass);
    const auto* gl = state.get<osg::GLExtensions>();
    constexpr GLenum sampleMask = 0x8E51;
    for (int i = 0; i < samples; ++i)
    {
        sample->set(i);
        state.apply();
        if (samples > 1)
        {
            glEnable(sampleMask);
            gl->glSampleMaski(0, 1u << i);
        }
        _resources->screen->draw(renderInfo);
    }
    if (samples > 1)
    {
        gl->glSampleMaski(0, ~0u);
        glDisable(sampleMask);
    }
    state.popStateSet();
    state.popStateSet();
}

void LabelPass::drawn(osg::RenderInfo&)
{
    // Where nothing labelled is in view nothing is under the point either.
    if (_resources && !_asked)
        _asked = _resources->pick.takeQuestion();
    if (_asked)
        _resources->pick.answer(_picked);
}

void LabelPass::fillPlan(osgMultiRender::Plan& plan) const
{
    using Decision = osgMultiRender::PlanEntry::Decision;
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
    plan.counts["labels.textBytes"] = double(sizes.textBytes);
    plan.counts["labels.rowBytes"] = double(sizes.rowBytes);
    plan.counts["labels.styleBytes"] = double(sizes.styleBytes);
    plan.counts["labels.recordBytes"] = double(_resources->objects.getBytes());
    plan.counts["labels.glyphBytes"] = double(_resources->getAtlasBytes());
    plan.counts["labels.targetBytes"] = double(_targets->getBytes());
}

} // namespace osgLabels
