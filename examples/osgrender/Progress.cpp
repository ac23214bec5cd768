// SPDX-License-Identifier: MIT
#include "Progress.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace osgrender
{

Progress::Progress(std::size_t total) : _total(total), _terminal(isatty(STDERR_FILENO) != 0) {}

void Progress::begin(const std::string& what)
{
    _what = what;
    if (_terminal)
        drawBar();
}

void Progress::end(double seconds, bool failed)
{
    ++_done;
    if (_terminal)
    {
        drawBar();
        if (_done == _total)
            std::fprintf(stderr, "\r\033[K");
        return;
    }
    std::fprintf(stderr, "[%zu/%zu] %s %s%.1f s\n", _done, _total, _what.c_str(),
                 failed ? "FAILED " : "", seconds);
}

void Progress::drawBar() const
{
    constexpr std::size_t Width = 30;
    const std::size_t filled = _total ? Width * _done / _total : Width;
    std::fprintf(stderr, "\r\033[K[%s%s] %zu/%zu %s", std::string(filled, '#').c_str(),
                 std::string(Width - filled, '.').c_str(), _done, _total, _what.c_str());
    std::fflush(stderr);
}

void printFailures(const std::vector<Failure>& failures, std::size_t total)
{
    if (failures.empty())
        return;
    std::size_t width = 0;
    for (const Failure& failure : failures)
        width = std::max(width, failure.place.size());
    std::fprintf(stderr, "%zu of %zu renders failed:\n", failures.size(), total);
    for (const Failure& failure : failures)
        std::fprintf(stderr, "  %-*s  %s\n", int(width), failure.place.c_str(),
                     failure.cause.c_str());
}

} // namespace osgrender
