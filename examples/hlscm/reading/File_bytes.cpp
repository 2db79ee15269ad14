// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reading/File_bytes.h"

#include "common/Interruption.h"
#include "common/Program_error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

namespace hlscm {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t piece = std::size_t(1) << 22; // a slow disk or pipe does not hold up Ctrl-C

class Open_file
{
public:
  explicit Open_file(const std::string& name)
    : m_descriptor(name == "-" ? STDIN_FILENO : ::open(name.c_str(), O_RDONLY | O_CLOEXEC))
  {}
  ~Open_file()
  {
    if(m_descriptor > STDIN_FILENO) {
      ::close(m_descriptor);
    }
  }
  Open_file(const Open_file&) = delete;
  Open_file& operator=(const Open_file&) = delete;

  bool is_good() const { return m_descriptor >= 0; }

  // Returns how many bytes came, 0 at the end, -1 after an error.
  ssize_t read(char* to, std::size_t size) const
  {
    for(;;) {
      Interruption::check();
      const ssize_t got = ::read(m_descriptor, to, size);
      if(got >= 0 || errno != EINTR) {
        return got;
      }
    }
  }

private:
  int m_descriptor;
};

// A device without end should not fill the memory.
void refuse_zeros(const std::string& name, const File_bytes& bytes)
{
  if(std::all_of(bytes.begin(), bytes.end(), [](char c) { return c == 0; })) {
    throw Program_error(name, "its first " + std::to_string(bytes.size())
                                  + " bytes are all zero, this is no mesh, name another file");
  }
}

} // namespace

char* File_bytes::room_for(std::size_t more)
{
  if(m_capacity - m_size < more) {
    const std::size_t capacity = std::max(m_size + more, m_size + m_size / 2);
    char* data = static_cast<char*>(std::realloc(m_data.get(), capacity));
    if(data == nullptr) {
      throw std::bad_alloc();
    }
    static_cast<void>(m_data.release()); // realloc() took it
    m_data.reset(data);
    m_capacity = capacity;
  }
  return m_data.get() + m_size;
}

std::string load_text(const std::string& file_name)
{
  const File_bytes bytes = load_file(file_name);
  return {bytes.begin(), bytes.end()};
}

std::string load_page(const fs::path& file)
{
  std::error_code ignored;
  if(!fs::exists(file, ignored)) {
    throw Program_error(file.string(), "this page is not there: check its name, or build it by scripts/"
                                       "install_dependencies.sh --web and cmake with -D "
                                       "HLSCM_BUILD_WEB=ON");
  }
  return load_text(file.string());
}

bool is_stream(const std::string& file_name)
{
  if(file_name == "-" || file_name.rfind("/dev/", 0) == 0) { // "/dev/stdin" may be a file
    return true;
  }
  std::error_code error;
  const fs::file_status status = fs::status(file_name, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

std::string name_in_messages(const std::string& file_name)
{
  return file_name == "-" ? "standard input" : file_name;
}

File_bytes load_file(const std::string& file_name)
{
  const std::string name = name_in_messages(file_name);
  std::error_code error;
  if(file_name != "-" && !fs::exists(file_name, error)) {
    throw Program_error(name, "there is no such file, check its name");
  }
  if(file_name != "-" && fs::is_directory(file_name, error)) {
    throw Program_error(name, "this is a folder, name a mesh file");
  }
  const Open_file file(file_name);
  if(!file.is_good()) {
    throw Program_error(name, std::string("cannot be opened (") + std::strerror(errno)
                                  + "), check its permissions");
  }
  File_bytes bytes;
  const bool has_end = !is_stream(file_name);
  if(has_end) {
    const std::uintmax_t size = fs::file_size(file_name, error);
    bytes.room_for((error ? 0 : std::size_t(size)) + 1);
  }
  for(ssize_t got = 1; got > 0;) {
    const std::size_t wanted = bytes.room() > 0 ? std::min(piece, bytes.room()) : piece;
    got = file.read(bytes.room_for(wanted), wanted);
    if(got < 0) {
      throw Program_error(name, "reading stopped after " + std::to_string(bytes.size()) + " bytes ("
                                    + std::strerror(errno) + "), check the disk and try again");
    }
    bytes.add(std::size_t(got));
    if(!has_end && got > 0 && bytes.size() >= piece && bytes.size() < 2 * piece) {
      refuse_zeros(name, bytes);
    }
  }
  return bytes;
}

bool is_packed(const char* begin, const char* end)
{
  return end - begin >= 3 && begin[0] == '\x1f' && begin[1] == '\x8b' && begin[2] == '\x08';
}

namespace {

// The state of zlib, which ends with its scope.
class Unpacking
{
public:
  Unpacking(const char* begin, const char* end) : m_begin(begin), m_end(end)
  {
    constexpr int largest_window_with_gzip_header = 15 + 16;
    if(inflateInit2(&m_stream, largest_window_with_gzip_header) != Z_OK) {
      throw std::bad_alloc();
    }
    m_stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(begin));
  }
  ~Unpacking() { inflateEnd(&m_stream); }
  Unpacking(const Unpacking&) = delete;
  Unpacking& operator=(const Unpacking&) = delete;

  std::size_t taken() const { return std::size_t(position() - m_begin); }
  bool is_at_end() const { return m_is_member_done && !is_packed(position(), m_end); }

  // Unpacks a piece at most; false if the bytes cannot be unpacked.
  bool unpack_piece(File_bytes& to)
  {
    if(m_is_member_done) { // a file may be several packed ones, one behind the other
      inflateReset(&m_stream);
    }
    const std::size_t left = std::size_t(m_end - position());
    m_stream.avail_in = uInt(std::min(left, piece));
    m_stream.next_out = reinterpret_cast<Bytef*>(to.room_for(piece));
    m_stream.avail_out = uInt(piece);
    const int result = inflate(&m_stream, Z_NO_FLUSH);
    to.add(piece - m_stream.avail_out);
    m_is_member_done = result == Z_STREAM_END;
    if(result == Z_MEM_ERROR) {
      throw std::bad_alloc();
    }
    return result == Z_OK || m_is_member_done;
  }

private:
  const char* position() const { return reinterpret_cast<const char*>(m_stream.next_in); }

  const char* m_begin;
  const char* m_end;
  z_stream m_stream{};
  bool m_is_member_done = false;
};

} // namespace

File_bytes unpack(const std::string& file_name, const char* begin, const char* end,
                  const Unpacking_limits& limits)
{
  const std::size_t packed_size = std::size_t(end - begin);
  const std::size_t limit = std::max(limits.harmless_size, limits.ratio * packed_size);
  Unpacking unpacking(begin, end);
  File_bytes bytes;
  while(!unpacking.is_at_end()) {
    Interruption::check();
    if(!unpacking.unpack_piece(bytes)) {
      const bool is_short = unpacking.taken() == packed_size;
      throw Program_error(file_name, is_short ? "the packed file ends too early, after "
                                                    + std::to_string(packed_size)
                                                    + " bytes, it is cut short: copy it again"
                                              : "the packed file is damaged near byte "
                                                    + std::to_string(unpacking.taken())
                                                    + ": copy it again");
    }
    if(bytes.size() > limit) {
      throw Program_error(file_name, "it unpacks to more than " + std::to_string(limit)
                                         + " bytes, more than a mesh would: if it is one, "
                                           "unpack it by gunzip first");
    }
  }
  return bytes;
}

} // namespace hlscm
