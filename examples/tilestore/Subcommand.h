// SPDX-License-Identifier: MIT
#pragma once

#include "Arguments.h"

#include <nlohmann/json.hpp>

#include <string>

namespace tilestore
{

using Json = nlohmann::ordered_json;

/// One of the things that the program does, in a file of its own.
struct Subcommand
{
    const char* name;
    const char* summary; ///< One line for the list of them.
    const char* help;    ///< The whole page of `osgtilestore <name> --help`.
    OptionList options;  ///< Besides --help and --json.
    /// Returns the exit status. Throws UsageError, or any other std::exception with one line that
    /// says what failed.
    int (*run)(const Arguments& arguments);
};

extern const Subcommand MaskCommand, LayoutCommand, BuildCommand, MergeCommand, AtlasCommand,
    UpdateCommand, InfoCommand, VerifyCommand, ExtractCommand, CompactCommand, NeighboursCommand,
    ReferenceCommand, BlendCommand;

/// "1,234,567".
std::string grouped(std::uint64_t number);
/// "3.4 MiB".
std::string byteText(std::uint64_t bytes);
/// Prints it on standard output.
void print(const Json& json);

} // namespace tilestore
