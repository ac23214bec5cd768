// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tilestore
{

/// What a user typed makes no sense; one line.
class UsageError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

struct Option
{
    const char* name; ///< "--level".
    bool hasValue = true;
};
using OptionList = std::vector<Option>;

/// The words behind a subcommand's name, as `--name value`, `--name=value` and names of files.
class Arguments
{
public:
    /// Throws UsageError for an unknown option or one without its value.
    Arguments(std::vector<std::string> words, const OptionList& options);

    bool has(const std::string& option) const { return _values.count(option) > 0; }
    bool isJson() const { return has("--json"); }
    /// The last value that was given.
    std::optional<std::string> find(const std::string& option) const;
    std::string get(const std::string& option, const std::string& standard) const;
    std::vector<std::string> all(const std::string& option) const;
    /// Throws UsageError for what is no whole number or not in the range.
    std::int64_t number(const std::string& option, std::int64_t standard, std::int64_t least,
                        std::int64_t most) const;
    /// "512", "64KiB", "1.5GiB".
    std::uint64_t bytes(const std::string& option, std::uint64_t standard) const;
    /// Whole numbers with commas between, `least` or `most` of them; none where it is not given.
    std::vector<std::int64_t> numbers(const std::string& option, std::size_t least,
                                      std::size_t most) const;

    /// The files that were named. Throws UsageError where there are fewer than `least`, or more
    /// than `most`; `what` says which are wanted, "STORE FILE".
    const std::vector<std::string>& files(std::size_t least, std::size_t most,
                                          const std::string& what) const;

private:
    std::map<std::string, std::vector<std::string>> _values; ///< In the order they were given.
    std::vector<std::string> _files;
};

/// Throws UsageError, naming `what`.
std::int64_t parseNumber(const std::string& text, const std::string& what, std::int64_t least,
                         std::int64_t most);
std::uint64_t parseBytes(const std::string& text, const std::string& what);

} // namespace tilestore
