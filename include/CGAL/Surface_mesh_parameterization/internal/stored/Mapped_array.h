// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_MAPPED_ARRAY_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_MAPPED_ARRAY_H

#include <CGAL/Surface_mesh_parameterization/internal/stored/Streaming_failure.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// A file as a piece of memory (POSIX). The system reads what is touched and writes what was changed;
// what is released takes no memory of the process until it is touched again.
class Mapped_file
{
public:
  Mapped_file() {}
  Mapped_file(Mapped_file&& other) noexcept { swap(other); }
  Mapped_file& operator=(Mapped_file&& other) noexcept
  {
    Mapped_file(std::move(other)).swap(*this);
    return *this;
  }
  ~Mapped_file()
  {
    if(m_data != nullptr)
      ::munmap(m_data, m_bytes);
  }

  // A new file of so many zeros. Their room on the disk is taken now: a disk that is full later
  // could only be met by a signal.
  static Mapped_file create(const std::string& path, std::size_t bytes)
  {
    Mapped_file result(path, bytes);
    const Descriptor file(path, O_RDWR | O_CREAT | O_TRUNC);
    const int error = bytes == 0 ? 0 : ::posix_fallocate(file.number, 0, off_t(bytes));
    if(error != 0)
      fail(path, "there is no room for " + std::to_string(bytes) + " bytes", error);
    result.map(file, PROT_READ | PROT_WRITE);
    return result;
  }

  // No file at all but zeros in memory, for what there is room for.
  static Mapped_file create_in_memory(const std::string& path, std::size_t bytes)
  {
    Mapped_file result(path, bytes);
    if(bytes > 0) {
      void* const data = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS,
                                -1, 0);
      if(data == MAP_FAILED)
        fail(path, "there is no memory for " + std::to_string(bytes) + " bytes", errno);
      result.m_data = data;
      result.m_is_in_memory = true;
#if defined(MADV_HUGEPAGE)
      ::madvise(data, bytes, MADV_HUGEPAGE); // small pages will do, too
#endif
    }
    return result;
  }

  // A file that there is.
  static Mapped_file open(const std::string& path, bool is_writable)
  {
    const Descriptor file(path, is_writable ? O_RDWR : O_RDONLY);
    struct stat status;
    if(::fstat(file.number, &status) != 0)
      fail(path, "it cannot be read", errno);
    Mapped_file result(path, std::size_t(status.st_size));
    result.map(file, is_writable ? PROT_READ | PROT_WRITE : PROT_READ);
    return result;
  }

  char* data() const { return static_cast<char*>(m_data); }
  std::size_t bytes() const { return m_bytes; }
  const std::string& path() const { return m_path; }

  // Takes the whole pages of bytes [begin, end) out of the memory of the process.
  void release(std::size_t begin, std::size_t end) const
  {
    static const std::size_t page = std::size_t(::sysconf(_SC_PAGESIZE));
    begin = (begin + page - 1) / page * page;
    end = end >= m_bytes ? m_bytes : end / page * page;
    if(begin < end && !m_is_in_memory)
      ::madvise(data() + begin, end - begin, MADV_DONTNEED);
  }

private:
  struct Descriptor
  {
    Descriptor(const std::string& path, int flags) : number(::open(path.c_str(), flags, 0666))
    {
      if(number < 0)
        fail(path, "it cannot be opened", errno);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { ::close(number); }

    int number;
  };

  Mapped_file(const std::string& path, std::size_t bytes) : m_path(path), m_bytes(bytes) {}

  void swap(Mapped_file& other) noexcept
  {
    std::swap(m_path, other.m_path);
    std::swap(m_bytes, other.m_bytes);
    std::swap(m_data, other.m_data);
    std::swap(m_is_in_memory, other.m_is_in_memory);
  }

  void map(const Descriptor& file, int protection)
  {
    if(m_bytes == 0)
      return;
    void* const data = ::mmap(nullptr, m_bytes, protection, MAP_SHARED, file.number, 0);
    if(data == MAP_FAILED)
      fail(m_path, "it cannot be mapped to memory", errno);
    m_data = data;
  }

  [[noreturn]] static void fail(const std::string& path, const std::string& what, int error)
  {
    throw Streaming_failure(Streaming_failure::RESUMABLE,
                            path + ": " + what + " (" + std::strerror(error) + ")");
  }

  std::string m_path;
  std::size_t m_bytes = 0;
  void* m_data = nullptr;
  bool m_is_in_memory = false;
};

// An array in a file: a handle, which may be constant while the entries are not.
template <class T>
class Mapped_array
{
  static_assert(std::is_trivially_copyable<T>::value, "files hold bytes");

public:
  typedef T value_type;

  Mapped_array() {}
  explicit Mapped_array(Mapped_file file) : m_file(std::move(file)) {}

  std::size_t size() const { return m_file.bytes() / sizeof(T); }
  bool empty() const { return size() == 0; }
  T* data() const { return reinterpret_cast<T*>(m_file.data()); }
  T* begin() const { return data(); }
  T* end() const { return data() + size(); }
  T& operator[](std::size_t i) const { return data()[i]; }

  // Takes [first, last) out of the memory of the process.
  void release(std::size_t first, std::size_t last) const
  {
    m_file.release(first * sizeof(T), last * sizeof(T));
  }
  void release() const { m_file.release(0, m_file.bytes()); }

  const Mapped_file& file() const { return m_file; }

private:
  Mapped_file m_file;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_MAPPED_ARRAY_H
