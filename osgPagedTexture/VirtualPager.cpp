// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualPagerState.h>

namespace osgPagedTexture
{

VirtualPager::VirtualPager(const VirtualPagerSettings& settings)
    : _state(std::make_unique<State>(settings))
{
}

VirtualPager::~VirtualPager() = default;

const VirtualPagerSettings& VirtualPager::getSettings() const
{
    return _state->settings;
}

std::uint32_t VirtualPager::addTexture(const std::string& storePath)
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    return _state->addTexture(storePath);
}

void VirtualPager::removeTexture(std::uint32_t texture)
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    _state->removeTexture(texture);
}

TileGrid VirtualPager::getGrid(std::uint32_t texture) const
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    const auto found = _state->textures.find(texture);
    return found == _state->textures.end() ? TileGrid() : found->second.grid;
}

int VirtualPager::getPageSide() const
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    return _state->format.side;
}

std::uint64_t VirtualPager::getPageBytes() const
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    return _state->format.side == 0 ? 0 : _state->format.bytes();
}

void VirtualPager::removeContext(unsigned int context)
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    _state->contexts.erase(context);
}

void VirtualPager::report(unsigned int view, const std::vector<PageNeed>& needs)
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    _state->report(view, needs);
}

void VirtualPager::removeView(unsigned int view)
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    _state->removeView(view);
}

void VirtualPager::advance(unsigned int frame)
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    _state->advance(frame);
}

PageUploads VirtualPager::takeUploads(unsigned int context, std::uint64_t maxBytes)
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    return _state->takeUploads(context, maxBytes);
}

bool VirtualPager::isAtRest() const
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    return _state->isAtRest();
}

void VirtualPager::setFrozen(bool frozen)
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    _state->isFrozen = frozen;
}

void VirtualPager::invalidate(std::uint32_t texture)
{
    _state->invalidate(texture, nullptr);
}

void VirtualPager::invalidate(std::uint32_t texture, const PixelRect& pixels)
{
    _state->invalidate(texture, &pixels);
}

void VirtualPager::waitForLoads(double seconds) const
{
    _state->waitForLoads(seconds);
}

VirtualPagerStatistics VirtualPager::getStatistics() const
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    return _state->getStatistics();
}

std::vector<std::string> VirtualPager::takeMessages()
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    return _state->takeMessages();
}

} // namespace osgPagedTexture
