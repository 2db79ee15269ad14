// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writing/Output_files.h"

#include "common/Interruption.h"
#include "common/Program_error.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ostream>
#include <streambuf>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

namespace hlscm {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t buffer_size = 1 << 20;

// mkstemp() gives 0600; the result shall have the mode of the file it replaces, or a new file's.
mode_t final_mode(const fs::path& target)
{
  struct stat existing;
  if(stat(target.c_str(), &existing) == 0) {
    return existing.st_mode & 07777;
  }
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

// Where a chain of symbolic links ends, also if nothing is there yet.
fs::path followed(fs::path target)
{
  constexpr int most_links = 40; // as the kernel
  std::error_code error;
  for(int i = 0; i < most_links && fs::is_symlink(fs::symlink_status(target, error)); ++i) {
    const fs::path next = fs::read_symlink(target, error);
    if(error) {
      break;
    }
    target = target.parent_path() / next; // an absolute one replaces it
  }
  return target;
}

void check_target(const fs::path& name, const fs::path& target)
{
  std::error_code ignored;
  if(fs::is_directory(target, ignored)) {
    throw Program_error(name.string(), "this is a folder, name a file for the output");
  }
  if(fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    throw Program_error(name.string(), "this is not a regular file, name another output");
  }
  if(fs::exists(target, ignored) && access(target.c_str(), W_OK) != 0) {
    throw Program_error(name.string(), "the existing file is write-protected, change its "
                                       "permissions or name another output");
  }
}

/// The buffer of a stream whose bytes go to a function as they come.
class File_buffer : public std::streambuf
{
public:
  using Put = std::function<void(std::string_view)>;
  explicit File_buffer(Put put) : m_put(std::move(put)) {}

private:
  std::streamsize xsputn(const char* bytes, std::streamsize size) override
  {
    m_put(std::string_view(bytes, std::size_t(size)));
    return size;
  }

  int_type overflow(int_type byte) override
  {
    if(!traits_type::eq_int_type(byte, traits_type::eof())) {
      const char c = traits_type::to_char_type(byte);
      xsputn(&c, 1);
    }
    return traits_type::not_eof(byte);
  }

  Put m_put;
};

} // namespace

Output_file::Output_file(const fs::path& target) : m_name(target)
{
  std::error_code error;
  m_target = fs::weakly_canonical(followed(target), error);
  if(error || m_target.filename().empty()) {
    m_target = target;
  }
  check_target(m_name, m_target);
  std::string pattern =
      (m_target.parent_path() / ("." + m_target.filename().string())).string() + ".XXXXXX";
  const int descriptor = mkstemp(pattern.data());
  if(descriptor < 0) {
    throw Program_error(m_name.string(), std::string("cannot be written (") + std::strerror(errno)
                                             + "), choose a folder that exists and is writable");
  }
  m_temporary = pattern;
  [[maybe_unused]] const int changed = fchmod(descriptor, final_mode(m_target));
  m_stream = fdopen(descriptor, "wb");
  std::setvbuf(m_stream, nullptr, _IOFBF, buffer_size);
}

Output_file::~Output_file()
{
  if(m_stream != nullptr) {
    std::fclose(m_stream);
  }
}

void Output_file::put(std::string_view bytes)
{
  m_size += bytes.size();
  if(std::fwrite(bytes.data(), 1, bytes.size(), m_stream) != bytes.size()) {
    fail();
  }
}

void Output_file::write(const std::function<bool(std::ostream&)>& write,
                        const std::function<void(std::size_t)>& observe)
{
  File_buffer buffer([&](std::string_view bytes) {
    put(bytes);
    if(observe) {
      observe(m_size);
    }
  });
  std::ostream stream(&buffer);
  stream.exceptions(std::ios::badbit); // to throw what the buffer has thrown
  if(!write(stream)) {
    throw Program_error(m_name.string(),
                        "this format cannot hold the model, choose another or split the mesh");
  }
}

void Output_file::close()
{
  std::FILE* stream = m_stream;
  m_stream = nullptr;
  if(stream != nullptr && std::fclose(stream) != 0) {
    fail();
  }
}

void Output_file::fail() const
{
  throw Program_error(m_name.string(), std::string("writing failed (") + std::strerror(errno)
                                           + "), make room or choose another folder");
}

void refuse_to_overwrite(const fs::path& input, const fs::path& output)
{
  std::error_code ignored;
  if(fs::equivalent(input, output, ignored)) {
    throw Program_error(output.string(), "the output is the input, choose another name");
  }
}

Output_files::Output_files()
{
  Interruption::set_clean_up([this] {
    m_mutex.lock(); // for good: the process ends, and no file shall be created before it has
    discard();
  });
}

Output_files::~Output_files()
{
  Interruption::set_clean_up(nullptr);
  discard();
}

void Output_files::create_folder(const fs::path& folder)
{
  std::lock_guard<std::mutex> lock(m_mutex);
  std::error_code error;
  if(fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    throw Program_error(folder.string(), "this is a file, name a folder");
  }
  fs::path part;
  for(const fs::path& name : folder) {
    part /= name;
    if(fs::create_directory(part, error)) {
      m_created_folders.push_back(part);
    }
    if(error && !fs::is_directory(part)) {
      throw Program_error(folder.string(), "the folder cannot be created (" + error.message()
                                               + "), choose a place that exists and is writable");
    }
  }
}

Output_file& Output_files::create(const fs::path& target)
{
  std::lock_guard<std::mutex> lock(m_mutex);
  m_files.push_back(std::make_unique<Output_file>(target));
  for(const auto& other : m_files) {
    if(other != m_files.back() && other->m_target == m_files.back()->m_target) {
      throw Program_error(target.string(), "two outputs have this name, choose another for one");
    }
  }
  return *m_files.back();
}

void Output_files::commit()
{
  std::lock_guard<std::mutex> lock(m_mutex);
  for(const auto& file : m_files) {
    file->close();
  }
  for(const auto& file : m_files) {
    std::error_code error;
    fs::rename(file->m_temporary, file->m_target, error);
    if(error) {
      throw Program_error(file->m_name.string(), "cannot be put in place (" + error.message()
                                                     + "), choose another output");
    }
    file->m_temporary.clear();
  }
  m_files.clear();
  m_created_folders.clear();
  Interruption::set_in_place();
}

// Only removes names; the streams are closed by the thread that writes to them.
void Output_files::discard()
{
  std::error_code ignored;
  for(const auto& file : m_files) {
    if(!file->m_temporary.empty()) {
      fs::remove(file->m_temporary, ignored);
    }
  }
  for(auto folder = m_created_folders.rbegin(); folder != m_created_folders.rend(); ++folder) {
    fs::remove(*folder, ignored); // fails for a folder that is not empty: somebody else uses it
  }
}

} // namespace hlscm
