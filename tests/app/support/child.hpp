// Runs work in a child process, which can be killed, limited or measured without affecting the tests.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <exception>

namespace tendril::test {

/// Runs `work` in a child. Returns its result (0 to 100), 101 if it threw, or -1 if it died otherwise.
template <class Work>
int in_child(const Work& work) {
    const pid_t pid = ::fork();
    if (pid == 0) {
        int result = 101;
        try {
            result = work();
        } catch (const std::exception&) {
        }
        ::_exit(result);
    }
    int status = 0;
    ::waitpid(pid, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The peak memory of this process so far, in megabytes.
inline long peak_megabytes() {
    struct rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

}  // namespace tendril::test
