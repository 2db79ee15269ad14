// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/Interruption.h"

#include "common/Program_error.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <mutex>
#include <thread>

#include <semaphore.h>
#include <unistd.h>

namespace hlscm {
namespace Interruption {
namespace {

constexpr std::chrono::milliseconds time_to_stop_by_itself(500);

std::atomic<bool> requested(false), is_finished(false), is_said(false);
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

void stop_if_nobody_else_does()
{
  while(sem_wait(&arrival) != 0) { // a handler ran in this thread
  }
  std::this_thread::sleep_for(time_to_stop_by_itself);

  std::lock_guard<std::mutex> lock(clean_up().mutex);
  if(is_finished) {
    return;
  }
  if(clean_up().action) {
    clean_up().action();
  }
  say_cancelled();
  _exit(1);
}

} // namespace

void install()
{
  clean_up();
  sem_init(&arrival, 0, 0);
  std::thread(stop_if_nobody_else_does).detach();
  struct sigaction action = {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  for(int signal : {SIGINT, SIGTERM}) {
    if(!is_ignored(signal)) {
      sigaction(signal, &action, nullptr);
    }
  }
  std::signal(SIGXFSZ, SIG_IGN); // a limit on file sizes is an error of writing, not the end
}

bool is_requested() { return requested; }

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

void say_cancelled()
{
  if(is_said.exchange(true)) {
    return;
  }
  const char message[] = "\r\033[Khlscm: cancelled\n";
  const std::size_t skip = isatty(STDERR_FILENO) ? 0 : 4; // the code that erases a progress bar
  [[maybe_unused]] const auto written =
      write(STDERR_FILENO, message + skip, sizeof message - 1 - skip);
}

void set_clean_up(std::function<void()> action)
{
  std::lock_guard<std::mutex> lock(clean_up().mutex);
  clean_up().action = std::move(action);
}

} // namespace Interruption
} // namespace hlscm
