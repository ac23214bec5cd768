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
    // Half of what is left, so that a piece that takes twice as long still fits.
    const double bytes =
        _rate == 0.0 ? 0.0 : std::min(0.5 * (_budget - _spent) * _rate, double(LargestPiece));
    if (bytes >= double(LeastPiece))
        return std::uint64_t(bytes);
    return _isFirst ? LeastPiece : 0;
}

void UploadPace::took(std::uint64_t bytes, double milliseconds)
{
    _isFirst = _isFirst && bytes == 0;
    if (!std::isfinite(milliseconds) || milliseconds <= 0.0)
        return;
    _spent += milliseconds;
    if (bytes == 0)
        return;
    // Slower counts at once, faster bit by bit.
    const double rate = std::clamp(double(bytes) / milliseconds, 1024.0, 1e9);
    const bool isSlower = rate < _rate || _rate == 0.0;
    _rate = isSlower ? rate : 0.875 * _rate + 0.125 * rate;
}

} // namespace osgPagedTexture
