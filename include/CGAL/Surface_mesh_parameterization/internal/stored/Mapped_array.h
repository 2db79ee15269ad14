// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_MAPPED_ARRAY_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_MAPPED_ARRAY_H

#include <CGAL/Blocked_execution/blocked_for.h>
#include <CGAL/Surface_mesh_parameterization/internal/stored/Streaming_failure.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// A file as a piece of memory (POSIX). The system reads what is touched and writes what was
// changed; what is released takes no memory of the process until it is touched again.
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

// A hash with one more word.
inline std::uint64_t mixed(std::uint64_t hash, std::uint64_t word)
{
  hash = (hash ^ word) * 0x9E3779B97F4A7C15u; // odd: no bit is lost
  return hash ^ (hash >> 29);
}

// A number that other bytes hardly have: of each megabyte a hash of its words, and a hash of these.
// It guards against damage, not against malice. `release(begin, end)`: what is called for each of
// them when it was read.
template <class Release>
std::uint64_t checksum_of(const char* data, std::size_t bytes, const Release& release)
{
  constexpr std::size_t block = std::size_t(1) << 20;
  std::vector<std::uint64_t> of_block(Blocked_execution::number_of_blocks(bytes, block));
  Blocked_execution::blocked_for(bytes, block, [&](std::size_t begin, std::size_t end) {
    std::uint64_t lanes[4] = {1, 2, 3, 4}, words[4];
    std::size_t i = begin;
    for(; i + sizeof(words) <= end; i += sizeof(words)) {
      std::memcpy(words, data + i, sizeof(words));
      for(int lane = 0; lane < 4; ++lane)
        lanes[lane] = mixed(lanes[lane], words[lane]);
    }
    for(; i < end; ++i)
      lanes[0] = mixed(lanes[0], std::uint8_t(data[i]));
    of_block[begin / block] = mixed(mixed(lanes[0], lanes[1]), mixed(lanes[2], lanes[3]));
    release(begin, end);
  });
  std::uint64_t result = mixed(1, bytes);
  for(const std::uint64_t hash : of_block)
    result = mixed(result, hash);
  return result;
}

inline std::uint64_t checksum_of(const Mapped_file& file)
{
  return checksum_of(file.data(), file.bytes(), [&file](std::size_t begin, std::size_t end) {
    file.release(begin, end);
  });
}

template <class T>
std::uint64_t checksum_of(const std::vector<T>& values)
{
  static_assert(std::is_trivially_copyable<T>::value, "bytes are read");
  return checksum_of(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T),
                     [](std::size_t, std::size_t) {});
}

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
  // The same when all before was: now and then also what came back, pages at a time, since entries
  // of later ranges have neighbours there.
  void release_passed(std::size_t first, std::size_t last) const
  {
    constexpr std::size_t entries = std::size_t(1) << 20;
    release(last >= size() || first / entries != last / entries ? 0 : first, last);
  }

  const Mapped_file& file() const { return m_file; }

private:
  Mapped_file m_file;
};

// What takes ranges of arrays in files out of the memory, one after the other.
template <class... Array>
auto releases(const Array&... array)
{
  return [&](std::size_t begin, std::size_t end) { (array.release_passed(begin, end), ...); };
}

// Calls `body(begin, end)` for blocks of rows, and after each slab of them `release(begin, end)`,
// so that what was streamed takes no memory any more.
template <class Body, class Release>
void stream_rows(std::size_t n, const Body& body, const Release& release)
{
  constexpr std::size_t slab = std::size_t(1) << 18, block = 16384;
  for(std::size_t first = 0; first < n; first += slab) {
    const std::size_t last = (std::min)(n, first + slab);
    Blocked_execution::blocked_for(last - first, block, [&](std::size_t begin, std::size_t end) {
      body(first + begin, first + end);
    });
    release(first, last);
  }
}

// The same for `body`s that return sums of their rows; returns those of all.
template <class Sum, class Body, class Release>
Sum sum_rows(std::size_t n, const Body& body, const Release& release)
{
  constexpr std::size_t slab = std::size_t(1) << 18, block = 16384;
  Sum result = Sum();
  for(std::size_t first = 0; first < n; first += slab) {
    const std::size_t last = (std::min)(n, first + slab);
    result += Blocked_execution::blocked_sum<Sum>(
      last - first, block,
      [&](std::size_t begin, std::size_t end) { return body(first + begin, first + end); });
    release(first, last);
  }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_MAPPED_ARRAY_H
