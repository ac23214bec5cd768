// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

namespace support
{

/// What a finished program left.
struct ProcessResult
{
    int exitCode = -1; ///< 128 + n for one that died by signal n, as in a shell.
    bool timedOut = false;
    std::string output; ///< Its standard output.
    std::string errors; ///< Its standard error.
    double peakMiB = 0; ///< Of memory that was not swapped out.
};

/// A program to run, found on PATH, with this process's environment changed by `environment`.
struct ChildProcess
{
    std::vector<std::string> arguments; ///< The program's name first.
    std::map<std::string, std::string> environment;
    std::vector<std::string> unset; ///< Variables that it must not see, for instance DISPLAY.
    std::string folder;             ///< To run in; this process's own where empty.
    double timeoutSeconds = 60.0;   ///< Then it is killed, with all that it started.

    /// Runs it to its end. A program that cannot be started has exit code 127.
    ProcessResult run() const;
};

} // namespace support
