// SPDX-License-Identifier: MIT
#pragma once

#include <support/ChildProcess.h>

#include <map>
#include <string>
#include <vector>

/// Runs osgtilestore with these words.
inline support::ProcessResult run(const std::vector<std::string>& words,
                                  const std::map<std::string, std::string>& environment = {})
{
    support::ChildProcess process;
    process.arguments = {OSGKITS_OSGTILESTORE};
    process.arguments.insert(process.arguments.end(), words.begin(), words.end());
    process.environment = environment;
    return process.run();
}
