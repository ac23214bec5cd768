// SPDX-License-Identifier: MIT
// The two passes of LabelPass over opaque leaves, and what is picked from the first.
#include <osgLabels/LabelPass.h>

#include <osgLabels/LabelExtensions.h>

#include <osgMultiRender/PassState.h>

#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/Notify>
#include <osg/Viewport>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

namespace osgLabels
{

using osgMultiRender::ForcedOff;
using osgMultiRender::ForcedOn;

namespace
{

/// Lets draws write one sample; leaves the mask as it was.
class OneSample
{
public:
    explicit OneSample(const osg::GLExtensions& gl) : _gl(gl), _wasOn(glIsEnabled(Mode))
    {
        LabelExtensions::instance().getIntegeri(Value, 0, &_mask);
        glEnable(Mode);
    }
    ~OneSample()
    {
        _gl.glSampleMaski(0, static_cast<GLbitfield>(_mask));
        if (!_wasOn)
            glDisable(Mode);
    }
    OneSample(const OneSample&) = delete;
    OneSample& operator=(const OneSample&) = delete;

    void set(int sample) const { _gl.glSampleMaski(0, 1u << sample); }

private:
    static constexpr GLenum Mode = 0x8E51, Value = 0x8E52; ///< GL_SAMPLE_MASK, its value
    const osg::GLExtensions& _gl;
    const bool _wasOn;
    GLint _mask = ~0;
};

} // namespace

void LabelPass::divert(osg::RenderInfo& renderInfo, const std::function<void()>& draw)
{
    osg::State& state = *renderInfo.getState();
    {
        osgMultiRender::FramebufferVisit visit(state);
        osg::ref_ptr<osg::StateSet> base = new osg::StateSet;
        base->setAttribute(
            new osg::Viewport(_viewport[0], _viewport[1], _viewport[2], _viewport[3]), ForcedOn);
        base->setAttribute(new osg::ColorMask, ForcedOn);
        base->setMode(GL_BLEND, ForcedOff);
        {
            const osgMultiRender::PassState pushed(state, *base);
            _targets->bind(state);
            clear(state);
            draw();
        }
        readPicked(state);
    }
    composite(renderInfo);
    ++_passes;
}

void LabelPass::clear(osg::State& state) const
{
    osg::ref_ptr<osg::StateSet> writes = new osg::StateSet;
    writes->setAttributeAndModes(new osg::Depth, ForcedOn);
    const osgMultiRender::PassState pushed(state, *writes);
    state.apply();
    const auto& gl = LabelExtensions::instance();
    const GLuint nothing[4] = {LabelTargets::Nothing, 0, 0, 0};
    gl.clearBufferuiv(GL_COLOR, 1, nothing);
    // Depths stay: what an earlier bin has drawn hides what comes later, but is in the view
    // already.
    const GLfloat farthest = 1.0f;
    if (_passes == 0)
        gl.clearBufferfv(GL_DEPTH, 0, &farthest);
}

std::string LabelPass::whyIncomplete(osg::State& state)
{
    const osgMultiRender::FramebufferVisit visit(state);
    _targets->bind(state);
    const std::string status = osgMultiRender::Framebuffer::whyIncomplete(state);
    if (status.empty())
        return {};
    const std::string reason = "OpenGL can't draw into buffers of " +
                               std::to_string(_targets->getLayout().width) + "x" +
                               std::to_string(_targets->getLayout().height) + " pixels with " +
                               std::to_string(_target.samples) + " samples (" + status + ")";
    static std::once_flag said;
    std::call_once(said,
                   [&]
                   {
                       OSG_WARN << "osgLabels::LabelScene: no labels, because " << reason
                                << "; fewer pixels or samples may help" << std::endl;
                   });
    return reason;
}

void LabelPass::readPicked(osg::State& state)
{
    const auto pixel = [](double at, int first, int size)
    { return first + std::clamp(int((0.5 + 0.5 * at) * size), 0, std::max(0, size - 1)); };
    for (Asked& asked : _asked)
    {
        // Nothing lies beside the view.
        if (!asked.question || !(std::abs(asked.question->x) <= 1.0) ||
            !(std::abs(asked.question->y) <= 1.0))
            continue;
        const unsigned int index =
            _targets->readIndex(state, pixel(asked.question->x, _viewport[0], _viewport[2]),
                                pixel(asked.question->y, _viewport[1], _viewport[3]));
        if (index != LabelTargets::Nothing)
            asked.identifier = _resources->objects.getIdentifier(index);
    }
}

void LabelPass::composite(osg::RenderInfo& renderInfo)
{
    osg::State& state = *renderInfo.getState();
    const int samples = _target.samples;
    osg::ref_ptr<osg::StateSet> pass = new osg::StateSet(*_resources->programs.getComposite(
        _languageVersion, samples,
        _resources->getDefines(_isPaged, _resources->objects.getShapes())));
    _targets->setFrames(state, _frames.data(), _frames.size() * sizeof(Frame));
    pass->addUniform(
        new osg::Uniform("osgLabels_viewport", osg::Vec4(float(_viewport[0]), float(_viewport[1]),
                                                         2.0f / float(std::max(1, _viewport[2])),
                                                         2.0f / float(std::max(1, _viewport[3])))));
    pass->merge(*_targets->getStateSet());
    pass->addUniform(new osg::Uniform("osgLabels_flippedHeight",
                                      _target.flipped ? _targets->getLayout().height : 0));
    pass->setAttribute(new osg::Viewport(_viewport[0], _viewport[1], _viewport[2], _viewport[3]),
                       ForcedOn);
    osg::ref_ptr<osg::Uniform> sample = new osg::Uniform("osgLabels_sample", 0);
    if (samples > 1)
        pass->addUniform(sample);
    const osgMultiRender::PassState below(state, *_under), above(state, *pass);
    std::optional<OneSample> one;
    for (int i = 0; i < samples; ++i)
    {
        sample->set(i);
        state.apply();
        if (samples > 1 && !one)
            one.emplace(*state.get<osg::GLExtensions>());
        if (one)
            one->set(i);
        _resources->screen->draw(renderInfo);
    }
}

} // namespace osgLabels
