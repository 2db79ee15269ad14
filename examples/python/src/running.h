// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PYTHON_RUNNING_H
#define HLSCM_PYTHON_RUNNING_H

#include "outcomes.h"

#include <CGAL/Blocked_execution/blocked_for.h>

#include <pybind11/pybind11.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include <dlfcn.h>

namespace hlscm_python {

/// Lets OpenBLAS, if that is CHOLMOD's BLAS, use one thread as long as there is such an object: how it
/// adds up depends on the number of its threads, and the threads are the library's own. numpy may use
/// the same OpenBLAS, so its number of threads is what it was afterwards.
class Blas_scope
{
public:
  Blas_scope()
  {
    const std::lock_guard<std::mutex> lock(s_mutex);
    if(s_users++ > 0)
      return;
    const auto threads = find_function<int()>("openblas_get_num_threads");
    const auto set_threads = find_function<void(int)>("openblas_set_num_threads");
    if(threads == nullptr || set_threads == nullptr)
      return;
    s_threads = threads();
    set_threads(1);
  }
  ~Blas_scope()
  {
    const std::lock_guard<std::mutex> lock(s_mutex);
    if(--s_users > 0 || s_threads == 0)
      return;
    find_function<void(int)>("openblas_set_num_threads")(s_threads);
    s_threads = 0;
  }
  Blas_scope(const Blas_scope&) = delete;
  Blas_scope& operator=(const Blas_scope&) = delete;

private:
  // A function of what is loaded, or null
  template <class Function>
  static Function* find_function(const char* name)
  {
    return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
  }

  static inline std::mutex s_mutex;
  static inline int s_users = 0;
  static inline int s_threads = 0; // before, 0 if they were not changed
};

/// What is told the progress of a computation: the user's callable, if there is one, and the
/// interpreter, which may have been interrupted by Ctrl-C. What they raise ends the computation.
class Progress
{
public:
  /// `callable` takes a number in [0, 1] and returns whether to go on (None: yes), or is None.
  explicit Progress(py::object callable) : m_callable(std::move(callable))
  {
    if(!m_callable.is_none() && !PyCallable_Check(m_callable.ptr()))
      throw py::type_error("progress is neither None nor callable");
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// For the library; this object must live as long.
  std::function<bool(double)> function()
  {
    return [this](double part) { return tell(part); };
  }

  /// Raises what the callable or the interpreter has raised.
  void rethrow() const
  {
    if(m_raised)
      std::rethrow_exception(m_raised);
  }

private:
  static constexpr std::int64_t pause = 50; // milliseconds between two looks at the interpreter

  static std::int64_t now()
  {
    using namespace std::chrono;
    return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
  }

  bool tell(double part)
  {
    if(m_is_stopped)
      return false;
    const bool is_called = !m_callable.is_none();
    if(!is_called && now() < m_next)
      return true;
    const py::gil_scoped_acquire gil;
    try {
      if(PyErr_CheckSignals() != 0)
        throw py::error_already_set();
      if(is_called)
        m_is_stopped = !says_yes(m_callable(part));
    } catch(const py::error_already_set&) {
      m_raised = std::current_exception();
      m_is_stopped = true;
    }
    m_next = now() + pause;
    return !m_is_stopped;
  }

  static bool says_yes(const py::object& answer)
  {
    const int yes = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());
    if(yes < 0)
      throw py::error_already_set();
    return yes == 1;
  }

  py::object m_callable;
  std::exception_ptr m_raised;
  std::atomic<std::int64_t> m_next = {0};
  std::atomic<bool> m_is_stopped = {false};
};

/// Returns `work()`, which must not touch the interpreter: other threads of Python run meanwhile.
/// Its loops use `threads` threads, 0 for all processors; more than there are are not started.
template <class Work>
auto run(unsigned int threads, const Work& work)
{
  const py::gil_scoped_release others_run;
  const Blas_scope blas;
  const unsigned int processors = (std::max)(1u, std::thread::hardware_concurrency());
  const CGAL::Blocked_execution::Thread_scope scope(
    threads == 0 ? 0 : (std::min)(threads, processors));
  return work();
}

/// The same with progress, the function of which `work` gets.
template <class Work>
auto run(unsigned int threads, const py::object& callable, const Work& work)
{
  Progress progress(callable);
  const std::function<bool(double)> function = progress.function();
  auto result = run(threads, [&] { return work(function); });
  progress.rethrow();
  return result;
}

/// Lets one call at a time work on an object; others wait without the interpreter. A call from within
/// another one, by its progress callable, would wait for itself: it raises RuntimeError.
class Exclusive
{
public:
  /// Takes the object as long as it exists.
  class Use
  {
  public:
    explicit Use(Exclusive& object) : m_object(object)
    {
      if(m_object.m_owner == std::this_thread::get_id())
        throw std::runtime_error("the object is in use by the call that tells this progress");
      const py::gil_scoped_release others_run;
      m_object.m_mutex.lock();
      m_object.m_owner = std::this_thread::get_id();
    }
    ~Use()
    {
      m_object.m_owner = std::thread::id();
      m_object.m_mutex.unlock();
    }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

  private:
    Exclusive& m_object;
  };

private:
  std::mutex m_mutex;
  std::atomic<std::thread::id> m_owner = {std::thread::id()};
};

} // namespace hlscm_python

#endif // HLSCM_PYTHON_RUNNING_H
