// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_WORK_FOLDER_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_WORK_FOLDER_H

#include <CGAL/Surface_mesh_parameterization/internal/stored/Mapped_array.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <sys/file.h>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Creates a folder, if it is not there, in which nobody else works as long as this exists.
class Folder_lock
{
public:
  explicit Folder_lock(const std::string& path)
  {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    m_folder = error ? -1 : ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if(m_folder < 0)
      throw Streaming_failure(Streaming_failure::RESUMABLE,
                              path + ": the work folder cannot be created ("
                              + (error ? error.message() : std::strerror(errno)) + ")");
    struct stat opened, named; // a run that ends now may have removed what was opened
    if(::flock(m_folder, LOCK_EX | LOCK_NB) == 0 && ::fstat(m_folder, &opened) == 0
       && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino
       && opened.st_dev == named.st_dev)
      return;
    ::close(m_folder);
    throw Streaming_failure(Streaming_failure::RESUMABLE,
                            path + ": another run works in this folder, name another one");
  }
  Folder_lock(const Folder_lock&) = delete;
  Folder_lock& operator=(const Folder_lock&) = delete;
  ~Folder_lock() { ::close(m_folder); }

private:
  int m_folder;
};

// The files of a run, and a list of its finished phases with their numbers and the checksums of
// their files: from these a later run can go on.
class Work_folder
{
public:
  // `identity`: of what the work is done; a run goes on only with the same.
  Work_folder(const std::string& path, const std::string& identity, bool resumes)
    : m_path(path), m_lock(path), m_identity(identity)
  {
    std::error_code ignored;
    if(resumes && std::filesystem::exists(m_path / manifest_name, ignored))
      read_manifest();
    else
      begin();
  }

  const std::filesystem::path& path() const { return m_path; }

  template <class T>
  Mapped_array<T> create(const std::string& name, std::size_t n)
  {
    return Mapped_array<T>(Mapped_file::create(path_of(name), n * sizeof(T)));
  }

  // The same for what no later run needs: in memory as long as there is room for it.
  template <class T>
  Mapped_array<T> create_scratch(const std::string& name, std::size_t n)
  {
    if(n * sizeof(T) > m_room_for_scratch)
      return create<T>(name, n);
    m_room_for_scratch -= n * sizeof(T);
    m_scratch[name] = n * sizeof(T);
    return Mapped_array<T>(Mapped_file::create_in_memory(path_of(name), n * sizeof(T)));
  }
  void set_room_for_scratch(std::size_t bytes) { m_room_for_scratch = bytes; }

  // A file of a finished phase, unchanged.
  template <class T>
  Mapped_array<T> open(const std::string& name)
  {
    const auto known = m_checksums.find(name);
    Mapped_array<T> result;
    if(known != m_checksums.end())
      result = Mapped_array<T>(Mapped_file::open(path_of(name), true));
    if(known == m_checksums.end() || checksum_of(result.file()) != known->second)
      throw Streaming_failure(Streaming_failure::RESUMABLE,
                              path_of(name) + ": the file is not what was written, remove the "
                                              "work folder and begin again");
    return result;
  }

  // Of scratch, too, which must not be in use any more.
  void remove(const std::string& name)
  {
    std::error_code ignored;
    m_room_for_scratch += m_scratch[name];
    m_scratch.erase(name);
    m_checksums.erase(name);
    std::filesystem::remove(path_of(name), ignored);
  }

  bool has_finished(const std::string& phase) const { return m_values.count(phase) > 0; }

  // Numbers of a finished phase.
  std::istringstream values(const std::string& phase) const
  {
    return std::istringstream(m_values.at(phase));
  }

  // From now on the phase need not be done again.
  void finish(const std::string& phase, const std::string& values,
              const std::vector<const Mapped_file*>& files)
  {
    for(const Mapped_file* file : files)
      m_checksums[std::filesystem::path(file->path()).stem().string()] = checksum_of(*file);
    m_values[phase] = values;
    write_manifest();
  }

