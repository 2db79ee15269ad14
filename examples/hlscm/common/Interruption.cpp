// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/Interruption.h"

#include "common/Program_error.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <mutex>
#include <thread>

#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <unistd.h>

namespace hlscm {
namespace Interruption {
namespace {

constexpr std::chrono::milliseconds time_to_stop_by_itself(500);

std::atomic<bool> requested(false), enough(false);
std::atomic<bool> is_finished(false), is_in_place(false), is_said(false);
sem_t arrival;

// Never destroyed: the waiting thread may outlive main().
struct Clean_up
{
  std::mutex mutex;
  std::function<void()> action;
};

Clean_up& clean_up()
{
  static Clean_up* instance = new Clean_up;
  return *instance;
}

// nohup and non-interactive shells start background jobs with SIGINT ignored; that wish is kept.
bool is_ignored(int signal)
{
  struct sigaction action;
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void handle(int)
{
  requested = true;
  sem_post(&arrival); // one of the few functions that a handler may call
}

void handle_enough(int) { enough = true; }

void listen(int signal, void (*handler)(int))
{
  if(is_ignored(signal)) {
    return;
  }
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

void say(const char* text)
{
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
}

// With the mutex of the clean-up.
void clean_up_now()
{
  if(clean_up().action) {
    clean_up().action();
  }
}

void* stop_if_nobody_else_does(void*)
{
  while(sem_wait(&arrival) != 0) { // a handler ran in this thread
  }
  std::this_thread::sleep_for(time_to_stop_by_itself);
  {
    std::lock_guard<std::mutex> lock(clean_up().mutex);
    if(!is_finished) {
      clean_up_now();
      say_cancelled();
      _exit(1);
    }
  }
  while(!is_in_place) {
    std::this_thread::sleep_for(time_to_stop_by_itself);
  }
  std::this_thread::sleep_for(time_to_stop_by_itself); // to print what was done
  say("hlscm: cancelled, but the results are in place\n");
  _exit(1);
}

// Whatever ends the process from within a library: exit() of the runtime of OpenMP, which cannot
// have a thread, or an exception that nobody caught.
[[noreturn]] void give_up()
{
  if(!is_finished && clean_up().mutex.try_lock()) {
    clean_up_now();
  }
  if(requested) {
    say_cancelled();
  } else {
    say("hlscm: error: a library gave up, most likely there is not enough memory or no thread left, "
        "close other programs or use --threads 1\n");
  }
  _exit(1);
}

// The thread needs hardly any memory. Without it the program waits for what does not poll.
void start_thread()
{
  constexpr std::size_t stack = 1 << 18;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, stack);
  pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
  pthread_t thread;
  [[maybe_unused]] const int failed =
      pthread_create(&thread, &attributes, stop_if_nobody_else_does, nullptr);
  pthread_attr_destroy(&attributes);
}

// A file of the program must not become one of the standard streams where those are closed; what is
// printed to them fails as before.
void fill_closed_streams()
{
  for(const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if(fcntl(stream, F_GETFD) < 0) {
      open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY); // gets the least number
    }
  }
}

} // namespace

void install()
{
  fill_closed_streams();
  clean_up();
  sem_init(&arrival, 0, 0);
  start_thread();
  std::atexit(give_up);
  std::set_terminate(give_up);
  for(const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
    listen(signal, handle);
  }
  listen(SIGUSR1, handle_enough);
  std::signal(SIGXFSZ, SIG_IGN); // a limit on file sizes is an error of writing, not the end
  std::signal(SIGPIPE, SIG_IGN); // nor is a reader that has gone
}

bool is_requested() { return requested; }

bool is_enough() { return enough; }

void check()
{
  if(requested) {
    throw Cancelled();
  }
}

void finish()
{
  std::lock_guard<std::mutex> lock(clean_up().mutex);
  check();
  is_finished = true;
}

void set_in_place() { is_in_place = true; }

void say_cancelled()
{
  if(is_said.exchange(true)) {
    return;
  }
  if(isatty(STDERR_FILENO)) {
    say("\r\033[K"); // erases a progress bar
  }
  say("hlscm: cancelled\n");
}

void set_clean_up(std::function<void()> action)
{
  std::lock_guard<std::mutex> lock(clean_up().mutex);
  clean_up().action = std::move(action);
}

void end_process(int exit_code)
{
  std::cout.flush();
  std::fflush(nullptr);
  _exit(exit_code);
}

} // namespace Interruption
} // namespace hlscm
