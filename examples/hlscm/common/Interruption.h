// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_INTERRUPTION_H
#define HLSCM_PROGRAM_INTERRUPTION_H

#include <functional>

namespace hlscm {

/// What ends the program before its time: Ctrl-C (SIGINT), SIGTERM, a closed terminal (SIGHUP),
/// SIGQUIT, a limit of processor time (SIGXCPU), and libraries that call exit() or terminate().
///
/// The handler of the signals raises a flag that all loops of the program and the progress callback
/// of the library poll. A stage that does not poll within half a second (a sparse factorization,
/// say) is abandoned: a thread of its own, which waits for the handler, runs the clean-up and ends
/// the process. Where no thread can be had, such a stage is waited for. SIGKILL cannot be noticed:
/// what it leaves are files named `.NAME.XXXXXX` beside the output NAME.
namespace Interruption {

/// Starts to listen; to be called once.
void install();

/// Whether the user asked to stop.
bool is_requested();

/// Whether the user asked, by the signal SIGUSR1, for the best that there is by now.
bool is_enough();

/// Throws `Cancelled` if the user asked to stop.
void check();

/// The same, and from now on nothing stops the program: it puts its results in place.
void finish();

/// The results are in place: what is left to be done may be stopped again.
void set_in_place();

/// Says that the program was cancelled, once.
void say_cancelled();

/// Sets what must happen before the process is ended from outside the main thread; empty for
/// nothing.
void set_clean_up(std::function<void()> clean_up);

/// Ends the process now that all is written: the end of a library (OpenBLAS) may hang.
[[noreturn]] void end_process(int exit_code);

} // namespace Interruption
} // namespace hlscm

#endif // HLSCM_PROGRAM_INTERRUPTION_H
