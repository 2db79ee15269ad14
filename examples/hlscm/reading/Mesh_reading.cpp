// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reading/Mesh_reading.h"

#include "common/Interruption.h"
#include "formats/Mesh_source.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace hlscm {

namespace {

namespace fs = std::filesystem;

struct File_bytes
{
  std::unique_ptr<char[]> data;
  std::size_t size = 0;
};

// In pieces, so that a slow disk does not hold up Ctrl-C.
File_bytes load(const std::string& file_name)
{
  std::error_code error;
  if(!fs::exists(file_name, error)) {
    throw Program_error(file_name, "there is no such file, check its name");
  }
  if(fs::is_directory(file_name, error)) {
    throw Program_error(file_name, "this is a folder, name a mesh file");
  }
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(file_name.c_str(), "rb"),
                                                       std::fclose);
  const std::size_t size = file ? std::size_t(fs::file_size(file_name, error)) : 0;
  if(!file || error) {
    throw Program_error(file_name, std::string("cannot be opened (")
                                       + (error ? error.message() : std::strerror(errno))
                                       + "), check its permissions");
  }
  File_bytes bytes{std::unique_ptr<char[]>(new char[size + 1]), size};
  constexpr std::size_t piece = std::size_t(1) << 24;
  for(std::size_t done = 0; done < size; done += piece) {
    Interruption::check();
    const std::size_t wanted = std::min(piece, size - done);
    if(std::fread(bytes.data.get() + done, 1, wanted, file.get()) != wanted) {
      throw Program_error(file_name, "reading stopped after " + std::to_string(done)
                                         + " bytes, check the disk and try again");
    }
  }
  return bytes;
}

std::string lower_case_extension(const std::string& file_name)
{
  std::string extension = fs::path(file_name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

} // namespace

Read_mesh read_mesh(const std::string& file_name, Progress_bar& progress)
{
  progress.start_stage("reading");
  const File_bytes bytes = load(file_name);
  return read_mesh(file_name, bytes.data.get(), bytes.data.get() + bytes.size, progress);
}

Read_mesh read_mesh(const std::string& file_name, const char* begin, const char* end,
                    Progress_bar& progress)
{
  struct Format
  {
    const char* extension;
    Read_mesh (*read)(const Mesh_source&);
  };
  static const Format formats[] = {
      {".off", read_off}, {".obj", read_obj}, {".ply", read_ply}, {".stl", read_stl}};

  const std::string extension = lower_case_extension(file_name);
  const Format* format = std::find_if(std::begin(formats), std::end(formats),
                                      [&](const Format& f) { return extension == f.extension; });
  if(format == std::end(formats)) {
    throw Program_error(file_name, "the extension \"" + extension
                                       + "\" is unknown, convert the mesh "
                                         "to .off, .obj, .ply or .stl");
  }
  const Mesh_source source{file_name, begin, end, progress};
  if(begin == end) {
    source.fail("the file is empty, export the mesh again");
  }
  Read_mesh mesh = format->read(source);
  if(mesh.soup.number_of_faces() == 0) {
    source.fail("there is no face in it (" + std::to_string(mesh.soup.number_of_vertices())
                + " vertices), give a mesh instead of points or a damaged file");
  }
  return mesh;
}

} // namespace hlscm
