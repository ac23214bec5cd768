// SPDX-License-Identifier: MIT
#include <support/ChildProcess.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>

namespace support
{

namespace
{

using Clock = std::chrono::steady_clock;

[[noreturn]] void become(const ChildProcess& process, int output, int errors)
{
    setpgid(0, 0); // a group of its own, so that a time-out ends its children too
    dup2(output, STDOUT_FILENO);
    dup2(errors, STDERR_FILENO);
    for (const auto& [name, value] : process.environment)
        setenv(name.c_str(), value.c_str(), 1);
    for (const std::string& name : process.unset)
        unsetenv(name.c_str());
    if (!process.folder.empty() && chdir(process.folder.c_str()) != 0)
        _exit(127);
    std::vector<char*> arguments;
    for (const std::string& argument : process.arguments)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
}

/// Reads both pipes to their end; false when the time is up before that.
bool readAll(int output, int errors, ProcessResult& result, Clock::time_point end)
{
    std::array<pollfd, 2> pipes = {{{output, POLLIN, 0}, {errors, POLLIN, 0}}};
    while (pipes[0].fd >= 0 || pipes[1].fd >= 0)
    {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
        if (left.count() <= 0)
            return false;
        poll(pipes.data(), pipes.size(), int(left.count()));
        for (pollfd& pipe : pipes)
        {
            if (pipe.fd < 0 || !pipe.revents)
                continue;
            std::array<char, 4096> buffer;
            const ssize_t size = read(pipe.fd, buffer.data(), buffer.size());
            if (size > 0)
                (pipe.fd == output ? result.output : result.errors).append(buffer.data(), size);
            else
                pipe.fd = -1;
        }
    }
    return true;
}

} // namespace

ProcessResult ChildProcess::run() const
{
    ProcessResult result;
    int output[2], errors[2];
    if (arguments.empty() || pipe2(output, O_CLOEXEC) != 0 || pipe2(errors, O_CLOEXEC) != 0)
        return result;
    const pid_t child = fork();
    if (child == 0)
        become(*this, output[1], errors[1]);
    close(output[1]);
    close(errors[1]);
    const auto end = Clock::now() + std::chrono::milliseconds(long(timeoutSeconds * 1000.0));
    if (child > 0)
    {
        result.timedOut = !readAll(output[0], errors[0], result, end);
        if (result.timedOut)
            kill(-child, SIGKILL);
        int status = 0;
        rusage usage = {};
        wait4(child, &status, 0, &usage);
        result.peakMiB = double(usage.ru_maxrss) / 1024.0;
        result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    close(output[0]);
    close(errors[0]);
    return result;
}

} // namespace support
