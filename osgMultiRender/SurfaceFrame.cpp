// SPDX-License-Identifier: MIT
// What SurfaceFrame does before it draws; SurfaceCollect.cpp culls, SurfaceResolve.cpp resolves
// leaves, SurfaceDraw.cpp draws.
#include <osgMultiRender/SurfaceFrame.h>

#include <osgMultiRender/WithheldLights.h>

#include <osg/GLExtensions>
#include <osg/Notify>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

namespace osgMultiRender
{

namespace
{

bool byOrder(const SurfaceItem& a, const SurfaceItem& b)
{
    if (a.diverted != b.diverted)
        return a.diverted;
    // Those of an output pass follow each other.
    if (a.passes != b.passes)
        return std::tie(a.passes[1], a.passes[0], a.passes[2], a.passes[3]) <
               std::tie(b.passes[1], b.passes[0], b.passes[2], b.passes[3]);
    return a.order < b.order;
}

} // namespace

bool SurfaceFrame::isOf(const SurfacePass& pass, const SurfaceItem& item) const
{
    const std::uint16_t place = item.passes[static_cast<std::size_t>(pass.getRole())];
    return place != NoPass && _passes[place].pass.get() == &pass;
}

void SurfaceFrame::prepare(osg::RenderInfo& renderInfo)
{
    if (_prepared)
        return;
    _prepared = true;
    osg::State& state = *renderInfo.getState();
    SurfaceVariantCache::instance().attach(state.getContextID());
    // After the stage of a camera drawn before, osg::State may have gone back to its default.
    if (const osg::Viewport* viewport = _stage->getViewport())
    {
        viewport->apply(state);
        state.haveAppliedAttribute(viewport);
    }
    const auto* gl = state.get<osg::GLExtensions>();
    _languageVersion = gl->glslLanguageVersion;
    _items.resize(_bins.size());
    for (std::size_t bin = 0; bin < _bins.size(); ++bin)
        _items[bin].resize(_bins[bin].size());
    _diverted.assign(_bins.size(), 0);
    // Some drivers tell of a newer language than their version of GL goes with.
    const bool isSupported = std::min(gl->glVersion, _languageVersion) >= 3.295f;
    if (isSupported)
        classifyAll(renderInfo);
    else
        sayTooOld(gl->glVersion);
    withholdLights();
    sortItems();
    if (isSupported)
        for (const Pass& pass : _passes)
            pass.pass->drawBefore(renderInfo, *this);
    writePlan(renderInfo);
}

void SurfaceFrame::sayTooOld(float glVersion)
{
    static std::once_flag said;
    std::call_once(said,
                   [&]
                   {
                       OSG_WARN << _group->getCompoundClassName() << ": OpenGL " << glVersion
                                << " with GLSL " << _languageVersion
                                << " is older than 3.3, so models keep their fixed-function look; "
                                   "a driver with the OpenGL 3.3 compatibility profile is needed"
                                << std::endl;
                   });
    for (std::size_t bin = 0; bin < _bins.size(); ++bin)
        for (std::size_t i = 0; i < _bins[bin].size(); ++i)
        {
            _items[bin][i].leaf = _bins[bin][i];
            ++_beyond["OpenGL older than 3.3"];
        }
}

void SurfaceFrame::classifyAll(osg::RenderInfo& renderInfo)
{
    forEachLight(
        [this](const osg::Light& light, const osg::Matrix*, bool)
        {
            if (light.getLightNum() >= 0 && light.getLightNum() < int(_lights.size()))
                _lights[light.getLightNum()] = &light;
        });
    for (const Pass& pass : _passes)
        pass.pass->begin(renderInfo, *this);
    for (std::size_t bin = 0; bin < _bins.size(); ++bin)
    {
        Surface* surface = nullptr;
        const osgUtil::StateGraph* graph = nullptr;
        SurfacePasses passes = NoPasses;
        SurfaceLook* look = nullptr;
        for (std::size_t i = 0; i < _bins[bin].size(); ++i)
        {
            osgUtil::RenderLeaf& leaf = *_bins[bin][i];
            const bool isNew = leaf._parent != graph; // leaves of one StateGraph follow each other
            if (isNew)
                passes = passesOf(graph = leaf._parent);
            SurfaceLook* const itsLook = lookOf(leaf, passes);
            if (isNew || itsLook != look)
                surface = &surfaceOf(renderInfo, graph, look = itsLook);
            resolve(*renderInfo.getState(), *surface, leaf, _isOrdered[bin], _items[bin][i]);
        }
    }
    for (const Pass& pass : _passes)
        pass.pass->end(renderInfo);
}

void SurfaceFrame::withholdLights()
{
    std::set<unsigned int> mentioned;
    const void* last = nullptr;
    for (const auto& [graph, surfaceState] : _states)
        if (surfaceState.getExtraLightsIdentity() && surfaceState.getExtraLightsIdentity() != last)
        {
            last = surfaceState.getExtraLightsIdentity();
            for (unsigned int number : surfaceState.getExtraLights(false))
                mentioned.insert(number);
        }
    if (mentioned.empty())
        return;
    osg::ref_ptr<osg::StateSet> withheld = new osg::StateSet;
    for (unsigned int number : mentioned)
    {
        withheld->setMode(GL_LIGHT0 + number,
                          osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
        withheld->setAttribute(new WithheldLights(number), osg::StateAttribute::OVERRIDE);
    }
    _withheld = withheld;
}

void SurfaceFrame::sortItems()
{
    std::unordered_map<const SurfaceVariant*, std::uint32_t> orderOf;
    for (std::size_t bin = 0; bin < _bins.size(); ++bin)
    {
        if (_isOrdered[bin])
            continue;
        for (SurfaceItem& item : _items[bin])
        {
            item.order = orderOf.emplace(item.variant, std::uint32_t(orderOf.size())).first->second;
            const std::uint16_t output = item.passes[OutputRole];
            item.diverted = output != NoPass && item.variant && !item.variant->failed &&
                            _passes[output].pass->diverts(item);
            _diverted[bin] += item.diverted;
        }
        if (!std::is_sorted(_items[bin].begin(), _items[bin].end(), byOrder))
            std::stable_sort(_items[bin].begin(), _items[bin].end(), byOrder);
    }
}

void SurfaceFrame::proxyDrawn(osg::RenderInfo& renderInfo)
{
    if (--_proxies == 0)
        for (const Pass& pass : _passes)
            pass.pass->drawn(renderInfo);
}

void SurfaceFrame::drawNothing(osg::RenderInfo& renderInfo)
{
    writePlan(renderInfo);
    for (const Pass& pass : _passes)
        pass.pass->drawn(renderInfo);
}

void SurfaceFrame::forEachLeaf(
    const SurfacePass& pass,
    const std::function<void(const osgUtil::RenderLeaf&, bool ordered)>& f) const
{
    const auto role = static_cast<std::size_t>(pass.getRole());
    const auto isIn = [&](const osgUtil::RenderLeaf& leaf)
    {
        const std::uint16_t place = passesOf(leaf._parent)[role];
        return place != NoPass && _passes[place].pass.get() == &pass;
    };
    for (std::size_t bin = 0; bin < _bins.size(); ++bin)
        for (const osgUtil::RenderLeaf* leaf : _bins[bin])
            if (isIn(*leaf))
                f(*leaf, _isOrdered[bin]);
}

void SurfaceFrame::forEachItem(const std::function<void(const SurfaceItem&)>& f) const
{
    for (const auto& items : _items)
        for (const SurfaceItem& item : items)
            f(item);
}

void SurfaceFrame::drawBin(osg::RenderInfo& renderInfo, std::size_t bin)
{
    prepare(renderInfo);
    const SurfaceItem* items = _items[bin].data();
    const std::size_t diverted = _diverted[bin];
    for (std::size_t i = 0, end = 0; i < diverted; i = end)
    {
        const std::uint16_t output = items[i].passes[OutputRole];
        for (end = i + 1; end < diverted && items[end].passes[OutputRole] == output;)
            ++end;
        _passes[output].pass->divert(renderInfo, [&] { draw(renderInfo, items + i, end - i); });
    }
    draw(renderInfo, items + diverted, _items[bin].size() - diverted);
}

void SurfaceFrame::drawLeaf(osg::RenderInfo& renderInfo, std::size_t bin, std::size_t leaf)
{
    prepare(renderInfo);
    draw(renderInfo, &_items[bin][leaf], 1);
}

} // namespace osgMultiRender
