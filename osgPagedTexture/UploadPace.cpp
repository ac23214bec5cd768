// SPDX-License-Identifier: MIT
#include <osgPagedTexture/UploadPace.h>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

void UploadPace::begin(double milliseconds)
{
    _budget = std::isnan(milliseconds) ? 0.0 : milliseconds;
    _spent = 0.0;
    _isFirst = true;
}

void UploadPace::widen(double milliseconds)
{
    _budget = std::isnan(milliseconds) ? _budget : std::max(_budget, milliseconds);
    _isFirst = true;
}

std::uint64_t UploadPace::piece() const
{
    const double left = _budget - _spent - _call;
    // Half of what is left, so that a piece that takes twice as long still fits.
    const double bytes = _rate == 0.0 ? 0.0 : std::min(0.5 * left * _rate, double(LargestPiece));
    if (bytes >= double(LeastPiece))
        return std::uint64_t(bytes);
    const bool isUnknown = _rate == 0.0 && left > 0.5 * _budget;
    return _isFirst || isUnknown ? LeastPiece : 0;
}

void UploadPace::took(std::uint64_t bytes, double milliseconds)
{
    _isFirst = _isFirst && bytes == 0;
    if (!std::isfinite(milliseconds) || milliseconds <= 0.0)
        return;
    _spent += milliseconds;
    // Slower counts at once, faster bit by bit.
    if (bytes >= LeastPiece)
    {
        const double rate = std::clamp(double(bytes) / milliseconds, 1024.0, 1e9);
        const bool isSlower = rate < _rate || _rate == 0.0;
        _rate = isSlower ? rate : 0.875 * _rate + 0.125 * rate;
    }
    else if (bytes > 0)
        _call = std::max(milliseconds, 0.875 * _call + 0.125 * milliseconds);
}

} // namespace osgPagedTexture
