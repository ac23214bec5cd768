// SPDX-License-Identifier: MIT
// The half of VirtualPass that finds out which pages are needed and gets them.
#include <osgPagedTexture/VirtualPass.h>

#include <osgMultiRender/PassState.h>

#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/Notify>
#include <osg/Viewport>

#include <chrono>
#include <cmath>

namespace osgPagedTexture
{

using osgMultiRender::ForcedOff;
using osgMultiRender::ForcedOn;
using osgMultiRender::SurfaceFrame;
using osgMultiRender::SurfaceItem;
using osgMultiRender::SurfaceKey;
using osgMultiRender::SurfaceState;

namespace
{

/// Of VirtualSettings::wait.
constexpr double longestWait = 120.0;

double halton(unsigned int index, unsigned int base)
{
    double result = 0.0, share = 1.0;
    for (; index > 0; index /= base)
    {
        share /= base;
        result += share * (index % base);
    }
    return result;
}

void mix(std::uint64_t& hash, const void* data, std::size_t bytes)
{
    const auto* from = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < bytes; ++i)
        hash = (hash ^ from[i]) * 1099511628211ull;
}

} // namespace

/// Of all that decides which pages are seen, as far as it can be told.
std::uint64_t VirtualPass::hashOf(SurfaceFrame& frame) const
{
    std::uint64_t hash = 1469598103934665603ull;
    const osg::RefMatrix *modelview = nullptr, *projection = nullptr;
    frame.forEachItem(
        [&](const SurfaceItem& item)
        {
            const auto& leaf = *item.leaf;
            const void* drawable = leaf._drawable;
            mix(hash, &drawable, sizeof drawable);
            if (leaf._modelview && leaf._modelview.get() != modelview)
                mix(hash, leaf._modelview->ptr(), 16 * sizeof(double));
            if (leaf._projection && leaf._projection.get() != projection)
                mix(hash, leaf._projection->ptr(), 16 * sizeof(double));
            modelview = leaf._modelview.get();
            projection = leaf._projection.get();
        });
    return hash;
}

bool VirtualPass::rekey(const SurfaceItem& item, SurfaceKey& key) const
{
    // A program of its own places its surfaces where only it knows.
    if (!item.variant || key.program || item.look || !_frame->isOf(*this, item))
        return false;
    const SurfaceState& state = *item.state;
    SurfaceKey plain;
    plain.clip = key.clip;
    plain.instance = key.instance;
    plain.texture = (key.texture & (Sampled | Taps | Wraps)) | Feedback;
    if (state.isOn(SurfaceState::AlphaTest))
        plain.texture |= Cutout;
    else if (state.isOn(SurfaceState::Blend))
        plain.texture |= Sheer;
    for (unsigned int unit = 0; unit < Units; ++unit)
        if (key.texture & (1u << unit) || (plain.texture & Cutout))
            plain.textures[unit] = key.textures[unit];
    key = plain;
    return true;
}

void VirtualPass::drawFeedback(osg::RenderInfo& renderInfo, SurfaceFrame& frame,
                               VirtualContext::View& view, unsigned int reduction,
                               unsigned int number)
{
    osg::State& state = *renderInfo.getState();
    GLint viewport[4];
    glGetIntegerv(GL_VIEWPORT, viewport);
    const int width = std::max(1, int(viewport[2] + GLint(reduction) - 1) / int(reduction));
    const int height = std::max(1, int(viewport[3] + GLint(reduction) - 1) / int(reduction));
    const osg::ref_ptr<osg::StateSet> over = new osg::StateSet;
    over->setAttribute(new osg::Viewport(0, 0, width, height), ForcedOn);
    over->setAttribute(new osg::ColorMask, ForcedOn);
    over->setAttributeAndModes(new osg::Depth, ForcedOn);
    for (const GLenum mode : {GL_BLEND, GL_STENCIL_TEST, GL_COLOR_LOGIC_OP,
                              GL_SAMPLE_ALPHA_TO_COVERAGE_ARB, GL_SCISSOR_TEST, GL_ALPHA_TEST})
        over->setMode(mode, ForcedOff);
    const bool jitters = reduction > 1;
    const auto offset = [&](unsigned int base, int side)
    { return jitters ? float((2.0 * halton(1 + number % 64, base) - 1.0) / side) : 0.0f; };
    over->addUniform(
        new osg::Uniform("osgPagedTexture_jitter", osg::Vec2(offset(2, width), offset(3, height))),
        ForcedOn);
    over->addUniform(new osg::Uniform("osgPagedTexture_sharper",
                                      osg::Vec2(float(width) / float(std::max(1, viewport[2])),
                                                float(number % 64))),
                     ForcedOn);
    {
        const osgMultiRender::PassState pushed(state, *over);
        state.apply();
        view.feedback->bind(state, width, height);
    }
    frame.drawAs(renderInfo, *over,
                 [this](const SurfaceItem& item, SurfaceKey& key) { return rekey(item, key); });
    _hasFeedback = true;
}

