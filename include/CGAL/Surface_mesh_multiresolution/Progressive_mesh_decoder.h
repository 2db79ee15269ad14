// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_DECODER_H
#define CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_DECODER_H

#include <CGAL/Surface_mesh_multiresolution/Textured_progressive_mesh.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/Section_decoder.h>
#include <CGAL/Surface_mesh_multiresolution/internal/file/progressive_mesh_format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_multiresolution {

/// \ingroup PkgHLSCMLevelsOfDetail
/// What the bytes of a progressive mesh file turn out to be.
enum class Progressive_mesh_file_status
{
  COMPLETE,           ///< all splits have been read
  TRUNCATED,          ///< sound so far, but more has to follow
  DAMAGED,            ///< not what was written from some place on
  OTHER_FORMAT,       ///< not a progressive mesh file
  UNSUPPORTED_VERSION ///< a progressive mesh file of a later version
};

/*!
\ingroup PkgHLSCMLevelsOfDetail

The class `Progressive_mesh_decoder` reads a progressive mesh file as its bytes arrive, in pieces of
any size. At any time it has the mesh of the bytes so far: nothing until the coarsest mesh is there,
then a finer and finer mesh, each time a section of about 4096 splits is complete.

The bytes may come from anywhere: what they say is checked, and however they lie they cost memory in
proportion to their number only, and no more than 16384 steps a split. A section is taken as a whole
or not at all, so that there is a valid mesh before any damage.

Linear time. Memory: 64 bytes a wedge beside the mesh, 48 if coordinates have 16 bits at most.
*/
class Progressive_mesh_decoder
{
public:
  /// Takes the next bytes of the file. Bytes behind its end or behind damage have no effect.
  void push(const char* data, std::size_t size);

  /// Returns what the bytes so far are: `TRUNCATED` as long as more has to follow.
  Progressive_mesh_file_status status() const { return m_status; }

  /// Returns the status in a sentence.
  std::string message() const;

  /// Returns whether there is a mesh.
  bool has_mesh() const { return m_has_base; }

  /// Returns the number of splits that have been read.
  std::size_t number_of_splits() const { return m_sections.number_of_splits(); }

  /// Returns the number of splits that the file should have; 0 before its header is there.
  std::size_t number_of_splits_in_file() const { return m_header.number_of_splits(); }

  /// Returns the bound on the error of each coordinate of a point, but for rounding: 0 if lossless.
  double position_error() const { return 0.5 * m_header.step[0]; }

  /// Returns the bound on the error of each texture coordinate, but for rounding: 0 if lossless.
  double uv_error() const { return 0.5 * m_header.step[1]; }

  /// Returns the mesh so far, empty if there is none, without texture if the file has none; its
  /// `source_vertex` is empty. Linear time.
  Textured_progressive_mesh mesh() const&
  {
    return m_has_base ? m_sections.mesh() : Textured_progressive_mesh();
  }

  /// Moves the mesh so far out of the decoder, which is of no use then.
  Textured_progressive_mesh mesh() &&
  {
    return m_has_base ? m_sections.take_mesh() : Textured_progressive_mesh();
  }

private:
  enum class Part { HEADER, SECTION_HEADER, SECTION };

  static constexpr std::size_t max_splits = internal::splits_per_section + 1; // of a section

  bool is_over() const { return m_status != Progressive_mesh_file_status::TRUNCATED; }
  void refuse(Progressive_mesh_file_status status) { m_status = status; }
  void expect(Part part, std::size_t size)
  {
    m_part = part;
    m_part_size = size;
  }
  void check_beginning(const char* data, std::size_t size);
  void take_part(const char* data);
  void take_header(const char* data);
  void take_section_header(const char* data);
  void take_section(const char* data);

  Progressive_mesh_file_status m_status = Progressive_mesh_file_status::TRUNCATED;
  Part m_part = Part::HEADER;
  std::size_t m_part_size = internal::file_header_size;
  std::size_t m_bytes_behind = 0;  // behind the present part, as far as they are known
  std::vector<char> m_pending;     // the beginning of a part whose end has not come yet
  std::vector<char> m_section;     // memory
  std::uint32_t m_splits = 0, m_crc = 0, m_wanted_crc = 0;
  bool m_has_base = false;
  internal::File_header m_header;
  internal::Section_decoder m_sections;
};

inline void Progressive_mesh_decoder::push(const char* data, std::size_t size)
{
  if(m_part == Part::HEADER)
    check_beginning(data, size);
  while(!is_over()) {
    const bool is_whole = m_pending.empty() && size >= m_part_size; // no need to copy
    const std::size_t taken = (std::min)(size, m_part_size - m_pending.size());
    if(!is_whole)
      m_pending.insert(m_pending.end(), data, data + taken);
    const char* part = is_whole ? data : m_pending.data();
    if(!is_whole && m_pending.size() < m_part_size)
      return;
    data += taken;
    size -= taken;
    m_bytes_behind = size;
    take_part(part);
    m_pending.clear();
  }
}

