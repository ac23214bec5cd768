// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

/// What a program did.
struct ChildResult
{
    int status = -1;    ///< Exit status; 128 + n for signal n, 124 when it ran too long.
    std::string output; ///< What it printed, both streams.
};

using Environment = std::map<std::string, std::string>;

/// Runs a program without DISPLAY and with `environment` over this process's own one; ends it after
/// 60 s. OSG_NOTIFY_LEVEL is NOTICE unless named.
ChildResult runChild(const std::vector<std::string>& arguments,
                     const Environment& environment = {});

/// A real X server of 1024x768 without a screen (Xvfb), ended with this object.
class XServer
{
public:
    XServer();
    XServer(const XServer&) = delete;
    XServer& operator=(const XServer&) = delete;
    ~XServer();

    /// The display's name, ":99"; empty when there is no Xvfb.
    const std::string& getDisplay() const { return _display; }

private:
    int _pid = -1;
    std::string _display;
};
