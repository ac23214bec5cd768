// SPDX-License-Identifier: MIT
#include "ChildProcess.h"

#include <support/ChildProcess.h>

#include <csignal>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

ChildResult runChild(const std::vector<std::string>& arguments, const Environment& environment)
{
    support::ChildProcess child;
    child.arguments = arguments;
    child.environment = environment;
    child.environment.emplace("OSG_NOTIFY_LEVEL", "NOTICE");
    if (!environment.count("DISPLAY"))
    {
        child.unset = {"DISPLAY"};
    }
    const support::ProcessResult process = child.run();
    return {process.timedOut ? 124 : process.exitCode, process.output + process.errors};
}

XServer::XServer()
{
    int ends[2];
    if (pipe(ends) != 0)
    {
        return;
    }
    _pid = fork();
    if (_pid == 0)
    {
        close(ends[0]);
        const std::string end = std::to_string(ends[1]);
        execlp("Xvfb", "Xvfb", "-displayfd", end.c_str(), "-screen", "0", "1024x768x24",
               "-nolisten", "tcp", static_cast<char*>(nullptr));
        _exit(127);
    }
    close(ends[1]);
    // The server writes its number and a line feed when it is ready, in one piece or more.
    std::string number;
    char buffer[16];
    pollfd ready = {ends[0], POLLIN, 0};
    while (number.find('\n') == std::string::npos && poll(&ready, 1, 20000) > 0)
    {
        const ssize_t size = read(ends[0], buffer, sizeof buffer);
        if (size <= 0)
        {
            break;
        }
        number.append(buffer, size);
    }
    close(ends[0]);
    const size_t end = number.find('\n');
    _display = end != std::string::npos ? ":" + number.substr(0, end) : "";
}

XServer::~XServer()
{
    if (_pid > 0)
    {
        kill(_pid, SIGTERM);
        waitpid(_pid, nullptr, 0);
    }
}
