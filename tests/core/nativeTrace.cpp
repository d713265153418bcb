// SPDX-License-Identifier: GPL-2.0-or-later
//
// Loaded first into all that the tests run (tools/test.sh): a process that a fault ends writes the functions it was in. Python's faulthandler writes lines
// of Python alone, and nothing of threads that Python does not know, such as the one of O.run. Functions without an exported name are written as
// places in their library: addr2line -Cfe LIBRARY PLACE.
#include <csignal>
#include <cstddef>
#include <execinfo.h>
#include <fcntl.h>
#include <unistd.h>

namespace {

/// As this process began: pytest puts a file of its own in place of a test's, and keeps it where the process ends by a fault.
const int errors = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);

constexpr int faults[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT };

void writeStack(int fault)
{
	constexpr char title[] = "\nFunctions of the thread that met the fault, the last one first:\n";
	void*          frames[64];
	const int      depth = backtrace(frames, 64);
	const int      to    = errors < 0 ? STDERR_FILENO : errors;
	if (write(to, title, sizeof title - 1) > 0) backtrace_symbols_fd(frames, depth, to);
	std::signal(fault, SIG_DFL);
	std::raise(fault);
}

const bool isInstalled = [] {
	void* frame[1];
	backtrace(frame, 1); // the first call allocates, which a handler must not
	for (const int fault : faults)
		std::signal(fault, writeStack);
	return true;
}();

} // namespace
