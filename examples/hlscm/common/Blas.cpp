// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/Blas.h"

#include <algorithm>
#include <cstddef>
#include <new>
#include <thread>
#include <vector>

#include <dlfcn.h>
#include <sys/mman.h>

namespace hlscm {

namespace {

constexpr std::size_t room = std::size_t(160) << 20; // for a buffer, and some more

// A function of the program's libraries, or null.
template <typename Function>
Function* find_function(const char* name)
{
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

// How many of that many buffers there is room for.
unsigned int possible_buffers(unsigned int wanted)
{
  std::vector<void*> tried;
  while(tried.size() < wanted) {
    void* buffer =
        mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if(buffer == MAP_FAILED) {
      break;
    }
    tried.push_back(buffer);
  }
  for(void* buffer : tried) {
    munmap(buffer, room);
  }
  return static_cast<unsigned int>(tried.size());
}

} // namespace

void end_blas_threads()
{
  const auto number = find_function<int()>("openblas_get_num_threads");
  const auto set_number = find_function<void(int)>("openblas_set_num_threads");
  const auto end_all = find_function<int()>("blas_thread_shutdown_");
  if(number == nullptr || set_number == nullptr) {
    return;
  }
  const auto threads = static_cast<unsigned int>(number());
  set_number(1);
  if(end_all != nullptr && possible_buffers(threads) == threads) { // else they never end, and ask for theirs
    end_all();
  }
}

unsigned int reserve_blas_memory(unsigned int wanted)
{
  const auto allocate = find_function<void*(int)>("blas_memory_alloc");
  const auto free = find_function<void(void*)>("blas_memory_free");
  if(allocate == nullptr || free == nullptr) {
    return wanted;
  }
  const unsigned int threads = std::max(1u, std::thread::hardware_concurrency());
  const unsigned int possible = possible_buffers(wanted == 0 ? threads : wanted);
  if(possible == 0) {
    throw std::bad_alloc();
  }
  std::vector<void*> buffers; // OpenBLAS keeps them when they are free again
  for(unsigned int i = 0; i < possible; ++i) {
    buffers.push_back(allocate(1));
  }
  for(void* buffer : buffers) {
    free(buffer);
  }
  return wanted == 0 && possible == threads ? 0 : possible;
}

} // namespace hlscm
