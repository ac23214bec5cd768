// SPDX-License-Identifier: MIT
#include <osgPagedTexture/FrameTimes.h>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

void FrameTimes::add(double value)
{
    if (std::isnan(value) || _capacity == 0)
        return;
    if (_values.size() < _capacity)
        _values.push_back(value);
    else
        _values[_next] = value;
    _next = (_next + 1) % _capacity;
}

double FrameTimes::getPercentile(double percent) const
{
    if (_values.empty())
        return 0.0;
    std::vector<double> sorted = _values;
    const double rank = std::ceil(std::clamp(percent, 0.0, 100.0) / 100.0 * double(sorted.size()));
    const std::size_t index = std::size_t(std::max(1.0, rank)) - 1;
    std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(index), sorted.end());
    return sorted[index];
}

std::vector<double> FrameTimes::getValues() const
{
    std::vector<double> ordered;
    const std::size_t first = _values.size() < _capacity ? 0 : _next;
    for (std::size_t i = 0; i < _values.size(); ++i)
        ordered.push_back(_values[(first + i) % _values.size()]);
    return ordered;
}

} // namespace osgPagedTexture
