// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reading/Mesh_reading.h"

#include "formats/Mesh_format.h"
#include "formats/Mesh_source.h"
#include "reading/File_bytes.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

namespace hlscm {

namespace {

namespace fs = std::filesystem;

std::string lower_case_extension(const fs::path& file_name)
{
  std::string extension = file_name.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

// The format that a name tells, ".gz" apart; nothing if its content shall.
std::optional<Mesh_format> format_of_name(const std::string& file_name, bool is_packed)
{
  fs::path name = file_name;
  const bool has_gz = lower_case_extension(name) == ".gz";
  const std::string extension = lower_case_extension(has_gz ? name.stem() : name);
  const auto format = format_of_extension(extension);
  if(!format && !(extension.empty() && (has_gz || is_packed)) && !is_stream(file_name)) {
    throw Program_error(file_name, "the extension \"" + extension
                                       + "\" is unknown, convert the mesh "
                                         "to .glb, .gltf, .off, .obj, .ply or .stl");
  }
  return format;
}

Read_mesh read_unpacked(const Mesh_source& source, std::optional<Mesh_format> format)
{
  if(source.begin == source.end) {
    source.fail("the file is empty, export the mesh again");
  }
  const auto ascii =
      format != Mesh_format::STL ? text_of_utf16(source.begin, source.end) : std::nullopt;
  if(ascii && !ascii->empty()) {
    const char* begin = ascii->data();
    return read_unpacked({source.file_name, begin, begin + ascii->size(), source.progress}, format);
  }
  if(!format) {
    format = format_of_content(source.begin, source.end);
  }
  if(!format) {
    source.fail("its first bytes are those of no format known here, give a file of GLB, glTF, OFF, "
                "OBJ, PLY or STL");
  }
  Mesh_source text = source;
  text.begin += byte_order_mark(source.begin, source.end, *format);
  if(text.begin == text.end) {
    source.fail("the file has a byte order mark and nothing else, export the mesh again");
  }
  Read_mesh mesh = read_format(text, *format);
  if(mesh.soup.number_of_faces() == 0) {
    source.fail("there is no face in it (" + std::to_string(mesh.soup.number_of_vertices())
                + " vertices), give a mesh instead of points or a damaged file");
  }
  return mesh;
}

} // namespace

Read_mesh read_mesh(const std::string& file_name, Progress_bar& progress)
{
  progress.start_stage("reading");
  const File_bytes bytes = load_file(file_name);
  return read_mesh(file_name, bytes.begin(), bytes.end(), progress);
}

Read_mesh read_mesh(const std::string& file_name, const char* begin, const char* end,
                    Progress_bar& progress)
{
  const bool is_gzip = is_packed(begin, end);
  const auto format = format_of_name(file_name, is_gzip);
  const std::string name = name_in_messages(file_name);
  if(!is_gzip) {
    return read_unpacked({name, begin, end, progress}, format);
  }
  const File_bytes bytes = unpack(name, begin, end);
  return read_unpacked({name, bytes.begin(), bytes.end(), progress}, format);
}

} // namespace hlscm