// Other formats are known by their first bytes, and later versions may have another header.
inline void Progressive_mesh_decoder::check_beginning(const char* data, std::size_t size)
{
  for(std::size_t i = 0; i < size && !is_over(); ++i) {
    const std::size_t at = m_pending.size() + i;
    const auto byte = static_cast<unsigned char>(data[i]);
    if(at < internal::file_magic.size() && byte != internal::file_magic[at])
      refuse(Progressive_mesh_file_status::OTHER_FORMAT);
    else if((at == 8 && byte != internal::version_with_texture
             && byte != internal::version_without_texture) || (at == 9 && byte != 0))
      refuse(Progressive_mesh_file_status::UNSUPPORTED_VERSION);
    else if(at > 9)
      return;
  }
}

inline void Progressive_mesh_decoder::take_part(const char* data)
{
  if(m_part == Part::HEADER)
    take_header(data);
  else if(m_part == Part::SECTION_HEADER)
    take_section_header(data);
  else
    take_section(data);
}

inline void Progressive_mesh_decoder::take_header(const char* data)
{
  const std::size_t crc_at = internal::file_header_size - 4;
  const internal::File_header header = internal::header_of(data);
  m_crc = internal::crc32(data, crc_at);
  if(m_crc != internal::load_little_endian(data + crc_at, 4) || !internal::is_sound(header))
    return refuse(Progressive_mesh_file_status::DAMAGED);
  m_header = header;
  m_sections = internal::Section_decoder(header);
  expect(Part::SECTION_HEADER, internal::section_header_size);
}

inline void Progressive_mesh_decoder::take_section_header(const char* data)
{
  m_splits = std::uint32_t(internal::load_little_endian(data, 4));
  m_wanted_crc = std::uint32_t(internal::load_little_endian(data + 8, 4));
  const std::size_t size = std::size_t(internal::load_little_endian(data + 4, 4));
  const std::size_t missing = number_of_splits_in_file() - number_of_splits();
  const bool is_sound = m_has_base
                          ? m_splits >= 1 && m_splits <= (std::min)(missing, max_splits)
                              && size <= internal::max_section_bytes(m_splits)
                          : m_splits == 0;
  if(!is_sound)
    return refuse(Progressive_mesh_file_status::DAMAGED);
  expect(Part::SECTION, size);
}

inline void Progressive_mesh_decoder::take_section(const char* data)
{
  m_crc = internal::section_crc(m_splits, data, m_part_size, m_crc);
  if(m_crc != m_wanted_crc)
    return refuse(Progressive_mesh_file_status::DAMAGED);
  m_section.assign(data, data + m_part_size);
  m_section.resize(m_part_size + internal::Section_decoder::slack(m_splits), 0);
  const bool is_sound = m_has_base
                          ? m_sections.read_splits(m_splits, m_section.data(), m_part_size)
                          : m_sections.read_base(m_section.data(), m_part_size);
  if(!is_sound)
    return refuse(Progressive_mesh_file_status::DAMAGED);
  if(!m_has_base)
    m_sections.reserve(m_bytes_behind);
  m_has_base = true;
  if(number_of_splits() == number_of_splits_in_file())
    m_status = Progressive_mesh_file_status::COMPLETE;
  expect(Part::SECTION_HEADER, internal::section_header_size);
}

inline std::string Progressive_mesh_decoder::message() const
{
  const std::string splits = std::to_string(number_of_splits()) + " of its "
                           + std::to_string(number_of_splits_in_file()) + " splits";
  const std::string so_far = m_has_base ? "the mesh has " + splits
                                        : std::string("there is no mesh before that");
  switch(m_status) {
  case Progressive_mesh_file_status::COMPLETE:
    return "the file is complete";
  case Progressive_mesh_file_status::TRUNCATED:
    return m_has_base ? "the file ends early: " + so_far
                      : "the file ends before its coarsest mesh is complete";
  case Progressive_mesh_file_status::DAMAGED:
    return "the file is damaged: " + so_far;
  case Progressive_mesh_file_status::OTHER_FORMAT:
    return "this is not a progressive mesh file";
  default:
    return "this is a progressive mesh file of another version than "
         + std::to_string(internal::version_with_texture) + " and "
         + std::to_string(internal::version_without_texture);
  }
}

} // namespace Surface_mesh_multiresolution
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_MULTIRESOLUTION_PROGRESSIVE_MESH_DECODER_H