  // Phases that were finished count no more: they will be done again.
  void forget(const std::vector<std::string>& phases)
  {
    for(const std::string& phase : phases)
      m_values.erase(phase);
    write_manifest();
  }

  // What all files take.
  std::size_t bytes() const
  {
    std::error_code ignored;
    std::size_t result = 0;
    for(const auto& file : files())
      result += std::size_t(std::filesystem::file_size(file, ignored));
    return result;
  }

  void remove_all()
  {
    remove_files();
    std::error_code ignored; // somebody else's files stay, and the folder with them
    std::filesystem::remove(m_path, ignored);
  }

  // Where something can be written before it gets its name.
  std::string path_of(const std::string& name) const { return (m_path / (name + suffix)).string(); }

private:
  static constexpr const char* suffix = ".hlscm";
  static constexpr const char* manifest_name = "finished.hlscm";

  void begin()
  {
    remove_files();
    write_manifest();
  }

  // Ours, by their names.
  std::vector<std::filesystem::path> files() const
  {
    std::error_code ignored;
    std::vector<std::filesystem::path> result;
    for(std::filesystem::directory_iterator at(m_path, ignored), end; !ignored && at != end;
        at.increment(ignored))
      if(at->path().extension() == suffix)
        result.push_back(at->path());
    return result;
  }

  // The list first: while it is there, so are the files that it names, whenever the process ends.
  void remove_files()
  {
    std::error_code ignored;
    std::filesystem::remove(m_path / manifest_name, ignored);
    for(const auto& file : files())
      std::filesystem::remove(file, ignored);
  }

  // By which damage to the list is seen.
  static std::string last_line(const std::string& text)
  {
    std::uint64_t hash = 1;
    for(const char c : text)
      hash = mixed(hash, std::uint8_t(c));
    return "end " + std::to_string(hash);
  }

  void write_manifest() const
  {
    std::ostringstream text;
    text << "identity " << m_identity << '\n';
    for(const auto& [phase, values] : m_values)
      text << "phase " << phase << ' ' << values << '\n';
    for(const auto& [name, checksum] : m_checksums)
      text << "file " << name << ' ' << checksum << '\n';
    const std::filesystem::path temporary = path_of("finished_new");
    std::ofstream out(temporary);
    out << text.str() << last_line(text.str()) << '\n';
    out.close();
    std::error_code error;
    if(out)
      std::filesystem::rename(temporary, m_path / manifest_name, error);
    if(!out || error)
      throw Streaming_failure(Streaming_failure::RESUMABLE, m_path.string()
                              + ": the work folder cannot be written, make room");
  }

  void read_manifest()
  {
    std::ifstream in(m_path / manifest_name);
    std::string text, line, key, name;
    bool is_whole = false, is_same = false;
    while(std::getline(in, line)) {
      is_whole = line == last_line(text);
      text += line + '\n';
      std::istringstream words(line);
      words >> key;
      if(key == "identity")
        is_same = line == "identity " + m_identity;
      else if(key == "phase" && words >> name)
        std::getline(words, m_values[name]);
      else if(key == "file" && words >> name)
        words >> m_checksums[name];
    }
    std::error_code ignored;
    for(const auto& file : files())
      if(file.filename() != manifest_name && m_checksums.count(file.stem().string()) == 0
         && is_whole && is_same)
        std::filesystem::remove(file, ignored); // it was being written
    if(!is_whole)
      throw Streaming_failure(Streaming_failure::RESUMABLE, (m_path / manifest_name).string()
                              + ": the file is not what was written, remove the work folder and "
                              "begin again");
    if(!is_same)
      throw Streaming_failure(Streaming_failure::RESUMABLE, m_path.string()
                              + ": this is work on another input or with other options, remove it "
                              "or do not resume it");
  }

  std::filesystem::path m_path;
  Folder_lock m_lock;
  std::string m_identity;
  std::map<std::string, std::string> m_values;
  std::map<std::string, std::uint64_t> m_checksums;
  std::map<std::string, std::size_t> m_scratch; // what is in memory, and its bytes
  std::size_t m_room_for_scratch = 0;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_STORED_WORK_FOLDER_H
