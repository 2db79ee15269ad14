// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_OUTPUT_FILES_H
#define HLSCM_PROGRAM_OUTPUT_FILES_H

#include <cstdio>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace hlscm {

/// A file that is being written under a temporary name beside its final one.
class Output_file
{
public:
  /// Creates the temporary file; throws `Program_error` if that is impossible.
  explicit Output_file(const std::filesystem::path& target);
  ~Output_file();
  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

  void put(std::string_view bytes);

  /// Passes a stream to a function that writes to it and returns whether it could. What makes the
  /// file fail is thrown through it, and what `observe` throws, which gets the size so far.
  void write(const std::function<bool(std::ostream&)>& write,
             const std::function<void(std::size_t)>& observe = nullptr);

  void close();
  std::size_t size() const { return m_size; } ///< bytes put so far

private:
  friend class Output_files;
  [[noreturn]] void fail() const;

  std::filesystem::path m_name;   // as the user wrote it, for messages
  std::filesystem::path m_target; // with symbolic links resolved
  std::filesystem::path m_temporary;
  std::FILE* m_stream = nullptr;
  std::size_t m_size = 0;
};

/// Throws `Program_error` if an output has the name of the input.
void refuse_to_overwrite(const std::filesystem::path& input, const std::filesystem::path& output);

/// All files that a run leaves behind: they appear under their names together, by `commit()`, or
/// not at all. What was there before stays untouched until then.
class Output_files
{
public:
  Output_files();
  ~Output_files();
  Output_files(const Output_files&) = delete;
  Output_files& operator=(const Output_files&) = delete;

  /// Creates a folder and the missing ones above it.
  void create_folder(const std::filesystem::path& folder);

  /// Starts a file; valid as long as this object.
  Output_file& create(const std::filesystem::path& target);

  /// Gives all files their final names.
  void commit();

private:
  void discard();

  std::mutex m_mutex; // between commit() and the clean-up of an interruption
  std::vector<std::unique_ptr<Output_file>> m_files;
  std::vector<std::filesystem::path> m_created_folders; // outermost first
};

} // namespace hlscm

#endif // HLSCM_PROGRAM_OUTPUT_FILES_H
