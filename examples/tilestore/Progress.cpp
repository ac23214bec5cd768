// SPDX-License-Identifier: MIT
#include "Progress.h"

#include <algorithm>
#include <cstdio>

#ifdef _WIN32
#include <io.h>
#define isatty _isatty
#define fileno _fileno
#else
#include <unistd.h>
#endif

namespace tilestore
{

Progress::Progress(const std::string& what, const std::string& unit)
    : _what(what), _unit(unit), _terminal(isatty(fileno(stderr)) != 0)
{
}

Progress::~Progress()
{
    if (_shown)
        std::fputs("\r\033[K", stderr);
}

void Progress::show(std::uint64_t done, std::uint64_t total)
{
    constexpr std::uint64_t Width = 30;
    const auto now = Clock::now();
    if (!_terminal || total == 0 || now - _last < std::chrono::milliseconds(200))
        return;
    _last = now;
    _shown = true;
    done = std::min(done, total);
    const auto filled = static_cast<std::size_t>(double(done) / double(total) * Width);
    const double seconds = std::chrono::duration<double>(now - _start).count();
    const double left = done > 0 ? seconds / double(done) * double(total - done) : 0.0;
    std::fprintf(stderr, "\r\033[K%s [%s%s] %llu/%llu %s, %.0f s, %.0f s to go ", _what.c_str(),
                 std::string(filled, '#').c_str(), std::string(Width - filled, '.').c_str(),
                 static_cast<unsigned long long>(done), static_cast<unsigned long long>(total),
                 _unit.c_str(), seconds, left);
    std::fflush(stderr);
}

} // namespace tilestore
