// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace osgrender
{

/// A render of a script that failed.
struct Failure
{
    std::string place; ///< "scenes.txt:12".
    std::string cause;
};

/// Shows how far a script is, on standard error: a bar on a terminal, else a line for each render.
class Progress
{
public:
    explicit Progress(std::size_t total);

    void begin(const std::string& what);
    void end(double seconds, bool failed);

private:
    void drawBar() const;

    std::size_t _total;
    std::size_t _done = 0;
    std::string _what;
    bool _terminal;
};

/// Prints place and cause in two columns on standard error.
void printFailures(const std::vector<Failure>& failures, std::size_t total);

} // namespace osgrender
