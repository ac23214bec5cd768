// SPDX-License-Identifier: MIT
#include "ChildProcess.h"

#include <csignal>
#include <cstdlib>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{

std::vector<char*> toPointers(std::vector<std::string>& words)
{
    std::vector<char*> pointers;
    for (std::string& word : words)
    {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    return pointers;
}

} // namespace

ChildResult runChild(const std::vector<std::string>& arguments, const Environment& environment)
{
    std::vector<std::string> words = {"timeout", "-k", "5", "60"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const auto pointers = toPointers(words);
    int ends[2];
    if (pipe(ends) != 0)
    {
        return {};
    }
    const pid_t pid = fork();
    if (pid == 0)
    {
        dup2(ends[1], STDOUT_FILENO);
        dup2(ends[1], STDERR_FILENO);
        close(ends[0]);
        unsetenv("DISPLAY");
        setenv("OSG_NOTIFY_LEVEL", "NOTICE", 1);
        for (const auto& [name, value] : environment)
        {
            setenv(name.c_str(), value.c_str(), 1);
        }
        execvp(pointers[0], pointers.data());
        _exit(127);
    }
    close(ends[1]);
    ChildResult result;
    char buffer[4096];
    for (ssize_t size; (size = read(ends[0], buffer, sizeof buffer)) > 0;)
    {
        result.output.append(buffer, size);
    }
    close(ends[0]);
    int status = 0;
    waitpid(pid, &status, 0);
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
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
