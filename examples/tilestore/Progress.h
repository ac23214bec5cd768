// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace tilestore
{

/// How far a long piece of work is: a bar on standard error, where that is a terminal.
class Progress
{
public:
    /// `unit`: what is counted, "tiles".
    Progress(const std::string& what, const std::string& unit);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::uint64_t done, std::uint64_t total);

private:
    using Clock = std::chrono::steady_clock;
    const std::string _what, _unit;
    const bool _terminal;
    const Clock::time_point _start = Clock::now();
    Clock::time_point _last;
    bool _shown = false;
};

} // namespace tilestore
