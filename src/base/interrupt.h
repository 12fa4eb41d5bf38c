// Ctrl-C and other signals that end a process: stop in order, with what was done saved.
#pragma once

namespace sundog {

// SIGINT (Ctrl-C), SIGTERM, SIGHUP (the terminal is gone), SIGPIPE (nobody reads what is printed) and SIGXFSZ (a file
// reached the limit of its size). Until defer_interrupts(), each ends the process at once with status 130: nothing has been
// rendered that could be saved. SIGXFSZ alone does not: the write that caused it fails and says so.
void install_interrupt_handler();

// From here on a signal only sets the flag below, so that the iteration can finish and the image be written. A second
// Ctrl-C, a second or more after the first, ends the process at once. A program that ends others, as `timeout` does, may
// send its signal twice, and soon: that is one request.
void defer_interrupts();

bool interrupt_requested();

} // namespace sundog