void VirtualPass::drawBefore(osg::RenderInfo& renderInfo, SurfaceFrame& frame)
{
    if (!_context)
        return;
    _resources->say(_seconds);
    VirtualContext::View& view = _context->viewOf(frame.getStage().getCamera());
    if (_settings.wait)
        waitForPages(renderInfo, frame, view);
    else
        goOn(renderInfo, frame, view);
    const bool isFading =
        !_settings.wait && _seconds < _context->getLastArrival() + _settings.fadeSeconds;
    _resources->setBusy(frame.getStage().getCamera(), _frameNumber,
                        _hasFeedback || view.feedback->isOnItsWay() || isFading);
}

/// Pictures of all pixels that it takes until each of a surface's textures has had its turn in
/// each, and some taps along footprints have.
unsigned int VirtualPass::wholePictures() const
{
    unsigned int most = 1;
    for (const Codes& codes : _codes)
    {
        unsigned int units = 0;
        bool hasTaps = false;
        for (const Code& code : codes)
        {
            units += code.number >= 0;
            hasTaps = hasTaps || (code.sampling & 255) > 1;
        }
        most = std::max(most, hasTaps ? std::max(2u, units) : units);
    }
    return most;
}

void VirtualPass::goOn(osg::RenderInfo& renderInfo, SurfaceFrame& frame, VirtualContext::View& view)
{
    osg::State& state = *renderInfo.getState();
    VirtualPager& pager = *_context->getPager();
    std::vector<PageNeed> needs;
    while (view.feedback->take(state, needs))
        pager.report(view.number, needs);
    pager.advance(_resources->step(_frameNumber));
    _context->upload(state, _settings.uploadMilliseconds, _seconds);

    const std::uint64_t seen = hashOf(frame);
    if (seen != view.seen)
        view.calmFrames = 0;
    view.seen = seen;
    if (_codes.empty())
        return;
    // The last ones look at each pixel, for each unit: slivers of pages fall between those of the
    // others.
    const unsigned int whole = wholePictures();
    if (view.calmFrames >= VirtualContext::View::CalmPictures + whole)
        return;
    const osgMultiRender::FramebufferVisit visit(state);
    const bool isWhole = view.calmFrames >= VirtualContext::View::CalmPictures;
    drawFeedback(renderInfo, frame, view, isWhole ? 1 : _settings.feedback,
                 isWhole ? view.calmFrames : _frameNumber);
    view.calmFrames += view.feedback->start(state);
}

void VirtualPass::waitForPages(osg::RenderInfo& renderInfo, SurfaceFrame& frame,
                               VirtualContext::View& view)
{
    osg::State& state = *renderInfo.getState();
    VirtualPager& pager = *_context->getPager();
    const std::uint64_t seen = hashOf(frame);
    if (seen == view.seen && view.isReported && pager.isAtRest())
        return;
    view.seen = seen;
    view.isReported = true;
    pager.advance(_resources->step(_frameNumber, true));
    _context->upload(state, 1e9, _seconds);
    if (!_codes.empty())
    {
        const osgMultiRender::FramebufferVisit visit(state);
        // Taps along footprints are chosen by chance; the pager remembers all of them.
        for (unsigned int picture = 0; picture < VirtualContext::View::WaitingPictures; ++picture)
        {
            drawFeedback(renderInfo, frame, view, 1, picture);
            pager.report(view.number, view.feedback->readNow());
        }
    }
    const auto start = std::chrono::steady_clock::now();
    // The pager is never at rest where another context waits for its next frame.
    constexpr unsigned int idleTurns = 20;
    for (unsigned int idle = 0; idle < idleTurns;)
    {
        pager.advance(_resources->step(_frameNumber, true));
        const bool isComplete = _context->upload(state, 1e9, _seconds);
        if (pager.isAtRest())
            break;
        idle = isComplete && pager.getStatistics().loadingPages == 0 ? idle + 1 : 0;
        const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
        if (waited.count() > longestWait)
        {
            OSG_WARN << "osgPagedTexture::VirtualScene: pages have not come for " << longestWait
                     << " s; the frame is drawn without them" << std::endl;
            break;
        }
        pager.waitForLoads(0.05);
    }
    _resources->say(_seconds);
}

} // namespace osgPagedTexture
