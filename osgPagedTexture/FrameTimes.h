// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <cstddef>
#include <vector>

namespace osgPagedTexture
{

/// The last measurements of something that is measured once a frame.
class OSGPAGEDTEXTURE_EXPORT FrameTimes
{
public:
    explicit FrameTimes(std::size_t capacity = 4096) : _capacity(capacity) {}

    /// NaN is left out.
    void add(double value);

    std::size_t getCount() const { return _values.size(); }
    double getLargest() const { return getPercentile(100.0); }

    /// The smallest value that `percent` of them do not exceed, nearest rank; 0 where there are
    /// none.
    double getPercentile(double percent) const;

    /// In the order in which they were measured.
    std::vector<double> getValues() const;

private:
    std::size_t _capacity;
    std::size_t _next = 0;
    std::vector<double> _values;
};

} // namespace osgPagedTexture
