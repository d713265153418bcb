// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/ExtensionTrial.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <exception>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace yade {

namespace {

	/// Where the process that loads a library on trial tells of its end.
	int trialPipe = -1;

	/// What it tells where all constructors have ended, and the status with which it ends where one has thrown.
	constexpr char constructed[] = "constructed";
	constexpr int  thrown        = 113;

	/// Time that the trial may take; then it says nothing of the library [s].
	constexpr unsigned trialSeconds = 20;

	[[noreturn]] void tellException()
	{
		std::string what = "an object that is no std::exception";
		try {
			std::rethrow_exception(std::current_exception());
		} catch (const std::exception& error) {
			what = error.what();
		} catch (...) {
		}
		const auto written = write(trialPipe, what.data(), what.size());
		_exit(written < 0 ? 2 : thrown);
	}

	/// An exception of a constructor ends here, by std::terminate: this process must not go on as a second one of the script. Through a
	/// pointer, since dlopen is declared as a function that throws nothing, to which compilers add no such end.
	void loadOnTrial(const char* path) noexcept
	{
		void* (*const volatile load)(const char*, int) = dlopen;
		load(path, RTLD_NOW | RTLD_GLOBAL);
	}

} // namespace

std::string faultOfConstructors(const std::string& path)
{
	int ends[2];
	if (pipe(ends) != 0) return "";
	const pid_t child = fork();
	if (child == 0) {
		trialPipe = ends[1];
		if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) { // what they print comes when the library is loaded
			dup2(nowhere, STDOUT_FILENO);
			dup2(nowhere, STDERR_FILENO);
		}
		std::signal(SIGALRM, SIG_DFL);
		alarm(trialSeconds); // a lock that another thread has holds this process for ever
		std::set_terminate(tellException);
		std::atexit([] { _exit(2); }); // before all else that std::exit would do, which may wait for threads that are not here
		loadOnTrial(path.c_str());
		const auto written
		        = write(trialPipe, constructed, sizeof(constructed) - 1); // not reached where a constructor ends the process
		_exit(written < 0 ? 2 : 0);
	}
	close(ends[1]);
	std::string told;
	char        part[256];
	for (ssize_t count; child > 0 && (count = read(ends[0], part, sizeof(part))) != 0;) {
		if (count > 0) told.append(part, std::size_t(count));
		else if (errno != EINTR) break;
	}
	close(ends[0]);
	int state = 0;
	if (child < 0) return "";
	while (waitpid(child, &state, 0) < 0 && errno == EINTR) { }
	if (WIFSIGNALED(state) && WTERMSIG(state) == SIGALRM) return "";
	if (WIFSIGNALED(state)) return std::string("a constructor of its static objects ends the process: ") + strsignal(WTERMSIG(state));
	if (WEXITSTATUS(state) == 0 && told == constructed) return "";
	return "a constructor of its static objects "
	        + (told.empty() || WEXITSTATUS(state) != thrown ? std::string("ends the process") : "throws: " + told);
}

} // namespace yade
